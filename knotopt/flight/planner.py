"""From supports to a flight plan: a route over every span, and a schedule."""

from __future__ import annotations

from copy import copy
from dataclasses import replace

import numpy as np
from scipy.spatial.distance import pdist

from formulations.schedule import Schedule, fastest_schedule, steady_schedule
from knotopt.arrays import FloatArray
from knotopt.cable.cable import Cable
from knotopt.errors import RequirementError
from knotopt.flight.formation import Formation
from knotopt.flight.laid_cable import Laid, hanging_cable
from knotopt.flight.limits import ROOM, FlightLimits
from knotopt.flight.plan import FlightPlan, PlannedCrossing
from knotopt.flight.route import SAMPLE, Passage, SpanRoute, SpanShape, build_route
from knotopt.flight.router import Crossed, Router, RouteShape, Way
from knotopt.flight.word import span_words
from knotopt.path.mesh import robot_times
from knotopt.path.world import World

INTERVAL = 0.05  # between samples of a plan [s]
MARGIN = 0.95  # share of speed and acceleration that a schedule uses
OUTSIDE = 20.0  # as far as no route goes [grid steps]
CLEAR = 1.15  # times the separation that routes keep from hovering robots
APART = 1.03  # of the separation that robots keep at nodes
WIDER = (1.0, 1.15, 1.3, 1.5, 1.75, 2.0)  # spacings tried
SCHEDULES = ("optimised", "fixed")


