"""Tables and figures of the formulations' benchmarks: LCF's excess, solvers, growth, proofs."""

from __future__ import annotations

import math
from collections import Counter, defaultdict
from collections.abc import Callable
from statistics import mean, median
from typing import Any

from matplotlib.figure import Figure

from benchmarks.plots.axes import (
    draw_families,
    family_legend,
    growth_axes,
    panel,
    robots_by_crossings,
)
from benchmarks.plots.words import machine_words
from benchmarks.results import grouped, load
from knotopt.atlas.report.performance import SHIFT, SOLVERS, draw_profile, shifted_geometric_mean
from knotopt.document.markdown import markdown_block
from knotopt.document.model import table_of

Rows = list[dict[str, Any]]


def counts_table(rows: Rows) -> str:
    """Robots by crossing number, and how LCF compares with the smallest open sets."""
    groups: dict[str, Rows] = defaultdict(list)
    for row in rows:
        groups[str(row["crossing_number"])] += row["cuts"].values()
    every = [cut for row in rows for cut in row["cuts"].values()]
    best = [
        {
            key: min(cut[key] for cut in row["cuts"].values())
            for key in ("baseline", "lcf", "layered", "opening", "opening_over_under", "span")
        }
        for row in rows
    ]

    def line(name: str, group: Rows) -> list[tuple[str, str]]:
        def share(key: str) -> str:  # a best cut is not of one set
            return f"{100 * mean(c[key] for c in group):.0f} %" if key in group[0] else ""

        return [
            ("crossings", name),
            ("cuts", f"{len(group)}"),
            ("baseline", f"{mean(c['baseline'] for c in group):.2f}"),
            ("LCF", f"{mean(c['lcf'] for c in group):.2f}"),
            ("open", share("lcf_open")),
            ("layered", f"{mean(c['layered'] for c in group):.2f}"),
            ("open", share("layered_open")),
            ("opening", f"{mean(c['opening'] for c in group):.2f}"),
            ("over-under", f"{mean(c['opening_over_under'] for c in group):.2f}"),
            ("span", f"{mean(c['span'] for c in group):.2f}"),
        ]

    named = [*groups.items(), ("all", every), ("all, best cut of each method", best)]
    return markdown_block(table_of([line(*each) for each in named], _lcf_note(every)))


def _lcf_note(cuts: Rows) -> str:
    is_open = [cut for cut in cuts if cut["lcf_open"]]
    excess = [cut["lcf"] - cut["opening"] for cut in is_open] or [0]
    fewer = [cut["opening"] - cut["lcf"] for cut in cuts if cut["lcf"] < cut["opening"]] or [0]
    proven = all(cut["opening_proven"] and cut["span_proven"] for cut in cuts)
    return (
        f"LCF's set is open (r = 0.5) on {100 * len(is_open) / len(cuts):.1f} % of the cuts; there "
        f"it uses {mean(excess):.2f} robots more than the smallest open set (mean; at most "
        f"{max(excess)}), and is smallest on {100 * mean(e == 0 for e in excess):.1f} %. On "
        f"{100 * sum(f > 0 for f in fewer) / len(cuts):.1f} % of the cuts it uses fewer robots "
        f"than any open set has (by {mean(fewer):.2f} in the mean). "
        + ("Every number of opening and span is a proven minimum." if proven else "NOT ALL PROVEN.")
    )


def speed_note(rows: Rows) -> str:
    """Times of compile, build and solve with CP-SAT, one thread."""
    cuts = [cut for row in rows for cut in row["cuts"].values()]
    parts = [
        f"`{name}`: median {median(c[key] for c in cuts):.1f} ms a cut, at most "
        f"{max(c[key] for c in cuts):.0f} ms, all {len(cuts)} cuts "
        f"{sum(c[key] for c in cuts) / 1e3:.0f} s on one core"
        for name, key in (("opening", "opening_ms"), ("span", "span_ms"))
    ]
    return "Compile, build and solve with CP-SAT on one thread: " + "; ".join(parts) + "."


def solver_table(rows: Rows) -> str:
    """Solved, proven, wrong, and times by formulation and solver."""
    runs: dict[tuple[str, str], Rows] = defaultdict(list)
    wrong: Counter[tuple[str, str]] = Counter()
    for row in rows:
        by_cut: dict[str, Rows] = defaultdict(list)
        for run in row["runs"]:
            runs[row["formulation"], run["solver"]].append(run)
            by_cut[run["cut"]].append(run)
        for group in by_cut.values():
            # The answer that most solvers call optimal stands; whoever differs is counted.
            optimal = [run for run in group if run["status"] == "optimal"]
            votes = Counter(run["objective"] for run in optimal)
            for run in optimal:
                if run["objective"] != votes.most_common(1)[0][0]:
                    wrong[row["formulation"], run["solver"]] += 1
    lines = []
    for key, group in sorted(runs.items()):
        times = [run["seconds"] for run in group]
        lines.append(
            [
                ("formulation", key[0]),
                ("solver", SOLVERS[key[1]][0]),
                ("instances", f"{len(group)}"),
                ("wrong", f"{wrong[key]}"),
                ("solved", f"{sum(run['objective'] is not None for run in group)}"),
                ("proven", f"{sum(run['status'] == 'optimal' for run in group)}"),
                ("mean ms", f"{1e3 * shifted_geometric_mean(times):.1f}"),
                ("median", f"{1e3 * median(times):.1f}"),
                ("worst", f"{1e3 * max(times):.0f}"),
            ]
        )
    note = (
        f"Mean: geometric, shifted by {1e3 * SHIFT:.0f} ms. Times are build and solve, one run "
        "each, one thread, limit 60 s. Wrong: called optimal, but not what most solvers found."
    )
    return markdown_block(table_of(lines, note))


