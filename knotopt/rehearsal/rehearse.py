"""Planning by rehearsal: the flight is simulated while it is planned, crossing by crossing.

At every crossing the way on is found anew past the cable as it lies then, the leader's own tether
included, and flown in physics. If the crossing does not happen, or is undone before the next, the
simulation goes back and other shapes of the way are tried.
"""

from __future__ import annotations

import logging
from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from knotopt.arrays import FloatArray
from knotopt.cable.cable import Cable
from knotopt.errors import RequirementError
from knotopt.flight.grid_layout import layout_of_supports
from knotopt.flight.limits import RANGES
from knotopt.flight.plan import MotionPlan, with_supports
from knotopt.flight.planner import FlightPlanner
from knotopt.flight.record import Disturbance
from knotopt.flight.request import FlightRequest
from knotopt.flight.route import SpanShape
from knotopt.rehearsal.attempt import SHAPES, RehearsedFlight
from knotopt.rehearsal.flown_set import FlownSet
from knotopt.sim.simulators import MUJOCO, Simulator
from knotopt.sim.trials import fly_trial, fly_trials

logger = logging.getLogger(__name__)

TRIALS = tuple(Disturbance(noise=0.01, seed=seed) for seed in (101, 102, 103))
"""Disturbances that a plan is tried in before it is taken."""

ATTEMPTS = ((1.1, 0), (1.25, 0), (1.1, 1), (0.97, 0), (1.25, 2), (1.1, 3))
"""Cable given to spans with crossings, over what the first plan needs; the first shape tried."""

MODELLED = (
    (5 / 3, 1.0, SpanShape()),
    (1.0, 1.0, SpanShape()),
    (5 / 3, 0.5, SpanShape()),
    (1.0, 0.5, SHAPES[0]),
)
"""Modelled routes that are tried where no turning point is left out: what the file's spacing is
multiplied by, share of the slack, shape. The cable of a long span hangs in a deep bight between
robots that follow each other closely, and catches on tethers when it is pulled out of it."""

WIDEN = 1.15  # of the file's spacing, where robots came too near each other
FARTHER = 0.5  # that the file is started each time [grid steps] where they still do
FILES, FLOWN = 40, 2  # such files that are looked at, and flown, at most
MORE = 1.1  # cable of a span where robots got stuck


@dataclass(frozen=True)
class _Candidate:
    """A flight that may be taken, the planner of its routes, and the cable if it was rehearsed."""

    flown: FlownSet
    planner: FlightPlanner
    lengths: FloatArray | None = None

    @property
    def is_robust(self) -> bool:
        """Whether it ties the knot whatever disturbs it."""
        return self.flown.robust == len(TRIALS)


@dataclass(frozen=True)
class _Task:
    """A set of supports, to be flown as requested."""

    cable: Cable
    supports: tuple[int, ...]
    request: FlightRequest
    simulator: Simulator

    def fly(
        self, what: str, motion: MotionPlan, planner: FlightPlanner, lengths: FloatArray | None
    ) -> _Candidate:
        """Fly a motion on the planner's routes, undisturbed and, if that ties, disturbed."""
        plan = with_supports(motion, self.cable, self.supports, self.request)
        flight = fly_trial(plan, simulator=self.simulator)
        robust, disturbed = 0, ""
        if flight.is_tied:
            robust = sum(each.is_tied for each in fly_trials(plan, TRIALS, self.simulator))
            disturbed = f"; disturbed {robust} of {len(TRIALS)}"
        logger.info("%s, %s schedule: %s%s", what, plan.schedule, flight.verdict, disturbed)
        flown = FlownSet(
            flight,
            robust=robust,
            separation=planner.formation().separation,
            steady=planner.motion("fixed", lengths).duration,
        )
        return _Candidate(flown, planner, lengths)


