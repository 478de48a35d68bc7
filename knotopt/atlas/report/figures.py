"""Charts of a report, in one column or two of a two-column paper."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from knotopt.arrays import FloatArray
from knotopt.atlas.report.heuristic import classes, difference
from knotopt.atlas.report.invariants import Invariants
from knotopt.atlas.report.relations import ARC, invariant_columns
from knotopt.atlas.report.results import Results
from knotopt.atlas.report.robots import named_groups
from knotopt.plot.figures import PANEL

BLUE, ORANGE, GREEN, GREY = "#0072B2", "#D55E00", "#009E73", "#B8B8B8"
SMALLEST_COLOURS = (BLUE, GREEN, "#CC79A7", "#E69F00")  # of the formulations
CLASSES = {  # colours differ in lightness, hatches tell them apart in print
    "open, smallest": (GREEN, ""),
    "open, with more": (BLUE, ""),
    "not open, with enough": (GREY, "////"),
    "fewer than any open": (ORANGE, "...."),
}
SMALL = {"fontsize": 7, "frameon": False}


def robots_figure(results: Results) -> Figure:
    """How many knots (best cut) and cuts need how many robots, by crossing number."""
    figure = Figure(figsize=(2 * PANEL, PANEL), layout="constrained")
    left, right = figure.subplots(1, 2, sharey=True)
    robots = results.cuts("opening_robots")
    _counts(left, results, robots.min(axis=1, keepdims=True))
    _counts(right, results, robots)
    left.set(title="knots, best cut", ylabel="smallest number of robots")
    right.set(title="all outer cuts")
    return figure


def heuristic_figure(results: Results) -> Figure:
    """LCF's robots less the smallest number, and the four classes by crossing number."""
    figure = Figure(figsize=(2 * PANEL, PANEL), layout="constrained")
    left, right = figure.subplots(1, 2)
    less, sorted_out = difference(results), classes(results)
    values = np.arange(less.min(), less.max() + 1)
    below = np.zeros(len(values))
    for name, (colour, hatch) in CLASSES.items():
        held = less[sorted_out[name]]
        heights = np.array([np.sum(held == value) for value in values])
        left.bar(
            values, heights, 0.8, below, color=colour, hatch=hatch, edgecolor="white", label=name
        )
        below += heights
    left.axvline(-0.5, color="#444444", linewidth=0.8, linestyle=":")
    left.set(
        xlabel="LCF's robots less the smallest number", ylabel="cuts", ylim=(0, 1.05 * below.max())
    )
    left.xaxis.set_major_locator(MaxNLocator(integer=True))
    left.legend(**SMALL)
    names = [name for name, _ in named_groups(results)]
    places = np.arange(len(names))
    below = np.zeros(len(names))
    for name, (colour, hatch) in CLASSES.items():
        shares = 100 * np.array(
            [sorted_out[name][knots].mean() for _, knots in named_groups(results)]
        )
        right.bar(places, shares, 0.8, below, color=colour, hatch=hatch, edgecolor="white")
        below += shares
    right.set(xlabel="crossing number", ylabel="cuts [%]", ylim=(0, 100))
    right.set_xticks(places, labels=names)
    return figure


def cuts_figure(results: Results) -> Figure:
    """Knots by what the worst cut costs them."""
    figure = Figure(figsize=(PANEL, 0.8 * PANEL), layout="constrained")
    axes = figure.subplots()
    shown = [*zip(results.smallest, SMALLEST_COLOURS, strict=False), ("lcf_robots", ORANGE)]
    width = 0.84 / len(shown)
    for index, (column, colour) in enumerate(shown):
        robots = results.cuts(column)
        counts = Counter((robots.max(axis=1) - robots.min(axis=1)).astype(int).tolist())
        places = np.array(sorted(counts))
        heights = [counts[place] for place in places.tolist()]
        label = results.methods[column].replace("`", "")
        offset = (index - (len(shown) - 1) / 2) * width
        axes.bar(places + offset, heights, width, color=colour, label=label)
    axes.set(xlabel="robots, worst cut less best cut", ylabel="knots")
    axes.xaxis.set_major_locator(MaxNLocator(integer=True))
    axes.legend(**SMALL)
    return figure


def relations_figure(results: Results, known: Mapping[str, Invariants]) -> Figure:
    """Robots against arc index, alternating knots and others side by side."""
    figure = Figure(figsize=(PANEL, PANEL), layout="constrained")
    axes = figure.subplots()
    arc = invariant_columns(results, known)[ARC]
    fewest = results.best("opening_robots")
    alternating = np.array([knot.alternating for knot in results.knots], dtype=float)
    largest = max(Counter(zip(arc.tolist(), fewest.tolist(), strict=True)).values())
    for which, label, colour, marker, offset in (
        (1, "alternating", BLUE, "o", -0.13),
        (0, "not alternating", ORANGE, "D", 0.13),
    ):
        chosen = alternating == which
        counts = Counter(zip(arc[chosen].tolist(), fewest[chosen].tolist(), strict=True))
        if not counts:
            continue
        x, y = np.array(sorted(counts)).T
        areas = [150 * counts[place] / largest + 4 for place in sorted(counts)]
        axes.scatter(x + offset, y, areas, color=colour, marker=marker, alpha=0.6, linewidths=0)
        sizes = np.unique(arc[chosen])
        means = [fewest[chosen & (arc == size)].mean() for size in sizes]
        axes.plot(sizes + offset, means, color=colour, marker=marker, markersize=3, label=label)
    axes.set(xlabel="arc index", ylabel="smallest number of robots, best cut")
    axes.xaxis.set_major_locator(MaxNLocator(integer=True))
    axes.yaxis.set_major_locator(MaxNLocator(integer=True))
    axes.legend(**SMALL, loc="upper left")
    axes.grid(alpha=0.3)
    return figure


def _counts(axes: Axes, results: Results, robots: FloatArray) -> None:
    """Numbers of entries by crossing number and robots, shaded by their share of the column."""
    groups = [(name, knots) for name, knots in named_groups(results) if name != "all"]
    if not groups:
        groups = named_groups(results)
    low, high = int(results.cuts("opening_robots").min()), int(results.cuts("opening_robots").max())
    for place, (_, knots) in enumerate(groups):
        counts = Counter(robots[knots].ravel().astype(int).tolist())
        for value, count in sorted(counts.items()):
            share = count / sum(counts.values())
            axes.bar(place, 1, 1, value - 0.5, color=BLUE, alpha=0.08 + 0.8 * share, linewidth=0)
            text = f"{count:,}" if count < 10_000 else f"{count / 1000:.0f}k"
            colour = "white" if share > 0.6 else "black"
            axes.text(place, value, text, ha="center", va="center", fontsize=6.5, color=colour)
    axes.set_xticks(range(len(groups)), labels=[name for name, _ in groups])
    axes.yaxis.set_major_locator(MaxNLocator(integer=True))
    axes.set(xlabel="crossing number", ylim=(low - 0.7, high + 0.7), xlim=(-0.6, len(groups) - 0.4))
    axes.tick_params(length=0)
    axes.spines[["top", "right"]].set_visible(False)
