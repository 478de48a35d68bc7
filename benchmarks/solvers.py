"""Solvers against each other on the same instances: 249 knots, all crossing-free cuts."""

from __future__ import annotations

import time
from collections.abc import Iterable
from itertools import islice
from typing import Any

from benchmarks.registry import Benchmark, Case, Result, register
from formulations.backends import BACKENDS, get_backend
from formulations.solution import Limits, Status
from knotopt.atlas.solvers import warm
from knotopt.cable.cable import Cable
from knotopt.cable.cut import crossing_free_cuts
from knotopt.catalogue.knots import shipped_knots
from knotopt.supports.lcf import lcf
from knotopt.supports.minimal import compile_program
from knotopt.supports.requirements import Requirements

LIMITS = Limits(seconds=60)
# Of `span`, which is slower to compile, and of the exhaustive search: so many cuts a knot.
FEW_CUTS = 1


def cases(smoke: bool) -> Iterable[Case]:
    """One case a knot and formulation."""
    names = list(shipped_knots())
    for name in names[:2] if smoke else names:
        for formulation in ("opening", "span"):
            yield {"knot": name, "formulation": formulation}


def measure(case: Case) -> Result:
    """For each cut and solver: status, objective, bound and time [s], build and solve."""
    for name in BACKENDS:
        warm(name)
    knot = shipped_knots()[case["knot"]]
    asked = Requirements(case["formulation"], with_loops=False)
    cuts = crossing_free_cuts(knot.diagram)
    is_span = asked.formulation == "span"
    runs: list[dict[str, Any]] = []
    for number, cut in enumerate(islice(cuts, FEW_CUTS) if is_span else cuts):
        program = compile_program(lcf(Cable(knot.diagram, cut)), asked)
        instance = program.instance(float(asked.openness**2))
        for name in BACKENDS:
            if name == "exhaustive" and (is_span or number >= FEW_CUTS):
                continue
            began = time.perf_counter()
            solution = get_backend(name).solve(instance, LIMITS)
            runs.append(
                {
                    "cut": str(cut),
                    "solver": name,
                    "status": str(solution.status),
                    "objective": solution.objective,
                    "bound": solution.bound,
                    "seconds": round(time.perf_counter() - began, 6),
                }
            )
    objectives: dict[str, set[int]] = {}
    for run in runs:
        if run["status"] == Status.OPTIMAL:
            objectives.setdefault(run["cut"], set()).add(run["objective"])
    return {
        "runs": runs,
        "disagreements": sorted(cut for cut, found in objectives.items() if len(found) > 1),
    }


register(Benchmark("solvers", "every solver on opening and span of 249 knots", cases, measure))
