"""Solvers by their times: shifted geometric means and performance profiles.

E. D. Dolan, J. J. More: Benchmarking optimization software with performance profiles (2002),
doi:10.1007/s101070100263.
"""

from __future__ import annotations

import math
from collections import defaultdict
from collections.abc import Iterable, Mapping
from statistics import mean

import numpy as np
from matplotlib.axes import Axes

SHIFT = 0.01  # of the geometric mean of times [s]
SOLVERS = {
    "cp-sat": ("CP-SAT", "-", "#0072B2"),
    "maxsat": ("RC2 (MaxSAT)", "--", "#009E73"),
    "highs": ("HiGHS (cvxpy)", "-.", "#D55E00"),
    "scip": ("SCIP (cvxpy)", ":", "#CC79A7"),
    "exhaustive": ("exhaustive", (0, (1, 3)), "#666666"),
}
"""What a solver is called, its line and its colour."""
TICKS = (1, 2, 5, 10, 20, 100, 1000, 10_000)


def shifted_geometric_mean(times: Iterable[float]) -> float:
    """exp(mean(log(t + SHIFT))) - SHIFT [s].

    Examples
    --------
    >>> round(shifted_geometric_mean([0.0, 0.03]), 6)
    0.01
    """
    return math.exp(mean(math.log(t + SHIFT) for t in times)) - SHIFT


def draw_profile(axes: Axes, programs: Iterable[Mapping[str, float]]) -> None:
    """Performance profile: the share of instances solved within x times the fastest solver's time.

    Parameters
    ----------
    axes : Axes
    programs : iterable of mapping of str to float
        Of each program the time of each solver [s], inf where it was not solved. Instances that
        nobody solved count.
    """
    ratios: dict[str, list[float]] = defaultdict(list)
    for times in programs:
        fastest = min(times.values())
        for solver, seconds in times.items():
            ratios[solver].append(seconds / fastest if math.isfinite(fastest) else math.inf)
    for solver, (label, style, colour) in SOLVERS.items():
        if ratios[solver]:
            values = np.sort(ratios[solver])
            share = np.arange(1, len(values) + 1) / len(values)
            axes.step(values, share, where="post", label=label, linestyle=style, color=colour)
    largest = max(
        (each for some in ratios.values() for each in some if math.isfinite(each)), default=1
    )
    axes.set(
        xscale="log",
        xlabel="time over the fastest solver's",
        ylabel="share of instances",
        ylim=(0, 1.02),
    )
    ticks = [tick for tick in TICKS if tick <= max(2, largest)]
    axes.set_xticks(ticks, labels=[f"{tick:,}" for tick in ticks], minor=False)
    axes.minorticks_off()
    axes.legend(fontsize=7, frameon=False, loc="lower right")
    axes.grid(alpha=0.3)