class FlightPlanner:
    """Plans the flight of a cable with its supports, span by span.

    Parameters
    ----------
    cable : Cable
    supports : tuple of int
    world : World
    limits : FlightLimits

    Attributes
    ----------
    places : float array, shape (R, 2)
        Of the robots in plan [grid steps].
    words : tuple of tuple of Letter
        Of each span.
    spans : list of SpanRoute
        Routes over the first spans, as far as they are planned.
    lengths : list of float
        Of the cable in these spans [grid steps].
    spacing : float
        Between robots in file [m], at least that of the limits.
    frozen : float array, shape (k, 3)
        The beginning of the route that is not to change any more [grid steps].
    """

    def __init__(
        self, cable: Cable, supports: tuple[int, ...], world: World, limits: FlightLimits
    ) -> None:
        self.cable, self.supports = cable, supports
        self.world, self.limits = world, limits
        self.places = cable.cells[robot_times(cable, supports)].astype(float)
        apart = pdist(self.places) * world.step
        if apart.min() < limits.separation:
            first, second = np.array(np.triu_indices(len(self.places), 1))[:, apart.argmin()]
            raise RequirementError(
                f"robots {first + 1} and {second + 1} hover {apart.min():.2f} m apart, less than "
                f"the separation of {limits.separation:g} m: a larger grid step is needed"
            )
        self.words = span_words(cable, supports)
        self.spans: list[SpanRoute] = []
        self.lengths: list[float] = []
        self.spacing = limits.spacing
        self.frozen: FloatArray = np.zeros((0, 3))

    @property
    def robots(self) -> int:
        """Number of robots."""
        return len(self.places)

    def modelled(self, spans: int) -> Laid:
        """The first spans, straight in plan and hanging as catenaries."""
        ends = np.column_stack((self.places, np.zeros(len(self.places))))
        return Laid(
            [hanging_cable(ends[i], ends[i + 1], self.lengths[i], 40) for i in range(spans)]
        )

    @property
    def tail(self) -> FloatArray:
        """A line in plan from p_1 out of the grid, that no route crosses, shape (2, 2)."""
        inwards = np.sign(np.diff(self.cable.points[:2].astype(float), axis=0))[0]
        return np.stack((self.places[0], self.places[0] - OUTSIDE * inwards))

    def crossed(self, spans: int) -> dict[int, list[tuple[float | None, float]]]:
        """Where the first spans are crossed by later ones among them: time, arc length."""
        found: dict[int, list[tuple[float | None, float]]] = {}
        for span in self.spans[:spans]:
            for gate in (passage.gate for passage in span.passages):
                found.setdefault(gate.letter.older, []).append((gate.letter.first, gate.along))
        return found

    def find_route(self, span: int, laid: Laid, shape: SpanShape) -> SpanRoute | None:
        """A route over span `span` (1-based), past the spans before it, or None.

        Raises
        ------
        RequirementError
            The room is too low for a gate.
        """
        router = Router(
            laid.in_plan,
            self.places[:span],
            self.places[span - 1],
            self.places[span],
            self.cleared(shape.route),
            [self.tail],
        )
        word = self.words[span - 1]
        orders: tuple[Crossed, ...] = (self.crossed(span - 1), {})
        for crossed in orders:
            way = router.find(word, crossed)
            if way is not None:
                return self.with_heights(way, laid, shape)
        return None

    def cleared(self, shape: RouteShape) -> RouteShape:
        """A shape that keeps from hovering robots what the limits ask for."""
        needed = CLEAR * self.limits.separation / self.world.step
        return replace(shape, clear=max(shape.clear, needed))

    def with_heights(self, way: Way, laid: Laid, shape: SpanShape) -> SpanRoute:
        """A way with a height in every gate.

        Raises
        ------
        RequirementError
            The room is too low for one.
        """
        world, passages = self.world, []
        lowest, highest = (
            (bound - world.altitude) / world.step for bound in (world.floor, world.ceiling)
        )
        for gate in way.gates:
            lies = laid.height(gate)
            over, under = max(lies, 0.0) + shape.heights.above, lies - shape.heights.below
            height = over if gate.letter.over else under
            if not lowest <= height <= highest:
                raise RequirementError(
                    f"to pass {gate.letter}, which hangs {-lies * world.step:.2f} m below the "
                    f"robots, the leader flies at {world.altitude + height * world.step:.2f} m; "
                    f"the room has {world.floor:g} to {world.ceiling:g} m"
                )
            passages.append(Passage(gate, lies, height))
        return SpanRoute(way.points, tuple(passages))

    def add(self, span: SpanRoute) -> None:
        """Take a route for the next span."""
        self.spans.append(span)
        self.lengths.append(span.tether * (1 + self.limits.slack))

    def plan_routes(self, shape: SpanShape) -> None:
        """Routes over all spans that are not planned yet, by the model of laid cable.

        Raises
        ------
        RequirementError
            There is no way, and which span and crossings that is.
        """
        for span in range(len(self.spans) + 1, self.robots):
            laid = self.modelled(span - 1)
            too_low: RequirementError | None = None
            for tried in shape.narrower:
                try:
                    route = self.find_route(span, laid, tried)
                except RequirementError as error:
                    too_low = error
                    continue
                if route is not None:
                    break
            else:
                if too_low is not None:
                    raise too_low
                word = ", ".join(map(str, self.words[span - 1])) or "no crossing"
                raise RequirementError(
                    f"there is no way for span {span}, from robot {span} to {span + 1}, with "
                    f"{word}: the laid cable and the hovering robots leave no room"
                )
            self.add(route)

    def formation(self) -> Formation:
        """The robots in file on the route over all spans."""
        inwards = np.sign(np.diff(self.cable.points[:2].astype(float), axis=0))[0]
        spacing = self.spacing / self.world.step
        approach = self.places[0] - inwards * (self.robots - 1) * spacing
        return Formation(
            build_route(approach, self.spans, self.frozen), self.world, self.limits, self.spacing
        )

    def space_out(self) -> Formation:
        """The formation, with the file's spacing enlarged until robots keep their separation.

        Corners and arcs bring robots nearer to each other than their distance along the route.
        """
        least = self.spacing
        for share in WIDER:
            self.spacing = share * least
            formation = self.formation()
            if formation.separation >= APART:
                break
        return formation

    def start_farther(self, distance: float) -> None:
        """Start the file farther outside, with more spacing; what is frozen of the route stays.

        Parameters
        ----------
        distance : float
            About [grid steps]: the route's points remain even.
        """
        count = round(distance / SAMPLE)
        out = self.tail[1] - self.tail[0]
        away = SAMPLE * np.arange(count, 0, -1)[:, None] * out / np.linalg.norm(out)
        start = np.column_stack((self.frozen[0, :2] + away, np.zeros(count)))
        self.frozen = np.concatenate((start, self.frozen))
        self.spacing += count * SAMPLE * self.world.step / (self.robots - 1)

    def copy(self) -> FlightPlanner:
        """A planner that has the same routes and can be changed by itself."""
        other = copy(self)
        other.spans, other.lengths = list(self.spans), list(self.lengths)
        return other

    def cable_lengths(self, formation: Formation) -> FloatArray:
        """Of the cable between robots, enough for the whole flight, shape (R - 1,) [m]."""
        apart = formation.farthest * (1 + self.limits.slack)
        return np.maximum(apart, np.array(self.lengths) * self.world.step)

    def plan(
        self,
        name: str,
        chosen_by: str,
        schedule: str | Schedule = "optimised",
        lengths: FloatArray | None = None,
    ) -> FlightPlan:
        """The flight plan of the routes taken, which must be those of all spans.

        Parameters
        ----------
        name, chosen_by : str
        schedule : str or Schedule
            "optimised", "fixed", or one at hand.
        lengths : float array, shape (R - 1,), optional
            Of the cable between robots; at least what the flight needs [m].
        """
        formation = self.space_out() if lengths is None else self.formation()
        limits, nodes = self.limits, formation.nodes
        derivatives = formation.derivatives(nodes)
        notes: tuple[str, ...] = ()
        separation = formation.separation
        if separation < 1:
            notes = (
                f"robots come within {separation:.2f} of their separation: the route turns back "
                "on the file, or passes a robot too closely",
            )
        if isinstance(schedule, Schedule):
            found = schedule
        elif schedule == "optimised":
            found = fastest_schedule(nodes, *derivatives, *kept(limits))
            if not found.is_optimal:
                notes += (f"the schedule is feasible, not proven optimal: {found.raw_status}",)
        else:
            found = steady_schedule(nodes, *derivatives, *kept(limits))
        duration = limits.hover_before + found.duration + limits.hover_after
        times = sample_times(int(np.ceil(duration / INTERVAL)) + 1)
        passed = iter(formation.route.passed)
        crossings = []
        for k, span in enumerate(self.spans, 1):
            for passage in span.passages:
                along = next(passed) * self.world.step
                when = limits.hover_before + found.when(along)
                crossings.append(self._crossing(k, passage, along, formation, when))
        passes = [limits.hover_before + found.when(stop) for stop in formation.stops[:-1]]
        return FlightPlan(
            name,
            self.cable,
            self.supports,
            chosen_by,
            schedule if isinstance(schedule, str) else schedule.raw_status,
            self.world,
            limits,
            times,
            formation.positions(found.at(times - limits.hover_before)),
            self.cable_lengths(formation) if lengths is None else lengths,
            formation.drawn(),
            tuple(crossings),
            np.array(passes),
            notes,
        )

    def _crossing(
        self, span: int, passage: Passage, along: float, formation: Formation, when: float
    ) -> PlannedCrossing:
        x, y, z = formation.point(along).tolist()
        letter = passage.gate.letter
        lies = self.world.altitude + passage.cable_height * self.world.step
        return PlannedCrossing(
            span,
            letter.older,
            letter.over,
            letter.sense,
            (x, y),
            z,
            lies,
            formation.arc_length(along),
            when,
        )


