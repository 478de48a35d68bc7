"""Planar diagrams of polygons in space: what is seen from one direction.

Directions are tried in one order, the view from above first. Seen from (s, t, 1), a point (x, y, z)
appears at (x - s z, y - t z), and axes are exchanged in a circle: maps of space that keep its
orientation. Floating point finds what surely crosses or misses; the rest, and all crossings, are
worked out in whole numbers, and a direction in which strands touch, or three of them meet in a
point, is passed over.
"""

from __future__ import annotations

import random
from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction
from itertools import pairwise
from operator import itemgetter

import numpy as np

from knotopt.arrays import FloatArray, IntArray
from knotopt.errors import DiagramError
from knotopt.planar.gauss import from_visits
from knotopt.planar.planar_diagram import PlanarDiagram
from knotopt.planar.polygon import (
    Corners,
    is_straight,
    orientation,
    without_spare_corners,
)

VIEWS = 24  # directions tried; of a closed polygon the one with the fewest crossings counts
FINENESS = 256  # of directions: their slopes are whole numbers of such parts
MOST_CROSSINGS = 3000  # of a view that is worked out: a second
SURE = 128 * float(np.finfo(np.float64).eps)  # of areas between points within 2 of the origin
BLOCK = 1024  # segments whose boxes are compared at once with those of all others


Pairs = list[tuple[int, int]]
"""Of segments i < j that cross."""


class CurveError(DiagramError):
    """Points that are no knot: the message says what is wrong, and of which points."""


@dataclass(frozen=True)
class View:
    """A polygon seen from one direction.

    Attributes
    ----------
    diagram : PlanarDiagram
        Oriented as the points run.
    direction : (x, y, z)
        From where it is seen.
    """

    diagram: PlanarDiagram
    direction: tuple[float, float, float]


def closed_view(points: FloatArray) -> View:
    """The planar diagram of a closed polygon, of several views the one with the fewest crossings.

    Parameters
    ----------
    points : float array, shape (m, 3)
        The corners in order, at least three, no two in a row equal; the last one is joined to the
        first.

    Raises
    ------
    CurveError
        The polygon meets itself, lies on one line, or has too many crossings in every view.

    Examples
    --------
    >>> angle = 4 * np.pi / 7 * np.arange(7)
    >>> wave = 2 + np.cos(1.5 * angle)
    >>> trefoil = [wave * np.cos(angle), wave * np.sin(angle), np.sin(1.5 * angle)]
    >>> closed_view(np.transpose(trefoil)).diagram.signs
    (-1, -1, -1)
    """
    kept = without_spare_corners(points, closed=True)
    corners = Corners(points[kept])
    if len(kept) == 3:
        if is_straight(*corners.exact):
            raise CurveError("the points of the curve lie on one line")
        return View(PlanarDiagram(()), (0.0, 0.0, 1.0))
    problem: _NoViewError | None = None
    views: list[tuple[int, Direction, Pairs]] = []
    for direction in _directions():
        try:
            pairs = _crossing_pairs(corners, direction, closed=True)
        except _NoViewError as error:
            problem = error
        else:
            views.append((len(pairs), direction, pairs))
    for _, direction, pairs in sorted(views, key=itemgetter(0)):
        try:
            return View(_diagram(corners, direction, pairs), direction.vector)
        except _NoViewError as error:
            problem = error
    assert problem is not None
    raise CurveError(problem.words(kept))


def open_view(points: FloatArray) -> View:
    """The planar diagram of an open polygon with its ends joined where one face has both.

    The view from above comes first. Before, the polygon loses what Reidemeister moves away from its
    ends take off, which keep its knotoid in that view.

    Parameters
    ----------
    points : float array, shape (m, 3)
        At least two, no two in a row equal.

    Raises
    ------
    CurveError
        The polygon meets itself, or in no view that was tried the ends lie in one face.

    References
    ----------
    V. Turaev, "Knotoids", Osaka Journal of Mathematics 49 (2012), 195-223.
    """
    problem, apart = None, False
    reach = 4 * float(np.abs(points).max())
    for direction in _directions():
        # What is led past an end, above or below it, changes the knotoid.
        away = reach * np.array(direction.vector)
        ends = [(at, points[at] + way) for at in (0, len(points) - 1) for way in (away, -away)]
        kept = without_spare_corners(points, closed=False, fixed=ends)
        corners = Corners(points[kept])
        try:
            pairs = _crossing_pairs(corners, direction, closed=False)
            return View(_diagram(corners, direction, pairs), direction.vector)
        except _NoViewError as error:
            problem = problem or error.words(kept)
        except DiagramError:
            # Ends in different faces could only be joined on a handle of the plane.
            apart = True
    if problem is not None and not apart:
        raise CurveError(problem)
    raise CurveError(
        f"the curve is open, and in none of {VIEWS} views do its two ends lie in one face of the "
        "diagram, where they could be joined: lead them out of the knot, or end with the first "
        "point again"
    )


