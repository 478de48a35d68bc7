"""The relaxation with softer and stiffer springs, on LCF's sets of 249 knots."""

from __future__ import annotations

from dataclasses import asdict

from benchmarks.registry import Benchmark, Case, Result, each_knot, register
from knotopt.catalogue.knots import shipped_knots
from knotopt.path.measures import measure
from knotopt.path.relaxation import Relaxation, relaxed_path
from knotopt.supports.lcf import best_cut

STIFFNESSES = (0.05, 0.1, 0.2, 0.3, 0.5, 1.0, 2.0)


def measure_knot(case: Case) -> Result:
    """The measures at each stiffness, all other parameters at their defaults."""
    chosen = best_cut(shipped_knots()[case["knot"]].diagram)
    return {
        "paths": [
            {"stiffness": k}
            | asdict(
                measure(
                    relaxed_path(chosen.cable, chosen.supports, None, Relaxation(stiffness=k)),
                    "lcf",
                )
            )
            for k in STIFFNESSES
        ]
    }


register(Benchmark("paths_stiffness", "relaxation, softer and stiffer", each_knot, measure_knot))