def rehearse_flight(
    cable: Cable,
    supports: tuple[int, ...],
    request: FlightRequest,
    attempts: int = 6,
    simulator: Simulator = MUJOCO,
) -> FlownSet:
    """Plan a flight, span by span, past the cable as it lies in a simulation.

    With a robot at every turning point modelled routes are tried first, in a wider file and with
    less slack than the limits'; the first that ties the knot, disturbed or not, is taken.
    Where robots of the best rehearsal come too near each other, its route is flown in longer files.

    Parameters
    ----------
    cable : Cable
    supports : tuple of int
        Turning points with a support robot (1-based).
    request : FlightRequest
    attempts : int
        Flights that are begun anew at most, until one ties the knot whatever disturbs it.
    simulator : Simulator

    Raises
    ------
    RequirementError
        Limits that no flight keeps.
    MissingExtraError
        The simulator is not installed (extra `sim`).
    """
    if attempts < 1:
        raise RequirementError(f"a flight is rehearsed once or more, not {attempts} times")
    task = _Task(cable, supports, request, simulator)
    planner = FlightPlanner(layout_of_supports(cable, supports), request.world, request.limits)
    best: _Candidate | None = None
    if len(supports) == len(cable.path) - 2:
        for candidate in _on_modelled_routes(task, planner):
            if candidate.is_robust:
                return candidate.flown
            best = _better(best, candidate)
    for candidate in _rehearsed(task, planner, attempts):
        if candidate.is_robust and candidate.flown.separation >= 1:
            return candidate.flown
        best = _better(best, candidate)
        effort = candidate.flown.rehearsals, candidate.flown.ways
    assert best is not None
    if best.flown.is_tied and best.flown.separation < 1 and best.lengths is not None:
        for candidate in _from_farther(task, best.planner, best.lengths):
            flown = replace(candidate.flown, given_up=best.flown.given_up)
            best = _better(best, replace(candidate, flown=flown))
    return replace(best.flown, rehearsals=effort[0], ways=effort[1])


def _better(best: _Candidate | None, other: _Candidate) -> _Candidate:
    return other if best is None or other.flown.rank > best.flown.rank else best


def _on_modelled_routes(task: _Task, planner: FlightPlanner) -> Iterator[_Candidate]:
    """Flights on modelled routes, with a robot at every turning point."""
    limits = planner.limits
    for widening, share, shape in MODELLED:
        spacing = min(widening * limits.spacing, RANGES["spacing"][1])
        slack = share * limits.slack
        changed = replace(planner, limits=replace(limits, spacing=spacing, slack=slack))
        planned = changed.with_routes(shape).spaced_out()
        what = f"modelled route, spacing {spacing:g} m, slack {slack:g}"
        yield task.fly(what, planned.motion(task.request.schedule), planned, None)


def _rehearsed(task: _Task, planner: FlightPlanner, attempts: int) -> Iterator[_Candidate]:
    """Rehearsals, each flown by the schedule requested, if it got to the end, and as rehearsed."""
    modelled = planner.with_routes(SHAPES[0])
    crosses = np.array([len(word) > 0 for word in planner.layout.words])
    more = np.ones(len(crosses))  # cable, where robots got stuck
    ways = 0
    for number, (spare, first) in enumerate(ATTEMPTS[:attempts], 1):
        shapes = SHAPES[first:] + SHAPES[:first]
        cable = np.where(crosses, spare, 1.0) * more
        run = RehearsedFlight(modelled, cable, shapes, task.simulator)
        stuck = run.fly()
        ways += run.ways
        motions = [run.motion()]
        if stuck is None:
            motions.insert(0, run.planner.motion(task.request.schedule, run.lengths))
        else:
            more[stuck - 1] *= MORE
        for motion in motions:
            found = task.fly(f"rehearsal {number}", motion, run.planner, run.lengths)
            flown = replace(found.flown, given_up=tuple(run.given_up), rehearsals=number, ways=ways)
            yield replace(found, flown=flown)
        wider = WIDEN if found.flown.separation < 1 else 1.0
        modelled = replace(modelled, spacing=wider * run.planner.spacing)


def _from_farther(task: _Task, planner: FlightPlanner, lengths: FloatArray) -> Iterator[_Candidate]:
    """A rehearsed route flown once more in files that are longer until the robots keep apart.

    The leader's way and its crossings stay; the robots behind are elsewhere when it comes back.
    """
    flights = 0
    for _ in range(FILES):
        planner = planner.started_farther(FARTHER)
        formation = planner.formation()
        if formation.separation < 1 or (formation.farthest > lengths).any():
            continue
        motion = planner.motion(task.request.schedule, lengths)
        found = task.fly(f"spacing {planner.spacing:.2f} m", motion, planner, lengths)
        yield found
        flights += 1
        if found.is_robust or flights == FLOWN:
            return