@dataclass(frozen=True)
class Direction:
    """From where a polygon is seen.

    Attributes
    ----------
    axis : int
        Which coordinate is taken as height: 2, or with the others following in a circle, 0 or 1.
    east, north : int
        What the direction has of the two other coordinates for each `FINENESS` of height.
    """

    axis: int
    east: int
    north: int

    @property
    def axes(self) -> tuple[int, int, int]:
        """The coordinates that count as x, y and height."""
        return (self.axis + 1) % 3, (self.axis + 2) % 3, self.axis

    @property
    def vector(self) -> tuple[float, float, float]:
        """In the points' coordinates; the largest is 1."""
        parts = dict(
            zip(self.axes, (self.east / FINENESS, self.north / FINENESS, 1.0), strict=True)
        )
        return parts[0], parts[1], parts[2]


def _directions() -> Iterator[Direction]:
    """The view from above, then others, always the same ones."""
    yield Direction(2, 0, 0)
    generator = random.Random(0)
    for number in range(1, VIEWS):
        east, north = (generator.randrange(1 - FINENESS, FINENESS) for _ in range(2))
        yield Direction((number + 2) % 3, east, north)


class _NoViewError(Exception):
    """Why a polygon is no diagram in some view: of which segments, or of how many crossings."""

    def __init__(self, what: str, *segments: int) -> None:
        super().__init__(what)
        self._segments = segments

    def words(self, kept: IntArray) -> str:
        """The sentence, of the points that a polygon had before it lost corners."""
        near = [f"{int(kept[segment]) + 1}" for segment in self._segments]
        return f"the curve {self}" + (f", near points {' and '.join(near)}" if near else "")


_MEETS = "meets itself"


def _diagram(corners: Corners, direction: Direction, pairs: Pairs) -> PlanarDiagram:
    """What is seen, from the pairs of segments that cross; an open polygon's ends are joined.

    Raises
    ------
    _NoViewError
        Strands meet in space, or three of them in this view, or there are too many crossings.
    DiagramError
        The ends of an open polygon lie in different faces.
    """
    if len(pairs) > MOST_CROSSINGS:
        raise _NoViewError(
            f"has more than {MOST_CROSSINGS} crossings in every view, after simplification"
        )
    flat = _Plan(corners, direction)
    count = len(corners.exact)
    visits: list[tuple[int, Fraction, int, bool]] = []  # segment, share, crossing, over
    signs = []
    for crossing, (i, j) in enumerate(pairs):
        after_i, after_j = (i + 1) % count, (j + 1) % count
        sign = orientation(*(corners.exact[k] for k in (i, after_i, j, after_j)))
        if not sign:
            raise _NoViewError(_MEETS, i, j)
        left = flat.turn(i, after_i, after_j) - flat.turn(i, after_i, j)
        share_i = Fraction(flat.turn(j, after_j, i), left)
        share_j = Fraction(-flat.turn(i, after_i, j), left)
        above = (sign > 0) == (left > 0)
        visits += [(i, share_i, crossing, above), (j, share_j, crossing, not above)]
        signs.append(sign)
    visits.sort()
    for (i, share, *_), (j, other, *_) in pairwise(visits):
        if (i, share) == (j, other):
            raise _NoViewError(_MEETS, i, j)
    return from_visits([visit[2] for visit in visits], [visit[3] for visit in visits], signs)


