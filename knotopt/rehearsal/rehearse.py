"""Planning by rehearsal: the flight is simulated while it is planned, crossing by crossing.

At every crossing the way on is found anew past the cable as it lies then, the leader's own tether
included, and flown in physics. If the crossing does not happen, or is undone before the next, the
simulation goes back and other shapes of the way are tried.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from knotopt.arrays import FloatArray
from knotopt.cable.cable import Cable
from knotopt.errors import RequirementError
from knotopt.flight.grid_layout import layout_of_supports
from knotopt.flight.limits import RANGES, ROOM, FlightLimits
from knotopt.flight.plan import FlightPlan, MotionPlan, with_supports
from knotopt.flight.planner import SCHEDULES, FlightPlanner
from knotopt.flight.record import Disturbance, FlightRecord
from knotopt.flight.route import SpanShape
from knotopt.path.world import World
from knotopt.rehearsal.attempt import SHAPES, RehearsedFlight
from knotopt.sim.judge import Outcome, Verdict
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

WIDEN = 1.15  # of the file's spacing, where robots came too near each other
FARTHER = 0.5  # that the file is started each time [grid steps] where they still do
FILES, FLOWN = 40, 2  # such files that are looked at, and flown, at most
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
    def against(self) -> str:
        """What speaks against flying it, "" if nothing does."""
        if not self.is_tied:
            return str(self.verdict)
        if self.separation < 1:
            return f"robots come within {self.separation:.2f} of their separation"
        return ""

    def noted(self, *notes: str) -> Rehearsal:
        """The rehearsal with further notes of its plan."""
        return replace(self, plan=self.plan.noted(*notes))

    @property
    def rank(self) -> tuple[bool, bool, int, int]:
        """Larger is better: tied, robots apart, robust, few crossings failed."""
        return self.is_tied, self.separation >= 1, self.robust, -len(self.failed)


class _Judge:
    """Flies plans, undisturbed and disturbed, and keeps the best.

    Parameters
    ----------
    plan_of : callable
        The flight plan with a motion: of which knot and supports.
    tell : callable
        Is told what came of each.
    """

    def __init__(
        self, plan_of: Callable[[MotionPlan], FlightPlan], tell: Callable[[str], None]
    ) -> None:
        self.plan_of, self.tell = plan_of, tell
        self.best: Rehearsal | None = None

    def fly(
        self,
        what: str,
        motion: MotionPlan,
        planner: FlightPlanner,
        steady: float,
        failed: tuple[str, ...] = (),
    ) -> Rehearsal:
        """Fly a motion on the planner's routes; `failed` are crossings that were given up."""
        plan = self.plan_of(motion)
        trial = fly_trial(plan)
        robust = sum(each.is_tied for each in fly_trials(plan, TRIALS)) if trial.is_tied else 0
        separation = planner.formation().separation
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

    With a robot at every turning point modelled routes are tried first, in a wider file and with
    less slack than the limits'; the first that ties the knot, disturbed or not, is taken.
    Where robots of the best rehearsal come too near each other, its route is flown in longer files.

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
    judge = _Judge(
        lambda motion: with_supports(motion, name, cable, supports, chosen_by),
        tell or (lambda _: None),
    )
    layout = layout_of_supports(cable, supports)
    if len(supports) == len(cable.path) - 2:
        safe = _fly_modelled(judge, FlightPlanner(layout, world, limits), schedule)
        if safe is not None:
            return safe
    modelled = FlightPlanner(layout, world, limits).with_routes(SHAPES[0])
    crosses = np.array([len(word) > 0 for word in layout.words])
    more = np.ones(len(crosses))  # cable, where robots got stuck
    ways = 0
    flown: tuple[FlightPlanner, FloatArray] | None = None  # of the best rehearsal
    for number, (spare, first) in enumerate(ATTEMPTS[:attempts], 1):
        shapes = SHAPES[first:] + SHAPES[:first]
        run = RehearsedFlight(modelled, np.where(crosses, spare, 1.0) * more, shapes, judge.tell)
        stuck = run.fly()
        if stuck is not None:
            more[stuck - 1] *= MORE
        ways += run.ways
        motions = [run.motion()]
        steady = run.planner.motion("fixed", run.lengths).duration
        if stuck is None:
            motions.insert(0, run.planner.motion(schedule, run.lengths))
        for motion in motions:
            found = judge.fly(f"rehearsal {number}", motion, run.planner, steady, tuple(run.failed))
            if found.robust == len(TRIALS) and found.separation >= 1:
                return replace(found, rehearsals=number, ways=ways)
            if judge.best is found:
                flown = run.planner, run.lengths
        wider = WIDEN if found.separation < 1 else 1.0
        modelled = modelled.with_spacing(wider * run.planner.spacing)
    assert judge.best is not None
    if judge.best.is_tied and judge.best.separation < 1 and flown is not None:
        _fly_from_farther(judge, *flown, schedule)
    return replace(judge.best, rehearsals=len(ATTEMPTS[:attempts]), ways=ways)


def _fly_modelled(judge: _Judge, planner: FlightPlanner, schedule: str) -> Rehearsal | None:
    """The first modelled route that ties the knot whatever disturbs it, if there is one."""
    limits = planner.limits
    for widening, share, shape in MODELLED:
        spacing = min(widening * limits.spacing, RANGES["spacing"][1])
        slack = share * limits.slack
        changed = replace(planner, limits=replace(limits, spacing=spacing, slack=slack))
        planned = changed.with_routes(shape).spaced_out()
        motion = planned.motion(schedule)
        steady = planned.motion("fixed").duration
        found = judge.fly(
            f"modelled route, spacing {spacing:g} m, slack {slack:g}", motion, planned, steady
        )
        if found.robust == len(TRIALS):
            return found
    return None


def _fly_from_farther(
    judge: _Judge, planner: FlightPlanner, lengths: FloatArray, schedule: str
) -> None:
    """Fly a rehearsed route once more in files that are longer until the robots keep apart.

    The leader's way and its crossings stay; the robots behind are elsewhere when it comes back.
    """
    failed, flights = judge.best.failed if judge.best else (), 0
    for _ in range(FILES):
        planner = planner.started_farther(FARTHER)
        formation = planner.formation()
        if formation.separation < 1 or (formation.farthest > lengths).any():
            continue
        motion = planner.motion(schedule, lengths)
        steady = planner.motion("fixed", lengths).duration
        found = judge.fly(f"spacing {planner.spacing:.2f} m", motion, planner, steady, failed)
        flights += 1
        if found.robust == len(TRIALS) or flights == FLOWN:
            return
