"""Table I of the paper, recomputed: robots before and after reduction by LCF."""

from __future__ import annotations

import csv
import io
import json
from dataclasses import dataclass, fields
from typing import Any

from knotopt.cable.staircase import find_staircases
from knotopt.catalogue.table1_grids import Table1Grid, table1_grids
from knotopt.diagram.grid import Mark
from knotopt.supports.lcf import LcfResult, best_cut
from knotopt.supports.support_set import format_supports

NOTE = """\
The paper shows its grids as pictures only, so which knots its rows show is not known: the knots \
and grids here are ours, named up to mirror image, and agree with the paper in crossings, in \
robots before and in robots after reduction. Table I does not single \
out one reading of LCF. When the reading used here was fixed, 5,508 sets of rules were tried: 176 \
of them give 5, 5, 5 on 3_1, 4_1 and 5_1, and each of those 176 gives all six rows on some grid. \
LCF gives no guarantee: its set need neither keep every threaded region open nor be the smallest \
that does."""
"""What the table does and does not show; printed wherever the table is."""


HEADS = ("row", "knot", "cut", "before", "after", "paper", "reduction", "stairs", "supports")


@dataclass(frozen=True)
class Table1Row:
    """One row; the fields are the columns of the CSV and the keys of the JSON.

    `supports` holds [index on the path (1-based), column, row] of each support robot;
    `longest_staircase` is the number of crossings in the longest diagonal run (Fig. 7);
    `grid` holds the marks [column, row] of the grid diagram.
    """

    row: str
    knot: str
    grid_size: int
    crossings: int
    cut: str
    robots_before: int
    robots_after: int
    robots_after_paper: int
    reduction_percent: float
    longest_staircase: int
    supports: tuple[tuple[int, int, int], ...]
    grid: tuple[Mark, ...]


def compute_table1(*, all_grids: bool = False) -> list[tuple[Table1Row, LcfResult]]:
    """Every row of Table I with LCF's result on its best outer cut.

    Parameters
    ----------
    all_grids : bool
        Also the grids that reproduce a row but are not the preferred one.

    Examples
    --------
    >>> [row.robots_after for row, _ in compute_table1()]
    [5, 5, 5, 7, 8, 6]
    """
    grids = [grid for grid in table1_grids() if grid.preferred or all_grids]
    return [(_row(grid, result), result) for grid in grids for result in [best_cut(grid.diagram)]]


def display(row: Table1Row) -> list[str]:
    """The cells of a row under `HEADS`, for people."""
    return [
        row.row,
        row.knot,
        row.cut,
        str(row.robots_before),
        str(row.robots_after),
        str(row.robots_after_paper),
        f"{row.reduction_percent:.1f} %",
        str(row.longest_staircase),
        format_supports(row.supports),
    ]


def table1_csv(rows: list[Table1Row]) -> str:
    """The rows as CSV; `supports` and `grid` are JSON lists in their cells."""
    buffer = io.StringIO()
    names = [field.name for field in fields(Table1Row)]
    writer = csv.DictWriter(buffer, names, lineterminator="\n")
    writer.writeheader()
    for row in rows:
        writer.writerow(_cells(row))
    return buffer.getvalue()


def table1_markdown(rows: list[Table1Row]) -> str:
    """The rows as a Markdown table with the note."""
    lines = ["| " + " | ".join(HEADS) + " |", "|---" * len(HEADS) + "|"]
    lines += ["| " + " | ".join(display(row)) + " |" for row in rows]
    return "\n".join(["# Table I, recomputed", "", *lines, "", NOTE, ""])


def _row(grid: Table1Grid, result: LcfResult) -> Table1Row:
    cable = result.cable
    longest = max((len(run) for run in find_staircases(cable, min_length=1)), default=0)
    return Table1Row(
        row=grid.row,
        knot=grid.knot,
        grid_size=cable.diagram.size,
        crossings=len(cable.crossings),
        cut=str(cable.cut),
        robots_before=result.baseline,
        robots_after=result.robots,
        robots_after_paper=grid.robots_after_paper,
        reduction_percent=result.reduction_percent,
        longest_staircase=longest,
        supports=result.placed_supports,
        grid=grid.marks,
    )


def _cells(row: Table1Row) -> dict[str, Any]:
    cells = {field.name: getattr(row, field.name) for field in fields(Table1Row)}
    return {**cells, "supports": json.dumps(row.supports), "grid": json.dumps(row.grid)}
