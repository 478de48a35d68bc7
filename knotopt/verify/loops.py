"""Whether a set of supports pierces every loop of a cable, which is the definition of `loops`.

A proof that fewer do not are loops of which no two have a turning point in common: each needs a
support of its own.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from fractions import Fraction
from typing import Any

from knotopt.errors import CertificateError
from knotopt.verify.definition import MODES, Claim, Definition, OpeningReport, and_loops
from knotopt.verify.fields import field, integers
from knotopt.verify.piercing import loop_clauses, loops_of
from knotopt.verify.proofs import by_counting, by_refutation
from knotopt.verify.regions import Cell


def check_loops(
    path: Sequence[Cell],
    size: int,
    supports: Collection[int],
    openness: Fraction = Fraction(1, 2),
    mode: str = "turning-point",
) -> OpeningReport:
    """Whether a support lies on every loop.

    Parameters
    ----------
    path, supports
        As for `check_opening`.
    size, openness, mode
        Of no account.

    Examples
    --------
    >>> path = [(1, 5), (4, 5), (4, 2), (2, 2), (2, 4), (5, 4), (5, 1), (3, 1), (3, 3), (1, 3)]
    >>> [check_loops(path, 5, held).is_open for held in ([5], [4])]
    [True, False]
    """
    return and_loops(_anything)(path, size, supports, openness, mode)


def _anything(*_: Any) -> OpeningReport:
    return OpeningReport((), (), None)


def _disjoint_loops(claim: Claim, content: Mapping[str, Any]) -> None:
    """Loops by the [column, row] of their crossings, each needing a support of its own."""
    known = loops_of(claim.path)
    owner: dict[int, tuple[int, ...]] = {}
    loops = [integers(cell, "loops") for cell in field(content, "loops", list)]
    for cell in loops:
        points = known.get((cell[0], cell[1])) if len(cell) == 2 else None
        if points is None:
            raise CertificateError(f"loops: {list(cell)} is no crossing of this cable")
        for point in points:
            if point in owner:
                raise CertificateError(
                    f"loops: those at {list(owner[point])} and {list(cell)} share p{point}"
                )
            owner[point] = cell
    if len(loops) < claim.robots - 2:
        raise CertificateError(f"loops: {len(loops)} need no {claim.robots - 2} supports")


LOOPS = Definition(
    name="loops",
    check=check_loops,
    modes=MODES,
    proofs={
        "disjoint loops": _disjoint_loops,
        "refutation": by_refutation(lambda claim, _: loop_clauses(claim.path)),
        "count": by_counting(check_loops),
    },
)
