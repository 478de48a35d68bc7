"""Planning by rehearsal: the flight is simulated while it is planned, crossing by crossing.

At every crossing the way on is found anew past the cable as it lies then, the leader's own tether
included, and flown in physics. If the crossing does not happen, or is undone before the next, the
simulation goes back and other shapes of the way are tried.
"""

from __future__ import annotations

import logging
from dataclasses import replace

import numpy as np

from knotopt.arrays import FloatArray
from knotopt.cable.cable import Cable
from knotopt.errors import RequirementError
from knotopt.flight.limits import RANGES, FlightLimits
from knotopt.flight.plan import FlightPlan
from knotopt.flight.planner import FlightPlanner
from knotopt.flight.record import Disturbance
from knotopt.flight.request import FlightRequest
from knotopt.flight.route import SpanShape
from knotopt.path.world import World
from knotopt.rehearsal.attempt import SHAPES, RehearsedFlight
from knotopt.rehearsal.flown_set import FlownSet
from knotopt.sim.simulators import MUJOCO, Simulator
from knotopt.sim.trials import fly_trial, fly_trials

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

logger = logging.getLogger(__name__)

WIDEN = 1.15  # of the file's spacing, where robots came too near each other
FARTHER = 0.5  # that the file is started each time [grid steps] where they still do
FILES, FLOWN = 40, 2  # such files that are looked at, and flown, at most
MORE = 1.1  # cable of a span where robots got stuck


class _Judge:
    """Flies plans, undisturbed and disturbed, and keeps the best."""

    def __init__(self, simulator: Simulator) -> None:
        self.simulator = simulator
        self.best: FlownSet | None = None

    def fly(
        self,
        what: str,
        plan: FlightPlan,
        planner: FlightPlanner,
        steady: float,
        given_up: tuple[str, ...] = (),
    ) -> FlownSet:
        """Fly a plan of the planner's routes; crossings were given up in its rehearsal."""
        flight = fly_trial(plan, simulator=self.simulator)
        robust, trials = 0, ""
        if flight.is_tied:
            robust = sum(each.is_tied for each in fly_trials(plan, TRIALS, self.simulator))
            trials = f"; disturbed {robust} of {len(TRIALS)}"
        logger.info("%s, %s schedule: %s%s", what, plan.schedule, flight.verdict, trials)
        separation = planner.formation().separation
        flown = FlownSet(flight, (), robust, separation, steady, given_up)
        if self.best is None or flown.rank > self.best.rank:
            self.best = flown
        return flown


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
        MuJoCo is not installed (extra `sim`).
    """
    if attempts < 1:
        raise RequirementError(f"a flight is rehearsed once or more, not {attempts} times")
    name, chosen_by, schedule = request.name, request.chosen_by, request.schedule
    world, limits = request.world, request.limits
    judge = _Judge(simulator)
    if len(supports) == len(cable.path) - 2:
        safe = _fly_modelled(judge, cable, supports, world, limits, (name, chosen_by), schedule)
        if safe is not None:
            return safe
    planner = FlightPlanner(cable, supports, world, limits)
    planner.plan_routes(SHAPES[0])
    modelled = list(planner.spans)
    crosses = np.array([len(word) > 0 for word in planner.words])
    more = np.ones(len(crosses))  # cable, where robots got stuck
    ways = 0
    flown: tuple[FlightPlanner, FloatArray] | None = None  # of the best rehearsal
    for number, (spare, first) in enumerate(ATTEMPTS[:attempts], 1):
        planner.spans[:] = modelled
        shapes = SHAPES[first:] + SHAPES[:first]
        run = RehearsedFlight(planner, np.where(crosses, spare, 1.0) * more, shapes, simulator)
        stuck = run.fly()
        if stuck is not None:
            more[stuck - 1] *= MORE
        ways += run.ways
        plans = [run.rehearsed(name, chosen_by)]
        steady = planner.plan(name, chosen_by, "fixed", run.lengths).duration
        if stuck is None:
            plans.insert(0, planner.plan(name, chosen_by, schedule, run.lengths))
        for plan in plans:
            found = judge.fly(f"rehearsal {number}", plan, planner, steady, tuple(run.failed))
            if found.robust == len(TRIALS) and found.separation >= 1:
                return replace(found, rehearsals=number, ways=ways)
            if judge.best is found:
                flown = planner.copy(), run.lengths
        if found.separation < 1:
            planner.spacing *= WIDEN
    assert judge.best is not None
    if judge.best.is_tied and judge.best.separation < 1 and flown is not None:
        _fly_from_farther(judge, *flown, (name, chosen_by), schedule)
    return replace(judge.best, rehearsals=len(ATTEMPTS[:attempts]), ways=ways)


def _fly_modelled(
    judge: _Judge,
    cable: Cable,
    supports: tuple[int, ...],
    world: World,
    limits: FlightLimits,
    about: tuple[str, str],
    schedule: str,
) -> FlownSet | None:
    """The first modelled route that ties the knot whatever disturbs it, if there is one."""
    for widening, share, shape in MODELLED:
        spacing = min(widening * limits.spacing, RANGES["spacing"][1])
        slack = share * limits.slack
        planner = FlightPlanner(
            cable, supports, world, replace(limits, spacing=spacing, slack=slack)
        )
        planner.plan_routes(shape)
        plan = planner.plan(*about, schedule)
        steady = planner.plan(*about, "fixed").duration
        found = judge.fly(
            f"modelled route, spacing {spacing:g} m, slack {slack:g}", plan, planner, steady
        )
        if found.robust == len(TRIALS):
            return found
    return None


def _fly_from_farther(
    judge: _Judge,
    planner: FlightPlanner,
    lengths: FloatArray,
    about: tuple[str, str],
    schedule: str,
) -> None:
    """Fly a rehearsed route once more in files that are longer until the robots keep apart.

    The leader's way and its crossings stay; the robots behind are elsewhere when it comes back.
    """
    failed, flights = judge.best.given_up if judge.best else (), 0
    for _ in range(FILES):
        planner.start_farther(FARTHER)
        formation = planner.formation()
        if formation.separation < 1 or (formation.farthest > lengths).any():
            continue
        plan = planner.plan(*about, schedule, lengths)
        steady = planner.plan(*about, "fixed", lengths).duration
        found = judge.fly(f"spacing {planner.spacing:.2f} m", plan, planner, steady, failed)
        flights += 1
        if found.robust == len(TRIALS) or flights == FLOWN:
            return
