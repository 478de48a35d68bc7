"""How many states a rope has, and planning backward from a goal against forward search."""

from __future__ import annotations

import time
from collections.abc import Iterable
from functools import cache
from itertools import takewhile
from statistics import median

from benchmarks.registry import Benchmark, Case, Result, register
from knotopt.cable.cable import Cable
from knotopt.diagram.families import torus_knot
from knotopt.reading.knot import read_knot
from knotopt.supports.lcf import best_cut
from knotopt.topology.actions import R2, Action, perform
from knotopt.topology.cable_state import cable_state
from knotopt.topology.legal import legal_actions
from knotopt.topology.plan import plan_graph
from knotopt.topology.state import TRIVIAL, RopeState

RUNS = 5  # of what is fast; the fastest counts
ONE_RUN_FROM = 5  # crossings at which growth and forward search are run once: they take seconds
MOST_FORWARD = 5  # crossings of the goals that are searched for forward: six take minutes
FEWEST_FIRST = ("3_1", "4_1 of 4 crossings", "4_1", "5_1", "5_2", "7_1")
LARGER = ("8_18", "9_40", "10_123", "T(3,7)", "K14n100")
WRITTEN = {
    "4_1 of 4 crossings": "U1- O2- U3+ O4+ U2- O1- U4+ O3+",
    "K14n100": (
        "O1+ U2- O3- U1+ O4+ O5- U6- U3- O2- U4+ U7+ O8+ U5- O6- U9+ U10- O11- O7+ U8+ O9+ U12- "
        "O13- O10- U11- U14- O12- U13- O14-"  # SnapPy's diagram, cut at its first strand
    ),
}
"""Goals other than the best cut of a knot's grid diagram."""


def growth_cases(smoke: bool) -> Iterable[Case]:
    """All states, and one of each class under mirror images and reverses, to five crossings."""
    for crossings in range(3 if smoke else 6):
        for canonical in (False, True):
            yield {"crossings": crossings, "canonical": canonical}


def measure_growth(case: Case) -> Result:
    """Number of states, and the time that they take from those of one crossing fewer [s]."""
    crossings, canonical = case["crossings"], case["canonical"]
    states = states_with(crossings, canonical)
    seconds = []
    if crossings:
        fewer = states_with(crossings - 1, canonical)
        for _ in range(RUNS if crossings < ONE_RUN_FROM else 1):
            start = time.perf_counter()
            next_states(fewer, canonical)
            seconds.append(time.perf_counter() - start)
    return {
        "states": len(states),
        "seconds": round(min(seconds), 6) if seconds else None,
        "runs": len(seconds),
    }


@cache
def states_with(crossings: int, canonical: bool) -> frozenset[RopeState]:
    """All states with that many crossings, or one of each class."""
    if crossings == 0:
        return frozenset((TRIVIAL,))
    return next_states(states_with(crossings - 1, canonical), canonical)


def next_states(states: Iterable[RopeState], canonical: bool) -> frozenset[RopeState]:
    """The states with one more crossing: R1 and C lead to all of them."""
    found = set()
    for state in states:
        for action in small_actions(state):
            after = RopeState(perform(state.code, action))
            found.add(after.canonical() if canonical else after)
    return frozenset(found)


def planning_cases(smoke: bool) -> Iterable[Case]:
    """Goals with 3 to 20 crossings."""
    for goal in FEWEST_FIRST[:1] if smoke else (*FEWEST_FIRST, *LARGER):
        yield {"goal": goal}


def measure_planning(case: Case) -> Result:
    """All plans, the time of finding them backward, and of meeting the goal forward [s]."""
    goal = goal_of(case["goal"])
    backward = []
    for _ in range(RUNS):
        start = time.perf_counter()
        graph = plan_graph(goal)
        backward.append(time.perf_counter() - start)
    result: Result = {
        "crossings": goal.crossings,
        "plans": graph.plan_count,
        "states": len(graph.states),
        "actions": graph.action_count,
        "seconds": round(min(backward), 6),
        "seconds_median": round(median(backward), 6),
        "runs": RUNS,
    }
    if goal.crossings <= MOST_FORWARD:
        forward = []
        for _ in range(RUNS if goal.crossings < ONE_RUN_FROM else 1):
            start = time.perf_counter()
            met = forward_search(goal)
            forward.append(time.perf_counter() - start)
        result |= {
            "forward_states": met,
            "forward_seconds": round(min(forward), 6),
            "forward_runs": len(forward),
            "ratio": round(min(forward) / min(backward), 1),
        }
    return result


def goal_of(name: str) -> RopeState:
    """The goal with that name."""
    if name in WRITTEN:
        return RopeState.from_gauss(WRITTEN[name])
    if name == "T(3,7)":
        return cable_state(Cable(torus_knot(3, 7), "L+"))
    return cable_state(best_cut(read_knot(name).diagram).cable)


def forward_search(goal: RopeState) -> int:
    """States met, breadth first from the trivial one, when the goal is.

    Only actions that do not make more crossings than the goal has are tried: none takes crossings
    away.
    """
    met = {TRIVIAL}
    queue = [TRIVIAL]
    for state in queue:
        left = goal.crossings - state.crossings
        actions = legal_actions(state) if left > 1 else small_actions(state) if left else ()
        for action in actions:
            after = RopeState(perform(state.code, action))
            if after not in met:
                met.add(after)
                queue.append(after)
                if after == goal:
                    return len(met)
    raise AssertionError(f"forward search does not meet {goal}")


def small_actions(state: RopeState) -> Iterable[Action]:
    """R1 and C, which make one crossing; R2 comes last among the legal actions."""
    return takewhile(lambda action: not isinstance(action, R2), legal_actions(state))


register(
    Benchmark("topology_growth", "states of a rope to five crossings", growth_cases, measure_growth)
)
register(
    Benchmark(
        "topology_planning",
        "plans to states with 3 to 20 crossings, backward and forward",
        planning_cases,
        measure_planning,
    )
)
