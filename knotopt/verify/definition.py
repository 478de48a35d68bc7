"""What the checkers know of a formulation, kept apart from what the package makes sets with."""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Any, Protocol

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


class Checker(Protocol):
    """Examines a set by a definition; parameters as of `knotopt.verify.opening.check_opening`."""

    def __call__(
        self,
        path: Sequence[Cell],
        size: int,
        supports: Collection[int],
        openness: Fraction,
        mode: str,
        /,
    ) -> OpeningReport: ...


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
    """

    path: tuple[Cell, ...]
    size: int
    openness: Fraction
    mode: str
    robots: int

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
