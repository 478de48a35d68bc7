"""Invariants of a knot from a diagram of it, by this package's own code alone."""

from __future__ import annotations

from dataclasses import dataclass

from knotopt.cable.alexander import alexander_from_gauss, determinant
from knotopt.identify import jones
from knotopt.planar.planar_diagram import PlanarDiagram
from knotopt.planar.signature import signature

MAX_CROSSINGS = 120
"""Crossings of a diagram whose Alexander polynomial is computed: it takes about a second."""
MAX_SIGNATURE_CROSSINGS = 1000
"""Crossings of one whose signature is computed: as long."""


@dataclass(frozen=True)
class Invariants:
    """What is computed of a knot, exactly.

    Attributes
    ----------
    signature : int or None
        In KnotInfo's sign: positive knots have a negative one. None for a diagram of more than
        `MAX_SIGNATURE_CROSSINGS` crossings.
    alexander : tuple of int or None
        Alexander polynomial, constant term first, leading coefficient positive; None for a diagram
        of more than `MAX_CROSSINGS` crossings.
    jones : mapping of power to coefficient, or None
        Jones polynomial in t; None for a diagram that is too wide.
    """

    signature: int | None
    alexander: tuple[int, ...] | None
    jones: jones.Polynomial | None

    @property
    def determinant(self) -> int | None:
        """Determinant, the Alexander polynomial at -1 without its sign."""
        return None if self.alexander is None else determinant(self.alexander)


def invariants(planar: PlanarDiagram) -> Invariants:
    """The invariants of a diagram's knot.

    Examples
    --------
    >>> invariants(PlanarDiagram(((0, 4, 1, 3), (2, 0, 3, 5), (4, 2, 5, 1))))
    Invariants(signature=-2, alexander=(1, -1, 1), jones={1: 1, 3: 1, 4: -1})
    """
    return Invariants(signature_or_none(planar), alexander(planar), jones.jones_polynomial(planar))


def alexander(planar: PlanarDiagram) -> tuple[int, ...] | None:
    """Alexander polynomial; None for a diagram of more than `MAX_CROSSINGS` crossings."""
    if len(planar.crossings) > MAX_CROSSINGS:
        return None
    visits = [crossing for crossing, _ in planar.visits]
    return alexander_from_gauss(visits, [over for _, over in planar.visits], planar.signs)


def signature_or_none(planar: PlanarDiagram) -> int | None:
    """Signature; None for a diagram of more than `MAX_SIGNATURE_CROSSINGS` crossings."""
    return signature(planar) if len(planar.crossings) <= MAX_SIGNATURE_CROSSINGS else None
