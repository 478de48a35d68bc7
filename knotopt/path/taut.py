"""The taut string: the shortest curve through the robots that passes them as the cable does.

Between two consecutive robots the cable may be deformed freely in the plane without the other
robots; the shortest curve of its homotopy class, in which a robot may be touched, is what the cable
becomes when pulled tight with its own strands passing through each other. No path that passes the
robots on the same sides, as one does that is deformed with its diagram while they stay where they
are, is shorter in plan, let alone in space.

The span's class is read off the edges of a triangulation of the robots that it crosses; the
shortest curve through those edges is found by the funnel algorithm (Lee and Preparata,
doi:10.1002/net.3230140304; Hershberger and Snoeyink, doi:10.1016/0925-7721(94)90010-8).
"""

from __future__ import annotations

from itertools import pairwise

import numpy as np

from knotopt.arrays import FloatArray, IntArray
from knotopt.cable.cable import Cable
from knotopt.path.mesh import robot_times
from knotopt.path.plane import cross
from knotopt.path.triangulation import triangulate

Point = tuple[float, float]
Portal = tuple[int, int]  # robots left and right of the way through an edge

NUDGE = (0.0917, 0.1373)
"""Where two strands or a strand and an edge run on one line, the span is looked at this much aside;
robots and strands are a whole step apart, so it passes the same robots on the same sides."""


def taut_string(cable: Cable, supports: tuple[int, ...]) -> list[FloatArray]:
    """The taut string's spans, each from a robot to the next, shape (k, 2) [grid steps].

    Raises
    ------
    RequirementError
        A support that is no turning point between the ends.

    Examples
    --------
    >>> from knotopt.reading.knot import read_knot
    >>> cable = Cable(read_knot("3").diagram, "L+")
    >>> [span.tolist() for span in taut_string(cable, ())]
    [[[1.0, 4.0], [1.0, 1.0]]]
    """
    times = robot_times(cable, supports)
    robots = cable.cells[times].astype(np.float64)
    size = cable.diagram.size
    frame = np.array([[0, 0], [size + 1, 0], [size + 1, size + 1], [0, size + 1]], dtype=float)
    points = np.concatenate((robots, frame))
    edges = _edges(triangulate(points, np.empty((0, 2), dtype=np.int64)))
    spans = []
    for index, (start, end) in enumerate(pairwise(times.tolist())):
        corners = cable.times[(cable.times > start) & (cable.times < end)]
        inner = cable.cells[corners] + np.array(NUDGE)
        way = np.concatenate((robots[index : index + 1], inner, robots[index + 1 : index + 2]))
        portals = _reduced(_crossed(way, points, edges, index), index, index + 1)
        chosen = _funnel(index, index + 1, portals, points)
        spans.append(points[chosen])
    return spans


def taut_length(cable: Cable, supports: tuple[int, ...]) -> float:
    """Length of the taut string [grid steps], a lower bound of every path in its class."""
    return float(
        sum(
            np.linalg.norm(np.diff(span, axis=0), axis=1).sum()
            for span in taut_string(cable, supports)
        )
    )


def _edges(triangles: IntArray) -> IntArray:
    ends = np.sort(np.concatenate([triangles[:, [k, (k + 1) % 3]] for k in range(3)]), axis=1)
    edges: IntArray = np.unique(ends, axis=0)
    return edges


def _crossed(way: FloatArray, points: FloatArray, edges: IntArray, start: int) -> list[Portal]:
    """The edges that a polyline crosses, in order, each with its left end first."""
    a, b = points[edges[:, 0]], points[edges[:, 1]]
    portals: list[Portal] = []
    last = len(way) - 2
    for step, (p, q) in enumerate(pairwise(way)):
        ends = {start} if step == 0 else set()
        ends |= {start + 1} if step == last else set()
        side_a, side_b = _area(p, q, a), _area(p, q, b)
        from_p, from_q = _area(a, b, p), _area(a, b, q)
        crossed = (side_a * side_b < 0) & (from_p * from_q < 0)
        crossed &= ~np.isin(edges, list(ends)).any(axis=1)
        found = np.flatnonzero(crossed)
        share = from_p[found] / (from_p[found] - from_q[found])
        for k in found[np.argsort(share)]:
            low, high = (int(v) for v in edges[k])
            portals.append((low, high) if side_a[k] > 0 else (high, low))
    return portals


def _reduced(portals: list[Portal], start: int, end: int) -> list[Portal]:
    """Without ways through an edge and back, and without turns round the span's own ends."""
    kept: list[Portal] = []
    for portal in portals:
        if kept and kept[-1] == portal[::-1]:
            kept.pop()
        else:
            kept.append(portal)
    while kept and start in kept[0]:
        kept.pop(0)
    while kept and end in kept[-1]:
        kept.pop()
    return kept


def _funnel(start: int, end: int, portals: list[Portal], points: FloatArray) -> list[int]:
    """Points that the shortest way from start to end through the portals bends at."""
    portals = [*portals, (end, end)]
    way = [start]
    apex, border, met = start, [start, start], [-1, -1]  # left and right, and their portals
    k = 0
    while k < len(portals):
        for side, sign in ((1, 1), (0, -1)):
            p, new, other = points[apex], portals[k][side], border[1 - side]
            if sign * _area(p, points[border[side]], points[new]) < 0:
                continue
            if apex == border[side] or sign * _area(p, points[other], points[new]) < 0:
                border[side], met[side] = new, k
            else:
                way.append(other)
                apex, k = other, met[1 - side]
                border, met = [apex, apex], [k, k]
                break
        k += 1
    way.append(end)
    return [v for i, v in enumerate(way) if i == 0 or v != way[i - 1]]


def _area(a: FloatArray, b: FloatArray, c: FloatArray) -> FloatArray:
    """Twice the signed area of triangle abc; any of them may be an array of points."""
    return cross(b - a, c - a)
