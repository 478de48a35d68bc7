"""Gates: places where a laid span is crossed at a right angle, straight before and after it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import combinations

import numpy as np
import shapely

from knotopt.arrays import BoolArray, FloatArray
from knotopt.flight.layout import Letter
from knotopt.flight.obstacles import Obstacles, nearest

PLACES = 0.2  # between candidates along a span [grid steps]
SHORTER = (1.0, 0.7, 0.5)  # shares of a straight run that are tried


@dataclass(frozen=True)
class RouteShape:
    """How generously a route goes through gates and past robots [grid steps].

    Parameters
    ----------
    run : float
        Straight run before and after each crossing.
    apart : float
        Between two crossings of one span, along it.
    clear : float
        From hovering robots.
    """

    run: float = 0.6
    apart: float = 0.8
    clear: float = 0.4


@dataclass(frozen=True)
class Gate:
    """Where a route crosses a laid span.

    Attributes
    ----------
    letter : Letter
    place, heading : tuple of float
        Where, and the unit vector of flight there.
    run : float
        Straight run before and after.
    along : float
        Arc length of the place on the older span, in plan.
    """

    letter: Letter
    place: tuple[float, float]
    heading: tuple[float, float]
    run: float
    along: float

    @property
    def entry(self) -> FloatArray:
        """Where the straight run begins."""
        return np.array(self.place) - self.run * np.array(self.heading)

    @property
    def exit(self) -> FloatArray:
        """Where the straight run ends."""
        return np.array(self.place) + self.run * np.array(self.heading)


Crossed = Mapping[int, Sequence[tuple[float | None, float]]]
"""For each span, its crossings so far: rank, if any, and arc length along the span."""


def possible_gates(
    letter: Letter, crossed: Crossed, obstacles: Obstacles, run: float
) -> list[Gate]:
    """Gates for a letter: places on its span between that span's neighbouring crossings.

    Each has the longest straight run, of a few shares of `run`, that meets nothing.
    """
    line = obstacles.laid[letter.older - 1]
    low, high = _stretch(letter, crossed.get(letter.older, ()), line.length)
    found = []
    for along in np.arange(PLACES, line.length, PLACES).tolist():
        if not low < along < high:
            continue
        ends = (max(along - 0.05, 0), min(along + 0.05, line.length))
        a, b = (np.array(line.interpolate(end).coords[0]) for end in ends)
        ahead = (b - a) / np.hypot(*(b - a))
        heading = letter.sense * np.array([-ahead[1], ahead[0]])
        place = line.interpolate(along).coords[0]
        for share in SHORTER:
            gate = Gate(letter, place, (heading[0], heading[1]), share * run, along)
            if _is_free(gate, obstacles):
                found.append(gate)
                break
    return found


def are_in_order(before: Sequence[Gate], after: Sequence[Gate], apart: float) -> BoolArray:
    """Whether gates of two letters may go together, shape (before, after).

    Those of one span are at least `apart` from each other along it, and in the order of their
    letters' ranks.
    """
    first, second = before[0].letter, after[0].letter
    if first.older != second.older:
        return np.ones((len(before), len(after)), dtype=bool)
    a = np.array([gate.along for gate in before])
    b = np.array([gate.along for gate in after])
    ahead = b[None] - a[:, None]
    if first.rank is not None and second.rank is not None:
        ahead *= np.sign(second.rank - first.rank)
    else:
        ahead = np.abs(ahead)
    return np.asarray(ahead >= apart - 1e-9)


def all_in_order(gates: Sequence[Gate], apart: float) -> bool:
    """Whether every two of these gates, one for each letter, may go together."""
    return all(are_in_order([one], [other], apart).all() for one, other in combinations(gates, 2))


def _stretch(
    letter: Letter, crossings: Sequence[tuple[float | None, float]], length: float
) -> tuple[float, float]:
    """The part of a span on which a letter keeps its rank among the span's crossings."""
    if letter.rank is None:
        return 0.0, length
    ranked = [(rank, along) for rank, along in crossings if rank is not None]
    before = [along for rank, along in ranked if rank < letter.rank]
    after = [along for rank, along in ranked if rank > letter.rank]
    return max(before, default=0.0), min(after, default=length)


def _is_free(gate: Gate, obstacles: Obstacles) -> bool:
    """Whether a gate's run meets no other cable and no robot."""
    ends = np.stack((gate.entry, np.array(gate.place), gate.exit))
    if nearest(ends, obstacles.posts).min() < obstacles.clear:
        return False
    share = 0.02 / gate.run
    halves = [shapely.LineString([ends[1] + share * (ends[k] - ends[1]), ends[k]]) for k in (0, 2)]
    return not any(half.intersects(obstacles.cable) for half in halves)
