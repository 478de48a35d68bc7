"""Relaxation and program on 249 knots, on LCF's and on the smallest sets, each on its best cut."""

from __future__ import annotations

from dataclasses import asdict

from benchmarks.registry import Benchmark, Case, Result, each_knot, register
from benchmarks.warm import warm_paths
from knotopt.catalogue.knots import shipped_knots
from knotopt.path.measures import both_methods, measure
from knotopt.path.result import PathResult
from knotopt.supports.lcf import best_cut
from knotopt.supports.search import best_supports


def measure_knot(case: Case) -> Result:
    """The measures of the four paths, and where the program's time goes [ms, one core]."""
    warm_paths()
    diagram = shipped_knots()[case["knot"]].diagram
    result: Result = {"grid_size": diagram.size, "paths": []}
    for name, chosen in (("lcf", best_cut(diagram)), ("opening", best_supports(diagram).best)):
        for path in both_methods(chosen):
            result["paths"].append(asdict(measure(path, name)) | _effort(path))
    return result


def _effort(path: PathResult) -> dict[str, float]:
    return {
        "rounds": len(path.rounds),
        "iterations": sum(each.iterations for each in path.rounds),
        "mesh_ms": round(1e3 * sum(each.mesh_seconds for each in path.rounds), 3),
        "build_ms": round(1e3 * sum(each.build_seconds for each in path.rounds), 3),
        "solve_ms": round(1e3 * sum(each.solve_seconds for each in path.rounds), 3),
        "steps": path.steps,
    }


register(Benchmark("paths", "relaxation and program on 249 knots", each_knot, measure_knot))
