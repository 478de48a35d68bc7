"""Section: what the knots themselves need, and what is known to fly, whatever the diagram."""

from __future__ import annotations

from collections import Counter

from knotopt.atlas.report.results import Results
from knotopt.document.model import Section, table
from knotopt.tables import of_the_knot
from knotopt.tables.methods import LCF, LOOPS, SAFE


def of_the_knots_section(results: Results) -> Section | None:
    """How many knots need how many robots, and the knots that have been flown; None without names.

    A knot is known by its name: of grids from files nothing is said.
    """
    named = [
        (place, knot, of_the_knot.cells([knot.knot]))
        for place, knot in enumerate(results.knots)
        if knot.crossing_number is not None
    ]
    if not named:
        return None
    needed = Counter(cells["needed"] for _, _, cells in named)
    counts = ", ".join(f"{count:,} need {robots}" for robots, count in sorted(needed.items()))
    compared = [
        method for method in (LOOPS, SAFE, LCF) if f"{method.key}_robots" in results.methods
    ]
    best = [results.best(f"{method.key}_robots") for method in compared]
    rows = [
        [knot.knot, *of_the_knot.display(cells), *(f"{fewest[place]:.0f}" for fewest in best)]
        for place, knot, cells in named
        if cells["flown"] is not None
    ]
    shown = table(
        ("knot", *of_the_knot.HEADS, *(method.head for method in compared)),
        rows,
        f"Of {len(named):,} knots with a name, {counts}; those that have been flown. "
        f"{of_the_knot.NOTE} Beside them stand the fewest of the diagrams here, each on its best "
        "outer cut.",
        "l" + "r" * (len(of_the_knot.HEADS) + len(compared)),
    )
    return Section("What the knots need, and what flies", (shown,))
