"""The leader's route in space: ways over the spans joined, with a height for every gate, smoothed.

Between entry and exit of a gate the route keeps one height, over or under the cable that lies
there; a dip ends only where the robot is clear of the cable. Robots hover at the world's altitude,
and the route is back there at each of its robots' own places.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace

import numpy as np
from scipy.sparse import diags_array, eye_array
from scipy.sparse.linalg import spsolve

from knotopt.arrays import FloatArray
from knotopt.flight.gates import Gate, RouteShape
from knotopt.path.curve import length_along

SAMPLE = 0.04  # between points of a route while it is smoothed [grid steps]
SMOOTHING = 0.3  # length over which corners are rounded [grid steps]
FROZEN = 1e7  # weight of what may not change
SLOPE = 2.0  # steepest ramp into a gate


@dataclass(frozen=True)
class HeightShape:
    """How far from laid cable a route passes it [grid steps].

    Parameters
    ----------
    above, below : float
        Height over the robots, or over the cable where that is higher, and depth under the cable.
    """

    above: float = 0.6
    below: float = 1.2


@dataclass(frozen=True)
class SpanShape:
    """How one span is flown: the way in plan, and the heights."""

    route: RouteShape = field(default_factory=RouteShape)
    heights: HeightShape = field(default_factory=HeightShape)

    @property
    def narrower(self) -> list[SpanShape]:
        """This shape, and others that need less room."""
        route, heights = self.route, self.heights
        return [
            SpanShape(
                RouteShape(route.run * share, route.apart * share, route.clear * clear),
                replace(heights, below=heights.below * depth),
            )
            for share, clear, depth in (
                (1.0, 1.0, 1.0),
                (1.0, 1.0, 0.5),
                (0.75, 1.0, 1.0),
                (0.5, 1.0, 1.0),
                (0.5, 0.75, 0.5),
            )
        ]


@dataclass(frozen=True)
class Passage:
    """A gate with heights above the hovering robots [grid steps].

    Attributes
    ----------
    gate : Gate
    cable_height : float
        Of the cable that lies there.
    height : float
        At which the leader passes.
    """

    gate: Gate
    cable_height: float
    height: float


@dataclass(frozen=True, eq=False)
class SpanRoute:
    """What the leader flies between two robots' places.

    Attributes
    ----------
    points : float array, shape (m, 2)
        The way in plan [grid steps]; every gate's place is one of them.
    passages : tuple of Passage
        In the order of flight.
    """

    points: FloatArray
    passages: tuple[Passage, ...]

    @property
    def tether(self) -> float:
        """The longest that cable from the first robot to the leader gets, taut through gates."""
        places = {passage.gate.place: passage.cable_height for passage in self.passages}
        longest = gone = 0.0
        last = np.array([*self.points[0], 0.0])
        for point in self.points:
            longest = max(longest, gone + float(np.hypot(*(point - last[:2]))))
            lies = places.get((float(point[0]), float(point[1])))
            if lies is not None:
                place = np.array([*point, lies])
                gone += float(np.linalg.norm(place - last))
                last = place
        return longest

    def gates_among(self, points: FloatArray) -> list[int]:
        """Which of the points on the way is the place of each gate, in the order of flight.

        A place may be passed twice: every gate is sought behind the one before it.
        """
        found, begin = [], 0
        for passage in self.passages:
            apart = np.linalg.norm(points[begin:] - np.array(passage.gate.place), axis=1)
            found.append(begin + int(np.argmin(apart)))
            begin = found[-1] + 1
        return found

    def up_to(self, gates: int) -> SpanRoute:
        """This route as far as the end of the straight run behind its first gates, one or more."""
        passages = self.passages[:gates]
        end = self.gates_among(self.points)[gates - 1] + 1
        return SpanRoute(np.vstack((self.points[:end], passages[-1].gate.exit)), passages)

    def then(self, rest: SpanRoute) -> SpanRoute:
        """This route, gone on with from where it ends."""
        points = np.concatenate((self.points, rest.points[1:]))
        return SpanRoute(points, self.passages + rest.passages)


@dataclass(frozen=True, eq=False)
class Route:
    """A smooth curve in space by a coordinate, nearly its arc length in plan before smoothing.

    Where the route turns back on itself the curve slows down by its coordinate: it is smooth there
    although its direction is not.

    Attributes
    ----------
    points : float array, shape (m, 3)
        At even steps of the coordinate [grid steps]; heights are above the robots'.
    along : float array, shape (m,)
        Coordinate of each point.
    stops : float array, shape (R,)
        Coordinate of each robot's own place.
    passed : tuple of float
        Coordinate of each gate, in the order of flight.
    """

    points: FloatArray
    along: FloatArray
    stops: FloatArray
    passed: tuple[float, ...]


def build_route(
    approach: FloatArray, spans: Sequence[SpanRoute], frozen: FloatArray | None = None
) -> Route:
    """Join the routes over all spans, and smooth.

    Parameters
    ----------
    approach : float array, shape (2,)
        Where the leader's route starts: straight from there to robot 1's place.
    spans : sequence of SpanRoute
        One for each span.
    frozen : float array, shape (k, 3), optional
        Points that the route begins with, such as were flown already.
    """
    pieces = [_sampled(np.stack((approach, spans[0].points[0])))]
    levels = [np.zeros(len(pieces[0]))]
    marks: list[int] = []
    offset = len(pieces[0]) - 1
    stops = [offset]
    for span in spans:
        piece = _sampled(span.points)
        at = span.gates_among(piece)
        levels.append(_profile(piece, at, span.passages)[1:])
        pieces.append(piece[1:])
        marks += [offset + index for index in at]
        offset += len(piece) - 1
        stops.append(offset)
    rough = np.column_stack((np.concatenate(pieces), np.concatenate(levels)))
    firm = np.ones(len(rough))
    firm[marks] = 30.0
    firm[stops] = 1e9
    firm[[0, -1]] = 1e9
    if frozen is not None:
        rough[: len(frozen)] = frozen
        firm[: len(frozen)] = FROZEN
    points = _smoothed(rough, firm)
    along: FloatArray = SAMPLE * np.arange(len(points), dtype=np.float64)
    return Route(points, along, along[stops], tuple(along[marks].tolist()))


def _sampled(points: FloatArray) -> FloatArray:
    """A polyline at nearly even distances, its ends and corners kept."""
    chords = np.linalg.norm(np.diff(points, axis=0), axis=1)
    points = points[np.concatenate(([True], chords > 1e-9))]
    chords = chords[chords > 1e-9]
    counts = np.maximum(np.round(chords / SAMPLE).astype(int), 1)
    shares = [np.arange(count) / count for count in counts]
    inner = [
        points[k] + share[:, None] * (points[k + 1] - points[k]) for k, share in enumerate(shares)
    ]
    return np.concatenate((*inner, points[-1:]))


def _profile(piece: FloatArray, at: list[int], passages: Sequence[Passage]) -> FloatArray:
    """Heights along a way: level through gates, ramps between, zero at both ends."""
    along = length_along(piece)
    end = along[-1]
    places, values = [0.0], [0.0]
    for k, (index, passage) in enumerate(zip(at, passages, strict=True)):
        enters, leaves = (along[index] + way * passage.gate.run for way in (-1, 1))
        height = passage.height
        room = enters - places[-1]
        ramp = abs(height) / SLOPE
        before = abs(values[-1]) / SLOPE
        if k and room > ramp + before:  # back among the robots in between
            places += [places[-1] + before, enters - ramp]
            values += [0.0, 0.0]
        elif not k and room > ramp:
            places.append(enters - ramp)
            values.append(0.0)
        places += [max(enters, places[-1] + 1e-6), leaves]
        values += [height, height]
    if passages:
        places.append(min(places[-1] + abs(values[-1]) / SLOPE, max(end, places[-1] + 1e-6)))
        values.append(0.0)
    return np.interp(along, places, values)


def _smoothed(points: FloatArray, firm: FloatArray) -> FloatArray:
    """The curve nearest to points, by least squares, whose third differences are small."""
    count = len(points)
    if count < 5:
        return points
    rows = diags_array(
        [-1.0, 3.0, -3.0, 1.0], offsets=[0, 1, 2, 3], shape=(count - 3, count), dtype=np.float64
    )
    stiffness = (SMOOTHING / SAMPLE) ** 6
    system = (diags_array(firm) @ eye_array(count) + stiffness * (rows.T @ rows)).tocsc()
    return np.asarray(spsolve(system, firm[:, None] * points))
