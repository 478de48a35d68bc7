"""Crossings and contacts of a polyline's projection on the horizontal plane.

Whether two segments cross is decided by on which side of one the ends of the other lie. These signs
are exact: where the rounding error of a determinant might reach zero (bound of J. R. Shewchuk,
doi:10.1007/PL00009321) it is computed again in rational numbers. A point on a line counts as lying
on its left, so a strand that passes through another one's vertex crosses it once.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction

import numpy as np

from knotopt.arrays import BoolArray, FloatArray, IndexArray

ROUNDING = 4e-16  # of a 2 x 2 determinant of differences, relative to its two products
BLOCK = 1024  # segments whose boxes are compared at once with those of all others


@dataclass(frozen=True, eq=False)
class Projection:
    """A polyline seen from above; points above one another in a row are one vertex.

    Attributes
    ----------
    flat : float array, shape (k, 2)
        The vertices; neighbours differ.
    start, end : float arrays, shape (k - 1,)
        Heights of the segments' ends.
    low, high : float arrays, shape (k,)
        Heights that the polyline takes at each vertex.
    segment : int array, shape (k - 1,)
        The polyline's own number of each segment.
    """

    flat: FloatArray
    start: FloatArray
    end: FloatArray
    low: FloatArray
    high: FloatArray
    segment: IndexArray


@dataclass(frozen=True, eq=False)
class Crossings:
    """Pairs of segments i < j that cross in plan.

    Attributes
    ----------
    i, j : int arrays, shape (C,)
    u, v : float arrays, shape (C,)
        Where on segment i and on segment j, in [0, 1].
    gap : float array, shape (C,)
        Height of segment i above segment j.
    touches : bool array, shape (C,)
        Whether |gap| is within the height tolerance.
    left : bool array, shape (C,)
        Whether segment j's direction points to the left of segment i's.
    """

    i: IndexArray
    j: IndexArray
    u: FloatArray
    v: FloatArray
    gap: FloatArray
    touches: BoolArray
    left: BoolArray

    def __len__(self) -> int:
        return len(self.i)


Contact = tuple[int, int]
"""A vertex, and a segment of which it is not an end, within tolerance of each other in plan."""


def projection(points: FloatArray) -> Projection:
    """The polyline seen from above, points float array of shape (m, 3)."""
    flat, height = points[:, :2], points[:, 2]
    stays = (flat[1:] == flat[:-1]).all(axis=1)
    first = np.concatenate(([0], np.flatnonzero(~stays) + 1))
    last = np.append(first[1:], len(points)) - 1
    return Projection(
        flat[first],
        height[last[:-1]],
        height[first[1:]],
        np.minimum.reduceat(height, first),
        np.maximum.reduceat(height, first),
        last[:-1],
    )


def crossings_and_contacts(
    seen: Projection, plan_tolerance: float, height_tolerance: float
) -> tuple[Crossings, list[Contact]]:
    """Every crossing of the projection, and every contact.

    Notes
    -----
    O(k^2) comparisons of boxes, in blocks of rows; all else is in proportion to the pairs of
    segments whose boxes meet.
    """
    flat = seen.flat
    step = flat[1:] - flat[:-1]
    length = np.hypot(step[:, 0], step[:, 1])
    i, j = _pairs(flat, plan_tolerance)
    base = np.stack((i, i, j, j))  # row r asks on which side of segment base[r] lies tip[r]
    tip = np.stack((j, j + 1, i, i + 1))
    along, across = step[base], flat[tip] - flat[base]
    left = along[..., 0] * across[..., 1]
    right = along[..., 1] * across[..., 0]
    area = left - right
    error = ROUNDING * (np.abs(left) + np.abs(right))
    apart = j > i + 1
    unsure = (np.abs(area) <= error) & (error > 0) & apart
    for where in zip(*np.nonzero(unsure), strict=True):
        area[where] = _exact_area(flat, int(base[where]), int(tip[where]))

    close = np.abs(area) <= plan_tolerance * length[base]
    close[0] &= apart  # the tip is the segment's own end
    close[3] &= apart
    contacts: list[Contact] = []
    if close.any():
        along, across, base, tip = along[close], across[close], base[close], tip[close]
        share = np.clip((along * across).sum(axis=1) / length[base] ** 2, 0, 1)
        off = across - share[:, None] * along
        near = np.hypot(off[:, 0], off[:, 1]) <= plan_tolerance
        contacts = sorted(set(zip(tip[near].tolist(), base[near].tolist(), strict=True)))

    side = area >= 0
    crosses = (side[0] != side[1]) & (side[2] != side[3]) & apart
    i, j, area, error = i[crosses], j[crosses], area[:, crosses], error[:, crosses]
    across_j, across_i = area[2] - area[3], area[0] - area[1]
    u, v = area[2] / across_j, area[0] / across_i
    rise_i, rise_j = seen.end[i] - seen.start[i], seen.end[j] - seen.start[j]
    gap = seen.start[i] + u * rise_i - seen.start[j] - v * rise_j
    error_u = 2 * (error[2] + error[3]) / np.abs(across_j)
    error_v = 2 * (error[0] + error[1]) / np.abs(across_i)
    size = np.abs(seen.start[i]) + np.abs(rise_i) + np.abs(seen.start[j]) + np.abs(rise_j)
    error_gap = error_u * np.abs(rise_i) + error_v * np.abs(rise_j) + 4 * ROUNDING * size
    touches = np.abs(gap) <= height_tolerance
    unsure = np.abs(np.abs(gap) - height_tolerance) <= error_gap
    unsure |= np.maximum(error_u * length[i], error_v * length[j]) > plan_tolerance / 8
    for c in np.flatnonzero(unsure).tolist():
        exact = _exact_crossing(seen, int(i[c]), int(j[c]))
        u[c], v[c], gap[c] = (float(value) for value in exact)
        touches[c] = abs(exact[2]) <= Fraction(height_tolerance)
    return Crossings(i, j, u, v, gap, touches, side[1][crosses]), contacts


def _pairs(flat: FloatArray, reach: float) -> tuple[IndexArray, IndexArray]:
    """Pairs of segments i < j whose boxes come within reach."""
    low = np.minimum(flat[:-1], flat[1:])
    high = np.maximum(flat[:-1], flat[1:]) + reach
    found = []
    for start in range(0, len(low), BLOCK):
        rows = slice(start, start + BLOCK)
        near = (low[rows, None, 0] <= high[None, start:, 0]) & (
            high[rows, None, 0] >= low[None, start:, 0]
        )
        near &= low[rows, None, 1] <= high[None, start:, 1]
        near &= high[rows, None, 1] >= low[None, start:, 1]
        i, j = np.nonzero(near)
        later = j > i
        found.append((i[later] + start, j[later] + start))
    i, j = (np.concatenate(column) for column in zip(*found, strict=True))
    return i, j


def _exact_area(flat: FloatArray, segment: int, vertex: int) -> float:
    (ax, ay), (bx, by), (cx, cy) = (
        (Fraction(x), Fraction(y)) for x, y in flat[[segment, segment + 1, vertex]].tolist()
    )
    return float((bx - ax) * (cy - ay) - (by - ay) * (cx - ax))


def _exact_crossing(seen: Projection, i: int, j: int) -> tuple[Fraction, Fraction, Fraction]:
    """Shares u, v and the gap of two segments that are known to cross."""
    (ax, ay), (bx, by), (cx, cy), (dx, dy) = (
        (Fraction(x), Fraction(y)) for x, y in seen.flat[[i, i + 1, j, j + 1]].tolist()
    )
    turn = (bx - ax) * (dy - cy) - (by - ay) * (dx - cx)
    u = ((cx - ax) * (dy - cy) - (cy - ay) * (dx - cx)) / turn
    v = ((cx - ax) * (by - ay) - (cy - ay) * (bx - ax)) / turn
    heights = (seen.start[i], seen.end[i], seen.start[j], seen.end[j])
    z_a, z_b, z_c, z_d = (Fraction(float(height)) for height in heights)
    return u, v, z_a + u * (z_b - z_a) - z_c - v * (z_d - z_c)
