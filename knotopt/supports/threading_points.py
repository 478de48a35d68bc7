"""Threading points: where a later strand passes through a region, which must then stay open."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from knotopt.arrays import IntArray
from knotopt.supports.regions import Regions
from knotopt.supports.threading import Threading


@dataclass(frozen=True, eq=False)
class ThreadingPoints:
    """All K threading points of a cable's regions, sorted by region, then by time.

    Attributes
    ----------
    region : int array, shape (K,), index of the region
    point : int array, shape (K,), index of the turning point (0-based)
    entry : int array, shape (K,)
        Time at which the strand through the point enters the region over its boundary
        [grid steps].
    """

    region: IntArray
    point: IntArray
    entry: IntArray

    def __len__(self) -> int:
        return len(self.region)

    def first_of_strands(self) -> ThreadingPoints:
        """Of each strand only the turning point that it meets first."""
        strand = np.stack((self.region, self.entry), axis=1)
        first = np.sort(np.unique(strand, axis=0, return_index=True)[1])
        return ThreadingPoints(self.region[first], self.point[first], self.entry[first])


def threading_points(regions: Regions, mode: Threading) -> ThreadingPoints:
    """The threading points of every region.

    A strand is what runs inside a region between two visits to its boundary; a strand that passes
    a boundary inside the region (a loop may cross itself) counts as two.

    Examples
    --------
    >>> from knotopt.cable.cable import Cable
    >>> from knotopt.diagram.families import torus_knot
    >>> regions = Regions(Cable(torus_knot(2, 3), "L+"))
    >>> found = threading_points(regions, Threading.TURNING_POINT)
    >>> list(zip(found.region.tolist(), (found.point + 1).tolist(), found.entry.tolist()))
    [(0, 9, 19), (1, 9, 19)]
    """
    cable = regions.cable
    region, point = np.nonzero(regions.later)
    visits, crossing, over = cable.visits
    crossings, every = cable.crossings, slice(None)
    # The strand through a point enters and leaves at the visits next to it whose crossing lies on
    # the boundary; runs of visits off the boundary are skipped with a running maximum.
    on = regions.boundaries.contain(every, crossings.first[crossing])
    on |= regions.boundaries.contain(every, crossings.second[crossing])
    place = np.arange(len(visits))
    before = np.maximum.accumulate(np.where(on, place, -1), axis=1)
    reverse = np.where(on, place, len(visits))[:, ::-1]
    after = np.minimum.accumulate(reverse, axis=1)[:, ::-1]
    next_visit = np.searchsorted(visits, cable.times[point])
    entered = before[region, next_visit - 1]
    left = after[region, np.minimum(next_visit, len(visits) - 1)]
    left = np.where(next_visit == len(visits), len(visits), left)
    if mode is Threading.OVER_UNDER:
        leaves = left < len(visits)
        chosen = leaves & (over[entered] != over[np.where(leaves, left, 0)])
        region, point, entered = region[chosen], point[chosen], entered[chosen]
    return ThreadingPoints(region, point, visits[entered])
