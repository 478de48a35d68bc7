"""LCF against the smallest sets of `opening` and `span` (without loops): 249 knots, all
crossing-free cuts.
"""

from __future__ import annotations

import time

from benchmarks.registry import Benchmark, Case, Result, each_knot, register
from formulations.backends import get_backend
from formulations.solution import Limits
from knotopt.atlas.solvers import warm
from knotopt.cable.cable import Cable
from knotopt.cable.cut import crossing_free_cuts
from knotopt.catalogue.knots import shipped_knots
from knotopt.supports.lcf import lcf
from knotopt.supports.minimal import compile_program
from knotopt.supports.requirements import Requirements
from knotopt.tables.methods import OPENING

THREADINGS = {"opening": None, "opening_over_under": "over-under", "span": None}


def measure(case: Case) -> Result:
    """For each cut: robots by method, LCF open or not, and times [ms] of one thread of CP-SAT.

    The time of a formulation is that to compile, build and solve, without LCF.
    """
    warm("cp-sat")
    knot = shipped_knots()[case["knot"]]
    openness = OPENING.requirements().openness
    cp_sat = get_backend("cp-sat")
    result: Result = {"crossing_number": knot.crossing_number, "cuts": {}}
    for cut in crossing_free_cuts(knot.diagram):
        seeded = lcf(Cable(knot.diagram, cut))
        layered = lcf(Cable(knot.diagram, cut), layered=True)
        row = {
            "baseline": seeded.baseline,
            "lcf": seeded.robots,
            "lcf_open": OPENING.is_met(seeded.cable, seeded.supports, openness),
            "layered": layered.robots,
            "layered_open": OPENING.is_met(layered.cable, layered.supports, openness),
        }
        for name, threading in THREADINGS.items():
            asked = Requirements(name.split("_")[0], threading=threading, with_loops=False)
            began = time.perf_counter()
            program = compile_program(seeded, asked)
            solution = cp_sat.solve(program.instance(float(asked.openness**2)), Limits())
            row[name] = solution.objective
            row[f"{name}_proven"] = solution.objective == solution.bound
            row[f"{name}_ms"] = round(1e3 * (time.perf_counter() - began), 3)
        result["cuts"][str(cut)] = row
    return result


register(
    Benchmark(
        "formulations",
        "LCF, opening and span on 249 knots x all cuts",
        each_knot,
        measure,
    )
)
