"""Knots pulled tight after the flight: how far the ends get, and whether the knot stays."""

from __future__ import annotations

from collections.abc import Iterable

from benchmarks.physics import NOISE, SEEDS, rehearse, rows_of_table1, supports_of
from benchmarks.registry import Benchmark, Case, Result, register
from knotopt.errors import RequirementError
from knotopt.flight.examine import examine_plan
from knotopt.flight.record import Disturbance
from knotopt.rehearsal.tighten import tighten_flight
from knotopt.sim.trials import fly_trials

APART = 30.0  # of the ends at most, more than any of these cables is long [m]
FLOWN = ("span 0.25", "lcf", "all")


def cases(smoke: bool) -> Iterable[Case]:
    """Smallest sets, LCF's and all turning points, for the rows of Table I."""
    for method in FLOWN[: 1 if smoke else None]:
        for row in rows_of_table1(smoke):
            yield {"row": row, "method": method, "number": 0}


def measure(case: Case) -> Result:
    """What the pull does to the knot, and in how many disturbed flights it is the knot."""
    chosen = supports_of(case)
    about = {"cut": str(chosen.cable.cut), "robots": chosen.robots}
    try:
        loose = rehearse(case["row"], (chosen,))
        tight = tighten_flight(loose, APART)
    except RequirementError as error:
        return {**about, "planned": False, "why": str(error)}
    plan = tight.plan
    disturbances = [Disturbance(noise=NOISE, seed=seed) for seed in SEEDS]
    laid, flights = (fly_trials(each, disturbances) for each in (loose.plan, plan))
    report = examine_plan(plan).limits
    return {
        **about,
        "planned": True,
        "tied_before": loose.is_tied,
        "tightening": round(plan.tightening, 2),
        "why": plan.notes[-1] if plan.notes else "",
        "ends_apart": [round(each, 3) for each in plan.ends_apart],
        "supports_within": [round(each, 3) for each in plan.supports_within],
        "undisturbed": str(tight.undisturbed.verdict),
        "disturbed": [str(each.verdict) for each in flights],
        "tied_laid": sum(each.is_tied for each in laid),
        "tied_disturbed": sum(each.is_tied for each in flights),
        "smallest_distance": round(tight.undisturbed.record.smallest_distance, 4),
        "largest_tension": round(tight.undisturbed.record.largest_tension, 3),
        "separation": round(report.separation.value, 3),
        "broken": list(report.broken),
    }


register(Benchmark("physics_tight", "knots pulled tight after the flight, Table I", cases, measure))
