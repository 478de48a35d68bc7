"""A rope drawn from its topological state alone, which says nothing about lengths or places.

The rope is laid through tangent discs, one for each crossing, for each segment or a few, and more
to fill the faces, along arcs that meet the discs' boundaries at right angles. So it is smooth, and
two strands cross once in their crossing's disc and nowhere else.
"""

from __future__ import annotations

from functools import lru_cache
from itertools import count

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection

from knotopt.arrays import ComplexArray, FloatArray
from knotopt.path.curve import length_along
from knotopt.plot.cable import CABLE_COLOUR
from knotopt.plot.packing import Triangle, circle_packing
from knotopt.topology.extract import extract_state
from knotopt.topology.state import RopeState

ARC_POINTS = 12  # of the rope in one disc; an even number, so that none lies on a crossing
LOOP_DISCS = 3  # of a segment that comes back to its crossing; others have one
END_SHARE = 0.5  # of the width or height of what lies between: the longest that an end is
GAP_SHARE = 0.35  # of the way to the next crossing that a gap takes up, at most


@lru_cache(maxsize=512)
def rope_curve(state: RopeState) -> FloatArray:
    """A smooth rope with this state: a polyline from head to tail, shape (m, 3), read-only.

    In plan the head is on the left, the tail at the same y, and the rope just fills a square of
    side 1 about the origin; heights are 1, 0 or -1. Outside is the face with both ends of the rope
    in it, if there is one, or else with most sides, preferably one with an end. Drawings of mirror
    images are mirror images.

    Raises
    ------
    ValueError
        The state is none of a rope in the plane.

    Examples
    --------
    >>> state = RopeState.from_gauss("U1+ O2+ U3+ O1+ U2+ O3+")
    >>> extract_state(rope_curve(state)).state == state
    True
    """
    if not state.is_planar:
        raise ValueError(f"{state}: not a rope in the plane")
    curve = _STRAIGHT
    if state.crossings:
        curve = _level(_trimmed(_level(_through(*_discs(state)))))
    low, high = curve[:, :2].min(axis=0), curve[:, :2].max(axis=0)
    plan = (curve[:, :2] - (low + high) / 2) / (high - low).max()
    curve = np.hstack((plan, curve[:, 2:]))
    curve.flags.writeable = False
    return curve


def draw_rope(
    axes: Axes,
    state: RopeState,
    *,
    centre: tuple[float, float] = (0.0, 0.0),
    size: float = 1.0,
    gap: float = 0.04,
    width: float = 1.5,
) -> None:
    """A rope broken where it passes under itself, with a dot at its head.

    Parameters
    ----------
    axes : Axes
    state : RopeState
    centre : (float, float)
    size : float
        Side of the square that it fills.
    gap : float
        Half-width of the gaps at most, as a share of the size.
    width : float
        Of the line [points].
    """
    curve = rope_curve(state)
    along = length_along(curve[:, :2])
    visits = extract_state(curve, plan_tolerance=0).visits
    at = np.interp(visits.parameter, np.arange(len(curve)), along)
    marks = np.concatenate(([0.0], at, along[-1:]))
    room = GAP_SHARE * np.minimum(np.diff(marks)[:-1], np.diff(marks)[1:])
    half = np.minimum(gap, room)[visits.gap < 0]
    under = at[visits.gap < 0]
    bounds = np.concatenate(([0.0], np.stack((under - half, under + half), 1).ravel(), along[-1:]))
    pieces = [
        _piece(curve[:, :2], along, start, end) * size + centre
        for start, end in bounds.reshape(-1, 2).tolist()
    ]
    axes.add_collection(
        LineCollection(pieces, colors=CABLE_COLOUR, linewidths=width, capstyle="butt", zorder=3)
    )
    x, y = pieces[0][0]
    axes.plot([x], [y], "o", color=CABLE_COLOUR, markersize=2.2 * width, zorder=4)


