"""The page `paths.md` and its figures, from the results of the benchmarks of paths."""

from __future__ import annotations

from statistics import median
from typing import Any

from matplotlib.figure import Figure

from benchmarks.plots.axes import draw_families, family_legend, growth_axes, panel
from benchmarks.plots.words import machine_words, ruled
from benchmarks.results import SMALL, grouped, load

Rows = list[dict[str, Any]]
DONE = ("solved", "converged")
GOAL_STRETCH = 1.25  # asked for the median
GOAL_SECONDS = 5.0  # asked of the program at N = 40
GOAL: dict[str, Any] = {"color": "#CC79A7", "linewidth": 0.8, "linestyle": "-"}
WEIGHT = 0.04  # of bending, unless another is asked for
METHODS = {"relaxation": "#999999", "nlp": "#0072B2"}


def _known(values: list[float | None]) -> list[float]:
    return [value for value in values if value is not None]


def catalogue_table(rows: Rows) -> str:
    """Counts and medians by supports and method."""
    lines = ruled(
        "| supports | method | paths | solved or converged | same diagram | other knot "
        "| clearance or opening lost | / taut, median | / taut, worst | radius, median "
        "| radius, smallest |"
    )
    for supports in ("lcf", "opening"):
        for method in METHODS:
            paths = _paths(rows, supports, method)
            lost = sum(
                p["same_diagram"] and (_below(p, "clearance", 0.148) or _below(p, "opening", 0.248))
                for p in paths
            )
            lines.append(
                f"| {supports} | {method} | {len(paths)} "
                f"| {sum(p['status'] in DONE for p in paths)} "
                f"| {sum(p['same_diagram'] for p in paths)} "
                f"| {sum(not p['same_knot'] for p in paths)} "
                f"| {lost} "
                f"| {median(p['stretch'] for p in paths):.3f} "
                f"| {max(p['stretch'] for p in paths):.3f} "
                f"| {median(p['smallest_radius'] for p in paths):.3f} "
                f"| {min(p['smallest_radius'] for p in paths):.3f} |"
            )
    return "\n".join(lines)


def against_note(rows: Rows) -> str:
    """Program against relaxation on the same supports, where both keep the diagram."""
    lines = []
    for supports in ("lcf", "opening"):
        pairs = [
            (relaxed, ours)
            for relaxed, ours in zip(
                _paths(rows, supports, "relaxation"), _paths(rows, supports, "nlp"), strict=True
            )
            if relaxed["same_diagram"] and ours["same_diagram"]
        ]
        ratios = [ours["length"] / relaxed["length"] for relaxed, ours in pairs]
        rounder = [ours["smallest_radius"] / r["smallest_radius"] for r, ours in pairs]
        both_worse = sum(a >= 1 and b <= 1 for a, b in zip(ratios, rounder, strict=True))
        lines.append(
            f"- {supports}: of {len(pairs)} sets on which both keep the diagram, the program's "
            f"path is shorter on {sum(ratio < 1 for ratio in ratios)} (its length over the "
            f"relaxation's: median {median(ratios):.3f}, worst {max(ratios):.3f}), its smallest "
            f"radius is larger on {sum(r > 1 for r in rounder)} (ratio: median "
            f"{median(rounder):.2f}, worst {min(rounder):.2f}); neither on {both_worse}."
        )
    return "\n".join(lines)


def time_note(rows: Rows) -> str:
    """What the program's time is made of."""
    lines = []
    for supports in ("lcf", "opening"):
        small = [
            p
            for row in rows
            if row["grid_size"] <= SMALL
            for p in row["paths"]
            if p["supports"] == supports and p["method"] == "nlp"
        ]
        parts = ", ".join(
            f"{name} {median(p[key] for p in small):.0f}"
            for name, key in (
                ("triangulating", "mesh_ms"),
                ("building", "build_ms"),
                ("solving", "solve_ms"),
            )
        )
        lines.append(
            f"- {supports}, N <= {SMALL} ({len(small)} knots): median "
            f"{median(p['milliseconds'] for p in small):.0f} ms ({parts}; "
            f"{median(p['rounds'] for p in small):.0f} rounds, "
            f"{median(p['iterations'] for p in small):.0f} iterations), without the independent "
            "check."
        )
    return "\n".join(lines)


def unsolved_note(rows: Rows) -> str:
    """The paths that the program did not solve, with what blocks them."""
    found = [
        f"- {row['knot']}, {p['supports']}, cut {p['cut']}: {p['blocked'] or p['status']}"
        for row in rows
        for p in row["paths"]
        if p["method"] == "nlp" and p["status"] != "solved"
    ]
    return "Not solved:\n\n" + "\n".join(found) if found else "The program solved all of them."


def stiffness_table(rows: Rows) -> str:
    """The relaxation's validity and length at each stiffness."""
    lines = ruled("| stiffness k | converged | same diagram | other knot | / taut, median |")
    every = [path for row in rows for path in row["paths"]]
    for stiffness, paths in grouped(every, "stiffness").items():
        lines.append(
            f"| {stiffness:g} | {sum(p['status'] in DONE for p in paths)} "
            f"| {sum(p['same_diagram'] for p in paths)} "
            f"| {sum(not p['same_knot'] for p in paths)} "
            f"| {median(p['stretch'] for p in paths):.3f} |"
        )
    return "\n".join([*lines, "", f"Of {len(rows)} knots, LCF's sets; alpha = 1, c = 0.5."])


