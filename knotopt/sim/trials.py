"""The same plan flown again and again, each time disturbed otherwise."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

from scipy.stats import binomtest

from knotopt.flight.plan import FlightPlan
from knotopt.flight.record import Disturbance, FlightRecord
from knotopt.sim.judge import Outcome, Verdict, judge
from knotopt.sim.simulation import simulate


@dataclass(frozen=True, eq=False)
class Trial:
    """One flight and what it tied."""

    record: FlightRecord
    verdict: Verdict

    @property
    def is_tied(self) -> bool:
        """Whether the wanted knot was tied, as far as its Alexander polynomial tells."""
        return self.verdict.outcome is Outcome.TIED


def fly_trials(plan: FlightPlan, disturbances: Iterable[Disturbance]) -> tuple[Trial, ...]:
    """Fly a plan once for each disturbance."""
    return tuple(fly_trial(plan, disturbance) for disturbance in disturbances)


def fly_trial(plan: FlightPlan, disturbance: Disturbance | None = None) -> Trial:
    """Fly a plan and judge what it tied."""
    record = simulate(plan, disturbance)
    return Trial(record, judge(record, plan.cable))


def wilson_interval(successes: int, trials: int, confidence: float = 0.95) -> tuple[float, float]:
    """Wilson's interval for a success rate.

    Examples
    --------
    >>> [round(bound, 3) for bound in wilson_interval(9, 10)]
    [0.596, 0.982]
    """
    bounds = binomtest(successes, trials).proportion_ci(confidence, method="wilson")
    return float(bounds.low), float(bounds.high)
