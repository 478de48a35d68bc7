"""What tells the knots of two planar diagrams apart: polynomial, signature, knot Floer homology.

The Alexander polynomial and the signature are computed here, in exact integers. Knot Floer homology
(Ozsvath and Szabo, doi:10.1016/j.aim.2003.05.001) detects the unknot, the trefoils, the figure
eight and 5_1, and tells most mirror images apart; it is asked for where the package
`knot_floer_homology` is installed, which is GPL and no part of this one.
"""

from __future__ import annotations

import importlib
import importlib.util
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

from knotopt.cable.alexander import alexander_from_gauss
from knotopt.errors import DiagramError
from knotopt.planar.gauss import from_visits
from knotopt.planar.planar_diagram import PlanarDiagram
from knotopt.planar.signature import signature

Ranks = tuple[tuple[tuple[int, int], int], ...]  # ((Alexander, Maslov grading), rank), ascending

UNKNOT: Ranks = (((0, 0), 1),)
HOMOLOGY = "knot_floer_homology"


@dataclass(frozen=True)
class Invariants:
    """Invariants of the knot of a diagram, each computed when it is first asked for.

    Examples
    --------
    >>> trefoil = Invariants(PlanarDiagram(((0, 4, 1, 3), (2, 0, 3, 5), (4, 2, 5, 1))))
    >>> trefoil.alexander, trefoil.signature
    ((1, -1, 1), -2)
    """

    planar: PlanarDiagram

    @cached_property
    def reduced(self) -> PlanarDiagram:
        """A diagram of the same knot without the crossings that simple moves take away."""
        return without_kinks(self.planar)

    @cached_property
    def alexander(self) -> tuple[int, ...]:
        """Alexander polynomial: coefficients, constant term first, the last one positive."""
        visits = self.reduced.visits
        return alexander_from_gauss(
            [c for c, _ in visits], [over for _, over in visits], self.reduced.signs
        )

    @cached_property
    def signature(self) -> int:
        """Signature, in KnotInfo's sign."""
        return signature(self.reduced)

    @cached_property
    def homology(self) -> Ranks | None:
        """Ranks of knot Floer homology; None where its package is not installed."""
        if importlib.util.find_spec(HOMOLOGY) is None:
            return None
        if not self.reduced.crossings:
            return UNKNOT
        package: Any = importlib.import_module(HOMOLOGY)
        code = [list(crossing) for crossing in self.reduced.pd_code]
        ranks = tuple(sorted(package.pd_to_hfk(code)["ranks"].items()))
        # The package takes reduced diagrams only, and does not say so: its Euler characteristic is
        # the polynomial.
        if _euler(ranks) != self.alexander:
            raise DiagramError(f"{HOMOLOGY} contradicts the Alexander polynomial of {self.planar}")
        return ranks

    def apart(self, other: Invariants) -> str | None:
        """The first invariant that tells the two knots apart, in words; None if none does."""
        if self.alexander != other.alexander:
            return "Alexander polynomial"
        if self.signature != other.signature:
            return "signature"
        return "knot Floer homology" if self.homology != other.homology else None


def _euler(ranks: Ranks) -> tuple[int, ...]:
    """Graded Euler characteristic: coefficients, the last one positive."""
    sums: Counter[int] = Counter()
    for (alexander, maslov), rank in ranks:
        sums[alexander] += rank if maslov % 2 == 0 else -rank
    degrees = [degree for degree, total in sums.items() if total]
    found = [sums[degree] for degree in range(min(degrees), max(degrees) + 1)]
    return tuple(total if found[-1] > 0 else -total for total in found)


def compared_by() -> str:
    """The invariants that `Invariants.apart` looks at here, in words."""
    known = "Alexander polynomial and signature"
    if importlib.util.find_spec(HOMOLOGY) is None:
        return known
    return "Alexander polynomial, signature and knot Floer homology"


def without_kinks(planar: PlanarDiagram) -> PlanarDiagram:
    """A diagram of the same knot, as far as crossings go away that are easily seen not to matter.

    These are nugatory crossings, which part the diagram in two (kinks are the simplest), and pairs
    of Reidemeister's second move.

    Examples
    --------
    >>> without_kinks(PlanarDiagram(((0, 0, 1, 1),))).crossings
    ()
    """
    visits, signs = list(planar.visits), planar.signs
    while gone := _kink(visits) or _pair(visits, signs):
        visits = [visit for visit in visits if visit[0] not in gone]
    kept = {c: number for number, c in enumerate(dict.fromkeys(c for c, _ in visits))}
    return from_visits(
        [kept[c] for c, _ in visits], [over for _, over in visits], [signs[c] for c in kept]
    )


def _kink(visits: list[tuple[int, bool]]) -> set[int]:
    """A crossing between whose visits every other one is visited twice, or not at all.

    It joins two parts of the knot, which are summands however they are joined.
    """
    first: dict[int, int] = {}
    for place, (crossing, _) in enumerate(visits):
        start = first.setdefault(crossing, place)
        if start < place:
            between = Counter(other for other, _ in visits[start + 1 : place])
            if all(count == 2 for count in between.values()):
                return {crossing}
    return set()


def _pair(visits: list[tuple[int, bool]], signs: Sequence[int]) -> set[int]:
    """Two crossings that one strand passes over in turn, there and back, and another under.

    In the plane such neighbours bound a face of two sides (second move).
    """
    met: dict[frozenset[int], bool] = {}
    for (crossing, over), (following, also) in zip(visits[-1:] + visits, visits, strict=False):
        pair = frozenset((crossing, following))
        opposite = signs[crossing] != signs[following]
        if over == also and opposite and met.setdefault(pair, over) != over:
            return set(pair)
    return set()
