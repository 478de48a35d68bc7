"""Boundaries of loops and pockets: which path intervals enclose a region (eq. 7 and 8).

Loops come one to a crossing. A pocket closes when a strand passes its second crossing with an arc
laid before, so its later interval runs between two CONSECUTIVE second visits: of C crossings there
are at most C - 1 pockets, and they are found in one pass instead of among all pairs.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from knotopt.arrays import BoolArray, IntArray
from knotopt.cable.cable import Cable


@dataclass(frozen=True, eq=False)
class Boundaries:
    """Boundaries of R regions as arrays: all loops by first visit, then all pockets by closing.

    Walking round the boundary from its start means: interval A forward in time, then interval B,
    forward or backward. A loop has A = [t1, t2] and an empty B.

    Attributes
    ----------
    apexes : int array, shape (R, 2)
        The region's own crossings in the order met, twice the same one for a loop.
    a, b : int array, shape (R, 2)
        First and last time of the intervals A and B [grid steps]; B of a loop is [0, -1].
    b_forward : bool array, shape (R,)
        Whether B is walked forward in time.
    """

    apexes: IntArray
    a: IntArray
    b: IntArray
    b_forward: BoolArray

    def __post_init__(self) -> None:
        for array in (self.apexes, self.a, self.b, self.b_forward):
            array.setflags(write=False)

    def __len__(self) -> int:
        return len(self.apexes)

    @property
    def is_pocket(self) -> BoolArray:
        """Whether the region is a pocket, shape (R,)."""
        pocket: BoolArray = self.b[:, 1] >= 0
        return pocket

    def contain(self, region: IntArray | slice, times: IntArray) -> BoolArray:
        """Which of T times lie on the boundaries of the given regions, shape (len, T)."""
        a, b = self.a[region, :, None], self.b[region, :, None]
        on: BoolArray = (a[:, 0] <= times) & (times <= a[:, 1])
        on |= (b[:, 0] <= times) & (times <= b[:, 1])
        return on

    def position(self, region: IntArray, time: IntArray) -> IntArray:
        """Distance walked round the boundary from its start to the given times [grid steps].

        `region` and `time` broadcast; each time must lie on its region's boundary.
        """
        a0, a1 = self.a[region, 0], self.a[region, 1]
        b0, b1 = self.b[region, 0], self.b[region, 1]
        in_a = (a0 <= time) & (time <= a1)
        along_b = np.where(self.b_forward[region], time - b0, b1 - time)
        position: IntArray = np.where(in_a, time - a0, a1 - a0 + along_b)
        return position


def find_boundaries(cable: Cable) -> Boundaries:
    """Boundaries of every loop and every pocket of a cable.

    O(C) memory and at worst O(C^2) time for C crossings, on arrays.

    Examples
    --------
    >>> from knotopt.diagram.families import torus_knot
    >>> boundaries = find_boundaries(Cable(torus_knot(2, 3), "L+"))
    >>> boundaries.apexes.tolist()
    [[0, 0], [1, 1], [2, 2], [0, 1], [1, 2]]
    """
    crossings = cable.crossings
    count = len(crossings)
    closing = np.argsort(crossings.second)
    first, second = crossings.first[closing], crossings.second[closing]

    # Pocket k is closed by the strand that runs from the k-th second visit to the next one.
    start, end = second[:-1], second[1:]
    low, high = np.minimum(first[:-1], first[1:]), np.maximum(first[:-1], first[1:])
    # Interval A must be a single arc of the diagram laid so far: no visit strictly inside it of a
    # crossing that is complete when the pocket closes. (So A also ends before B starts: otherwise
    # the start of B, which completes its crossing, would lie inside A.)
    visits, index, _ = cable.visits
    complete = np.append(crossings.second[index], cable.length)  # reduceat needs a last entry
    inside = np.stack((np.searchsorted(visits, low) + 1, np.searchsorted(visits, high)), axis=1)
    occupied = inside[:, 0] < inside[:, 1]
    soonest = np.minimum.reduceat(complete, inside.ravel())[::2] if count > 1 else end
    kept = np.flatnonzero(~(occupied & (soonest <= end)))

    # B starts at the crossing where A ends; that is the k-th one exactly if A runs backward.
    forward = first[kept] > first[kept + 1]
    met_first = closing[kept + forward]
    met_second = closing[kept + ~forward]
    loops = np.arange(count)
    return Boundaries(
        apexes=np.column_stack((np.append(loops, met_first), np.append(loops, met_second))),
        a=np.column_stack(
            (np.append(crossings.first, low[kept]), np.append(crossings.second, high[kept]))
        ),
        b=np.column_stack((np.append(0 * loops, start[kept]), np.append(0 * loops - 1, end[kept]))),
        b_forward=np.concatenate((np.ones(count, dtype=bool), forward)),
    )
