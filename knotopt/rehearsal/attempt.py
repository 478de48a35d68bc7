"""One simulated flight that is planned while it is flown, crossing by crossing."""

from __future__ import annotations

import logging
from collections.abc import Iterator
from dataclasses import dataclass, replace
from itertools import accumulate
from operator import attrgetter

import numpy as np

from formulations.schedule import Schedule, greedy_schedule
from knotopt.arrays import FloatArray
from knotopt.errors import RequirementError
from knotopt.flight.formation import NODES
from knotopt.flight.gates import RouteShape
from knotopt.flight.layout import Word
from knotopt.flight.leader_crossings import happened_word, leader_crossings
from knotopt.flight.plan import MotionPlan
from knotopt.flight.planner import INTERVAL, FlightPlanner, sample_times, with_margin
from knotopt.flight.route import HeightShape, SpanRoute, SpanShape
from knotopt.rehearsal.observer import Observer
from knotopt.sim.simulation import Checkpoint
from knotopt.sim.simulators import MUJOCO, Simulator

logger = logging.getLogger(__name__)

SHAPES = tuple(
    SpanShape(RouteShape(run, apart), HeightShape(above, below))
    for run, apart, above, below in (
        (0.6, 0.8, 0.6, 0.7),
        (0.9, 0.8, 0.6, 0.7),
        (0.9, 1.0, 0.8, 0.4),
        (1.2, 0.8, 0.6, 0.7),
        (1.2, 1.2, 0.8, 1.1),
        (0.4, 0.5, 0.6, 0.4),
    )
)
"""Shapes of a way that are tried, in this order."""

CLOSE = 0.08  # a crossing with a smaller gap may as well have been the other [grid steps]
TAUT = 0.98  # share of a span's cable that a way may need
STUCK = 10  # letters that being stuck counts as


@dataclass(frozen=True, eq=False)
class _Leg:
    """One way on to the next crossing, flown: the planner with it, and where that leads.

    `wrong` and `near` count letters of the word, see `RehearsedFlight._judged`.
    """

    wrong: int
    near: int
    finished: bool
    planner: FlightPlanner
    timing: Schedule
    setpoints: FloatArray
    checkpoint: Checkpoint

    @property
    def rank(self) -> tuple[int, int]:
        """Smaller is better."""
        return self.wrong, self.near


