"""The exact test `laid`: whether a cable, laid in straight spans, is still the knot.

The laid cable's diagram is the grid's with every lost hook (`knotopt.laid.hooks`) turned over: the
later strand, held by nothing there, passes above. What its knot is, invariants say.

Crossings that are over as well, and are not flown since they undo each other or belong to one span,
are drawn with it; what is hooked between them later then counts as beyond them. So where the
crossings that are flown make a diagram by themselves, that has to be the knot, too.
"""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from knotopt.cable.cable import Cable
from knotopt.errors import DiagramError
from knotopt.laid.hooks import LostHook, flown_crossings, lost_hooks
from knotopt.laid.invariants import Invariants
from knotopt.laid.ways import Ways
from knotopt.planar.gauss import from_visits
from knotopt.planar.planar_diagram import PlanarDiagram


def laid_diagram(cable: Cable, lost: Collection[int]) -> PlanarDiagram:
    """The closed cable's diagram with some hooks turned over.

    Parameters
    ----------
    cable : Cable
    lost : collection of int
        Indices into `cable.crossings` of crossings with the first visit over.

    Examples
    --------
    >>> from knotopt.diagram.families import torus_knot
    >>> cable = Cable(torus_knot(2, 3), "L+")
    >>> laid_diagram(cable, ()).signs, laid_diagram(cable, (0,)).signs
    ((1, 1, 1), (-1, 1, 1))
    """
    crossings = cable.crossings
    turned = np.isin(np.arange(len(crossings)), list(lost))
    _, index, over = cable.visits
    signs = np.where(turned, -crossings.sign, crossings.sign)
    return from_visits(index.tolist(), (over ^ turned[index]).tolist(), signs.tolist())


@dataclass(frozen=True)
class Laid:
    """A cable laid with a set of supports, and what became of its crossings.

    Attributes
    ----------
    supports : tuple of int
        Turning points with a support robot (1-based).
    lost : tuple of LostHook
    needed : tuple of int
        Those of the lost crossings that, turned over alone, change the knot; the others were
        redundant.
    apart : str or None
        The invariant that tells the laid cable from the knot; None if it is the knot as far as
        invariants say. For certain it is where every crossing is flown: the diagram is the grid's.
    """

    supports: tuple[int, ...]
    lost: tuple[LostHook, ...]
    needed: tuple[int, ...]
    apart: str | None

    @property
    def is_knot(self) -> bool:
        """Whether no invariant tells the laid cable from the knot."""
        return self.apart is None

    @property
    def redundant(self) -> tuple[int, ...]:
        """The lost crossings that, turned over alone, leave the knot what it is."""
        return tuple(each.crossing for each in self.lost if each.crossing not in self.needed)


class LaidTest:
    """The test for one cable; what invariants say of a diagram is kept.

    Parameters
    ----------
    cable : Cable

    Examples
    --------
    Two sets of three robots on Table I's trefoil; the second one loses a crossing, and the knot:

    >>> from knotopt.catalogue.table1_grids import table1_grids
    >>> trefoil = table1_grids()[0].diagram
    >>> LaidTest(Cable(trefoil, "L+")).laid((4,)).is_knot
    True
    >>> laid = LaidTest(Cable(trefoil, "R+")).laid((8,))
    >>> laid.apart, laid.needed, laid.redundant
    ('Alexander polynomial', (0,), ())
    """

    def __init__(self, cable: Cable) -> None:
        self.cable = cable
        self._apart: dict[frozenset[int], str | None] = {frozenset(): None}
        self._as_flown: dict[tuple[int, ...], str | None] = {}

    @cached_property
    def hooks(self) -> tuple[int, ...]:
        """Crossings whose later visit passes under, as indices into `cable.crossings`."""
        return tuple(np.flatnonzero(self.cable.crossings.first_over).tolist())

    @cached_property
    def knot(self) -> Invariants:
        """Of the grid's own diagram."""
        return Invariants(laid_diagram(self.cable, ()))

    @cached_property
    def ways(self) -> Ways:
        """The diagrams that losing hooks can leave."""
        return Ways(self.knot.planar)

    def apart(self, lost: Collection[int]) -> str | None:
        """The invariant that tells the knot with these hooks turned over from the grid's."""
        key = frozenset(lost)
        if key not in self._apart:
            self._apart[key] = self.knot.apart(Invariants(laid_diagram(self.cable, key)))
        return self._apart[key]

    def apart_as_flown(self, flown: Collection[int]) -> str | None:
        """The invariant that tells the cable with these crossings alone from the grid's.

        None also where they cannot be drawn in the plane without others.
        """
        key = tuple(sorted(flown))
        if key not in self._as_flown:
            number = {c: k for k, c in enumerate(key)}
            _, index, over = self.cable.visits
            kept = [
                (number[c], o)
                for c, o in zip(index.tolist(), over.tolist(), strict=True)
                if c in number
            ]
            signs = self.cable.crossings.sign[list(key)].tolist()
            try:
                planar = from_visits([c for c, _ in kept], [o for _, o in kept], signs)
            except DiagramError:
                self._as_flown[key] = None
            else:
                self._as_flown[key] = self.knot.apart(Invariants(planar))
        return self._as_flown[key]

    def laid(self, supports: tuple[int, ...]) -> Laid:
        """What a set of supports makes of the cable.

        Raises
        ------
        RequirementError
            A support that is no turning point between the ends.
        """
        lost = lost_hooks(self.cable, supports)
        crossings = [each.crossing for each in lost]
        needed = tuple(c for c in crossings if self.apart({c}) is not None)
        apart = self.apart(crossings)
        if apart is None:
            apart = self.apart_as_flown(flown_crossings(self.cable, supports))
        return Laid(supports, lost, needed, apart)