def growth_table(rows: Rows) -> str:
    """Times at each size, medians over the seeds."""
    lines = ruled(
        "| family | N | runs | crossings | program s | rounds | iterations | solved "
        "| relaxation s | same diagram, program | relaxation |"
    )
    for (family, size), group in grouped(rows, "family", "size").items():
        relaxed = [row["paths"][0] for row in group]
        ours = [row["paths"][1] for row in group]
        lines.append(
            f"| {family} | {size} | {len(group)} | {median(r['crossings'] for r in group):.0f} "
            f"| {median(p['milliseconds'] for p in ours) / 1e3:.2f} "
            f"| {median(r['rounds'] for r in group):.0f} "
            f"| {median(r['iterations'] for r in group):.0f} "
            f"| {sum(p['status'] == 'solved' for p in ours)} "
            f"| {median(p['milliseconds'] for p in relaxed) / 1e3:.2f} "
            f"| {sum(p['same_diagram'] for p in ours)} "
            f"| {sum(p['same_diagram'] for p in relaxed)} |"
        )
    return "\n".join(lines)


def stretch_figure(rows: Rows) -> Figure:
    """Length over the taut string's, sorted, by supports and method."""
    figure, axes = panel()
    for supports, style in (("lcf", "-"), ("opening", "--")):
        for method, colour in METHODS.items():
            values = sorted(p["stretch"] for p in _paths(rows, supports, method))
            axes.plot(
                [100 * (k + 1) / len(values) for k in range(len(values))],
                values,
                color=colour,
                linestyle=style,
                label=f"{'program' if method == 'nlp' else method}, {supports}",
            )
    axes.axhline(GOAL_STRETCH, label=f"goal for the median: {GOAL_STRETCH}", **GOAL)
    axes.set(xlabel="share of 249 knots [%]", ylabel="length over the taut string's")
    axes.legend(fontsize=7, frameon=False)
    axes.grid(alpha=0.3)
    return figure


def tradeoff_figure(rows: Rows) -> Figure:
    """Length against bending as the weight grows, a line a row of Table I."""
    figure, axes = panel()
    rows = [row for row in rows if row["smooth"]]  # a polyline has no curvature to measure
    groups = grouped(rows, "row")
    for name, group in groups.items():
        axes.plot(
            [row["bending_energy"] for row in group],
            [row["stretch"] for row in group],
            marker="o",
            markersize=3,
            label=f"row {name}",
        )
    usual = [row for group in groups.values() for row in group if row["bending"] == WEIGHT]
    axes.plot(
        [row["bending_energy"] for row in usual],
        [row["stretch"] for row in usual],
        "k*",
        markersize=7,
        zorder=4,
        label=f"weight {WEIGHT}, the default",
    )
    axes.set(
        xscale="log",
        xlabel="bending: squared curvature, integrated",
        ylabel="length over the taut string's",
    )
    figure.legend(loc="outside lower center", ncols=3, fontsize=7, frameon=False)
    axes.grid(alpha=0.3)
    return figure


def growth_figure(rows: Rows) -> Figure:
    """Time against grid size, log-log, both methods."""
    figure, axes = panel()
    styles = {"program": "-", "relaxation": ":"}
    for place, style in zip((1, 0), styles.values(), strict=True):
        paths = [row | row["paths"][place] for row in rows]
        draw_families(axes, paths, lambda path: path["milliseconds"] / 1e3, linestyle=style)
    label = f"goal at N = 40: {GOAL_SECONDS:g} s"
    goal = axes.axhline(GOAL_SECONDS, xmin=0.8, label=label, **GOAL)
    growth_axes(axes, "time [s]", (10, 20, 40))
    family_legend(axes, styles, goal)
    return figure


def write_parts() -> tuple[list[str], dict[str, Figure]]:
    """The text of `paths.md`, part by part, and its figures by file name."""
    header, catalogue = load("paths")
    _, stiffness = load("paths_stiffness")
    _, tradeoff = load("paths_tradeoff")
    _, growth = load("paths_growth")
    parts = [
        "# Benchmarks of the paths",
        f"One machine, one core: {machine_words(header)}. Clearance 0.15, opening 0.25, "
        "gap 0.3, slope 1, bending 0.04; each path made and examined once.",
        f"## Relaxation and program: {len(catalogue)} knots, best cut of LCF and of `opening`",
        catalogue_table(catalogue),
        "Clearance or opening lost: below 0.148 or 0.248 though the diagram is the grid's. Radius "
        "and lengths in grid steps.",
        against_note(catalogue),
        unsolved_note(catalogue),
        time_note(catalogue),
        "![length over the taut string's](paths_stretch.png)",
        "## The relaxation, softer and stiffer",
        stiffness_table(stiffness),
        "## Length against bending (weights 0.005 to 0.64, star: 0.04)",
        "![trade-off](paths_tradeoff.png)",
        "## Growth with the grid size, smallest sets of `opening`, cut L+ (random: seeds 0 to 2)",
        growth_table(growth),
        "![time against grid size](paths_growth.png)",
    ]
    figures = {
        "paths_stretch.png": stretch_figure(catalogue),
        "paths_tradeoff.png": tradeoff_figure(tradeoff),
        "paths_growth.png": growth_figure(growth),
    }
    return parts, figures


def _paths(rows: Rows, supports: str, method: str) -> Rows:
    return [
        path
        for row in rows
        for path in row["paths"]
        if path["supports"] == supports and path["method"] == method
    ]


def _below(path: dict[str, Any], key: str, limit: float) -> bool:
    return any(value < limit for value in _known([path[key]]))