def sample_times(count: int) -> FloatArray:
    """Times of the first samples of a plan [s]."""
    times: FloatArray = INTERVAL * np.arange(count, dtype=np.float64)
    return times


def kept(limits: FlightLimits) -> tuple[float, float]:
    """Speed and acceleration that leave something for what happens between nodes."""
    return MARGIN * limits.speed, MARGIN * limits.acceleration


def plan_flight(
    name: str,
    cable: Cable,
    supports: tuple[int, ...],
    chosen_by: str = "all",
    world: World = ROOM,
    limits: FlightLimits | None = None,
    schedule: str = "optimised",
    shape: SpanShape | None = None,
) -> FlightPlan:
    """Plan a flight by the model of laid cable: straight in plan, catenaries in height.

    Parameters
    ----------
    name : str
        Of the knot.
    cable : Cable
    supports : tuple of int
        Turning points with a support robot (1-based).
    chosen_by : str
        How they were chosen.
    world : World
    limits : FlightLimits, optional
    schedule : str
        "optimised" or "fixed": at one path speed throughout, as in the paper.
    shape : SpanShape, optional

    Raises
    ------
    RequirementError
        Limits that no flight keeps: no way between cable and robots, or too low a room.

    Examples
    --------
    >>> from knotopt.catalogue.lookup import find_knot
    >>> cable = Cable(find_knot("3").diagram, "L+")
    >>> plan = plan_flight("3_1", cable, (3, 4, 6), schedule="fixed")
    >>> [crossing.name for crossing in plan.crossings]
    ['span 4 over span 1', 'span 4 under span 1', 'span 4 over span 2']
    """
    if schedule not in SCHEDULES:
        raise RequirementError(f"a schedule is one of {', '.join(SCHEDULES)}, not {schedule!r}")
    planner = FlightPlanner(cable, supports, world, limits or FlightLimits())
    planner.plan_routes(shape or SpanShape())
    return planner.plan(name, chosen_by, schedule)
