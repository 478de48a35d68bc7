"""Threads: where a later strand passes through an active region, and the region's boundary there.

A thread needs room: some point of the strand, in the region, keeps its distance from the boundary.
The program keeps one vertex of the strand, the *witness*, that far away; it may slide along.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from knotopt.arrays import BoolArray, FloatArray, IntArray
from knotopt.path.mesh import Mesh
from knotopt.supports.regions import Regions
from knotopt.supports.threading import Threading
from knotopt.supports.threading_points import threading_points


@dataclass(frozen=True, eq=False)
class Threads:
    """All K threads of a cable's active regions.

    Attributes
    ----------
    witness : int array, shape (K,)
        Time of a turning point of the strand inside the region [grid steps].
    first, second : int array, shape (K, 2)
        Time intervals of the region's boundary; the second of a loop is empty, [0, -1].
    """

    witness: IntArray
    first: IntArray
    second: IntArray

    def __len__(self) -> int:
        return len(self.witness)

    def on_boundary(self, times: FloatArray) -> BoolArray:
        """Which times lie on each thread's boundary, shape (K, len(times))."""
        on: BoolArray = np.zeros((len(self), len(times)), dtype=bool)
        for interval in (self.first, self.second):
            on |= (interval[:, :1] <= times) & (times <= interval[:, 1:])
        return on


def find_threads(regions: Regions, robots: IntArray) -> Threads:
    """Every thread of every active region, any later turning point inside counting.

    Parameters
    ----------
    regions : Regions
    robots : int array
        Times of the robots: a turning point without one makes the better witness, as it can move.

    Examples
    --------
    >>> from knotopt.cable.cable import Cable
    >>> from knotopt.diagram.families import torus_knot
    >>> threads = find_threads(Regions(Cable(torus_knot(2, 3), "L+")), np.array([0, 23]))
    >>> threads.witness.tolist()
    [20, 20]
    """
    points = threading_points(regions, Threading.TURNING_POINT)
    times = regions.cable.times[points.point]
    order = np.lexsort((times, np.isin(times, robots), points.entry, points.region))
    strand = np.stack((points.region[order], points.entry[order]), axis=1)
    chosen = order[np.sort(np.unique(strand, axis=0, return_index=True)[1])]
    boundaries = regions.boundaries
    region = points.region[chosen]
    return Threads(times[chosen], boundaries.a[region], boundaries.b[region])


def opening_pairs(mesh: Mesh, threads: Threads, within: float) -> IntArray:
    """Witness and segment ends (vertices) of boundary segments so near to a witness, (K, 3)."""
    if not len(threads):
        return np.empty((0, 3), dtype=np.int64)
    on = threads.on_boundary(mesh.times)
    both = on[:, :-1] & on[:, 1:]
    # Two boundary intervals of a pocket can touch in no segment: a strand lies between them.
    thread, segment = np.nonzero(both)
    place = mesh.places(threads.witness)[thread]
    start, end = mesh.plan[segment], mesh.plan[segment + 1]
    near = segment_distances(mesh.plan[place], start, end) < within
    return np.stack((mesh.chain[place], mesh.chain[segment], mesh.chain[segment + 1]), axis=1)[near]


def segment_distances(points: FloatArray, starts: FloatArray, ends: FloatArray) -> FloatArray:
    """Distance of each point from its segment, shape (K,)."""
    along = ends - starts
    share = ((points - starts) * along).sum(axis=1) / np.maximum((along**2).sum(axis=1), 1e-300)
    nearest = starts + np.clip(share, 0, 1)[:, None] * along
    distances: FloatArray = np.linalg.norm(points - nearest, axis=1)
    return distances
