"""The search over grid diagrams: grids a second, compiled and not, and the front by runs."""

from __future__ import annotations

import time
from collections.abc import Iterable
from dataclasses import replace

from benchmarks.registry import Benchmark, Case, Result, register
from knotopt.catalogue.knots import shipped_knots
from knotopt.diagram.grid import GridDiagram
from knotopt.search.run import STEPS, Run, run
from knotopt.search.search import GridSearch

KNOTS = ("3_1", "5_2", "7_6", "8_18", "8_19", "9_47", "10_123", "10_161")
RUNS = (1, 4, 16, 40)
"""Runs after which the front is looked at."""


def cases(smoke: bool) -> Iterable[Case]:
    """One case a knot."""
    return (
        {"knot": name, "runs": RUNS[: 1 if smoke else None]}
        for name in KNOTS[: 1 if smoke else None]
    )


def measure(case: Case) -> Result:
    """Grids a second of one run, compiled and not, and the fronts; seconds of the processor."""
    diagram = shipped_knots()[case["knot"]].diagram
    run(diagram, 0, compile=True)  # so that it is compiled
    compiled, plain = (_timed(diagram, compile=compile) for compile in (True, False))
    if compiled[0] != plain[0]:
        raise AssertionError(f"compiled and plain runs differ on {case}")
    search, fronts = GridSearch(diagram), []
    start = time.process_time()
    for count in case["runs"]:
        while len(search.runs) < count:
            search = replace(search, runs=(*search.runs, run(diagram, len(search.runs))))
        seconds = round(time.process_time() - start, 3)
        fronts.append(
            {"runs": count, "seconds": seconds, "front": [each.counts for each in search.front]}
        )
    looked = compiled[0].looked
    return {
        "crossing_number": shipped_knots()[case["knot"]].crossing_number,
        "size": diagram.size,
        "looked": looked,
        "moves_per_second": round(STEPS * diagram.size / compiled[1]),
        "grids_per_second": round(looked / compiled[1]),
        "grids_per_second_plain": round(looked / plain[1]),
        "ratio": round(plain[1] / compiled[1], 1),
        "fronts": fronts,
    }


def _timed(diagram: GridDiagram, *, compile: bool) -> tuple[Run, float]:
    """The run and its least time of three; of one, where it is not compiled."""
    seconds = float("inf")
    for _ in range(3 if compile else 1):
        start = time.process_time()
        made = run(diagram, 0, compile=compile)
        seconds = min(seconds, time.process_time() - start)
    return made, seconds


register(Benchmark("diagrams", "Search over grids: grids a second, fronts", cases, measure))
