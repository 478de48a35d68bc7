"""Exact plane geometry: winding numbers by quadrants, distances by projection."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction

Point = tuple[Fraction | int, Fraction | int]


def winding_number(curve: Sequence[Point], q: Point) -> int:
    """How often a closed polygon winds round a point that is not on it, counterclockwise.

    Counts quarter turns between the quadrants, seen from q, in which the vertices lie.

    Raises
    ------
    ValueError
        q lies on the polygon.

    Examples
    --------
    >>> winding_number([(0, 0), (2, 0), (2, 2), (0, 2)], (1, 1))
    1
    """
    offsets = [(x - q[0], y - q[1]) for x, y in curve]
    quarters = 0
    for (x0, y0), (x1, y1) in zip(offsets, [*offsets[1:], offsets[0]], strict=True):
        area = x0 * y1 - x1 * y0
        if area == 0 and x0 * x1 + y0 * y1 <= 0:
            raise ValueError(f"the point ({q[0]}, {q[1]}) lies on the polygon")
        step = (_quadrant(x1, y1) - _quadrant(x0, y0)) % 4
        if step == 2:
            quarters += 2 if area > 0 else -2
        else:
            quarters += step if step < 2 else -1
    return quarters // 4


def squared_distance(q: Point, start: Point, end: Point) -> Fraction:
    """Squared distance of a point from a segment, by projection onto it.

    Examples
    --------
    >>> squared_distance((0, 0), (1, 0), (0, 1))
    Fraction(1, 2)
    """
    along = (end[0] - start[0], end[1] - start[1])
    length = along[0] ** 2 + along[1] ** 2
    share = Fraction(0)
    if length:
        dot = (q[0] - start[0]) * along[0] + (q[1] - start[1]) * along[1]
        share = min(max(Fraction(dot) / length, Fraction(0)), Fraction(1))
    nearest = (start[0] + share * along[0], start[1] + share * along[1])
    return Fraction((q[0] - nearest[0]) ** 2 + (q[1] - nearest[1]) ** 2)


def intersection(a: Point, b: Point, c: Point, d: Point) -> Point | None:
    """The one point that segments ab and cd share; None if there is none, or more than one.

    Examples
    --------
    >>> intersection((0, 0), (2, 2), (0, 1), (1, 0))
    (Fraction(1, 2), Fraction(1, 2))
    """
    ux, uy, vx, vy = b[0] - a[0], b[1] - a[1], d[0] - c[0], d[1] - c[1]
    area = ux * vy - uy * vx
    if area == 0:
        return None
    s = Fraction((c[0] - a[0]) * vy - (c[1] - a[1]) * vx) / area
    t = Fraction((c[0] - a[0]) * uy - (c[1] - a[1]) * ux) / area
    if not (0 <= s <= 1 and 0 <= t <= 1):
        return None
    return (a[0] + s * ux, a[1] + s * uy)


def _quadrant(x: Fraction | int, y: Fraction | int) -> int:
    if x > 0 and y >= 0:
        return 0
    if x <= 0 and y > 0:
        return 1
    if x < 0 and y <= 0:
        return 2
    return 3
