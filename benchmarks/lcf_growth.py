"""Growth of LCF's time and memory with the grid size on torus knots and random grids."""

from __future__ import annotations

import time
import tracemalloc
from collections.abc import Iterable

from benchmarks.lcf_by_definition import slow_lcf
from benchmarks.registry import Benchmark, Case, Result, register
from knotopt.cable.cable import Cable
from knotopt.diagram.families import random_knot, torus_knot
from knotopt.diagram.grid import GridDiagram
from knotopt.supports.lcf import lcf

SEEDS = range(5)
REPEATS = 3  # the fastest counts: a busy machine only ever adds time
DEFINITION_UP_TO = 25  # the definition spelled out takes minutes beyond


def cases(smoke: bool) -> Iterable[Case]:
    """T(2, N-2), T(p, p+1) and random grids of five seeds up to N = 100."""
    sizes = (5, 9) if smoke else (9, 15, 21, 25, 31, 41, 51, 61, 71, 81, 91, 99)
    for size in sizes:
        yield {"family": "T(2,N-2)", "size": size, "seed": None}
        yield {"family": "T(p,p+1)", "size": size, "seed": None}
    for size in (6, 9) if smoke else (10, 15, 20, 25, 30, 40, 50, 60, 70, 80, 90, 100):
        for seed in SEEDS:
            yield {"family": "random", "size": size, "seed": seed}


def measure(case: Case) -> Result:
    """Counts, the time of one cut [s] and the most memory it holds [MiB]."""
    seconds = float("inf")
    for _ in range(REPEATS):
        start = time.perf_counter()
        cable = Cable(diagram_of(case), "L+")
        result = lcf(cable)
        seconds = min(seconds, time.perf_counter() - start)
    tracemalloc.start()
    again = lcf(Cable(diagram_of(case), "L+"))
    memory = tracemalloc.get_traced_memory()[1] / 2**20
    tracemalloc.stop()
    ratio = None
    if case["size"] <= DEFINITION_UP_TO:
        start = time.perf_counter()
        expected = slow_lcf(list(cable.path), case["size"], layered=False)
        ratio = round((time.perf_counter() - start) / seconds, 1)
        if not expected == result.supports == again.supports:
            raise AssertionError(f"LCF departs from its definition on {case}")
    return {
        "crossings": len(cable.crossings),
        "regions": len(result.regions),
        "active": len(result.regions.active),
        "robots": result.robots,
        "robots_layered": lcf(cable, layered=True).robots,
        "seconds": round(seconds, 6),
        "mebibytes": round(memory, 2),
        "times_faster_than_definition": ratio,
    }


def diagram_of(case: Case) -> GridDiagram:
    """The grid diagram of a family, size and seed."""
    size = case["size"]
    if case["family"] == "T(2,N-2)":
        return torus_knot(2, size - 2)
    if case["family"] == "T(p,p+1)":
        return torus_knot(size // 2, size - size // 2)
    return random_knot(size, case["seed"])


register(Benchmark("lcf_growth", "LCF on torus knots and random grids to N = 100", cases, measure))
