"""Planning by rehearsal: the flight is simulated while it is planned, crossing by crossing.

At every crossing the way on is found anew past the cable as it lies then, the leader's own tether
included, and flown in physics. If the crossing does not happen, or is undone before the next, the
simulation goes back and other shapes of the way are tried.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from knotopt.cable.cable import Cable
from knotopt.errors import RequirementError
from knotopt.flight.limits import ROOM, FlightLimits
from knotopt.flight.plan import FlightPlan
from knotopt.flight.planner import SCHEDULES, FlightPlanner
from knotopt.flight.record import Disturbance, FlightRecord
from knotopt.flight.rehearsed import SHAPES, RehearsedFlight
from knotopt.flight.route import SpanShape
from knotopt.path.world import World
from knotopt.sim.judge import Outcome, Verdict
from knotopt.sim.trials import fly_trial, fly_trials

TRIALS = tuple(Disturbance(noise=0.01, seed=seed) for seed in (101, 102, 103))
"""Disturbances that a plan is tried in before it is taken."""

ATTEMPTS = ((1.1, 0), (1.25, 0), (1.1, 1), (0.97, 0), (1.25, 2), (1.1, 3))
"""Cable given to spans with crossings, over what the first plan needs; the first shape tried."""

MODELLED = ((1.0, SpanShape()), (0.5, SpanShape()), (1.0, SHAPES[0]), (0.5, SHAPES[0]))
"""Modelled routes that are tried where no turning point is left out: share of the slack, shape."""

WIDEN = 1.15  # of the file's spacing, where robots came too near each other
MORE = 1.1  # cable of a span where robots got stuck


@dataclass(frozen=True)
class Rehearsal:
    """What came of planning by rehearsal.

    Attributes
    ----------
    plan : FlightPlan
        Its schedule is "rehearsed" where the optimised one did not tie the knot.
    record : FlightRecord
    verdict : Verdict
        Of the plan flown without disturbance.
    robust : int
        Of the `TRIALS` disturbed flights it was tried in, how many tied the knot. The plan was
        chosen by these: its success rate is for other disturbances to tell.
    separation : float
        Least distance of two robots, 1 on the ellipsoid of the limits.
    steady : float
        Duration of the same flight at one path speed throughout [s].
    failed : tuple of str
        Crossings that no way tried made happen, in the order of flight.
    rehearsals, ways : int
        Flights begun anew, and ways from crossing to crossing that were simulated; none where a
        modelled route is flown.
    """

    plan: FlightPlan
    record: FlightRecord
    verdict: Verdict
    robust: int
    separation: float
    steady: float
    failed: tuple[str, ...]
    rehearsals: int
    ways: int

    @property
    def is_tied(self) -> bool:
        """Whether the undisturbed flight ties the knot wanted."""
        return self.verdict.outcome is Outcome.TIED

    @property
    def rank(self) -> tuple[bool, bool, int, int]:
        """Larger is better: tied, robots apart, robust, few crossings failed."""
        return self.is_tied, self.separation >= 1, self.robust, -len(self.failed)


class _Judge:
    """Flies plans, undisturbed and disturbed, and keeps the best.

    Parameters
    ----------
    tell : callable
        Is told what came of each.
    """

    def __init__(self, tell: Callable[[str], None]) -> None:
        self.tell = tell
        self.best: Rehearsal | None = None

    def fly(
        self,
        what: str,
        plan: FlightPlan,
        planner: FlightPlanner,
        steady: float,
        run: RehearsedFlight | None = None,
    ) -> Rehearsal:
        """Fly a plan of the planner's routes, found by `run` if by any."""
        trial = fly_trial(plan)
        robust = sum(each.is_tied for each in fly_trials(plan, TRIALS)) if trial.is_tied else 0
        separation = planner.formation().separation
        failed = () if run is None else tuple(run.failed)
        found = Rehearsal(
            plan, trial.record, trial.verdict, robust, separation, steady, failed, 0, 0
        )
        self.tell(
            f"{what}, {plan.schedule} schedule: {trial.verdict}"
            + (f"; disturbed {robust} of {len(TRIALS)}" if trial.is_tied else "")
        )
        if self.best is None or found.rank > self.best.rank:
            self.best = found
        return found


def rehearse_flight(
    name: str,
    cable: Cable,
    supports: tuple[int, ...],
    chosen_by: str = "all",
    world: World = ROOM,
    limits: FlightLimits | None = None,
    schedule: str = "optimised",
    tell: Callable[[str], None] | None = None,
    attempts: int = 6,
) -> Rehearsal:
    """Plan a flight, span by span, past the cable as it lies in a simulation.

    With a robot at every turning point modelled routes are tried first, with the slack of the
    limits and with half of it; the first that ties the knot, disturbed or not, is taken.

    Parameters
    ----------
    name, cable, supports, chosen_by, world, limits, schedule
        As for `knotopt.flight.planner.plan_flight`.
    tell : callable, optional
        Is told what is being flown.
    attempts : int
        Flights that are begun anew at most, until one ties the knot whatever disturbs it.

    Raises
    ------
    RequirementError
        Limits that no flight keeps.
    MissingExtraError
        MuJoCo is not installed (extra `sim`).
    """
    if schedule not in SCHEDULES:
        raise RequirementError(f"a schedule is one of {', '.join(SCHEDULES)}, not {schedule!r}")
    if attempts < 1:
        raise RequirementError(f"a flight is rehearsed once or more, not {attempts} times")
    limits = limits or FlightLimits()
    judge = _Judge(tell or (lambda _: None))
    if len(supports) == len(cable.path) - 2:
        for share, shape in MODELLED:
            slack = share * limits.slack
            planner = FlightPlanner(cable, supports, world, replace(limits, slack=slack))
            planner.plan_routes(shape)
            plan = planner.plan(name, chosen_by, schedule)
            steady = planner.plan(name, chosen_by, "fixed").duration
            found = judge.fly(f"modelled route, slack {slack:g}", plan, planner, steady)
            if found.robust == len(TRIALS):
                return found
    planner = FlightPlanner(cable, supports, world, limits)
    planner.plan_routes(SHAPES[0])
    modelled = list(planner.spans)
    crosses = np.array([len(word) > 0 for word in planner.words])
    more = np.ones(len(crosses))  # cable, where robots got stuck
    ways = 0
    for number, (spare, first) in enumerate(ATTEMPTS[:attempts], 1):
        planner.spans[:] = modelled
        shapes = SHAPES[first:] + SHAPES[:first]
        run = RehearsedFlight(planner, np.where(crosses, spare, 1.0) * more, shapes, judge.tell)
        for span in range(1, planner.robots):
            run.fly_span(span)
            if run.stuck:
                more[span - 1] *= MORE
                break
        ways += run.ways
        plans = [run.rehearsed(name, chosen_by)]
        steady = planner.plan(name, chosen_by, "fixed", run.lengths).duration
        if not run.stuck:
            plans.insert(0, planner.plan(name, chosen_by, schedule, run.lengths))
        for plan in plans:
            found = judge.fly(f"rehearsal {number}", plan, planner, steady, run)
            if found.robust == len(TRIALS) and found.separation >= 1:
                return replace(found, rehearsals=number, ways=ways)
        if found.separation < 1:
            planner.spacing *= WIDEN
    assert judge.best is not None
    return replace(judge.best, rehearsals=len(ATTEMPTS[:attempts]), ways=ways)
