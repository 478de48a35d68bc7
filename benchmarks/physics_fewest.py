"""The fewest robots that fly: sets that hold every loop with one support, or two, flown.

A plan comes of rehearsals, which are judged on disturbances of their own; others are counted.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace
from itertools import combinations

from benchmarks.physics import ATTEMPTS, measure_flown
from benchmarks.registry import Benchmark, Case, Result, register
from knotopt.cable.cable import Cable
from knotopt.cable.cut import Cut, crossing_free_cuts
from knotopt.errors import RequirementError
from knotopt.flight.limits import ROOM
from knotopt.flight.request import FlightRequest
from knotopt.reading.knot import read_knot
from knotopt.rehearsal.rehearse import rehearse_flight
from knotopt.supports.loops import loop_stretches

SEEDS = range(1, 13)
GRIDS = (*((name, "", 1, 0.5) for name in ("3", "5", "3_1", "5_1", "7_1")), ("4", "B+", 2, 0.7))
"""Knot or row of Table I; the one cut, or all; supports; metres per grid step.

The torus knots T(2, n) are those that one support might be enough for. The pairs of 4_1 are many
and take a minute each: one cut, with the room that they need.
"""


def cases(smoke: bool) -> Iterable[Case]:
    """All sets of so many supports that hold every loop."""
    for name, only, supports, step in GRIDS[: 1 if smoke else None]:
        diagram = read_knot(name).diagram
        for cut in [Cut.parse(only, diagram.size)] if only else crossing_free_cuts(diagram):
            cable = Cable(diagram, cut)
            loops = [set(range(first, last + 1)) for first, last, _ in loop_stretches(cable)]
            for chosen in combinations(range(2, len(cable.path)), supports):
                if all(loop & {*chosen} for loop in loops):
                    yield {"row": name, "cut": str(cut), "supports": [*chosen], "step": step}
                    if smoke:
                        return


def measure(case: Case) -> Result:
    """Whether the set ties undisturbed, and in how many of twelve disturbed flights."""
    cable = Cable(read_knot(case["row"]).diagram, case["cut"])
    request = FlightRequest(case["row"], "file", replace(ROOM, step=case["step"]))
    try:
        flown = rehearse_flight(cable, tuple(case["supports"]), request, ATTEMPTS)
    except RequirementError as error:
        return {"robots": len(case["supports"]) + 2, "planned": False, "why": str(error)}
    return {
        "robots": len(case["supports"]) + 2,
        "planned": True,
        **measure_flown(flown.undisturbed, SEEDS if flown.undisturbed.is_tied else ()),
        "rehearsals": flown.rehearsals,
    }


register(
    Benchmark(
        "physics_fewest",
        "sets of one support that hold every loop of T(2, n), and of two of 4_1, flown",
        cases,
        measure,
    )
)
