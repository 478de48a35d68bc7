"""The page `summary.md` and its figures, from the results of LCF's benchmarks."""

from __future__ import annotations

from collections.abc import Callable
from statistics import mean, median
from typing import Any

import numpy as np
from matplotlib.figure import Figure

from benchmarks.plots.axes import SPREAD, draw_medians, panel, robots_by_crossings
from benchmarks.plots.words import machine_words
from benchmarks.results import FAMILIES, SPEED_AT, grouped, load
from knotopt.document.markdown import markdown_block
from knotopt.document.model import table_of

FIT_FROM = 40  # growth exponents are fitted to N >= 40, where fixed costs no longer count


def catalogue_summary(rows: list[dict[str, Any]]) -> str:
    """Table: robots by crossing number."""
    lines = []
    for name, group in [*grouped(rows, "crossing_number").items(), ("all", rows)]:
        cuts = [robots for row in group for robots in row["robots"].values()]
        layered = [robots for row in group for robots in row["robots_layered"].values()]
        best = [min(row["robots"].values()) for row in group]
        lines.append(
            [
                ("crossings", f"{name}"),
                ("knots", f"{len(group)}"),
                ("cuts", f"{len(cuts)}"),
                ("baseline", f"{mean(row['robots_before'] for row in group):.2f}"),
                ("LCF", f"{mean(cuts):.2f}"),
                ("LCF, best cut", f"{mean(best):.2f}"),
                ("layered", f"{mean(layered):.2f}"),
                ("ms a cut", f"{median(row['ms_per_cut'] for row in group):.2f}"),
            ]
        )
    speed = median(row["times_faster_than_definition"] for row in rows)
    size = min(SPEED_AT, max(row["grid_size"] for row in rows))
    milliseconds = median(row["ms_per_cut"] for row in rows if row["grid_size"] == size)
    note = (
        f"At N = {size} a cut takes {milliseconds:.2f} ms (median over the knots of that size). "
        f"Median speed-up over the definition spelled out in plain Python: {speed:.0f} times."
    )
    return markdown_block(table_of(lines, note))


def growth_exponent(rows: list[dict[str, Any]], family: str) -> float:
    """Slope of log(median seconds) against log N for N >= FIT_FROM."""
    times = _by_size(rows, family, "seconds")
    sizes = [size for size in times if size >= FIT_FROM]
    slope: float = np.polyfit(np.log(sizes), np.log([median(times[s]) for s in sizes]), 1)[0]
    return slope


def growth_summary(rows: list[dict[str, Any]]) -> str:
    """Table: time, memory and growth exponent by family at the largest size."""
    lines = []
    for family in FAMILIES:
        size = max(_by_size(rows, family, "seconds"))
        last = [row for row in rows if row["family"] == family and row["size"] == size]
        lines.append(
            [
                ("family", family),
                ("N", f"{size}"),
                ("runs", f"{len(last)}"),
                ("crossings", f"{median(r['crossings'] for r in last):.0f}"),
                ("robots", f"{median(r['robots'] for r in last):.0f}"),
                ("seconds", f"{max(r['seconds'] for r in last):.2f}"),
                ("MiB", f"{max(r['mebibytes'] for r in last):.0f}"),
                ("time grows as", f"N^{growth_exponent(rows, family):.1f}"),
            ]
        )
    note = (
        "Seconds and MiB are the worst of the runs; each run counts the fastest of three. MiB is "
        f"what LCF allocates, without the interpreter. Exponents are fitted to N >= {FIT_FROM}."
    )
    return markdown_block(table_of(lines, note))


def growth_figure(rows: list[dict[str, Any]]) -> Figure:
    """Time of LCF on one cut against grid size, log-log, one marker a family."""
    figure, axes = panel()
    for family, (marker, colour) in FAMILIES.items():
        seconds = _by_size(rows, family, "seconds")
        draw_medians(
            axes,
            {size: [1e3 * value for value in values] for size, values in seconds.items()},
            marker=marker,
            color=colour,
            markersize=4,
            label=f"{family}: $N^{{{growth_exponent(rows, family):.1f}}}$",
        )
    axes.set(xscale="log", yscale="log", xlabel="grid size N", ylabel="LCF on one cut [ms]")
    axes.set_xticks([10, 20, 50, 100], labels=["10", "20", "50", "100"])
    axes.legend(fontsize=7, frameon=False, **SPREAD)
    axes.grid(alpha=0.3)
    return figure


def robots_figure(rows: list[dict[str, Any]]) -> Figure:
    """Robots by crossing number: baseline, LCF over all cuts, LCF on the best cut."""
    series: tuple[tuple[str, str, str, Callable[[dict[str, Any]], list[int]]], ...] = (
        ("baseline 2N", "s", "#666666", lambda row: [row["robots_before"]]),
        ("LCF, all cuts", "o", "#0072B2", lambda row: list(row["robots"].values())),
        ("LCF layered, all cuts", "D", "#009E73", lambda row: list(row["robots_layered"].values())),
        ("LCF, best cut", "^", "#D55E00", lambda row: [min(row["robots"].values())]),
    )
    return robots_by_crossings(rows, series)


def write_parts() -> tuple[list[str], dict[str, Figure]]:
    """The parts of the page."""
    _, startup = load("startup")
    header, catalogue = load("lcf_catalogue")
    _, growth = load("lcf_growth")
    answers = [
        f"`knotopt {' '.join(row['arguments'])}`: {row['seconds']:.2f} s, "
        f"{row['times_a_bare_python']:.1f} times a bare Python (median of {row['runs']} runs)."
        for row in startup
    ]
    parts = [
        "# Benchmarks of LCF",
        f"One machine, one core: {machine_words(header)}.",
        "## 249 prime knots up to 10 crossings, all crossing-free cuts (mean robots)",
        catalogue_summary(catalogue),
        "![robots by crossing number](robots.png)",
        "## Growth with the grid size, cut L+ (random grids: seeds 0 to 4)",
        growth_summary(growth),
        "![time against grid size](growth.png)",
        "## Command line",
        "\n".join(f"- {answer}" for answer in answers),
    ]
    return parts, {"robots.png": robots_figure(catalogue), "growth.png": growth_figure(growth)}


def _by_size(rows: list[dict[str, Any]], family: str, key: str) -> dict[int, list[float]]:
    groups = grouped((row for row in rows if row["family"] == family), "size")
    return {size: [row[key] for row in group] for size, group in groups.items()}
