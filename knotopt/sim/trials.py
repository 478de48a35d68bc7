"""Plans flown in physics and judged: once, or again and again, each time disturbed otherwise."""

from __future__ import annotations

import logging
from collections.abc import Iterable
from dataclasses import dataclass
from functools import cached_property

from scipy.stats import binomtest

from knotopt.flight.examine import Examination, examine_flight
from knotopt.flight.plan import FlightPlan, MotionPlan
from knotopt.flight.record import Disturbance, FlightRecord
from knotopt.sim.judge import Outcome, Verdict, judge
from knotopt.sim.simulators import MUJOCO, Simulator

logger = logging.getLogger(__name__)


@dataclass(frozen=True, eq=False)
class Flight:
    """One flight in physics and what it tied.

    Attributes
    ----------
    plan : FlightPlan
        That was flown.
    record : FlightRecord
        Of what happened, the disturbance included.
    verdict : Verdict
    """

    plan: FlightPlan
    record: FlightRecord
    verdict: Verdict

    @property
    def is_tied(self) -> bool:
        """Whether the wanted knot was tied, as far as its Alexander polynomial tells."""
        return self.verdict.outcome is Outcome.TIED

    @cached_property
    def examination(self) -> Examination | None:
        """What the flight was like; None where the simulation broke down."""
        try:
            return examine_flight(self.plan, self.record)
        except ValueError:  # positions that are no numbers
            return None

    @property
    def amiss(self) -> str:
        """The first crossing that was not as planned, in words; "" if all were."""
        if self.examination is None:
            return "the simulation broke down"
        return next((row.sentence for row in self.examination.amiss), "")

    @property
    def came_of(self) -> str:
        """What came of it: what was tied, and how far a flight came that got stuck."""
        if self.examination is None:
            return f"{self.verdict}; {self.amiss}"
        if not self.record.finished:
            return f"{self.verdict}, held back at {self.record.clock[-1]:.1f} s of the plan"
        return str(self.verdict)

    @property
    def why(self) -> str:
        """What came of it, and the first crossing that was not as planned."""
        if self.examination is None:
            return self.came_of
        amiss = self.amiss or self.examination.states.difference
        return f"{self.came_of}; {amiss or 'every crossing is as planned, which is not enough'}"


def fly_trial(
    plan: FlightPlan, disturbance: Disturbance | None = None, simulator: Simulator = MUJOCO
) -> Flight:
    """Fly a plan and judge what it tied.

    Raises
    ------
    MissingExtraError, RequirementError
        As `Simulator.start` raises them.
    """
    record = simulate(plan, disturbance, simulator)
    flight = Flight(plan, record, judge(record, plan.cable))
    logger.debug("%s: %s", record.disturbance, flight.verdict)
    return flight


def fly_trials(
    plan: FlightPlan, disturbances: Iterable[Disturbance], simulator: Simulator = MUJOCO
) -> tuple[Flight, ...]:
    """Fly a plan once for each disturbance."""
    return tuple(fly_trial(plan, disturbance, simulator) for disturbance in disturbances)


def simulate(
    plan: MotionPlan, disturbance: Disturbance | None = None, simulator: Simulator = MUJOCO
) -> FlightRecord:
    """What happens when a plan is flown, undisturbed unless a disturbance is given.

    Raises
    ------
    MissingExtraError, RequirementError
        As `Simulator.start` raises them.
    """
    simulation = simulator.start(
        plan.positions[0],
        plan.lengths,
        step=plan.world.step,
        speed=plan.limits.speed,
        disturbance=disturbance,
    )
    simulation.follow(plan.positions, plan.interval)
    return simulation.record()


def wilson_interval(successes: int, trials: int) -> tuple[float, float]:
    """Wilson's 95 % interval for a success rate.

    Examples
    --------
    >>> [round(bound, 3) for bound in wilson_interval(9, 10)]
    [0.596, 0.982]
    """
    bounds = binomtest(successes, trials).proportion_ci(0.95, method="wilson")
    return float(bounds.low), float(bounds.high)
