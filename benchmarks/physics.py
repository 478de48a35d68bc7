"""Physics against the models: sets of supports of each kind, flown under noise.

The plan of a set comes of rehearsals, which are judged on disturbances of their own; the success
rate is of others.
"""

from __future__ import annotations

import random
import time
from collections.abc import Iterable
from functools import cache

from benchmarks.registry import Benchmark, Case, Result, register
from knotopt.cable.cable import Cable
from knotopt.catalogue.knots import shipped_knots
from knotopt.catalogue.table1_grids import table1_grids
from knotopt.errors import RequirementError
from knotopt.flight.examine import examine_plan
from knotopt.flight.plan import FlightPlan
from knotopt.flight.planner import plan_flight
from knotopt.flight.record import Disturbance
from knotopt.flight.request import FlightRequest
from knotopt.mission.alternatives import PASSED, rehearse_first
from knotopt.reading.knot import read_knot
from knotopt.rehearsal.flown_set import FlownSet
from knotopt.sim.trials import Flight, fly_trial, fly_trials
from knotopt.supports.by_size import optimal_sets
from knotopt.supports.minimal import MinimalSupports
from knotopt.supports.requirements import Requirements
from knotopt.supports.selection import GivenSupports, choose_supports, equally_small
from knotopt.supports.support_set import SupportSet

NOISE = 0.01  # of robots' positions [m]
SEEDS = (1, 2, 3, 4, 5)
ATTEMPTS = 3  # rehearsals of a set
METHODS: dict[str, tuple[str, Requirements | None]] = {
    "span 0.25": ("milp", Requirements("span", 0.25, with_loops=False)),
    "lcf": ("lcf", None),
    "all": ("all", None),
    "none": ("none", None),
    "opening 0.5": ("milp", Requirements("opening", 0.5)),
    "span 0.5": ("milp", Requirements("span", 0.5, with_loops=False)),
    "random": ("random", Requirements("span", 0.25, with_loops=False)),
}
RANDOM, SMALL = 2, 3  # random sets of as many supports as the smallest has, for the first rows
OPTIMAL = 20  # sets of `span` at most, of all optimal ones
CROSSINGS = 7  # of the knots flown on KnotInfo's grids
KNOT_METHODS = ("span 0.25", "opening 0.5", "lcf", "all")  # flown there
OPTIMAL_METHOD = "span 0.25"  # whose smallest sets are all flown


def cases(smoke: bool) -> Iterable[Case]:
    """The sets of every method, and random ones, for the rows of Table I."""
    for method in ("none", "span 0.25") if smoke else METHODS:
        for number in range(RANDOM if method == "random" else 1):
            for row in rows_of_table1(smoke)[: SMALL if method == "random" else None]:
                yield {"row": row, "method": method, "number": number}


def knot_cases(smoke: bool) -> Iterable[Case]:
    """The sets of some methods for all knots with few crossings, on KnotInfo's grids."""
    knots = [knot for knot in shipped_knots().values() if knot.crossing_number <= CROSSINGS]
    for knot in knots[: 1 if smoke else None]:
        for method in ("none",) if smoke else KNOT_METHODS:
            yield {"row": knot.name, "method": method, "number": 0}


def optimal_cases(smoke: bool) -> Iterable[Case]:
    """The sets of `span` as small as the canonical one, on every cut; it is number 0."""
    for row in rows_of_table1(smoke):
        sets = len(_optimal_sets(row, OPTIMAL_METHOD))
        for number in range(1 if smoke else sets):
            yield {"row": row, "method": OPTIMAL_METHOD, "number": number}


@cache
def _optimal_sets(row: str, method: str) -> tuple[MinimalSupports, ...]:
    """The smallest sets on all cuts, the canonical one first, `OPTIMAL` at most."""
    return optimal_sets(read_knot(row).diagram, METHODS[method][1], OPTIMAL).sets


def rows_of_table1(smoke: bool) -> list[str]:
    """Its rows that name one grid each."""
    return [grid.row for grid in table1_grids() if grid.preferred][: 1 if smoke else None]


