"""Subsets of supports of small knots: what the models say of it, and what physics does.

Flights are on modelled routes, one undisturbed flight a subset.
"""

from __future__ import annotations

from collections.abc import Iterable
from fractions import Fraction
from itertools import combinations

from benchmarks.registry import Benchmark, Case, Result, register
from knotopt.cable.cable import Cable
from knotopt.errors import RequirementError
from knotopt.flight.examine import LEAST_OPEN
from knotopt.flight.planner import plan_flight
from knotopt.reading.knot import read_knot
from knotopt.sim.trials import fly_trial
from knotopt.verify.opening import check_opening
from knotopt.verify.span import check_span

CHECKS = {"opening": check_opening, "span": check_span}
OPENNESS = {"any": LEAST_OPEN, "0.25": Fraction(1, 4), "0.5": Fraction(1, 2)}  # [grid steps]
LOST_AT = "0.25"  # openness for which lost regions are counted

GRIDS = {"3_1": ("3", "L+"), "4_1": ("4", "L+")}  # row of Table I and cut


def subset_cases(smoke: bool) -> Iterable[Case]:
    """Every subset of the turning points: 256 of 3_1 and 1,024 of 4_1."""
    for knot, (row, cut) in GRIDS.items():
        turning = range(2, len(Cable(read_knot(row).diagram, cut).path))
        for size in range(len(turning) + 1):
            for supports in combinations(turning, size):
                yield {"knot": knot, "row": row, "cut": cut, "supports": list(supports)}
                if smoke:
                    return


def measure_subset(case: Case) -> Result:
    """Whether a set ties on the modelled route, undisturbed, and what the models say of it."""
    cable = Cable(read_knot(case["row"]).diagram, case["cut"])
    supports = tuple(case["supports"])
    says = said_of(cable, supports)
    try:
        plan = plan_flight(case["knot"], cable, supports, "file", schedule="optimised")
    except RequirementError as error:
        return {**says, "tied": False, "verdict": f"no plan: {error}"}
    trial = fly_trial(plan)
    return {**says, "tied": trial.is_tied, "verdict": str(trial.verdict)}


def said_of(cable: Cable, supports: tuple[int, ...]) -> Result:
    """Whether each model calls a set open, and how many regions `span` loses."""
    on_cable = (cable.path, cable.diagram.size, supports)
    lost = check_span(*on_cable, OPENNESS[LOST_AT]).closures
    return {
        "models": {
            f"{model} {r}": check(*on_cable, openness).is_open
            for model, check in CHECKS.items()
            for r, openness in OPENNESS.items()
        },
        "regions_lost": len({str(closure.region) for closure in lost}),
    }


register(
    Benchmark(
        "physics_subsets",
        "subsets of supports of 3_1 and 4_1, flown on modelled routes",
        subset_cases,
        measure_subset,
    )
)
