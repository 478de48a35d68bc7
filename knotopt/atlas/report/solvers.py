"""Section: the same programs by several solvers, where they were asked for."""

from __future__ import annotations

import math
from collections import defaultdict
from collections.abc import Callable
from statistics import median

from matplotlib.figure import Figure

from knotopt.atlas.report.performance import SHIFT, SOLVERS, draw_profile, shifted_geometric_mean
from knotopt.atlas.report.results import Results
from knotopt.cable.cut import OUTER_CUTS
from knotopt.document.columns import Row
from knotopt.document.model import NONE, Picture, Section, Table, table_of
from knotopt.plot.figures import PANEL

PROFILE = "solvers"
"""The name of the figure."""
STATISTICS: dict[str, Callable[[list[float]], float]] = {
    "mean ms": shifted_geometric_mean,
    "median ms": median,
    "largest ms": max,
}
Program = tuple[int, str, str]
"""Number of the knot, cut and formulation."""


def solvers_section(results: Results) -> Section | None:
    """Solved, proven, wrong, times and their profile; None if the run has no solvers."""
    if not results.solvers:
        return None
    settings = results.manifest.settings
    asked = [row for row in results.solvers if row["meets_definition"] is not None]
    return Section(
        "Solvers",
        (
            f"Each program was solved by each solver on one thread, seed {settings.seed}, time "
            f"limit {settings.solver_limit:g} s. The sets of {len(asked):,} answers were examined "
            "by the independent checkers too.",
            solvers_table(results),
            Picture(
                PROFILE,
                "Performance profile: the share of instances that a solver proved within so many "
                "times the fastest solver's time.",
                "which share of the programs each solver solves within a multiple of the best time",
                is_wide=len(_formulations(results)) > 1,
            ),
        ),
    )


def solvers_table(results: Results) -> Table:
    """Answers and times by formulation and solver."""
    wrong = wrong_answers(results)
    rows = []
    for formulation in _formulations(results):
        for solver in results.manifest.settings.solvers:
            kept = [
                (row, is_wrong)
                for row, is_wrong in zip(results.solvers, wrong, strict=True)
                if (row["formulation"], row["solver"]) == (formulation, solver)
            ]
            tried = [row for row, _ in kept if row["status"] != "refused"]
            times = [row["seconds"] for row in tried]
            rows.append(
                [
                    ("formulation", f"`{formulation}`"),
                    ("solver", SOLVERS[solver][0]),
                    ("programs", f"{len(tried):,}"),
                    ("solved", f"{sum(row['objective'] is not None for row in tried):,}"),
                    ("proven", f"{sum(row['proven'] for row in tried):,}"),
                    ("wrong", f"{sum(is_wrong for _, is_wrong in kept):,}"),
                    *(
                        (head, f"{1e3 * of(times):.1f}" if times else NONE)
                        for head, of in STATISTICS.items()
                    ),
                ]
            )
    return table_of(
        rows,
        "Programs that the solver takes, those to which it gave a set, and those of which it says "
        "that the set is smallest. Wrong: the set breaks a row or the definition, the solver "
        "failed, or it says that no set is as small as one that another solver found. Mean: "
        f"geometric, shifted by {1e3 * SHIFT:.0f} ms. Times are build and solve, those that ended "
        "without a proof too, whatever else the machine did.",
    )


def profile_figure(results: Results) -> Figure:
    """A performance profile of each formulation."""
    formulations = _formulations(results)
    figure = Figure(figsize=(len(formulations) * PANEL, PANEL), layout="constrained")
    for axes, formulation in zip(
        figure.subplots(1, len(formulations), squeeze=False)[0], formulations, strict=True
    ):
        programs: dict[Program, dict[str, float]] = defaultdict(dict)
        for row in results.solvers:
            if row["formulation"] == formulation:
                seconds = row["seconds"] if row["proven"] else math.inf
                programs[_program(row)][row["solver"]] = seconds
        draw_profile(axes, programs.values())
        axes.set_title(formulation, fontsize=9)
    return figure


def wrong_answers(results: Results) -> list[bool]:
    """Which rows of the solvers cannot be right.

    A set counts that satisfies every row, so that of two solvers that contradict each other the
    one is wrong whose bound is above the other's set.
    """
    smallest: dict[Program, float] = _smallest_of_the_atlas(results)
    for row in results.solvers:
        if row["satisfies"]:
            program = _program(row)
            smallest[program] = min(smallest.get(program, math.inf), row["objective"])
    return [
        row["satisfies"] is False
        or row["meets_definition"] is False
        or (row["bound"] or 0) > (found := smallest.get(_program(row), math.inf))
        or (row["status"] == "infeasible" and found < math.inf)
        for row in results.solvers
    ]


def _smallest_of_the_atlas(results: Results) -> dict[Program, float]:
    """Robots of the sets of `atlas.parquet`."""
    return {
        (knot.number, cut, formulation): robots
        for formulation in _formulations(results)
        for knot, row in zip(
            results.knots, results.cuts(f"{formulation}_robots").tolist(), strict=True
        )
        for cut, robots in zip(OUTER_CUTS, row, strict=True)
        if not math.isnan(robots)
    }


def _formulations(results: Results) -> list[str]:
    return list(dict.fromkeys(row["formulation"] for row in results.solvers))


def _program(row: Row) -> Program:
    return row["number"], row["cut"], row["formulation"]
