"""Piercing sets, and formulations with loops and without: 249 knots, their outer cuts.

Times are ratios: of the sweep, a cut of some ten microseconds, to CP-SAT on the same rows.
"""

from __future__ import annotations

import time
from collections.abc import Callable

from benchmarks.registry import Benchmark, Case, Result, each_knot, register
from formulations.backends import get_backend
from formulations.loops import pierce
from formulations.solution import Limits
from knotopt.atlas.solvers import warm
from knotopt.cable.cable import Cable
from knotopt.cable.cut import outer_cuts
from knotopt.catalogue.knots import shipped_knots
from knotopt.supports.lcf import lcf
from knotopt.supports.loops import disjoint_loops, loop_stretches
from knotopt.supports.minimal import compile_program
from knotopt.supports.requirements import Requirements

OPENNESS = {"opening": (0.5,), "span": (0.25, 0.5)}
REPEATS = 20  # of the sweep; the fastest counts


def measure(case: Case) -> Result:
    """For each outer cut: loops that share no turning point, and robots of every smallest set."""
    warm("cp-sat")
    diagram = shipped_knots()[case["knot"]].diagram
    cp_sat = get_backend("cp-sat")
    result: Result = {"grid_size": diagram.size, "cuts": {}}
    for cut in outer_cuts(diagram):
        seeded = lcf(cable := Cable(diagram, cut))
        stretches = loop_stretches(cable)
        row = {
            "crossings": len(stretches),
            "disjoint": len(disjoint_loops(cable)),
            "loops": 2 + len(pierce(stretches)),
            "sweep_ms": round(1e3 * _fastest(lambda on=stretches: pierce(on)), 5),
            "rows_and_sweep_ms": round(1e3 * _fastest(lambda on=cable: disjoint_loops(on)), 5),
        }
        instance = compile_program(seeded, Requirements("loops")).instance(0.25)
        began = time.perf_counter()
        solution = cp_sat.solve(instance, Limits())
        row["cp_sat_ms"] = round(1e3 * (time.perf_counter() - began), 3)
        row["agree"] = solution.objective == solution.bound == row["loops"]
        for name, values in OPENNESS.items():
            for with_loops in (False, True):
                asked = Requirements(name, with_loops=with_loops)
                program = compile_program(seeded, asked)
                for r in values:
                    solution = cp_sat.solve(program.instance(r**2), Limits())
                    proven = solution.objective == solution.bound
                    row[f"{asked.words} {r:g}"] = solution.objective if proven else None
        result["cuts"][str(cut)] = row
    return result


def _fastest(call: Callable[[], object]) -> float:
    """Of several calls, the fastest [s]."""
    times = []
    for _ in range(REPEATS):
        began = time.perf_counter()
        call()
        times.append(time.perf_counter() - began)
    return min(times)


register(
    Benchmark(
        "loops", "loops by sweep and by CP-SAT; opening and span with loops", each_knot, measure
    )
)