def _discs(state: RopeState) -> tuple[ComplexArray, FloatArray, FloatArray]:
    """Centres and radii of the discs along the rope, those of crossings twice, and its heights."""
    new = count()
    crossing: list[int] = []  # at each visit
    for visit, entry in enumerate(state.code):
        crossing.append(crossing[entry >> 2] if entry >> 2 < visit else next(new))
    last = len(crossing)
    segments = []
    for s in range(last + 1):
        is_loop = 0 < s < last and crossing[s - 1] == crossing[s]
        segments.append([next(new) for _ in range(LOOP_DISCS if is_loop else 1)])
    rope, height = list(segments[0]), [0.0]
    for entry, disc, segment in zip(state.code, crossing, segments[1:], strict=True):
        rope += [disc, *segment]
        height += [1.0 if entry & 2 else -1.0, *(0.0 for _ in segment)]
    triangles: list[Triangle] = []
    outer: list[int] = []
    outside = max(state.faces, key=lambda face: _outwardness(face, last))
    for face in state.faces:
        border = _border(face, crossing, segments)
        if face == outside or len(set(border)) < len(border):
            # A disc on both sides of the face would touch one disc in its middle twice.
            ring = [next(new) for _ in border]
            for (a, b), (c, d) in zip(_pairs(border), _pairs(ring), strict=True):
                triangles += [(a, b, c), (b, d, c)]
            border = ring
        if face == outside:
            outer = border
        else:
            middle = next(new)
            triangles += [(a, b, middle) for a, b in _pairs(border)]
    centres, radii = circle_packing(triangles, outer)
    return centres[rope], radii[rope], np.array(height)


def _outwardness(face: tuple[int, ...], last: int) -> tuple[bool, int, int, list[int]]:
    """Sorts faces: both ends in it, sides without those of ends, ends; mirror images alike."""
    segments = sorted(dart >> 1 for dart in face)
    ends = len({0, last}.intersection(segments))
    return ends == 2, len(face) - 2 * ends, ends, segments


def _border(face: tuple[int, ...], crossing: list[int], segments: list[list[int]]) -> list[int]:
    """Discs around a face, the face on the left."""
    border: list[int] = []
    for dart in face:
        segment = dart >> 1
        start = segment if dart & 1 else segment - 1  # the visit that the dart comes from
        if 0 <= start < len(crossing):
            border += [crossing[start], *segments[segment][:: -1 if dart & 1 else 1]]
    return border


def _pairs(around: list[int]) -> list[tuple[int, int]]:
    return list(zip(around, around[1:] + around[:1], strict=True))


def _through(centre: ComplexArray, radius: FloatArray, height: FloatArray) -> FloatArray:
    """Points of the rope through its discs, shape (m, 3)."""
    share = radius[:-1] / (radius[:-1] + radius[1:])
    touch = centre[:-1] + share * np.diff(centre)
    middle, scale = centre[1:-1], radius[1:-1]
    start, end = (touch[:-1] - middle) / scale, (touch[1:] - middle) / scale
    # The chord is a line of the hyperbolic plane in Klein's model, the arc in Poincare's.
    along = (1 - np.cos(np.linspace(0, np.pi, ARC_POINTS))) / 2
    chord = start[:, None] + (end - start)[:, None] * along[:-1]
    arc = chord / (1 + np.sqrt(np.maximum(0, 1 - np.abs(chord) ** 2)))
    arcs = middle[:, None] + scale[:, None] * arc
    height = np.repeat(height[1:-1], ARC_POINTS - 1)
    plan = np.concatenate((centre[:1], arcs.ravel(), touch[-1:], centre[-1:]))
    return np.stack((plan.real, plan.imag, np.concatenate(([0.0], height, [0.0, 0.0]))), axis=1)


def _level(curve: FloatArray) -> FloatArray:
    """Turned in plan so that the way from head to tail goes to the right."""
    x, y = curve[-1, :2] - curve[0, :2]
    turn = np.array([[x, -y], [y, x]]) / np.hypot(x, y)
    return np.hstack((curve[:, :2] @ turn, curve[:, 2:]))


def _trimmed(curve: FloatArray) -> FloatArray:
    """The rope with its ends no longer than a share of what lies between."""
    along = length_along(curve[:, :2])
    visits = extract_state(curve, plan_tolerance=0).visits.parameter
    first, last = np.interp(visits[[0, -1]], np.arange(len(curve)), along)
    longest = END_SHARE * np.ptp(_piece(curve, along, first, last)[:, :2], axis=0).max()
    return _piece(curve, along, max(0.0, first - longest), min(along[-1], last + longest))


def _piece(curve: FloatArray, along: FloatArray, start: float, end: float) -> FloatArray:
    """The rope from one length along it to another."""
    places = np.concatenate(([start], along[(along > start) & (along < end)], [end]))
    return np.stack([np.interp(places, along, column) for column in curve.T], axis=1)


_STRAIGHT = np.array([[0.0, 0, 0], [1, 0, 0]])