def profile_figure(rows: Rows) -> Figure:
    """Performance profile on `opening`: share of instances solved within x times the fastest."""
    programs: list[dict[str, float]] = []
    for row in rows:
        by_cut: dict[str, dict[str, float]] = defaultdict(dict)
        for run in row["runs"]:
            if row["formulation"] == "opening" and run["solver"] != "exhaustive":
                solved = run["status"] == "optimal"
                by_cut[run["cut"]][run["solver"]] = run["seconds"] if solved else math.inf
        programs += by_cut.values()
    figure, axes = panel()
    draw_profile(axes, programs)
    return figure


def robots_figure(rows: Rows) -> Figure:
    """Robots by crossing number, over all cuts: LCF, layered, opening, span."""

    def of_cuts(key: str) -> Callable[[dict[str, Any]], list[float]]:
        return lambda row: [cut[key] for cut in row["cuts"].values()]

    series = (
        ("baseline 2N", "s", "#666666", of_cuts("baseline")),
        ("span, smallest", "v", "#CC79A7", of_cuts("span")),
        ("LCF", "o", "#0072B2", of_cuts("lcf")),
        ("opening, smallest", "^", "#D55E00", of_cuts("opening")),
        ("LCF layered", "D", "#009E73", of_cuts("layered")),
    )
    return robots_by_crossings(rows, series)


def growth_table(rows: Rows) -> str:
    """Compile and solve times at each size, and what LCF has there."""
    lines = []
    for (formulation, family, size), group in grouped(
        rows, "formulation", "family", "size"
    ).items():
        solved = [row for row in group if row["robots"] is not None]
        lines.append(
            [
                ("formulation", formulation),
                ("family", family),
                ("N", f"{size}"),
                ("runs", f"{len(group)}"),
                ("LCF", f"{mean(row['lcf'] for row in group):.1f}"),
                ("smallest", f"{mean(row['robots'] for row in solved):.1f}"),
                ("proven", f"{sum(row['status'] == 'optimal' for row in group)}"),
                ("compile s", f"{max(row['compile_seconds'] for row in group):.2f}"),
                ("solve s", f"{max(row['solve_seconds'] for row in group):.3f}"),
            ]
        )
    note = "Robots are means, seconds the worst of the runs; limit 60 s."
    return markdown_block(table_of(lines, note))


def growth_figure(rows: Rows) -> Figure:
    """Compile plus solve time against grid size, log-log, by formulation and family."""
    figure, axes = panel()
    styles = {"opening": "-", "span": "--"}
    for formulation, group in grouped(rows, "formulation").items():
        draw_families(
            axes,
            group,
            lambda row: row["compile_seconds"] + row["solve_seconds"],
            linestyle=styles[formulation],
        )
    growth_axes(axes, "compile and solve [s]", (10, 20, 40, 60))
    family_legend(axes, styles)
    return figure


def certificates_note(rows: Rows) -> str:
    """How many minima are certified, and what that takes."""
    return (
        f"{len(rows)} certificates for {sum(row['cuts'] for row in rows)} cuts, every "
        f"crossing-free one of each knot ({sum(row['every_cut'] for row in rows)} of {len(rows)}): "
        f"proven in {sum(row['prove_seconds'] for row in rows):.0f} s and checked in "
        f"{sum(row['check_seconds'] for row in rows):.0f} s on one core, "
        f"{sum(row['bytes'] for row in rows) / 1e6:.1f} MB."
    )


def write_parts() -> tuple[list[str], dict[str, Figure]]:
    """The text of `formulations.md`, part by part, and its figures by file name."""
    header, catalogue = load("formulations")
    _, solvers = load("solvers")
    _, growth = load("formulations_growth")
    _, certificates = load("certificates")
    parts = [
        "# Benchmarks of the formulations",
        f"One machine: {machine_words(header)}. r = 0.5.",
        "## LCF against the smallest sets: 249 prime knots, all crossing-free cuts (mean robots)",
        counts_table(catalogue),
        speed_note(catalogue),
        "![robots by crossing number](formulations_robots.png)",
        "## Solvers against each other",
        solver_table(solvers),
        "![performance profile](solvers_profile.png)",
        "## Growth with the grid size, cut L+ (random grids: seeds 0 to 4)",
        growth_table(growth),
        "![time against grid size](formulations_growth.png)",
        "## Certificates",
        certificates_note(certificates),
    ]
    figures = {
        "formulations_robots.png": robots_figure(catalogue),
        "solvers_profile.png": profile_figure(solvers),
        "formulations_growth.png": growth_figure(growth),
    }
    return parts, figures
