"""Section: how long it took, and paths where they were asked for."""

from __future__ import annotations

import numpy as np

from knotopt.atlas.report.results import Results
from knotopt.document.cells import percent
from knotopt.document.model import Section, Table, table, table_of
from knotopt.supports.registry import find_formulation
from knotopt.tables.comparison import is_done, path_groups, path_medians
from knotopt.tables.methods import PROGRAMS

STEPS = {
    "lcf_seconds": "LCF and its layered set",
    **{
        f"{method.key}_seconds": f"`{method.formulation}`{' with loops' * method.with_loops}"
        + f", {method.threading}" * find_formulation(method.formulation).has_openness
        for method in PROGRAMS
    },
    "paths_seconds": "four paths and their checks",
    "check_seconds": "checks by the definitions",
}


def times_section(results: Results) -> Section:
    """Times a cut of every step, the largest memory, and where solvers are compared."""
    memory = np.nanmax(results.seconds("worker_mib"))
    where = (
        "is in section Solvers."
        if results.solvers
        else "is the matter of the benchmark `solvers`: see `benchmarks/results/formulations.md` "
        "in knotopt's repository."
    )
    return Section(
        "Times",
        (
            times_table(results),
            f"The largest worker process had {memory:,.0f} MiB.",
            "The programs were solved by CP-SAT on one thread. How it compares with other solvers "
            f"(solved, proven, wrong, shifted geometric means, performance profile) {where}",
        ),
    )


def times_table(results: Results) -> Table:
    """Median, 90 % and largest of every step."""
    rows = []
    for column, words in STEPS.items():
        if column not in results.times.column_names:
            continue
        seconds = results.seconds(column)
        seconds = seconds[~np.isnan(seconds)]
        if seconds.size:
            rows.append(
                [
                    words,
                    f"{seconds.size:,}",
                    f"{1e3 * np.median(seconds):.1f}",
                    f"{1e3 * np.quantile(seconds, 0.9):.1f}",
                    f"{1e3 * seconds.max():.1f}",
                    f"{seconds.sum():,.1f}",
                ]
            )
    return table(
        ("step", "cuts", "median ms", "90 % ms", "largest ms", "all together s"),
        rows,
        "Times a cut of compiling, building and solving, as measured in the run, whatever else the "
        "machine did; 90 %: that much is not exceeded on 90 % of the cuts.",
    )


def paths_section(results: Results) -> Section | None:
    """Medians of the paths' measures; None if the run has no paths."""
    if not results.paths:
        return None
    rows = [
        [
            ("supports", supports),
            ("method", method),
            ("paths", f"{len(paths):,}"),
            ("done", percent(is_done(paths))),
            ("same diagram", percent([path["same_diagram"] for path in paths])),
            ("same knot", percent([path["same_knot"] for path in paths])),
            *path_medians(paths),
        ]
        for (supports, method), paths in path_groups(results.paths).items()
    ]
    return Section(
        "Cable paths",
        (
            table_of(
                rows,
                "Paths of the relaxation and of the program on LCF's set and on the smallest open "
                "one: shares of paths, then medians [grid steps] where there is something to "
                'measure. "/ taut" is the length over the taut string\'s; same knot: the same '
                "Alexander polynomial.",
            ),
        ),
    )
