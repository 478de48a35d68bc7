"""What the checkers know of a formulation, kept apart from what the package makes sets with."""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

from knotopt.verify.piercing import bare_loops
from knotopt.verify.regions import Cell, DefinedRegion, define_regions

MODES = ("turning-point", "over-under")  # which turning points inside a region thread it


@dataclass(frozen=True)
class Closure:
    """A region that is not open, and why."""

    region: str
    reason: str


@dataclass(frozen=True)
class OpeningReport:
    """What a set of supports does to a cable.

    Attributes
    ----------
    closures : tuple of Closure
        Empty if every active region is r-open.
    closed_regions : tuple of int
        Indices of the regions that are not, as `define_regions` orders them.
    smallest_opening_squared : Fraction or None
        Smallest squared distance of a threading point from an edge of its polygon [grid steps^2],
        0 if a region is lost; None if there are no threading points.
    """

    closures: tuple[Closure, ...]
    closed_regions: tuple[int, ...]
    smallest_opening_squared: Fraction | None

    @property
    def is_open(self) -> bool:
        """Whether every active region is r-open."""
        return not self.closures


Checker = Callable[[Sequence[Cell], int, Collection[int], Fraction, str], OpeningReport]
"""Examines a set by a definition; parameters as of `knotopt.verify.opening.check_opening`."""


def and_loops(check: Checker) -> Checker:
    """The checker that also wants a support on every loop of the cable."""

    def checker(
        path: Sequence[Cell], size: int, supports: Collection[int], openness: Fraction, mode: str
    ) -> OpeningReport:
        report = check(path, size, supports, openness, mode)
        bare = bare_loops(path, supports)
        closures = (Closure(f"loop [{c},{r}]", "no support on it") for _, (c, r) in bare)
        return OpeningReport(
            (*closures, *report.closures),
            tuple(sorted({number for number, _ in bare} | {*report.closed_regions})),
            report.smallest_opening_squared,
        )

    return checker


@dataclass(frozen=True)
class Claim:
    """On one cut, `robots` - 1 robots are too few.

    Attributes
    ----------
    path : tuple of (column, row)
        Of the cable.
    size : int
        Of the grid.
    openness : Fraction
    mode : str
        One of `MODES`.
    robots : int
    with_loops : bool
        Whether a support is wanted on every loop, too.
    """

    path: tuple[Cell, ...]
    size: int
    openness: Fraction
    mode: str
    robots: int
    with_loops: bool = False

    @property
    def regions(self) -> tuple[DefinedRegion, ...]:
        """The cable's regions."""
        return define_regions(self.path, self.size)


Proof = Callable[[Claim, Mapping[str, Any]], None]
"""Reads a proof in a certificate's `bounds`; raises `CertificateError` if it does not prove the
claim."""


@dataclass(frozen=True)
class Definition:
    """One formulation.

    Attributes
    ----------
    name : str
    check : Checker
    modes : tuple of str
        Of `MODES`, those that it has.
    proofs : mapping of str to Proof
        By the `method` that a certificate names.
    """

    name: str
    check: Checker
    modes: tuple[str, ...]
    proofs: Mapping[str, Proof]

    def checker(self, *, with_loops: bool) -> Checker:
        """Examines a set by the definition, and by that of `loops` too, if asked."""
        return and_loops(self.check) if with_loops else self.check
