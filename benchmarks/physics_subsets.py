"""Subsets of supports of small knots: what the models say of it, and what physics does.

Flights are on modelled routes, one undisturbed flight a subset.
"""

from __future__ import annotations

from collections.abc import Iterable
from fractions import Fraction
from itertools import combinations

from benchmarks.registry import Benchmark, Case, Result, register
from knotopt.cable.cable import Cable
from knotopt.catalogue.lookup import find_knot
from knotopt.errors import RequirementError
from knotopt.flight.planner import plan_flight
from knotopt.sim.trials import fly_trial
from knotopt.verify.opening import check_opening
from knotopt.verify.span import check_span

OPENNESS = Fraction(1, 4)  # by which the models judge a subset [grid steps]


GRIDS = {"3_1": ("3", "L+", 8), "4_1": ("4", "L+", 4)}
"""Row of Table I, cut, most supports: all of 3_1's; 4_1 has 10 turning points."""


def subset_cases(smoke: bool) -> Iterable[Case]:
    """Every subset of 3_1's turning points, and those of at most 4 of 4_1's."""
    for knot, (row, cut, most) in GRIDS.items():
        turning = range(2, len(Cable(find_knot(row).diagram, cut).path))
        for size in range(most + 1):
            for supports in combinations(turning, size):
                yield {"knot": knot, "row": row, "cut": cut, "supports": list(supports)}
                if smoke:
                    return


def measure_subset(case: Case) -> Result:
    """Whether a set ties on the modelled route, undisturbed, and what the models say of it."""
    cable = Cable(find_knot(case["row"]).diagram, case["cut"])
    supports = tuple(case["supports"])
    models = {"opening": check_opening, "span": check_span}
    says = {
        name: check(cable.path, cable.diagram.size, supports, OPENNESS).is_open
        for name, check in models.items()
    }
    try:
        plan = plan_flight(case["knot"], cable, supports, "file", schedule="optimised")
    except RequirementError as error:
        return {"models": says, "tied": False, "verdict": f"no plan: {error}"}
    trial = fly_trial(plan)
    return {"models": says, "tied": trial.is_tied, "verdict": str(trial.verdict)}


register(
    Benchmark(
        "physics_subsets",
        "subsets of supports of 3_1 and 4_1, flown on modelled routes",
        subset_cases,
        measure_subset,
    )
)