def supports_of(case: Case) -> SupportSet:
    """The set of a case."""
    diagram = read_knot(case["row"]).diagram
    choice, requirements = METHODS[case["method"]]
    if choice in ("all", "lcf"):
        return choose_supports(diagram, choice)
    if choice == "milp" and case["number"]:
        return _optimal_sets(case["row"], case["method"])[case["number"]]
    smallest = choose_supports(diagram, "milp", "best", requirements)
    cable = smallest.cable
    if choice == "none":
        return GivenSupports(cable, ())
    if choice == "random":
        places = range(2, len(cable.path))
        drawn = random.Random(case["number"]).sample(places, len(smallest.supports))
        return GivenSupports(cable, tuple(sorted(drawn)))
    return smallest


def measure_set(case: Case) -> Result:
    """Whether the set ties undisturbed, in how many disturbed flights, and what failed first."""
    return _measured(case["row"], (supports_of(case),))


def measure(case: Case) -> Result:
    """The same of the first cut whose set, as small as the best cut's, ties with robots apart."""
    if case["method"] in ("none", "random"):
        return measure_set(case)
    return measure_first(case["row"], *METHODS[case["method"]])


def measure_first(
    name: str, choice: str, requirements: Requirements | None, seeds: Iterable[int] = SEEDS
) -> Result:
    """The same for any choice of supports."""
    sets = equally_small(read_knot(name).diagram, choice, requirements=requirements)
    return _measured(name, tuple(sets), seeds)


def rehearse(name: str, sets: Iterable[SupportSet]) -> FlownSet:
    """As `fly --sim` rehearses them, with fewer attempts."""
    return rehearse_first(sets, FlightRequest(name, "file"), attempts=ATTEMPTS)


def _measured(name: str, sets: tuple[SupportSet, ...], seeds: Iterable[int] = SEEDS) -> Result:
    started = time.perf_counter()
    try:
        if sets[0].supports:
            flown = rehearse(name, sets)
            plan, rehearsals = flown.plan, flown.rehearsals
        else:
            plan, rehearsals = plan_flight(name, sets[0].cable, (), "file"), 0
        trial = fly_trial(plan)
    except RequirementError as error:
        about = _about(sets[0].cable, sets[0].supports, len(sets))
        return {**about, "planned": False, "why": str(error)}
    about = _about(plan.cable, plan.supports, 1 + sum(PASSED in note for note in plan.notes))
    planned = time.perf_counter() - started
    return {
        **about,
        "planned": True,
        **measure_flown(trial, seeds),
        "rehearsals": rehearsals,
        "planning_seconds": round(planned, 2),
    }


def measure_flown(trial: Flight, seeds: Iterable[int]) -> Result:
    """What an undisturbed flight came to, and flights of its plan with noise of these seeds."""
    plan = trial.plan
    flights = fly_trials(plan, [Disturbance(noise=NOISE, seed=seed) for seed in seeds])
    lost = next((each for each in (trial, *flights) if not each.is_tied), None)
    return {
        "undisturbed": str(trial.verdict),
        "tied": trial.is_tied,
        "disturbed": [str(each.verdict) for each in flights],
        "tied_disturbed": sum(each.is_tied for each in flights),
        "first_amiss": lost.amiss if lost else "",
        "schedule": plan.schedule,
        "flight_seconds": round(plan.duration, 2),
        "simulation_seconds": round(trial.record.seconds, 3),
        "smallest_distance": round(trial.record.smallest_distance, 4),
        "largest_tension": round(trial.record.largest_tension, 3),
        "separation": round(separation_of(plan), 3),
    }


def _about(cable: Cable, supports: tuple[int, ...], cuts: int) -> Result:
    return {
        "cut": str(cable.cut),
        "cuts_tried": cuts,
        "robots": len(supports) + 2,
        "supports": list(supports),
    }


def separation_of(plan: FlightPlan) -> float:
    """Least distance of two robots, 1 on the ellipsoid of the limits."""
    return examine_plan(plan).limits.separation.value


register(Benchmark("physics", "sets of each method flown in physics, Table I", cases, measure))
register(
    Benchmark(
        "physics_knots",
        f"the same for all knots to {CROSSINGS} crossings, KnotInfo's grids",
        knot_cases,
        measure,
    )
)
register(
    Benchmark("physics_optimal", "all optimal sets of span, Table I", optimal_cases, measure_set)
)
