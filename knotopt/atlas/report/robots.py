"""Section: robots by crossing number, on average and how they are distributed."""

from __future__ import annotations

from collections import Counter

import numpy as np

from knotopt.arrays import IntArray
from knotopt.atlas.report.results import Results
from knotopt.document.cells import mean
from knotopt.document.model import Block, Picture, Section, Table, table


def robots_section(results: Results) -> Section:
    """Means of every method, and how many knots need how many robots."""
    blocks: list[Block] = [
        means_table(results),
        *(distribution_table(results, column) for column in results.smallest),
        Picture(
            "robots",
            "Smallest number of robots (`opening`, turning-point) by crossing number: left, knots "
            "by their best outer cut; right, all outer cuts. Shades are shares of a column.",
            "how many knots, and cuts, of each crossing number need how many robots",
            is_wide=True,
        ),
    ]
    return Section("Robots by crossing number", tuple(blocks))


def means_table(results: Results) -> Table:
    """Mean robots of every method, over all cuts, and on each method's best."""
    heads = ["crossing number", "knots", "cuts", *results.methods.values()]
    rows = [
        [name, f"{len(knots):,}", f"{8 * len(knots):,}"]
        + [mean(results.cuts(column)[knots]) for column in results.methods]
        for name, knots in named_groups(results)
    ]
    count = len(results.knots)
    best = [mean(results.best(column)) for column in results.methods]
    rows.append(["all, best cut of each", f"{count:,}", f"{count:,}", *best])
    return table(
        heads,
        rows,
        "Mean number of robots, the two lifting ones included, over the eight outer cuts of every "
        "knot; in the last row each method has the outer cut that is best for it. LCF and layered "
        "stand for their sets whether or not these are open.",
    )


def distribution_table(results: Results, column: str) -> Table:
    """How many knots need how many robots on their best outer cut."""
    fewest = results.best(column)
    known = fewest[~np.isnan(fewest)]
    numbers = range(int(known.min()), int(known.max()) + 1) if known.size else range(0)
    rows = []
    for name, knots in named_groups(results):
        counts = Counter(fewest[knots].tolist())
        rows.append(
            [name, f"{len(knots):,}", *(f"{counts[n]:,}" if counts[n] else "" for n in numbers)]
        )
    return table(
        ["crossing number", "knots", *map(str, numbers)],
        rows,
        f"How many knots need how many robots on the best of their eight outer cuts "
        f"({results.methods[column]}).",
    )


def named_groups(results: Results) -> list[tuple[str, IntArray]]:
    """Indices of the knots of each crossing number, by what it is called, and of all."""
    numbers = np.array([knot.crossing_number for knot in results.knots], dtype=float)
    known, unknown = np.unique(numbers[~np.isnan(numbers)]), np.flatnonzero(np.isnan(numbers))
    groups = [(f"{number:.0f}", np.flatnonzero(numbers == number)) for number in known]
    groups += [("not in a table", unknown)] if unknown.size else []
    return [*groups, ("all", np.arange(len(numbers)))] if len(groups) > 1 else groups
