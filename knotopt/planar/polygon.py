"""Polygons in space with fewer corners of the same knot.

A corner is left out where the triangle that it makes with its two neighbours meets no other part
of the polygon: a move of Reidemeister, which keeps the knot. K. Koniaris and M. Muthukumar,
doi:10.1103/PhysRevLett.66.2211; W. R. Taylor, doi:10.1038/35022623.

A corner goes only where that is certain: by floating point with the error bounds of J. R. Shewchuk,
doi:10.1007/PL00009321, and where these leave doubt, in whole numbers.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from functools import cached_property

import numpy as np

from knotopt.arrays import BoolArray, FloatArray, IntArray

Point = tuple[int, int, int]
ROUNDING = 8e-16  # of a 3 x 3 determinant of differences, relative to its products
ROW = 32  # segments whose boxes are looked at together
UNDERFLOW = 1e-290  # of products of coordinates below 2, whose differences may be this far off


class Corners:
    """Points in space, in floating point and, exactly, in whole numbers of one small unit.

    Parameters
    ----------
    points : float array, shape (m, 3)
        Finite.
    """

    def __init__(self, points: FloatArray) -> None:
        largest = float(np.abs(points).max(initial=0.0)) or 1.0
        self.points = np.ldexp(points, -int(np.frexp(largest)[1]))
        self._given = points

    @cached_property
    def exact(self) -> list[Point]:
        """The points in whole numbers: the coordinates given, times one power of two."""
        mantissa, exponent = np.frexp(self._given)
        numbers = np.ldexp(mantissa, 53).astype(np.int64)
        smallest = int(exponent[numbers != 0].min(initial=0))
        shift = np.where(numbers == 0, 0, exponent - smallest)
        return [
            (x << i, y << j, z << k)
            for (x, y, z), (i, j, k) in zip(numbers.tolist(), shift.tolist(), strict=True)
        ]


def without_spare_corners(
    points: FloatArray, *, closed: bool, fixed: Sequence[tuple[int, FloatArray]] = ()
) -> IntArray:
    """Which corners of a polygon a polygon of the same knot can keep.

    Parameters
    ----------
    points : float array, shape (m, 3)
        No two in a row are equal, nor the last and the first of a closed one.
    closed : bool
        Whether the last point is joined to the first. The ends of an open polygon stay.
    fixed : sequence of (int, point)
        Segments from one of the points to a point elsewhere, which nothing may pass through.

    Returns
    -------
    int array
        Indices of the corners that stay, in order; at least three, or the two ends.

    Notes
    -----
    O(m) a corner that is tried. Segments that meet stay, so that a polygon that meets itself is
    still one that does.

    Examples
    --------
    >>> square = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], dtype=float)
    >>> without_spare_corners(square, closed=True).tolist()
    [1, 2, 3]
    """
    places = Corners(np.vstack([points, *(tip[None] for _, tip in fixed)]))
    kept = list(range(len(points)))
    while True:
        left = _Sweep(places, kept, [at for at, _ in fixed], closed=closed).corners()
        if len(left) == len(kept):
            return np.array(kept, dtype=np.int64)
        kept = left


class _Sweep:
    """One look at every corner of a polygon; segments are found by their boxes.

    Places are the polygon's corners and, after them, the tips of what is fixed. Segment k runs from
    corner k to the next one that is left; those that are fixed come last.
    """

    def __init__(
        self, places: Corners, kept: list[int], fixed: Sequence[int], *, closed: bool
    ) -> None:
        count = len(kept)
        tips = len(places.points) - len(fixed) + np.arange(len(fixed))
        self._kept = kept
        self._closed = closed
        self._points = places.points[np.concatenate((kept, tips)).astype(np.int64)]
        self._exact = [places.exact[k] for k in (*kept, *tips.tolist())]
        self._after = [*range(1, count), 0]
        self._before = [count - 1, *range(count - 1)]
        starts = [kept.index(at) for at in fixed]
        self._start = np.array([*range(count), *starts], dtype=np.int64)
        self._end = np.array([*self._after, *range(count, count + len(fixed))], dtype=np.int64)
        ends = self._points[[self._start, self._end]]
        # Padded to whole rows of segments, each row with the box of them all.
        rows = math.ceil(len(self._start) / ROW)
        self._low = np.full((3, rows * ROW), np.inf)
        self._high = -self._low
        self._low[:, : len(self._start)] = ends.min(axis=0).T
        self._high[:, : len(self._start)] = ends.max(axis=0).T
        if not closed:
            self._low[:, count - 1], self._high[:, count - 1] = np.inf, -np.inf
        self._row_low = self._low.reshape(3, rows, ROW).min(axis=2)
        self._row_high = self._high.reshape(3, rows, ROW).max(axis=2)

    def corners(self) -> list[int]:
        """The corners that stay when each has been tried, by their numbers in all the points."""
        gone: set[int] = set()
        left = count = len(self._kept)
        skipped = -1
        for b in range(count) if self._closed else range(1, count - 1):
            if self._closed and left <= 3:
                break
            # After a corner goes its neighbour is left for the next time: needles meet more.
            if b != skipped and self._is_spare(b):
                skipped = self._after[b]
                self._leave_out(b)
                gone.add(b)
                left -= 1
        return [corner for k, corner in enumerate(self._kept) if k not in gone]

    def _leave_out(self, b: int) -> None:
        a, c = self._before[b], self._after[b]
        self._after[a], self._before[c] = c, a
        self._end[a] = c
        ends = self._points[[a, c]]
        row = a // ROW
        self._low[:, a], self._high[:, a] = ends.min(axis=0), ends.max(axis=0)
        self._row_low[:, row] = np.minimum(self._row_low[:, row], self._low[:, a])
        self._row_high[:, row] = np.maximum(self._row_high[:, row], self._high[:, a])
        self._low[:, b], self._high[:, b] = np.inf, -np.inf

    def _others(self, low: FloatArray, high: FloatArray, a: int, b: int) -> IntArray:
        """The segments whose boxes meet a box, but for a and b."""
        rows = np.flatnonzero(_overlap(self._row_low, self._row_high, low, high))
        near = (rows[:, None] * ROW + np.arange(ROW)).ravel()
        near = near[_overlap(self._low[:, near], self._high[:, near], low, high)]
        others: IntArray = near[(near != a) & (near != b)]
        return others

    def _is_spare(self, b: int) -> bool:
        """Whether nothing meets the triangle of a corner and its neighbours but at these two."""
        a, c = self._before[b], self._after[b]
        exact = self._exact
        corner = exact[a], exact[b], exact[c]
        if _is_between(*corner):
            return True  # the polygon stays the same
        triangle = self._points[[a, b, c]]
        others = self._others(triangle.min(axis=0), triangle.max(axis=0), a, b)
        start, end = self._start[others], self._end[others]
        shared = (start == a) | (start == c) | (end == a) | (end == c)
        for p, q in zip(start[shared].tolist(), end[shared].tolist(), strict=True):
            at_c, tip = c in (p, q), q if p in (a, c) else p
            if _leads_inside(corner if at_c else corner[::-1], exact[tip]):
                return False
        start, end = start[~shared], end[~shared]
        doubtful = ~self._surely_missed(triangle, start, end)
        return not any(
            _meets(corner, exact[p], exact[q])
            for p, q in zip(start[doubtful].tolist(), end[doubtful].tolist(), strict=True)
        )

    def _surely_missed(self, triangle: FloatArray, start: IntArray, end: IntArray) -> BoolArray:
        """Which segments surely miss the triangle."""
        if not len(start):
            return np.zeros(0, dtype=np.bool_)
        a, b, c = triangle
        p, q = self._points[start], self._points[end]
        around = np.stack([_side(p, q, a, b), _side(p, q, b, c), _side(p, q, c, a)])
        beside = (around.max(axis=0) > 0) & (around.min(axis=0) < 0)
        missed: BoolArray = beside | (_side(a, b, c, p) * _side(a, b, c, q) > 0)
        return missed


def _overlap(low: FloatArray, high: FloatArray, least: FloatArray, most: FloatArray) -> BoolArray:
    """Which boxes, shapes (3, n), meet one."""
    found: BoolArray = (low[0] <= most[0]) & (high[0] >= least[0])
    for axis in (1, 2):
        found &= (low[axis] <= most[axis]) & (high[axis] >= least[axis])
    return found


def _side(a: FloatArray, b: FloatArray, c: FloatArray, d: FloatArray) -> FloatArray:
    """Sign of det(a - d, b - d, c - d) where it is sure, else 0."""
    (ax, ay, az), (bx, by, bz), (cx, cy, cz) = (
        np.moveaxis(np.asarray(point - d), -1, 0) for point in (a, b, c)
    )
    terms = [
        (az, bx * cy, cx * by),
        (bz, cx * ay, ax * cy),
        (cz, ax * by, bx * ay),
    ]
    value = sum(height * (plus - minus) for height, plus, minus in terms)
    size = sum(np.abs(height) * (np.abs(plus) + np.abs(minus)) for height, plus, minus in terms)
    sure = np.abs(value) > ROUNDING * size + UNDERFLOW
    signs: FloatArray = np.where(sure, np.sign(value), 0.0)
    return signs


def orientation(a: Point, b: Point, c: Point, d: Point) -> int:
    """The determinant of b - a, c - a and d - a, exactly."""
    (ux, uy, uz), (vx, vy, vz), (wx, wy, wz) = _minus(b, a), _minus(c, a), _minus(d, a)
    return ux * (vy * wz - vz * wy) - uy * (vx * wz - vz * wx) + uz * (vx * wy - vy * wx)


def _minus(a: Point, b: Point) -> Point:
    return a[0] - b[0], a[1] - b[1], a[2] - b[2]


def _cross(a: Point, b: Point, c: Point) -> Point:
    """Normal of a triangle; zero if it is none."""
    (ux, uy, uz), (vx, vy, vz) = _minus(b, a), _minus(c, a)
    return uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx


def is_straight(a: Point, b: Point, c: Point) -> bool:
    """Whether three points lie on one line."""
    return not any(_cross(a, b, c))


def _is_between(a: Point, b: Point, c: Point) -> bool:
    """Whether b lies on the segment from a to c."""
    if not is_straight(a, b, c):
        return False
    return sum(x * y for x, y in zip(_minus(b, a), _minus(c, b), strict=True)) >= 0


def _meets(triangle: tuple[Point, Point, Point], p: Point, q: Point) -> bool:
    """Whether a segment meets a triangle."""
    a, b, c = triangle
    above_p, above_q = orientation(*triangle, p), orientation(*triangle, q)
    if (above_p > 0 and above_q > 0) or (above_p < 0 and above_q < 0):
        return False
    if above_p or above_q:
        around = [orientation(p, q, *side) for side in ((a, b), (b, c), (c, a))]
        return not (max(around) > 0 > min(around))
    turn = _turn_in_plane(triangle)
    if turn is None:
        return True  # three points of a line: rare, and it does no harm to keep them
    sides = ((a, b), (b, c), (c, a))
    # Two convex sets of a plane miss each other if a line along one of their sides parts them.
    if any(turn(u, v, p) < 0 and turn(u, v, q) < 0 for u, v in sides):
        return False
    across = [turn(p, q, corner) for corner in triangle]
    return not (min(across) > 0 or max(across) < 0)


def _leads_inside(triangle: tuple[Point, Point, Point], tip: Point) -> bool:
    """Whether a segment from the triangle's last corner runs along or inside the triangle."""
    a, b, c = triangle
    if orientation(a, b, c, tip):
        return False
    turn = _turn_in_plane(triangle)
    if turn is None:
        return True
    return turn(b, c, tip) >= 0 and turn(c, a, tip) >= 0


def _turn_in_plane(
    triangle: tuple[Point, Point, Point],
) -> Callable[[Point, Point, Point], int] | None:
    """Signed area of three points of a triangle's plane, positive for its own; None for a line."""
    normal = _cross(*triangle)
    axis = next((axis for axis in range(3) if normal[axis]), None)
    if axis is None:
        return None
    i, j = (axis + 1) % 3, (axis + 2) % 3
    sign = 1 if normal[axis] > 0 else -1

    def turn(a: Point, b: Point, c: Point) -> int:
        return sign * ((b[i] - a[i]) * (c[j] - a[j]) - (b[j] - a[j]) * (c[i] - a[i]))

    return turn
