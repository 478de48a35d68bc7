"""Safe sets on the grids that were searched for them, flown."""

from __future__ import annotations

from collections.abc import Iterable

from benchmarks.physics import CROSSINGS, measure_first
from benchmarks.physics_fewest import SEEDS
from benchmarks.registry import Benchmark, Case, Result, register
from knotopt.catalogue.knots import shipped_knots
from knotopt.catalogue.stored_grids import stored_grids
from knotopt.catalogue.table1_grids import table1_grids
from knotopt.reading.knot import read_knot
from knotopt.supports.requirements import Requirements

GRID, OPENNESS = "safe0.5", 0.5


def cases(smoke: bool) -> Iterable[Case]:
    """The knots with few crossings, and those of Table I."""
    flown = {knot.name for knot in shipped_knots().values() if knot.crossing_number <= CROSSINGS}
    flown |= {grid.knot for grid in table1_grids()}
    knots = [knot for knot, grid in stored_grids() if grid == GRID and knot in flown]
    return ({"row": f"{knot} {GRID}"} for knot in knots[: 1 if smoke else None])


def measure(case: Case) -> Result:
    """Of the first cut whose set, as small as the best cut's, ties with robots apart."""
    marks = read_knot(case["row"]).diagram.marks  # a later search may store another grid
    flown = measure_first(case["row"], "milp", Requirements("span", OPENNESS), SEEDS)
    return {"grid": [list(mark) for mark in marks], **flown}


register(Benchmark("physics_safe", "safe sets on the grids searched for them", cases, measure))
