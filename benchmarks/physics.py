"""Physics against the models: sets of supports of each kind, flown under noise.

The plan of a set comes of rehearsals, which are judged on disturbances of their own; the success
rate is of others. All turning points are flown on the modelled route.
"""

from __future__ import annotations

import random
import time
from collections.abc import Iterable
from fractions import Fraction
from functools import cache
from itertools import combinations
from typing import Any

from benchmarks.registry import Benchmark, Case, Result, register
from knotopt.cable.cable import Cable
from knotopt.catalogue.table1_grids import table1_grids
from knotopt.diagram.grid import GridDiagram
from knotopt.errors import RequirementError
from knotopt.flight.examine import examine_flight, examine_plan
from knotopt.flight.plan import FlightPlan
from knotopt.flight.planner import plan_flight
from knotopt.flight.record import Disturbance
from knotopt.flight.rehearsal import rehearse_flight
from knotopt.sim.trials import fly_trial, fly_trials
from knotopt.supports.choice import choose_supports
from knotopt.supports.ordered import optimal_sets
from knotopt.supports.requirements import Requirements
from knotopt.verify.opening import check_opening
from knotopt.verify.span import check_span

NOISE = 0.01  # of robots' positions [m]
SEEDS = (1, 2, 3, 4, 5)
ATTEMPTS = 3  # rehearsals of a set
OPENNESS = Fraction(1, 4)  # by which the models judge a subset [grid steps]
METHODS: dict[str, tuple[str, Requirements | None]] = {
    "span 0.25": ("milp", Requirements("span", 0.25)),
    "lcf": ("lcf", None),
    "all": ("all", None),
    "none": ("none", None),
}
MORE: dict[str, tuple[str, Requirements | None]] = {
    "opening 0.5": ("milp", Requirements("opening", 0.5)),
    "span 0.5": ("milp", Requirements("span", 0.5)),
    "random": ("random", Requirements("span", 0.25)),
}
SMALL = 3  # rows of Table I whose grids are at most 7 x 7
OPTIMAL = 20  # sets of `span` at most, of all optimal ones on the best cut


@cache
def _grid(row: str) -> GridDiagram:
    return next(grid.diagram for grid in table1_grids() if grid.row == row and grid.preferred)


def _rows(smoke: bool) -> list[str]:
    return [grid.row for grid in table1_grids() if grid.preferred][: 1 if smoke else None]


def cases(smoke: bool) -> Iterable[Case]:
    """The canonical set of every method, for the rows with small grids."""
    for method in ("none", "span 0.25") if smoke else METHODS:
        for row in _rows(smoke)[:SMALL]:
            yield {"row": row, "method": method, "number": 0}


def more_cases(smoke: bool) -> Iterable[Case]:
    """The other rows and methods, and all optimal sets of `span`."""
    for method in MORE if smoke else {**METHODS, **MORE}:
        for row in _rows(smoke)[0 if method in MORE else SMALL :]:
            yield {"row": row, "method": method, "number": 0}
            if smoke:
                return
    for number in range(1, OPTIMAL):
        for row in _rows(smoke):
            yield {"row": row, "method": "span 0.25", "number": number}


def supports_of(case: Case) -> tuple[Any, tuple[int, ...]] | None:
    """Cable and supports of a case, None if there are no so many optimal sets."""
    diagram = _grid(case["row"])
    choice, requirements = {**METHODS, **MORE}[case["method"]]
    if choice in ("all", "lcf"):
        chosen = choose_supports(diagram, choice)
        return chosen.cable, chosen.supports
    chosen = choose_supports(diagram, "milp", "best", requirements)
    cable = chosen.cable
    if choice == "none":
        return cable, ()
    if choice == "random":
        places = range(2, len(cable.path))
        return cable, tuple(sorted(random.Random(0).sample(places, len(chosen.supports))))
    if case["number"] == 0:
        return cable, chosen.supports
    others = [each for each in optimal_sets(cable, requirements).sets if each != chosen.supports]
    return (cable, others[case["number"] - 1]) if case["number"] <= len(others) else None


def measure(case: Case) -> Result:
    """Whether the set ties undisturbed, in how many disturbed flights, and what failed first."""
    found = supports_of(case)
    if found is None:
        return {"planned": False, "why": "there are no more optimal sets on this cut"}
    cable, supports = found
    about = {"cut": str(cable.cut), "robots": len(supports) + 2, "supports": list(supports)}
    started = time.perf_counter()
    try:
        if case["method"] in ("all", "none"):
            plan = plan_flight(case["row"], cable, supports, "file")
            trial, rehearsals = fly_trial(plan), 0
        else:
            rehearsal = rehearse_flight(
                case["row"], cable, supports, "file", attempts=1 if not supports else ATTEMPTS
            )
            plan, rehearsals = rehearsal.plan, rehearsal.rehearsals
            trial = fly_trial(plan)
    except RequirementError as error:
        return {**about, "planned": False, "why": str(error)}
    planned = time.perf_counter() - started
    flights = fly_trials(plan, [Disturbance(noise=NOISE, seed=seed) for seed in SEEDS])
    lost = next((each for each in (trial, *flights) if not each.is_tied), None)
    amiss = examine_flight(plan, lost.record).amiss if lost else ()
    return {
        **about,
        "planned": True,
        "undisturbed": str(trial.verdict),
        "tied": trial.is_tied,
        "disturbed": [str(each.verdict) for each in flights],
        "tied_disturbed": sum(each.is_tied for each in flights),
        "first_amiss": amiss[0].sentence if amiss else "",
        "schedule": plan.schedule,
        "flight_seconds": round(plan.duration, 2),
        "rehearsals": rehearsals,
        "planning_seconds": round(planned, 2),
        "simulation_seconds": round(trial.record.seconds, 3),
        "smallest_distance": round(trial.record.smallest_distance, 4),
        "largest_tension": round(trial.record.largest_tension, 3),
        "separation": round(separation_of(plan), 3),
    }


def separation_of(plan: FlightPlan) -> float:
    """Least distance of two robots, 1 on the ellipsoid of the limits."""
    return examine_plan(plan).limits.separation.value


def subset_cases(smoke: bool) -> Iterable[Case]:
    """Every subset of turning points of 3_1's grid."""
    for size in range(9):
        for supports in combinations(range(2, 10), size):
            yield {"knot": "3_1", "row": "3", "cut": "L+", "supports": list(supports)}
            if smoke:
                return


def measure_subset(case: Case) -> Result:
    """Whether a set ties on the modelled route, undisturbed, and what the models say of it."""
    cable = Cable(_grid(case["row"]), case["cut"])
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


register(Benchmark("physics", "sets of each method flown in physics, small grids", cases, measure))
register(
    Benchmark("physics_more", "other rows, methods and optimal sets (hours)", more_cases, measure)
)
register(
    Benchmark(
        "physics_subsets",
        "every subset of supports of 3_1, flown on modelled routes",
        subset_cases,
        measure_subset,
    )
)
