"""What the figures share: medians and means with their spread, and legends."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from statistics import mean
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from benchmarks.results import FAMILIES, Row, grouped
from knotopt.plot.figures import PANEL

ASIDE = 0.08  # between the bars of two series
SPREAD: dict[str, Any] = {"title": "medians; bars: least to most", "title_fontsize": 6}
BARS: dict[str, Any] = {"capsize": 2, "elinewidth": 0.8, "capthick": 0.8}


def panel() -> tuple[Figure, Axes]:
    """A figure of one panel, one column of a paper wide."""
    figure = Figure(figsize=(PANEL, PANEL), layout="constrained")
    return figure, figure.subplots()


def draw_medians(axes: Axes, groups: Mapping[float, Sequence[float]], **style: Any) -> None:
    """Medians of the groups, each over its key, with bars from the least value to the greatest."""
    middle = np.array([np.median(values) for values in groups.values()])
    least = np.array([min(values) for values in groups.values()])
    most = np.array([max(values) for values in groups.values()])
    axes.errorbar(list(groups), middle, (middle - least, most - middle), **BARS, **style)


def draw_families(
    axes: Axes, rows: Sequence[Row], seconds: Callable[[Row], float], **style: Any
) -> None:
    """Medians of times against grid size, a line a family of grid diagrams."""
    for family, (marker, colour) in FAMILIES.items():
        sizes = grouped((row for row in rows if row["family"] == family), "size")
        times = {size: [*map(seconds, group)] for size, group in sizes.items()}
        draw_medians(axes, times, marker=marker, color=colour, markersize=4, **style)


def growth_axes(axes: Axes, label: str, sizes: Sequence[int]) -> None:
    """Times against grid size, log-log, with ticks at some sizes."""
    axes.set(xscale="log", yscale="log", xlabel="grid size N", ylabel=label)
    axes.set_xticks(sizes, labels=[str(size) for size in sizes])
    axes.minorticks_off()
    axes.grid(alpha=0.3)


Series = tuple[str, str, str, Callable[[Row], Sequence[float]]]
"""Label, marker, colour, and what a record contributes."""


def robots_by_crossings(rows: Sequence[Row], series: Sequence[Series]) -> Figure:
    """Mean robots by crossing number, with bars from quartile to quartile side by side."""
    figure, axes = panel()
    numbers = sorted({row["crossing_number"] for row in rows})
    for place, (label, marker, colour, pick) in enumerate(series):
        at = np.array(numbers) + ASIDE * (place - (len(series) - 1) / 2)
        groups = [
            [value for row in rows if row["crossing_number"] == number for value in pick(row)]
            for number in numbers
        ]
        # Not error bars: a mean may lie outside the quartiles.
        low, high = np.transpose([np.percentile(group, (25, 75)) for group in groups])
        axes.vlines(at, low, high, color=colour, linewidth=1.2, alpha=0.6)
        means = [mean(group) for group in groups]
        axes.plot(at, means, marker=marker, color=colour, markersize=4, linewidth=1, label=label)
    axes.set(xlabel="crossing number", ylabel="robots", ylim=(0, None))
    axes.legend(fontsize=7, frameon=False, title="means; bars: the middle half", title_fontsize=7)
    axes.grid(alpha=0.3)
    return figure


def family_legend(axes: Axes, styles: Mapping[str, str], *more: Line2D) -> None:
    """Families by marker and colour, and what line styles mean, on lines without markers."""
    families = [
        Line2D([], [], color=colour, marker=marker, markersize=4, linestyle="", label=family)
        for family, (marker, colour) in FAMILIES.items()
    ]
    lines = [
        Line2D([], [], color="#444444", linestyle=style, label=name)
        for name, style in styles.items()
    ]
    handles = [*families, *lines, *more]
    axes.legend(handles=handles, fontsize=6, frameon=False, handlelength=3, **SPREAD)
