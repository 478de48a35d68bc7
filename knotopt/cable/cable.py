"""The cable: the closed path of a grid diagram opened at a cut, with its crossings.

Time on the path is arc length from p_1 in grid steps, so every lattice point of the path has an
integer time. What is laid first is what the later strand passes over or under.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import NDArray

from knotopt.arrays import BoolArray, IntArray
from knotopt.cable.cut import Cut, crossing_free_cuts
from knotopt.diagram.grid import GridDiagram, Mark
from knotopt.errors import CutError
from knotopt.showing import ShownShort, plural


@dataclass(frozen=True)
class Crossing:
    """One crossing c of a cable, visited at times first < second [grid steps from p_1].

    ``first_over`` says whether the visit at ``first`` is the over-crossing one; ``sign`` is +1
    when the over strand turns counterclockwise into the under strand's direction, else -1.
    """

    column: int
    row: int
    first: int
    second: int
    first_over: bool
    sign: int


@dataclass(frozen=True)
class Arc:
    """The piece of cable between two consecutive crossing visits (gamma_i, eq. 2 of the paper).

    ``crossings`` are the crossings at its two ends, None at a free end of the cable; ``start`` and
    ``end`` are times; ``turning_points`` are the 1-based indices on the path in between.
    """

    crossings: tuple[int | None, int | None]
    start: int
    end: int
    turning_points: tuple[int, ...]


@dataclass(frozen=True, eq=False)
class Crossings:
    """All C crossings of a cable as arrays, in the order of their first visits.

    Attributes
    ----------
    cell : int array, shape (C, 2), [column, row]
    first, second : int array, shape (C,), times of the two visits
    first_over : bool array, shape (C,)
    sign : int array, shape (C,), +1 or -1
    """

    cell: IntArray
    first: IntArray
    second: IntArray
    first_over: BoolArray
    sign: IntArray

    def __len__(self) -> int:
        return len(self.first)

    def __getitem__(self, index: int) -> Crossing:
        others = (self.first, self.second, self.first_over, self.sign)
        return Crossing(*self.cell[index].tolist(), *(values[index].item() for values in others))

    def __iter__(self) -> Iterator[Crossing]:
        return (self[index] for index in range(len(self)))


@dataclass(frozen=True, repr=False)
class Cable(ShownShort):
    """The cable p_1 ... p_2N of a grid diagram, opened at a crossing-free cut.

    Parameters
    ----------
    diagram : GridDiagram
    cut : Cut or str
        A cut or its name.

    Raises
    ------
    CutError
        The cut does not exist or its segment carries crossings.

    Examples
    --------
    >>> from knotopt.diagram.families import torus_knot
    >>> cable = Cable(torus_knot(2, 3), "L+")
    >>> cable.path
    ((1, 5), (4, 5), (4, 2), (2, 2), (2, 4), (5, 4), (5, 1), (3, 1), (3, 3), (1, 3))
    >>> [(c.column, c.row, c.first, c.second, c.sign) for c in cable.crossings]
    [(4, 4, 4, 12, 1), (3, 2, 7, 19, 1), (2, 3, 9, 21, 1)]
    """

    diagram: GridDiagram
    cut: Cut

    def __init__(self, diagram: GridDiagram, cut: Cut | str) -> None:
        if isinstance(cut, str):
            cut = Cut.parse(cut, diagram.size)
        if cut.size != diagram.size:
            raise CutError(f"cut {cut} is of a grid of size {cut.size}, not {diagram.size}")
        object.__setattr__(self, "diagram", diagram)
        object.__setattr__(self, "cut", cut)
        if not cut.is_outer:
            line = diagram.crossing_cells.take(cut.index - 1, axis=int(cut.axis == "row"))
            if count := int(line.sum()):
                free = ", ".join(str(free) for free in crossing_free_cuts(diagram))
                raise CutError(
                    f"cut {cut}: the segment in {cut.axis} {cut.index} carries "
                    f"{count} crossing{'s' * (count != 1)}, so the cable would not hold the knot; "
                    f"crossing-free cuts of this grid: {free}"
                )

    @property
    def in_words(self) -> str:
        """Grid size, cut, crossings."""
        crossings = plural(len(self.crossings), "crossing")
        return f"grid of size {self.diagram.size}, cut {self.cut}, {crossings}"

    @cached_property
    def path(self) -> tuple[Mark, ...]:
        """Turning points p_1 ... p_n as [column, row]; n = 2N."""
        loop = self.diagram.traversal
        axis = 0 if self.cut.axis == "column" else 1
        first = next(
            i
            for i, mark in enumerate(loop)
            if mark[axis] == self.cut.index and loop[(i + 1) % len(loop)][axis] == self.cut.index
        )
        opened = loop[first + 1 :] + loop[: first + 1]
        return opened if self.cut.direction == "+" else opened[::-1]

    @cached_property
    def points(self) -> IntArray:
        """The path as an array, shape (n, 2) [grid steps]."""
        return frozen(np.array(self.path, dtype=np.int64))

    @cached_property
    def times(self) -> IntArray:
        """Time of each turning point, shape (n,): arc length from p_1 [grid steps]."""
        steps = np.abs(np.diff(self.points, axis=0)).sum(axis=1)
        return frozen(np.concatenate(([0], np.cumsum(steps))))

    @property
    def length(self) -> int:
        """Length of the cable [grid steps]."""
        return int(self.times[-1])

    @cached_property
    def cells(self) -> IntArray:
        """Lattice point at each integer time, shape (length + 1, 2), as [column, row]."""
        steps = np.diff(self.points, axis=0)
        lengths = np.diff(self.times)
        units = np.repeat(np.sign(steps), lengths, axis=0)
        return frozen(self.points[0] + np.concatenate(([[0, 0]], np.cumsum(units, axis=0))))

    @cached_property
    def crossings(self) -> Crossings:
        """Every crossing with both visits, ordered by first visit."""
        cell = np.argwhere(self.diagram.crossing_cells) + 1
        start, times = self.points[:-1], self.times
        directions = np.sign(np.diff(self.points, axis=0))
        # Each column and each row that carries a crossing holds exactly one segment of the path.
        segment = np.zeros((2, self.diagram.size + 1), dtype=np.int64)
        for axis in (0, 1):
            along = np.flatnonzero(directions[:, axis] == 0)
            segment[axis, start[along, axis]] = along
        over, under = segment[0, cell[:, 0]], segment[1, cell[:, 1]]
        over_time = times[over] + np.abs(cell[:, 1] - start[over, 1])
        under_time = times[under] + np.abs(cell[:, 0] - start[under, 0])
        first = np.minimum(over_time, under_time)
        order = np.argsort(first)
        sign = -directions[over, 1] * directions[under, 0]
        return Crossings(
            frozen(cell[order]),
            frozen(first[order]),
            frozen(np.maximum(over_time, under_time)[order]),
            frozen((over_time < under_time)[order]),
            frozen(sign[order]),
        )

    @cached_property
    def visits(self) -> tuple[IntArray, IntArray, BoolArray]:
        """Crossing visits along the path: times, crossing indices, over or not, each (2C,)."""
        crossings = self.crossings
        times = np.concatenate((crossings.first, crossings.second))
        index = np.tile(np.arange(len(crossings)), 2)
        over = np.concatenate((crossings.first_over, ~crossings.first_over))
        order = np.argsort(times)
        return frozen(times[order]), frozen(index[order]), frozen(over[order])

    @cached_property
    def arcs(self) -> tuple[Arc, ...]:
        """The 2C + 1 pieces of cable between p_1, the crossing visits in order, and p_n."""
        times, index, _ = self.visits
        bounds = [0, *times.tolist(), self.length]
        ends: list[int | None] = [None, *index.tolist(), None]
        corners = np.searchsorted(self.times, bounds, side="left").tolist()
        corners[-1] = len(self.path)
        return tuple(
            Arc(crossings, start, end, tuple(range(before + 1, after + 1)))
            for crossings, (start, end), (before, after) in zip(
                pairwise(ends), pairwise(bounds), pairwise(corners), strict=True
            )
        )


def frozen(array: NDArray[Any]) -> NDArray[Any]:
    """The array itself, made read-only."""
    array.setflags(write=False)
    return array
