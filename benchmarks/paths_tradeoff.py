"""Length against bending: the program at several weights, on LCF's sets of Table I."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from benchmarks.registry import Benchmark, Case, Result, register
from knotopt.catalogue.table1_grids import table1_grids
from knotopt.path.optimise import optimise_path
from knotopt.path.requirements import PathRequirements
from knotopt.supports.lcf import best_cut

WEIGHTS = (0.005, 0.01, 0.02, 0.04, 0.08, 0.16, 0.32, 0.64)


def cases(smoke: bool) -> Iterable[Case]:
    """One case a row and weight."""
    rows = [grid.row for grid in table1_grids() if grid.preferred]
    for row in rows[:1] if smoke else rows:
        for weight in WEIGHTS[3:5] if smoke else WEIGHTS:
            yield {"row": row, "bending": weight}


def measure(case: Case) -> Result:
    """Length over the taut string's, integral of squared curvature, smallest radius."""
    grid = next(g for g in table1_grids() if g.preferred and g.row == case["row"])
    chosen = best_cut(grid.diagram)
    asked = PathRequirements(bending=case["bending"])
    path = optimise_path(chosen.cable, chosen.supports, asked)
    s = np.linspace(0, path.curve.length, 20_000)
    return {
        "status": str(path.status),
        "smooth": path.curve.is_smooth,
        "stretch": path.stretch,
        "bending_energy": float(np.trapezoid(path.curve.curvature(s) ** 2, s)),
        "smallest_radius": path.report.smallest_radius,
    }


register(Benchmark("paths_tradeoff", "length against bending, Table I", cases, measure))
