"""Two guesses at what a set of supports ties in flight, by the diagram alone.

They are heuristics, measured against flights in docs/laid.md: neither is a theorem of the taut
cable, nor the exact test `knotopt.laid.laid`, which compares the flight's own words.

- Test A, `self_crossings_over`: every crossing of a span with itself becomes one that the later
  visit passes over.
- Test C, `monotone_windings`: so it does; then the crossings that a strand passes over, in order,
  undo each other where they are neighbours, there and back over one older span (between two of them
  it may have passed under), and those become under; and where a strand winds about an older span,
  the crossings of the winding slide until they follow each other along that span, one way or the
  other.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import groupby, product

import numpy as np

from knotopt.cable.cable import Cable
from knotopt.errors import DiagramError
from knotopt.flight.layout import Letter, undone_pairs
from knotopt.laid.invariants import Invariants
from knotopt.laid.laid import LaidTest
from knotopt.path.mesh import robot_times
from knotopt.planar.gauss import from_visits

MOST_RUNS = 6
"""Windings that are tried both ways; further ones only forwards."""


def self_crossings_over(test: LaidTest, supports: tuple[int, ...]) -> bool:
    """Test A: whether the knot is left when each span's crossings with itself are turned over.

    Parameters
    ----------
    test : LaidTest
        Of the cable.
    supports : tuple of int
        Turning points with a support robot (1-based).

    Raises
    ------
    RequirementError
        A support that is no turning point between the ends.
    """
    marked = _Marked.of(test.cable, supports)
    return test.apart([c for c in test.hooks if marked.is_own(c)]) is None


def monotone_windings(test: LaidTest, supports: tuple[int, ...]) -> bool | None:
    """Test C: whether the knot is left when crossings slide as a taut tether's would.

    Returns
    -------
    bool or None
        None if the windings cannot be drawn in the plane as they would be.

    Parameters, raises
        As for `self_crossings_over`.
    """
    marked = _Marked.of(test.cable, supports).taut()
    if test.knot.apart(marked.invariants) is not None:
        return False
    runs = [run for run in marked.windings() if not marked.is_monotone(run)]
    if not runs:
        return True
    drawn = False
    for ways in product((False, True), repeat=min(len(runs), MOST_RUNS)):
        try:
            laid = marked.slid(runs, [*ways, *[False] * (len(runs) - len(ways))]).invariants
        except DiagramError:
            continue
        drawn = True
        if test.knot.apart(laid) is None:
            return True
    return False if drawn else None


@dataclass(frozen=True)
class _Marked:
    """A cable's code, in which crossings can be changed.

    Attributes
    ----------
    order : tuple of int
        The crossing at each visit.
    first_over : tuple of bool
        Of each crossing.
    signs : tuple of int
    spans : tuple of (int, int)
        The spans of each crossing's older and later visit.
    """

    order: tuple[int, ...]
    first_over: tuple[bool, ...]
    signs: tuple[int, ...]
    spans: tuple[tuple[int, int], ...]

    @classmethod
    def of(cls, cable: Cable, supports: tuple[int, ...]) -> _Marked:
        crossings, times = cable.crossings, robot_times(cable, supports)
        older, later = np.searchsorted(times, (crossings.first, crossings.second), side="left")
        return cls(
            tuple(cable.visits[1].tolist()),
            tuple(crossings.first_over.tolist()),
            tuple(crossings.sign.tolist()),
            tuple(zip(older.tolist(), later.tolist(), strict=True)),
        )

    def is_own(self, crossing: int) -> bool:
        """Whether a span crosses itself there."""
        older, later = self.spans[crossing]
        return older == later

    def flown(self) -> list[int]:
        """Crossings of different spans, in the order of their later visits."""
        seen, found = set[int](), []
        for crossing in self.order:
            if crossing in seen and not self.is_own(crossing):
                found.append(crossing)
            seen.add(crossing)
        return found

    def taut(self) -> _Marked:
        """Own crossings turned over, and over ones that undo each other turned under."""
        turned = {c for c, over in enumerate(self.first_over) if over and self.is_own(c)}
        over = [c for c in self.flown() if not self.first_over[c]]
        for _, strand in groupby(over, key=lambda c: self.spans[c][1]):
            word = list(strand)
            letters = [Letter(self.spans[c][0], True, -self.signs[c], None) for c in word]
            turned |= {word[place] for pair in undone_pairs(letters) for place in pair}
        return replace(
            self,
            first_over=tuple(over != (c in turned) for c, over in enumerate(self.first_over)),
            signs=tuple(-s if c in turned else s for c, s in enumerate(self.signs)),
        )

    def windings(self) -> Iterator[list[int]]:
        """Crossings in turn in which a strand turns one way about one older span."""

        def turning(crossing: int) -> tuple[tuple[int, int], int]:
            # The strand goes round one way if it comes back below, from the other side.
            return self.spans[crossing], self.signs[crossing]

        for _, run in groupby(self.flown(), key=turning):
            yield list(run)

    def is_monotone(self, run: Sequence[int]) -> bool:
        """Whether crossings lie along the older span as they follow each other on the later."""
        places = [self.order.index(crossing) for crossing in run]
        return places in (sorted(places), sorted(places, reverse=True))

    def slid(self, runs: Sequence[Sequence[int]], backwards: Sequence[bool]) -> _Marked:
        """Crossings of windings put in order along their older span."""
        order = list(self.order)
        for run, is_back in zip(runs, backwards, strict=True):
            places = sorted((self.order.index(c) for c in run), reverse=is_back)
            for crossing, place in zip(run, places, strict=True):
                order[place] = crossing
        return replace(self, order=tuple(order))

    @property
    def invariants(self) -> Invariants:
        """Of the closed cable.

        Raises
        ------
        DiagramError
            It cannot be drawn in the plane.
        """
        seen, over = set[int](), []
        for crossing in self.order:
            over.append(self.first_over[crossing] != (crossing in seen))
            seen.add(crossing)
        return Invariants(from_visits(self.order, over, self.signs))