class RehearsedFlight:
    """A flight under way: the only thing here that changes, as its simulation does.

    Parameters
    ----------
    planner : FlightPlanner
        With routes over all spans, none of them flown.
    spare : float array, shape (R - 1,)
        Cable of each span over what these routes need.
    shapes : tuple of SpanShape
        To be tried at every crossing, in order.
    simulator : Simulator

    Attributes
    ----------
    planner : FlightPlanner
        The routes flown so far, and those of `planner` after them.
    lengths : float array, shape (R - 1,)
        Of the cable between robots [m].
    given_up : list of str
        Crossings that no way tried made happen.
    ways : int
        Ways from crossing to crossing that were flown.
    stuck : bool
        Whether a taut cable held robots back.
    """

    def __init__(
        self,
        planner: FlightPlanner,
        spare: FloatArray,
        shapes: tuple[SpanShape, ...],
        simulator: Simulator = MUJOCO,
    ) -> None:
        self.planner, self.shapes = planner.spaced_out(), shapes
        formation = self.planner.formation()
        self.lengths = planner.cable_lengths(formation) * spare
        self.along = formation.begin
        self.first = formation.positions(np.array([self.along]))[0]
        self.simulation = simulator.start(
            self.first,
            self.lengths,
            step=planner.world.step,
            speed=planner.limits.speed,
        )
        self.legs: list[_Leg] = []
        self.began: list[float] = []
        self.given_up: list[str] = []
        self.ways = 0
        self.stuck = False

    def motion(self) -> MotionPlan:
        """The motion as it was flown, timing included."""
        limits = self.planner.limits
        before, after = (
            int(np.ceil(time / INTERVAL)) for time in (limits.hover_before, limits.hover_after)
        )
        flown = np.concatenate((self.first[None], *(leg.setpoints for leg in self.legs)))
        hover = [np.repeat(flown[:1], before, axis=0), np.repeat(flown[-1:], after, axis=0)]
        positions = np.concatenate((hover[0], flown, hover[1]))
        planned = self.planner.motion(self._timing(), self.lengths)
        times = sample_times(len(positions))
        return replace(planned, schedule="rehearsed", positions=positions, times=times)

    def _timing(self) -> Schedule:
        """The schedules of all legs, one after the other."""
        timings = [leg.timing for leg in self.legs]
        durations = (INTERVAL * len(leg.setpoints) for leg in self.legs)
        *starts, end = accumulate(durations, initial=0.0)
        nodes = [timing.nodes[:-1] for timing in timings]
        times = [start + timing.times[:-1] for start, timing in zip(starts, timings, strict=True)]
        pace = [timing.pace[:-1] for timing in timings]
        return Schedule(
            np.concatenate((*nodes, timings[-1].nodes[-1:])),
            np.concatenate((*times, [end])),
            np.concatenate((*pace, timings[-1].pace[-1:])),
            is_optimal=False,
            raw_status="rehearsed",
            iterations=0,
        )

    def fly(self) -> int | None:
        """Fly all spans; return the one where robots got stuck (1-based), if there is one."""
        for span in range(1, self.planner.layout.robots):
            self.fly_span(span)
            if self.stuck:
                return span
        return None

    def fly_span(self, span: int) -> None:
        """Fly the leader from its stop at robot `span`'s place to the next one."""
        word = self.planner.layout.words[span - 1]
        self.began.append(self.simulation.clock)
        if not word:
            self._take(self._fly(span, self.planner.spans[span - 1], 0))
            return
        for done in range(len(word) + 1):
            self._next_crossing(span, word, done)

    def _next_crossing(self, span: int, word: Word, done: int) -> None:
        """Fly through gate `done` (from 0) of a span, or from the last one to the next robot."""
        start = self.simulation.checkpoint()
        legs = []
        for route in self._ways_on(span, word, done):
            self.simulation.restore(start)
            legs.append(self._fly(span, route, done + 1))
            if legs[-1].rank == (0, 0):
                break
        best = min(legs, key=attrgetter("rank"))
        self.simulation.restore(best.checkpoint)
        self._take(best)
        name = f"span {span} {word[done]}" if done < len(word) else f"the end of span {span}"
        if best.wrong:
            self.given_up.append(name)
        logger.info("%s: %s", name, "as planned" if not best.wrong else "not as planned")

    def _take(self, leg: _Leg) -> None:
        """Make what was flown part of the flight: the route up to here changes no more."""
        self.legs.append(leg)
        self.stuck |= not leg.finished
        self.along = float(leg.timing.nodes[-1])
        self.planner = leg.planner.with_flown(self.along)

    def _ways_on(self, span: int, word: Word, done: int) -> Iterator[SpanRoute]:
        """Routes over a span that go on from here, past the cable as it lies.

        If there is none, the one that was planned before.
        """
        planner = self.planner
        observer = Observer(planner, self.simulation)
        laid = observer.laid(span - 1)
        flown = planner.spans[span - 1].up_to(done) if done else None
        start = planner.layout.places[span - 1] if flown is None else flown.points[-1]
        tether = observer.tether(span)
        walls = [[planner.layout.tail, tether]] if tether is not None else []
        seen = set()
        for barriers in (*walls, [planner.layout.tail], []):
            for shape in self.shapes:
                crossed = observer.crossed(span, laid, done, 0.5 * shape.route.apart)
                router = planner.router(span, start, laid, shape, barriers)
                way = router.find(word[done:], crossed)
                if way is None:
                    continue
                try:
                    route = planner.with_heights(way, laid, shape)
                except RequirementError:
                    continue
                if flown is not None:
                    route = flown.then(route)
                key = route.points.round(3).tobytes()
                needed = route.tether * planner.world.step
                if key not in seen and needed < TAUT * self.lengths[span - 1]:
                    seen.add(key)
                    yield route
            if seen:
                return
        yield planner.spans[span - 1]

    def _fly(self, span: int, route: SpanRoute, gates: int) -> _Leg:
        """Fly through that many gates of a route, or to its end."""
        planner = self.planner.with_span(span, route)
        formation = planner.formation()
        before = sum(len(each.passages) for each in planner.spans[: span - 1])
        step = planner.world.step
        end = formation.stops[span] if span < planner.layout.robots - 1 else formation.end
        if gates <= len(route.passages) and gates:
            gate = route.passages[gates - 1].gate
            end = (formation.route.passed[before + gates - 1] + gate.run) * step
        nodes = np.linspace(self.along, end, max(int((end - self.along) / NODES), 8))
        timing = greedy_schedule(nodes, *formation.derivatives(nodes), *with_margin(planner.limits))
        count = int(np.ceil(timing.duration / INTERVAL)) + 1
        positions = formation.positions(timing.at(sample_times(count)))
        finished = self.simulation.follow(positions, INTERVAL)
        self.ways += 1
        wrong, near = self._judged(span, gates)
        wrong += 0 if finished else STUCK
        logger.debug("way %d: %d letters wrong, %d crossings near it", self.ways, wrong, near)
        checkpoint = self.simulation.checkpoint()
        return _Leg(wrong, near, finished, planner, timing, positions[1:], checkpoint)

    def _judged(self, span: int, gates: int) -> tuple[int, int]:
        """Letters of a span's word so far that are wrong, and crossings that were near to it.

        Near to being wrong are crossings beyond the word, although others undid them, and those
        with little height between.
        """
        crossings = leader_crossings(self.simulation.record(), span, self.began[span - 1])
        wanted, happened = (
            [(letter.older, letter.over, letter.sense) for letter in word]
            for word in (self.planner.layout.words[span - 1][:gates], happened_word(crossings))
        )
        same = 0
        while same < min(len(wanted), len(happened)) and wanted[same] == happened[same]:
            same += 1
        wrong = len(wanted) + len(happened) - 2 * same
        tight = CLOSE * self.planner.world.step
        near = sum(not each.is_own and abs(each.gap) < tight for each in crossings)
        near += max(sum(not each.is_curl for each in crossings) - len(wanted), 0)
        return wrong, near
