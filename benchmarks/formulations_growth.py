"""Growth of `opening` (to N = 60) and `span` (to N = 24) on random and torus grids, cut L+."""

from __future__ import annotations

import time
from collections.abc import Iterable

from benchmarks.lcf_growth import diagram_of
from benchmarks.registry import Benchmark, Case, Result, register
from formulations.backends import get_backend
from formulations.solution import Limits
from knotopt.atlas.solvers import warm
from knotopt.cable.cable import Cable
from knotopt.supports.lcf import lcf
from knotopt.supports.minimal import compile_program
from knotopt.supports.requirements import Requirements

LIMITS = Limits(seconds=60)
SEEDS = range(5)
SIZES = {"opening": (10, 20, 30, 40, 50, 60), "span": (8, 12, 16, 20, 24)}


def cases(smoke: bool) -> Iterable[Case]:
    """Random grids of five seeds, T(2, N-2) and T(p, p+1)."""
    for formulation, sizes in SIZES.items():
        for size in sizes[:1] if smoke else sizes:
            for seed in SEEDS:
                yield {"formulation": formulation, "family": "random", "size": size, "seed": seed}
            for family in ("T(2,N-2)", "T(p,p+1)"):
                odd = size + 1  # of an even N, T(2, N - 2) would be a link
                yield {"formulation": formulation, "family": family, "size": odd, "seed": None}


def measure(case: Case) -> Result:
    """Times [s] to compile and to solve (CP-SAT, one thread), and what came out."""
    warm("cp-sat")
    asked = Requirements(case["formulation"], with_loops=False)
    seeded = lcf(Cable(diagram_of(case), "L+"))
    began = time.perf_counter()
    instance = compile_program(seeded, asked).instance(float(asked.openness**2))
    compiled = time.perf_counter()
    solution = get_backend("cp-sat").solve(instance, LIMITS)
    solved = time.perf_counter()
    return {
        "lcf": seeded.robots,
        "robots": solution.objective,
        "bound": solution.bound,
        "status": str(solution.status),
        "variables": len(instance.variables),
        "rows": len(instance.rows),
        "compile_seconds": round(compiled - began, 4),
        "solve_seconds": round(solved - compiled, 4),
    }


register(Benchmark("formulations_growth", "opening to N = 60, span to N = 24", cases, measure))
