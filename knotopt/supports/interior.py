"""Interiors of regions: the grid cells that a flood fill from outside does not reach (eq. 9)."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from knotopt.arrays import BoolArray, IntArray
from knotopt.cable.cable import Cable
from knotopt.errors import GridError
from knotopt.supports.boundary import Boundaries

MAX_GIBIBYTES = 2  # enough for T(250,251)
_CELLS_AT_ONCE = 1 << 22  # bounds the memory of one batch of flood fills to some 100 MB

# 4 neighbours within a region's own plane, none across planes: one labelling fills many regions.
_PLANE_NEIGHBOURS = np.zeros((3, 3, 3), dtype=bool)
_PLANE_NEIGHBOURS[1] = [[0, 1, 0], [1, 1, 1], [0, 1, 0]]


def fill_interiors(cable: Cable, boundaries: Boundaries) -> NDArray[np.uint8]:
    """Interior cells of every region, packed.

    The flood fill steps to 4 neighbours, starts outside the padded grid and never steps on the
    boundary; the boundary is not interior. (A bay behind a neck one grid step wide is therefore
    interior, although the boundary curve does not wind around it.)

    Returns
    -------
    uint8 array, shape (R, ceil(N * N / 8))
        Bits of the (N, N) masks indexed [column - 1, row - 1]; see `unpack`.

    Raises
    ------
    GridError
        The masks would take more than `MAX_GIBIBYTES`.
    """
    size = cable.diagram.size
    gibibytes = len(boundaries) * size**2 / 8 / 2**30
    if gibibytes > MAX_GIBIBYTES:
        raise GridError(
            f"a grid of size {size} with {len(boundaries)} regions is too large: their interiors "
            f"take {gibibytes:.0f} GiB, and {MAX_GIBIBYTES} are allowed"
        )
    batch = max(1, _CELLS_AT_ONCE // (size + 2) ** 2)
    packed = np.zeros((len(boundaries), (size * size + 7) // 8), dtype=np.uint8)
    for low in range(0, len(boundaries), batch):
        part = slice(low, low + batch)
        packed[part] = np.packbits(_fill(cable, boundaries, part), axis=1)
    return packed


def unpack(packed: NDArray[np.uint8], size: int) -> BoolArray:
    """Masks of shape (..., N, N), indexed [column - 1, row - 1], from their packed bits."""
    bits = np.unpackbits(packed, axis=-1, count=size * size).astype(bool)
    return bits.reshape(*packed.shape[:-1], size, size)


def layer_count(packed: NDArray[np.uint8], size: int) -> IntArray:
    """How many of the given regions enclose each cell, shape (N, N) (section III.A.2)."""
    layers = np.zeros((size, size), dtype=np.int64)
    batch = max(1, _CELLS_AT_ONCE // size**2)
    for low in range(0, len(packed), batch):
        layers += unpack(packed[low : low + batch], size).sum(axis=0)
    return layers


def _fill(cable: Cable, boundaries: Boundaries, chosen: slice) -> BoolArray:
    size = cable.diagram.size
    intervals = np.concatenate((boundaries.a[chosen], boundaries.b[chosen]))
    lengths = intervals[:, 1] - intervals[:, 0] + 1
    plane = np.tile(np.arange(len(intervals) // 2), 2)
    offsets = np.cumsum(lengths) - lengths
    times = np.arange(lengths.sum()) + np.repeat(intervals[:, 0] - offsets, lengths)
    columns, rows = cable.cells[times].T
    free = np.ones((len(intervals) // 2, size + 2, size + 2), dtype=bool)
    free[np.repeat(plane, lengths), columns, rows] = False
    labels = np.empty(free.shape, dtype=np.int32)
    ndimage.label(free, structure=_PLANE_NEIGHBOURS, output=labels)
    inside: BoolArray = free & (labels != labels[:, :1, :1])
    return inside[:, 1:-1, 1:-1].reshape(len(free), size * size)