class _Plan:
    """What is seen of the corners, in whole numbers."""

    def __init__(self, corners: Corners, direction: Direction) -> None:
        i, j, k = direction.axes
        self._places = [
            (FINENESS * p[i] - direction.east * p[k], FINENESS * p[j] - direction.north * p[k])
            for p in corners.exact
        ]

    def turn(self, a: int, b: int, c: int) -> int:
        """Twice the area of three corners, positive if they turn to the left."""
        (ax, ay), (bx, by), (cx, cy) = (self._places[k] for k in (a, b, c))
        return (bx - ax) * (cy - ay) - (by - ay) * (cx - ax)

    def runs_on(self, a: int, b: int, c: int) -> bool:
        """Whether two segments in a row meet in their common corner only."""
        if self.turn(a, b, c):
            return True
        (ax, ay), (bx, by), (cx, cy) = (self._places[k] for k in (a, b, c))
        return (bx - ax) * (cx - bx) + (by - ay) * (cy - by) > 0


def _crossing_pairs(corners: Corners, direction: Direction, *, closed: bool) -> Pairs:
    """The pairs of segments i < j that cross, each in a point inside of both."""
    i, j, k = direction.axes
    slope = np.array([direction.east, direction.north]) / FINENESS
    flat = corners.points[:, [i, j]] - slope * corners.points[:, [k]]
    count = len(flat)
    segments = count if closed else count - 1
    plan = _Plan(corners, direction)
    for corner in range(0 if closed else 1, segments):
        if not plan.runs_on(corner - 1, corner, (corner + 1) % count):
            raise _NoViewError(_MEETS, (corner - 1) % count, corner)
    start, end = flat[:segments], np.roll(flat, -1, axis=0)[:segments]
    found: Pairs = []
    for first, second in _near(start, end):
        apart = (second > first + 1) & ~(closed & (first == 0) & (second == segments - 1))
        a, b = first[apart], second[apart]
        sides = np.stack(
            [
                _sure_side(start[a], end[a], start[b]),
                _sure_side(start[a], end[a], end[b]),
                _sure_side(start[b], end[b], start[a]),
                _sure_side(start[b], end[b], end[a]),
            ]
        )
        missed = (sides[0] * sides[1] > 0) | (sides[2] * sides[3] > 0)
        sure = (sides != 0).all(axis=0)
        found += zip(a[sure & ~missed].tolist(), b[sure & ~missed].tolist(), strict=True)
        for p, r in zip(a[~sure & ~missed].tolist(), b[~sure & ~missed].tolist(), strict=True):
            q, s = (p + 1) % count, (r + 1) % count
            about_p = plan.turn(p, q, r), plan.turn(p, q, s)
            about_r = plan.turn(r, s, p), plan.turn(r, s, q)
            if _same_side(about_p) or _same_side(about_r):
                continue
            if 0 in about_p or 0 in about_r:
                raise _NoViewError(_MEETS, p, r)
            found.append((p, r))
    return found


def _near(start: FloatArray, end: FloatArray) -> Iterator[tuple[IntArray, IntArray]]:
    """Pairs of segments i < j whose boxes meet, with room for rounding."""
    low, high = np.minimum(start, end) - SURE, np.maximum(start, end) + SURE
    for begin in range(0, len(low), BLOCK):
        rows = slice(begin, begin + BLOCK)
        meet = (low[rows, None, 0] <= high[None, begin:, 0]) & (
            high[rows, None, 0] >= low[None, begin:, 0]
        )
        meet &= low[rows, None, 1] <= high[None, begin:, 1]
        meet &= high[rows, None, 1] >= low[None, begin:, 1]
        first, second = np.nonzero(meet)
        yield first + begin, second + begin


def _sure_side(a: FloatArray, b: FloatArray, c: FloatArray) -> FloatArray:
    """+1 where c lies surely left of a segment, -1 where surely right, 0 where it is not sure."""
    along, across = b - a, c - a
    area = along[:, 0] * across[:, 1] - along[:, 1] * across[:, 0]
    sides: FloatArray = np.where(np.abs(area) > SURE, np.sign(area), 0.0)
    return sides


def _same_side(areas: tuple[int, int]) -> bool:
    return min(areas) > 0 or max(areas) < 0
