"""The plan of a flight: where every robot is at every instant, and what the leader ties by it."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import Self

import numpy as np
from scipy.spatial.distance import pdist

from knotopt.arrays import FloatArray
from knotopt.cable.cable import Cable
from knotopt.flight.limits import FlightLimits
from knotopt.flight.request import FlightRequest
from knotopt.path.world import World
from knotopt.showing import ShownShort, plural


@dataclass(frozen=True)
class PlannedCrossing:
    """One crossing of the leader's route with cable that is laid already.

    Attributes
    ----------
    span : int
        Span that is being flown: span j is the cable from robot j to robot j + 1 (1-based).
    older : int
        Span that is crossed, `older` < `span`.
    over : bool
        Whether the route passes over it.
    sense : int
        +1 where the route crosses the older span, seen along that one, from its right to its
        left, else -1.
    place : tuple of float
        Where in plan, (x, y) [m].
    height, cable_height : float
        Of the route and of the older span there [m].
    route : float
        Arc length along the leader's route [m].
    time : float
        When the leader is there [s].
    """

    span: int
    older: int
    over: bool
    sense: int
    place: tuple[float, float]
    height: float
    cable_height: float
    route: float
    time: float

    @property
    def name(self) -> str:
        """The crossing in words, such as "span 4 over span 1"."""
        return f"span {self.span} {'over' if self.over else 'under'} span {self.older}"


@dataclass(frozen=True, eq=False, kw_only=True)
class MotionPlan:
    """Every robot's position over time. Robot 1 holds the cable's first end; robot R, the leader,
    its last.

    Attributes
    ----------
    schedule : str
        "fixed", "optimised" or "rehearsed".
    world : World
    limits : FlightLimits
    times : float array, shape (T,)
        Evenly spaced from 0 [s].
    positions : float array, shape (T, R, 3)
        Of the robots [m; x along columns, y along rows, z up from the ground].
    lengths : float array, shape (R - 1,)
        Of cable between consecutive robots [m].
    route : float array, shape (m, 3)
        The leader's whole way, evenly spaced in arc length [m].
    crossings : tuple of PlannedCrossing
        In the order of flight.
    passes : float array, shape (R - 1,)
        When the leader is at the places of robots 1 to R - 1, where spans begin [s].
    notes : tuple of str
        What the planner could not do as asked.
    tightening : float
        Time at the end in which the knot, laid before, is pulled tight, hovering after it included
        [s]; 0 where it is not.
    """

    schedule: str
    world: World
    limits: FlightLimits
    times: FloatArray
    positions: FloatArray
    lengths: FloatArray
    route: FloatArray
    crossings: tuple[PlannedCrossing, ...]
    passes: FloatArray
    notes: tuple[str, ...] = field(default=())
    tightening: float = 0.0

    def noted(self, *notes: str) -> Self:
        """The plan with further notes."""
        return replace(self, notes=(*self.notes, *notes))

    @property
    def robots(self) -> int:
        """Number of robots R, the two at the cable's ends included."""
        return len(self.lengths) + 1

    @property
    def laid(self) -> float:
        """Time at which the knot is laid and the robots have hovered [s]."""
        return self.duration - self.tightening

    @property
    def laying(self) -> int:
        """Number of samples until then."""
        return round(self.laid / self.interval) + 1

    @property
    def anchors(self) -> FloatArray:
        """Where the robots hover when the knot is laid, shape (R, 3) [m]."""
        return np.asarray(self.positions[self.laying - 1])

    @property
    def ends_apart(self) -> tuple[float, float]:
        """Distance of the robots at the cable's ends, when the knot is laid and at last [m]."""
        first, last = np.linalg.norm([each[-1] - each[0] for each in self._rests], axis=1).tolist()
        return first, last

    @property
    def supports_within(self) -> tuple[float, float]:
        """Largest distance of two supports, when the knot is laid and at last [m]; 0 of one."""
        first, last = (max(pdist(each[1:-1]), default=0.0) for each in self._rests)
        return float(first), float(last)

    @property
    def _rests(self) -> tuple[FloatArray, FloatArray]:
        return self.anchors, self.positions[-1]

    @property
    def duration(self) -> float:
        """Time of flight, hovering included [s]."""
        return float(self.times[-1])

    @property
    def interval(self) -> float:
        """Time between samples [s]."""
        return float(self.times[1] - self.times[0])


@dataclass(frozen=True, eq=False, kw_only=True, repr=False)
class FlightPlan(ShownShort, MotionPlan):
    """A motion that ties the knot of a grid diagram with supports on its cable.

    Attributes
    ----------
    name : str
        Of the knot.
    cable : Cable
    supports : tuple of int
        Turning points with a support robot (1-based).
    chosen_by : str
        How the supports were chosen: "milp", "lcf", "all" or a file.
    """

    name: str
    cable: Cable
    supports: tuple[int, ...]
    chosen_by: str

    @property
    def in_words(self) -> str:
        """Knot, robots, schedule, duration."""
        flown = f"{self.schedule} schedule, {self.duration:.1f} s"
        return f"{self.name}, cut {self.cable.cut}, {plural(self.robots, 'robot')}, {flown}"


def with_supports(
    motion: MotionPlan, cable: Cable, supports: tuple[int, ...], request: FlightRequest
) -> FlightPlan:
    """A motion as the flight plan of a knot that was asked for."""
    return FlightPlan(
        **vars(motion),
        name=request.name,
        cable=cable,
        supports=supports,
        chosen_by=request.chosen_by,
    )
