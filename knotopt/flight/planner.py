"""From a layout to the motion of its robots: a route over every span, and a schedule."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace

import numpy as np
from scipy.spatial.distance import pdist

from formulations.schedule import Schedule, fastest_schedule, steady_schedule
from knotopt.arrays import FloatArray
from knotopt.cable.cable import Cable
from knotopt.errors import RequirementError
from knotopt.flight.formation import Formation
from knotopt.flight.gates import Crossed
from knotopt.flight.grid_layout import layout_of_supports
from knotopt.flight.laid_cable import LaidCable, hanging_cable
from knotopt.flight.layout import Layout
from knotopt.flight.limits import ROOM, FlightLimits
from knotopt.flight.plan import FlightPlan, MotionPlan, PlannedCrossing, with_supports
from knotopt.flight.request import FlightRequest
from knotopt.flight.route import SAMPLE, Passage, SpanRoute, SpanShape, build_route
from knotopt.flight.router import Router, Way
from knotopt.path.world import World

INTERVAL = 0.05  # between samples of a plan [s]
MARGIN = 0.95  # share of speed and acceleration that a schedule uses
CLEAR = 1.15  # times the separation that routes keep from hovering robots
APART = 1.03  # of the separation that robots keep at nodes
WIDER = (1.0, 1.15, 1.3, 1.5, 1.75, 2.0)  # spacings tried


@dataclass(frozen=True, eq=False)
class FlightPlanner:
    """The flight of a layout as far as it is planned; every step returns another planner.

    Parameters
    ----------
    layout : Layout
    world : World
    limits : FlightLimits
    spans : tuple of SpanRoute
        Routes over the first spans.
    lengths : tuple of float
        Of the cable in these spans as they were planned first [grid steps].
    spacing : float
        Between robots in file [m]; raised to that of the limits.
    flown : float array, shape (k, 3)
        The beginning of the route that is not to change any more [grid steps].

    Raises
    ------
    RequirementError
        Robots that would hover closer than their separation.
    """

    layout: Layout
    world: World = ROOM
    limits: FlightLimits = field(default_factory=FlightLimits)
    spans: tuple[SpanRoute, ...] = ()
    lengths: tuple[float, ...] = ()
    spacing: float = 0.0
    flown: FloatArray = field(default_factory=lambda: np.zeros((0, 3)))

    def __post_init__(self) -> None:
        object.__setattr__(self, "spacing", max(self.spacing, self.limits.spacing))
        apart = pdist(self.layout.places) * self.world.step
        if apart.min() < self.limits.separation:
            first, second = np.array(np.triu_indices(self.layout.robots, 1))[:, apart.argmin()]
            raise RequirementError(
                f"robots {first + 1} and {second + 1} hover {apart.min():.2f} m apart, less than "
                f"the separation of {self.limits.separation:g} m: a larger grid step is needed"
            )

    def modelled_cable(self, spans: int) -> LaidCable:
        """The first spans, straight in plan and hanging as catenaries."""
        ends = np.column_stack((self.layout.places, np.zeros(self.layout.robots)))
        return LaidCable(
            [hanging_cable(ends[i], ends[i + 1], self.lengths[i], 40) for i in range(spans)]
        )

    def crossed(self, spans: int) -> dict[int, list[tuple[float | None, float]]]:
        """Where the first spans are crossed by later ones among them: rank, arc length."""
        found: dict[int, list[tuple[float | None, float]]] = {}
        for span in self.spans[:spans]:
            for gate in (passage.gate for passage in span.passages):
                found.setdefault(gate.letter.older, []).append((gate.letter.rank, gate.along))
        return found

    def find_route(self, span: int, laid: LaidCable, shape: SpanShape) -> SpanRoute | None:
        """A route over span `span` (1-based), past the spans before it, or None.

        Raises
        ------
        RequirementError
            The room is too low for a gate.
        """
        start = self.layout.places[span - 1]
        router = self.router(span, start, laid, shape, [self.layout.tail])
        orders: tuple[Crossed, ...] = (self.crossed(span - 1), {})
        for crossed in orders:
            way = router.find(self.layout.words[span - 1], crossed)
            if way is not None:
                return self.with_heights(way, laid, shape)
        return None

    def router(
        self,
        span: int,
        start: FloatArray,
        laid: LaidCable,
        shape: SpanShape,
        barriers: Sequence[FloatArray],
    ) -> Router:
        """Finds ways from a start to the end of a span, as far from robots as the limits ask."""
        places = self.layout.places
        needed = CLEAR * self.limits.separation / self.world.step
        clear = replace(shape.route, clear=max(shape.route.clear, needed))
        return Router(laid.in_plan, places[:span], start, places[span], clear, barriers)

    def with_heights(self, way: Way, laid: LaidCable, shape: SpanShape) -> SpanRoute:
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

    def with_next(self, route: SpanRoute) -> FlightPlanner:
        """With a route over the first span that has none."""
        length = route.tether * (1 + self.limits.slack)
        return replace(self, spans=(*self.spans, route), lengths=(*self.lengths, length))

    def with_span(self, span: int, route: SpanRoute) -> FlightPlanner:
        """With another route over span `span` (1-based); its cable stays as long."""
        return replace(self, spans=(*self.spans[: span - 1], route, *self.spans[span:]))

    def with_routes(self, shape: SpanShape) -> FlightPlanner:
        """With routes over all spans that have none, by the model of laid cable.

        Raises
        ------
        RequirementError
            There is no way, and which span and crossings that is.
        """
        planner = self
        for span in range(len(self.spans) + 1, self.layout.robots):
            planner = planner.with_next(planner.modelled_route(span, shape))
        return planner

    def modelled_route(self, span: int, shape: SpanShape) -> SpanRoute:
        """A route over span `span` (1-based) of this shape, or of one that needs less room.

        Raises
        ------
        RequirementError
            There is none.
        """
        laid = self.modelled_cable(span - 1)
        too_low: RequirementError | None = None
        for narrower in shape.narrower:
            try:
                route = self.find_route(span, laid, narrower)
            except RequirementError as error:
                too_low = error
                continue
            if route is not None:
                return route
        if too_low is not None:
            raise too_low
        word = ", ".join(map(str, self.layout.words[span - 1])) or "no crossing"
        raise RequirementError(
            f"there is no way for span {span}, from robot {span} to {span + 1}, with "
            f"{word}: the laid cable and the hovering robots leave no room"
        )

    def formation(self) -> Formation:
        """The robots in file on the route over all spans."""
        spacing = self.spacing / self.world.step
        approach = self.layout.places[0] + self.layout.outwards * (self.layout.robots - 1) * spacing
        route = build_route(approach, self.spans, self.flown)
        return Formation(route, self.world, self.limits, self.spacing)

    def spaced_out(self) -> FlightPlanner:
        """With the file's spacing enlarged until robots keep their separation, or to its double.

        Corners and arcs bring robots nearer to each other than their distance along the route.
        """
        for share in WIDER:
            wider = replace(self, spacing=share * self.spacing)
            if wider.formation().separation >= APART:
                break
        return wider

    def with_flown(self, along: float) -> FlightPlanner:
        """With the route up to a path coordinate [m] not to change any more."""
        route = self.formation().route
        return replace(self, flown=route.points[route.along * self.world.step <= along])

    def started_farther(self, distance: float) -> FlightPlanner:
        """With the file farther outside and more spacing; what has been flown of the route stays.

        Parameters
        ----------
        distance : float
            About [grid steps]: the route's points remain even.
        """
        count = round(distance / SAMPLE)
        away = SAMPLE * np.arange(count, 0, -1)[:, None] * self.layout.outwards
        start = np.column_stack((self.flown[0, :2] + away, np.zeros(count)))
        spacing = self.spacing + count * SAMPLE * self.world.step / (self.layout.robots - 1)
        return replace(self, flown=np.concatenate((start, self.flown)), spacing=spacing)

    def cable_lengths(self, formation: Formation) -> FloatArray:
        """Of the cable between robots, enough for the whole flight, shape (R - 1,) [m]."""
        apart = formation.farthest * (1 + self.limits.slack)
        return np.maximum(apart, np.array(self.lengths) * self.world.step)

    def motion(
        self, schedule: str | Schedule = "optimised", lengths: FloatArray | None = None
    ) -> MotionPlan:
        """The motion of all robots on the routes, which must be those of all spans.

        Parameters
        ----------
        schedule : str or Schedule
            "optimised", "fixed", or one at hand.
        lengths : float array, shape (R - 1,), optional
            Of the cable between robots; what the flight needs, unless given [m].
        """
        formation = self.formation()
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
            found = fastest_schedule(nodes, *derivatives, *with_margin(limits))
            if not found.is_optimal:
                notes += (f"the schedule is feasible, not proven optimal: {found.raw_status}",)
        else:
            found = steady_schedule(nodes, *derivatives, *with_margin(limits))
        duration = limits.hover_before + found.duration + limits.hover_after
        times = sample_times(int(np.ceil(duration / INTERVAL)) + 1)
        passed = iter(formation.route.passed)
        crossings = []
        for k, span in enumerate(self.spans, 1):
            for passage in span.passages:
                along = next(passed) * self.world.step
                when = limits.hover_before + found.when(along)
                x, y, z = formation.point(along).tolist()
                letter = passage.gate.letter
                lies = self.world.altitude + passage.cable_height * self.world.step
                crossed = (letter.older, letter.over, letter.sense)
                length = formation.arc_length(along)
                crossings.append(PlannedCrossing(k, *crossed, (x, y), z, lies, length, when))
        passes = [limits.hover_before + found.when(stop) for stop in formation.stops[:-1]]
        return MotionPlan(
            schedule=schedule if isinstance(schedule, str) else schedule.raw_status,
            world=self.world,
            limits=limits,
            times=times,
            positions=formation.positions(found.at(times - limits.hover_before)),
            lengths=self.cable_lengths(formation) if lengths is None else lengths,
            route=formation.drawn(),
            crossings=tuple(crossings),
            passes=np.array(passes),
            notes=notes,
        )


def sample_times(count: int) -> FloatArray:
    """Times of the first samples of a plan [s]."""
    return np.asarray(INTERVAL * np.arange(count, dtype=np.float64))


def with_margin(limits: FlightLimits) -> tuple[float, float]:
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
    >>> from knotopt.reading.knot import read_knot
    >>> cable = Cable(read_knot("3").diagram, "L+")
    >>> plan = plan_flight("3_1", cable, (3, 4, 6), schedule="fixed")
    >>> [crossing.name for crossing in plan.crossings]
    ['span 4 over span 1', 'span 4 under span 1', 'span 4 over span 2']
    """
    request = FlightRequest(name, chosen_by, world, limits or FlightLimits(), schedule)
    planner = FlightPlanner(layout_of_supports(cable, supports), world, request.limits)
    motion = planner.with_routes(shape or SpanShape()).spaced_out().motion(schedule)
    return with_supports(motion, cable, supports, request)
