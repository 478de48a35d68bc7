"""Growth of both methods with the grid size, to N = 40, on the smallest sets, cut L+."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import asdict

from benchmarks.lcf_growth import diagram_of
from benchmarks.registry import Benchmark, Case, Result, register
from benchmarks.warm import warm_paths
from knotopt.cable.cable import Cable
from knotopt.path.measures import both_methods, measure
from knotopt.supports.minimal import minimal_supports

SIZES = (10, 15, 20, 30, 40)
SEEDS = range(3)


def cases(smoke: bool) -> Iterable[Case]:
    """Random grids of three seeds, T(2, N-2) and T(p, p+1)."""
    for size in SIZES[:1] if smoke else SIZES:
        for seed in SEEDS:
            yield {"family": "random", "size": size, "seed": seed}
        for family in ("T(2,N-2)", "T(p,p+1)"):
            odd = size + 1 if size % 2 == 0 else size  # of an even N, T(2, N - 2) would be a link
            yield {"family": family, "size": odd, "seed": None}


def measure_size(case: Case) -> Result:
    """The measures of both paths, and what the independent check takes [s]."""
    warm_paths()
    chosen = minimal_supports(Cable(diagram_of(case), "L+"), canonical=False)
    paths = both_methods(chosen)
    return {
        "cable_length": chosen.cable.length,
        "crossings": len(chosen.cable.crossings),
        "rounds": len(paths[1].rounds),
        "iterations": sum(each.iterations for each in paths[1].rounds),
        "paths": [asdict(measure(path, "opening")) for path in paths],
    }


register(Benchmark("paths_growth", "paths to N = 40", cases, measure_size))
