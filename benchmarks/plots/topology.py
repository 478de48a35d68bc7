"""The page `topology.md`, from the results of the benchmarks of a rope's states."""

from __future__ import annotations

from statistics import median
from typing import Any

from matplotlib.figure import Figure

from benchmarks.plots.words import machine_words, ruled
from benchmarks.results import grouped, load
from knotopt.plot.figures import PANEL, measured_axes

Rows = list[dict[str, Any]]
KINDS = ((False, "all", "s", "#666666"), (True, "up to symmetry", "o", "#0072B2"))


def growth_table(rows: Rows) -> str:
    """One line a number of crossings."""
    lines = ruled(
        "| crossings | states | time [s] | runs | up to mirror image and reverse | time [s] "
        "| runs |"
    )
    for crossings in sorted({row["crossings"] for row in rows}):
        cells = []
        for canonical in (False, True):
            (row,) = (r for r in rows if (r["crossings"], r["canonical"]) == (crossings, canonical))
            seconds = f"{row['seconds']:.2g}" if row["runs"] else "-"
            cells += [f"{row['states']:,}", seconds, str(row["runs"] or "-")]
        lines.append(f"| {crossings} | {' | '.join(cells)} |")
    return "\n".join(lines)


def planning_table(rows: Rows) -> str:
    """One line a goal."""
    lines = ruled(
        "| goal | crossings | plans | states | actions | backward [ms] | median [ms] | runs "
        "| forward [s] | runs | states met | forward / backward |"
    )
    for row in rows:
        forward = " | | |"
        if "ratio" in row:
            forward = (
                f"{row['forward_seconds']:.2g} | {row['forward_runs']} "
                f"| {row['forward_states']:,} | {row['ratio']:,.0f}"
            )
        lines.append(
            f"| {row['goal']} | {row['crossings']} | {row['plans']:,} | {row['states']} "
            f"| {row['actions']} | {1e3 * row['seconds']:.2f} | {1e3 * row['seconds_median']:.2f} "
            f"| {row['runs']} | {forward} |"
        )
    return "\n".join(lines)


def extraction_table(rows: Rows) -> str:
    """One line a kind of curve and number of points."""
    lines = ruled(
        "| curve | points | curves | crossings, median | ambiguous | fastest [ms] | median [ms] "
        "| runs a curve |"
    )
    for (curve, points), some in grouped(rows, "curve", "points").items():
        counts = [row["crossings"] for row in some if row["crossings"] is not None]
        lines.append(
            f"| {curve} | {points} | {len(some)} | {median(counts) if counts else '-'} "
            f"| {len(some) - len(counts)} | {1e3 * median(row['seconds'] for row in some):.2f} "
            f"| {1e3 * median(row['seconds_median'] for row in some):.2f} "
            f"| {some[0]['repeats']} |"
        )
    return "\n".join(lines)


def topology_figure(growth: Rows, planning: Rows) -> Figure:
    """Number of states, and times of generating them, planning and searching, by crossings."""
    figure = Figure(figsize=(2 * PANEL, PANEL), layout="constrained")
    left, right = figure.subplots(1, 2)
    for canonical, label, marker, colour in KINDS:
        some = [row for row in growth if row["canonical"] == canonical]
        style = {"marker": marker, "color": colour, "markersize": 4}
        left.plot(
            [row["crossings"] for row in some],
            [row["states"] for row in some],
            label=label,
            **style,
        )
        timed = [row for row in some if row["runs"]]
        right.plot(
            [row["crossings"] for row in timed],
            [row["seconds"] for row in timed],
            label=f"generating, {label}",
            **style,
        )
    for label, key, marker, colour in (
        ("searching forward", "forward_seconds", "^", "#D55E00"),
        ("planning backward", "seconds", "D", "#009E73"),
    ):
        some = [row for row in planning if key in row]
        right.plot(
            [row["crossings"] for row in some],
            [row[key] for row in some],
            linestyle="",
            marker=marker,
            color=colour,
            markersize=4,
            label=label,
        )
    for axes, label in ((left, "states"), (right, "time [s]")):
        axes.set_yscale("log")
        measured_axes(axes, "crossings", label)
        axes.xaxis.get_major_locator().set_params(integer=True)
        axes.legend(fontsize=7, frameon=False)
    return figure


def write_parts() -> tuple[list[str], dict[str, Figure]]:
    """The parts of the page."""
    header, growth = load("topology_growth")
    _, planning = load("topology_planning")
    _, extraction = load("topology_extraction")
    parts = [
        "# States of a rope",
        f"One machine, one core: {machine_words(header)}.",
        "## How many there are",
        growth_table(growth),
        "Times are for making all states from those with one crossing fewer, by R1 and C; the "
        "fastest of the runs.",
        "![states and times by number of crossings](topology.png)",
        "## Planning backward and searching forward",
        planning_table(planning),
        "Goals are knots' cables on their best cuts, whose grid diagrams may have more crossings "
        "than the knots, or diagrams with the least crossings where the number is given and for "
        "K14n100. Backward: all plans, as a graph. Forward: breadth first from the trivial state "
        "by the actions that do not make more crossings than the goal has, until the goal is met; "
        "only to five crossings. Both times are the fastest "
        "of their runs, in one process; R2 by the paper's rule.",
        "## Reading the state off a polyline",
        extraction_table(extraction),
        "Medians over the curves of the fastest and of the median run of each.",
    ]
    return parts, {"topology.png": topology_figure(growth, planning)}
