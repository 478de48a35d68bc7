"""Regions of a cable: loops and pockets, and which of them a later strand threads.

Paper, section III.A.1 and 2: a region is active if a turning point later on the path than the
region's first point lies in its interior; otherwise it is passive.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from enum import StrEnum
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from knotopt.arrays import BoolArray, IntArray
from knotopt.cable.cable import Cable, frozen
from knotopt.supports.boundary import Boundaries, find_boundaries
from knotopt.supports.interior import fill_interiors, layer_count, unpack


class RegionKind(StrEnum):
    """Loop (eq. 7) or pocket (eq. 8)."""

    LOOP = "loop"
    POCKET = "pocket"


@dataclass(frozen=True, eq=False)
class Region:
    """One region of a cable.

    Attributes
    ----------
    kind : RegionKind
    apexes : tuple of int
        Indices into `cable.crossings`: one for a loop, two for a pocket.
    intervals : tuple of (first time, last time)
        Path intervals of the boundary [grid steps], in the order walked.
    boundary : tuple of int
        Turning points B(l) on the boundary, going round from its start (1-based on the path).
    interior : bool array, shape (N, N), indexed [column - 1, row - 1]
    threaded_by : int or None
        The first later turning point inside (1-based); None makes the region passive.
    """

    kind: RegionKind
    apexes: tuple[int, ...]
    intervals: tuple[tuple[int, int], ...]
    boundary: tuple[int, ...]
    interior: BoolArray
    threaded_by: int | None

    @property
    def name(self) -> str:
        """Kind and crossings (counted from 1), such as `loop c2` or `pocket c1 c3`."""
        return _name(self.kind, self.apexes)

    @property
    def is_active(self) -> bool:
        """Whether the region must be kept open."""
        return self.threaded_by is not None

    @property
    def why(self) -> str:
        """The reason in words: which later turning point lies inside, or that none does."""
        if self.threaded_by is None:
            return "passive: no later turning point lies inside"
        return f"active: p_{self.threaded_by} is the first later turning point inside"


@dataclass(frozen=True)
class Regions:
    """All R regions of a cable: a sequence of `Region`, held as arrays.

    The loops come first, by their crossing's first visit, then the pockets, by the time at which
    they close.

    Examples
    --------
    >>> from knotopt.diagram.families import torus_knot
    >>> regions = Regions(Cable(torus_knot(2, 3), "L+"))
    >>> [(str(r.kind), r.apexes) for r in regions]
    [('loop', (0,)), ('loop', (1,)), ('loop', (2,)), ('pocket', (0, 1)), ('pocket', (1, 2))]
    >>> regions[0].why
    'active: p_9 is the first later turning point inside'
    """

    cable: Cable

    @cached_property
    def boundaries(self) -> Boundaries:
        """Boundary intervals of every region."""
        return find_boundaries(self.cable)

    @cached_property
    def packed_interiors(self) -> NDArray[np.uint8]:
        """Interior masks, packed to bits, shape (R, ceil(N * N / 8))."""
        return frozen(fill_interiors(self.cable, self.boundaries))

    def on_boundary(self, regions: IntArray) -> BoolArray:
        """Which turning points lie on the boundaries of the given regions, shape (len, n)."""
        return self.boundaries.contain(regions, self.cable.times)

    @cached_property
    def inside(self) -> BoolArray:
        """Which turning points lie in each interior, shape (R, n)."""
        size = self.cable.diagram.size
        columns, rows = self.cable.points.T - 1
        bit = columns * size + rows
        mask: BoolArray = ((self.packed_interiors[:, bit // 8] >> (7 - bit % 8)) & 1).astype(bool)
        return mask

    @property
    def later(self) -> BoolArray:
        """Which turning points lie in each interior and come later than its start, shape (R, n)."""
        return self.inside & (self.cable.times > self.boundaries.a[:, :1])

    @cached_property
    def threaded_by(self) -> IntArray:
        """Index (0-based) of the first later turning point inside, -1 if none, shape (R,)."""
        found: IntArray = np.where(self.later.any(axis=1), self.later.argmax(axis=1), -1)
        return found

    @cached_property
    def active(self) -> IntArray:
        """Indices of the active regions."""
        return np.flatnonzero(self.threaded_by >= 0)

    def layers(self) -> IntArray:
        """Per-cell counter: how many active regions enclose each cell, shape (N, N)."""
        return layer_count(self.packed_interiors[self.active], self.cable.diagram.size)

    def __len__(self) -> int:
        return len(self.boundaries)

    def __getitem__(self, index: int) -> Region:
        boundaries = self.boundaries
        kind, apexes = self._kind(index)
        on = np.flatnonzero(self.on_boundary(np.array([index])))
        walked = boundaries.position(np.full(len(on), index), self.cable.times[on])
        threaded_by = int(self.threaded_by[index])
        intervals = [boundaries.a[index], boundaries.b[index]][: len(apexes)]
        return Region(
            kind=kind,
            apexes=apexes,
            intervals=tuple((int(low), int(high)) for low, high in intervals),
            boundary=tuple((on[np.argsort(walked)] + 1).tolist()),
            interior=unpack(self.packed_interiors[index], self.cable.diagram.size),
            threaded_by=threaded_by + 1 if threaded_by >= 0 else None,
        )

    def __iter__(self) -> Iterator[Region]:
        return (self[index] for index in range(len(self)))

    def name(self, index: int) -> str:
        """Name of a region, at less cost than that of the whole `Region`."""
        return _name(*self._kind(index))

    def _kind(self, index: int) -> tuple[RegionKind, tuple[int, ...]]:
        pocket = bool(self.boundaries.is_pocket[index])
        apexes = tuple(self.boundaries.apexes[index, : 1 + pocket].tolist())
        return RegionKind.POCKET if pocket else RegionKind.LOOP, apexes


def _name(kind: RegionKind, apexes: tuple[int, ...]) -> str:
    return " ".join([str(kind), *(f"c{index + 1}" for index in apexes)])
