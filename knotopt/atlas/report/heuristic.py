"""Section: the Loop Consistency Filter beside the smallest open sets: excess and deficit."""

from __future__ import annotations

from itertools import product

import numpy as np

from knotopt.arrays import BoolArray, FloatArray, IntArray
from knotopt.atlas.report.results import Results
from knotopt.atlas.report.robots import named_groups
from knotopt.document.cells import largest, mean, percent
from knotopt.document.model import Block, Picture, Section, Table, table_of
from knotopt.tables.methods import HEURISTICS, JUDGES


def heuristic_section(results: Results) -> Section:
    """How often LCF's set is open, what it wastes there, and where it has too few robots."""
    blocks: list[Block] = [
        "LCF promises neither an open set nor a smallest one. A cut falls into one of four "
        "classes: LCF's set is open and smallest; it is open with more robots than needed (the "
        "excess); it is not open although it has as many robots as a smallest open set, or more; "
        "it has fewer robots than any open set (the deficit), and cannot be open.",
        class_table(results),
        Picture(
            "heuristic",
            "LCF's robots less the smallest number of the same cut: left, cuts by that "
            "difference; right, the four classes by crossing number.",
            "how much LCF's number of robots differs from the smallest, and how often it is open",
            is_wide=True,
        ),
        variants_table(results),
        _on_best_cuts(results),
    ]
    return Section("LCF against the smallest open sets", tuple(blocks))


def difference(results: Results, column: str = "lcf_robots") -> FloatArray:
    """Robots of LCF less the smallest number of the same cut, turning-point, shape (K, 8)."""
    less: FloatArray = results.cuts(column) - results.cuts("opening_robots")
    return less


def classes(results: Results) -> dict[str, BoolArray]:
    """The four classes of cuts, each of shape (K, 8)."""
    less, is_open = difference(results), results.holds("lcf_open")
    return {
        "open, smallest": is_open & (less == 0),
        "open, with more": is_open & (less > 0),
        "not open, with enough": ~is_open & (less >= 0),
        "fewer than any open": less < 0,
    }


def class_table(results: Results) -> Table:
    """Shares of the four classes, excess and deficit by crossing number."""
    sorted_out, less = classes(results), difference(results)
    is_open, below = results.holds("lcf_open"), sorted_out["fewer than any open"]

    def cells(knots: IntArray) -> list[tuple[str, str]]:
        excess = less[knots][is_open[knots]]
        deficit = -less[knots][below[knots]]
        return [
            ("cuts", f"{8 * len(knots):,}"),
            ("open", percent(is_open[knots])),
            *((name, percent(held[knots])) for name, held in sorted_out.items()),
            ("excess, mean", mean(excess)),
            ("largest", largest(excess)),
            ("deficit, mean", mean(deficit)),
            ("largest", largest(deficit)),
        ]

    return table_of(
        [[("crossing number", name), *cells(knots)] for name, knots in named_groups(results)],
        "LCF's set on the outer cuts, by `opening` with threading by turning points. Excess: "
        "robots above the smallest open set of the cut, over the cuts where LCF's set is open. "
        "Deficit: robots below it, over the cuts of the last class.",
    )


def variants_table(results: Results) -> Table:
    """LCF and its layered set, in both threading modes."""
    rows = []
    for method, (judge, suffix) in product(HEURISTICS, JUDGES.items()):
        is_open = results.holds(f"{method.key}_open{suffix}")
        less = results.cuts(f"{method.key}_robots") - results.cuts(f"{judge.key}_robots")
        rows.append(
            [
                ("set, threading", f"{method.head}, {judge.threading}"),
                ("cuts", f"{is_open.size:,}"),
                ("open", percent(is_open)),
                ("open, smallest", percent(is_open & (less == 0))),
                ("excess, mean", mean(less[is_open])),
                ("largest", largest(less[is_open])),
                ("fewer than any open", percent(less < 0)),
                ("deficit, mean", mean(-less[less < 0])),
                ("largest", largest(-less[less < 0])),
            ]
        )
    return table_of(
        rows,
        "LCF and its layered variant, each judged in both threading modes against the smallest "
        "open set of the same cut and mode.",
    )


def _on_best_cuts(results: Results) -> str:
    """What remains when each method has the cut that is best for it."""
    lcf, is_open = results.cuts("lcf_robots"), results.holds("lcf_open")
    smallest = results.best("opening_robots")
    count = len(results.knots)
    chosen = lcf.argmin(axis=1)
    opens = is_open[np.arange(count), chosen]
    some = is_open.any(axis=1)
    best_open = np.where(is_open, lcf, np.inf).min(axis=1)
    excess = (best_open - smallest)[some]
    text = (
        f"On the outer cut where it has the fewest robots (ties: the first), LCF's set is open for "
        f"{int(opens.sum()):,} of {count:,} knots. "
    )
    if not some.any():
        return text + "It is open on no outer cut of any knot."
    return text + (
        f"On some outer cut it is open for {int(some.sum()):,}; the smallest of those sets "
        f"has {mean(excess)} robots more than the knot needs on its best outer cut (mean; at most "
        f"{largest(excess)}), and none more for {int((excess == 0).sum()):,}."
    )
