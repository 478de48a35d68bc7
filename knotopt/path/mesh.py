"""The mesh: a cable's path as vertices in the plane, crossings shared by their two strands.

Every place on the path keeps its *time*, the arc length from p_1 on the grid, whatever becomes of
its position: robots, crossings and threading points are found by their times. A fixed frame lies
around the grid; triangles fill it.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from knotopt.arrays import BoolArray, FloatArray, IntArray
from knotopt.cable.cable import Cable
from knotopt.errors import RequirementError

MARGIN = 2.0  # from the grid to its frame [grid steps]
FRAME = 4  # vertices of the frame


@dataclass(frozen=True, eq=False)
class Mesh:
    """A path's vertices and places; see `lay_mesh` for the first one.

    Attributes
    ----------
    cable : Cable
    supports : tuple of int
        Turning points with a support robot (1-based), increasing.
    positions : float array, shape (V, 2) [grid steps]
        The path's vertices, then the frame's.
    chain : int array, shape (m,)
        Vertex at each place of the path.
    times : float array, shape (m,), increasing [grid steps]
    heights : float array, shape (m,) [grid steps]
    """

    cable: Cable
    supports: tuple[int, ...]
    positions: FloatArray
    chain: IntArray
    times: FloatArray
    heights: FloatArray

    def moved(self, positions: FloatArray, heights: FloatArray) -> Mesh:
        """The same mesh somewhere else."""
        return replace(self, positions=positions, heights=heights)

    def places(self, times: IntArray) -> IntArray:
        """Where on the path the given times are; they must be places."""
        return np.searchsorted(self.times, times)

    @cached_property
    def robots(self) -> IntArray:
        """Places of all robots along the path."""
        return self.places(robot_times(self.cable, self.supports))

    @cached_property
    def over(self) -> IntArray:
        """Place of each crossing's upper visit, shape (C,)."""
        return self._visits(self.cable.crossings.first_over)

    @cached_property
    def under(self) -> IntArray:
        """Place of each crossing's lower visit, shape (C,)."""
        return self._visits(~self.cable.crossings.first_over)

    def _visits(self, is_first: BoolArray) -> IntArray:
        crossings = self.cable.crossings
        return self.places(np.where(is_first, crossings.first, crossings.second))

    @cached_property
    def joints(self) -> IntArray:
        """Places of robots and crossing visits in order: the ends of arcs."""
        return np.unique(np.concatenate((self.robots, self.over, self.under)))

    @cached_property
    def segments(self) -> IntArray:
        """Vertices at the ends of each segment, shape (m - 1, 2)."""
        return np.stack((self.chain[:-1], self.chain[1:]), axis=1)

    @cached_property
    def lengths(self) -> FloatArray:
        """Length of each segment in plan, shape (m - 1,)."""
        lengths: FloatArray = np.linalg.norm(np.diff(self.plan, axis=0), axis=1)
        return lengths

    @property
    def plan(self) -> FloatArray:
        """Position of every place, shape (m, 2)."""
        return self.positions[self.chain]

    @property
    def points(self) -> FloatArray:
        """The path in space, shape (m, 3)."""
        return np.column_stack((self.plan, self.heights))

    @cached_property
    def held(self) -> BoolArray:
        """Which vertices stay where they are, shape (V,): robots and frame."""
        held = np.zeros(len(self.positions), dtype=bool)
        held[self.chain[self.robots]] = True
        held[-FRAME:] = True
        return held


def between(points: FloatArray | IntArray, places: FloatArray) -> FloatArray:
    """Points of a polyline at fractional places: k + u is a share u after point k."""
    every = np.arange(len(points))
    return np.column_stack([np.interp(places, every, axis) for axis in points.T])


def robot_times(cable: Cable, supports: tuple[int, ...]) -> IntArray:
    """Times of all robots on a cable, the lifting ones included.

    Raises
    ------
    RequirementError
        A support that is no turning point between the ends.
    """
    count = len(cable.path)
    for index in supports:
        if not isinstance(index, int | np.integer) or not 1 < index < count:
            raise RequirementError(
                f"no support robot can be at p{index}: those of this cable are p2 to p{count - 1}"
            )
    if len(set(supports)) < len(supports):
        twice = next(index for index in supports if supports.count(index) > 1)
        raise RequirementError(f"two support robots at p{twice}")
    return cable.times[[0, *(index - 1 for index in sorted(supports)), count - 1]]


def lay_mesh(cable: Cable, supports: tuple[int, ...]) -> Mesh:
    """The grid path as a mesh: a place at every lattice point, and within every arc; heights 0."""
    robots = robot_times(cable, supports)
    times = np.arange(cable.length + 1, dtype=np.float64)
    visits = np.unique(np.concatenate((robots, *cable.visits[:1])))
    short = visits[:-1][np.diff(visits) == 1]  # arcs without a lattice point inside
    times = np.sort(np.concatenate((times, short + 0.5)))
    plan = between(cable.cells, times)
    vertex = np.arange(len(times))
    crossings = cable.crossings
    vertex[np.searchsorted(times, crossings.second)] = np.searchsorted(times, crossings.first)
    kept, chain = np.unique(vertex, return_inverse=True)
    low, high = 1 - MARGIN, cable.diagram.size + MARGIN
    frame = np.array([[low, low], [high, low], [high, high], [low, high]])
    positions = np.concatenate((plan[kept], frame))
    supports = tuple(sorted(int(index) for index in supports))
    return Mesh(cable, supports, positions, chain, times, np.zeros(len(times)))
