"""LCF over the 249 prime knots up to 10 crossings and all their crossing-free cuts."""

from __future__ import annotations

import time
from statistics import median

from benchmarks.lcf_by_definition import slow_lcf
from benchmarks.registry import Benchmark, Case, Result, each_knot, register
from knotopt.cable.cable import Cable
from knotopt.cable.cut import Cut, crossing_free_cuts
from knotopt.catalogue.knots import shipped_knots
from knotopt.diagram.grid import GridDiagram, Mark
from knotopt.supports.lcf import lcf

REPEATS = 5


def measure(case: Case) -> Result:
    """Robots for each cut, and the median time of a cut with and without arrays [ms]."""
    knot = shipped_knots()[case["knot"]]
    cuts = crossing_free_cuts(knot.diagram)
    plain = {str(cut): lcf(Cable(knot.diagram, cut)).robots for cut in cuts}
    layered = {str(cut): lcf(Cable(knot.diagram, cut), layered=True).robots for cut in cuts}
    path = list(Cable(knot.diagram, cuts[0]).path)
    start = time.perf_counter()
    slow_lcf(path, knot.diagram.size, layered=False)
    by_definition = 1e3 * (time.perf_counter() - start)
    fast = median(_milliseconds(knot.marks, cut) for cut in cuts)
    return {
        "crossing_number": knot.crossing_number,
        "grid_size": knot.diagram.size,
        "robots_before": 2 * knot.diagram.size,
        "robots": plain,
        "robots_layered": layered,
        "ms_per_cut": round(fast, 3),
        "times_faster_than_definition": round(by_definition / fast, 1),
    }


def _milliseconds(marks: tuple[Mark, ...], cut: Cut) -> float:
    times = []
    for _ in range(REPEATS):
        diagram = GridDiagram.from_marks(marks)  # anew, so that nothing is cached
        start = time.perf_counter()
        lcf(Cable(diagram, cut))
        times.append(1e3 * (time.perf_counter() - start))
    return median(times)


register(
    Benchmark(
        "lcf_catalogue",
        "LCF on 249 knots x all crossing-free cuts",
        each_knot,
        measure,
    )
)
