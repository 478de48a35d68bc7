"""Section: what the choice of the cut is worth."""

from __future__ import annotations

import numpy as np

from knotopt.atlas.report.results import Results
from knotopt.atlas.report.robots import named_groups
from knotopt.cable.cut import OUTER_CUTS
from knotopt.document.cells import largest, mean
from knotopt.document.model import Picture, Section, Table, table, table_of


def cuts_section(results: Results) -> Section:
    """Best against worst outer cut, and which cut is best how often."""
    return Section(
        "Best cut against worst",
        (
            spread_table(results),
            Picture(
                "cuts",
                "Robots on a knot's worst outer cut less those on its best: knots by that "
                "difference.",
                "how many knots lose how many robots by the worst cut",
            ),
            by_cut_table(results),
        ),
    )


def spread_table(results: Results) -> Table:
    """Means on the best, the middle and the worst cut by crossing number."""
    rows = []
    for column in ("lcf_robots", *results.smallest):
        for name, knots in named_groups(results):
            robots = results.cuts(column)[knots]
            spread = robots.max(axis=1) - robots.min(axis=1)
            rows.append(
                [
                    ("method", results.methods[column]),
                    ("crossing number", name),
                    ("knots", f"{len(knots):,}"),
                    ("best cut", mean(robots.min(axis=1))),
                    ("mean cut", mean(robots)),
                    ("worst cut", mean(robots.max(axis=1))),
                    ("worst less best", mean(spread)),
                    ("largest", largest(spread)),
                    ("knots with none", f"{int((spread == 0).sum()):,}"),
                ]
            )
    return table_of(
        rows,
        "Mean robots on the best, an average and the worst of a knot's eight outer cuts, and the "
        "difference between worst and best: mean, largest, and of how many knots it is zero.",
    )


def by_cut_table(results: Results) -> Table:
    """Mean robots on each of the eight cuts, and how often it is a best one."""
    robots = results.cuts("opening_robots")
    is_best = robots == robots.min(axis=1, keepdims=True)
    ends = {
        "mean robots": [mean(robots[:, k]) for k in range(len(OUTER_CUTS))],
        "knots where it is a best one": [f"{int(n):,}" for n in np.sum(is_best, axis=0)],
        "knots where it alone is": [
            f"{int(n):,}"
            for n in np.sum(is_best & (is_best.sum(axis=1, keepdims=True) == 1), axis=0)
        ],
    }
    return table(
        ("smallest open set", *OUTER_CUTS),
        [(name, *cells) for name, cells in ends.items()],
        f"The eight outer cuts against each other (`opening`, {len(robots):,} knots).",
    )
