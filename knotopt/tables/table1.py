"""Table I of the paper, recomputed: robots before and after reduction by LCF, and the fewest.

Beside LCF's count stand the provably smallest ones of the formulations `opening` and `span`, on
LCF's cut and on the best one.
"""

from __future__ import annotations

import csv
import io
import json
from collections.abc import Iterator
from dataclasses import asdict, dataclass, fields
from typing import Any

from formulations.backends import DEFAULT
from knotopt.cable.cable import Cable
from knotopt.cable.staircase import find_staircases
from knotopt.catalogue.table1_grids import Table1Grid, table1_grids
from knotopt.diagram.grid import Mark
from knotopt.path import measures
from knotopt.path.measures import PathMeasures, both_methods, measure
from knotopt.path.result import PathResult
from knotopt.supports.lcf import LcfResult, best_cut
from knotopt.supports.minimal import MinimalSupports, minimal_supports
from knotopt.supports.requirements import Requirements
from knotopt.supports.search import best_supports

Support = tuple[int, int, int]

NOTE = """\
The paper shows its grids as pictures only, so which knots its rows show is not known: the knots \
and grids here are ours, named up to mirror image, and agree with the paper in crossings, in \
robots before and in robots after reduction. Table I does not single \
out one reading of LCF. When the reading used here was fixed, 5,508 sets of rules were tried: 176 \
of them give 5, 5, 5 on 3_1, 4_1 and 5_1, and each of those 176 gives all six rows on some grid. \
LCF gives no guarantee: its set need neither keep every threaded region open nor be the smallest \
that does; "open" says whether it does (formulation opening, r = 0.5). Under opening and span \
stand the smallest numbers of robots on LCF's cut and, in brackets, on the best of all \
crossing-free cuts; they are proven if no smaller set exists under that definition."""
"""What the table does and does not show; printed wherever the table is."""


HEADS = (
    "row",
    "knot",
    "cut",
    "before",
    "LCF",
    "paper",
    "open",
    "opening",
    "span",
    "proven",
)


@dataclass(frozen=True)
class Table1Row:
    """One row; the fields are the columns of the CSV and the keys of the JSON.

    `supports` holds [index on the path (1-based), column, row] of each support robot of LCF,
    `opening_supports` and `span_supports` those of the smallest sets, which belong to their own
    best cuts; `*_same_cut` are the smallest numbers on LCF's cut;
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
    supports: tuple[Support, ...]
    openness: float
    lcf_open: bool
    opening_same_cut: int
    opening_robots: int
    opening_cut: str
    opening_supports: tuple[Support, ...]
    span_same_cut: int
    span_robots: int
    span_cut: str
    span_supports: tuple[Support, ...]
    solver: str
    proven: bool
    grid: tuple[Mark, ...]


@dataclass(frozen=True)
class Table1Result:
    """A row, and what it summarises: LCF on its best outer cut, the smallest sets on theirs.

    `relaxed` and `optimised` are the paths of LCF's set.
    """

    row: Table1Row
    lcf: LcfResult
    opening: MinimalSupports
    span: MinimalSupports
    relaxed: PathResult
    optimised: PathResult

    @property
    def paths(self) -> list[PathMeasures]:
        """The measures of both paths."""
        return [measure(path, "lcf") for path in (self.relaxed, self.optimised)]


def compute_table1(*, all_grids: bool = False) -> Iterator[Table1Result]:
    """Every row of Table I, one after the other.

    Parameters
    ----------
    all_grids : bool
        Also the grids that reproduce a row but are not the preferred one.

    Examples
    --------
    >>> [(each.row.robots_after, each.row.opening_robots) for each in compute_table1()]
    [(5, 5), (5, 5), (5, 6), (7, 12), (8, 6), (6, 5)]
    """
    return (_result(grid) for grid in chosen_grids(all_grids=all_grids))


def chosen_grids(*, all_grids: bool = False) -> list[Table1Grid]:
    """The preferred grid of every row, or all that reproduce one."""
    return [grid for grid in table1_grids() if grid.preferred or all_grids]


def display(row: Table1Row) -> list[str]:
    """The cells of a row under `HEADS`, for people."""
    return [
        row.row,
        row.knot,
        row.cut,
        str(row.robots_before),
        str(row.robots_after),
        str(row.robots_after_paper),
        "yes" if row.lcf_open else "no",
        f"{row.opening_same_cut} ({row.opening_robots})",
        f"{row.span_same_cut} ({row.span_robots})",
        "yes" if row.proven else "no",
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


PATH_HEADS = ("row", "knot", *measures.HEADS)


def display_paths(results: list[Table1Result]) -> list[list[str]]:
    """The cells under `PATH_HEADS` of the paths of every row."""
    return [
        [result.row.row, result.row.knot, *measures.display(path)]
        for result in results
        for path in result.paths
    ]


def paths_csv(results: list[Table1Result]) -> str:
    """The measures of every path as CSV."""
    buffer = io.StringIO()
    names = ["row", "knot", *(field.name for field in fields(PathMeasures))]
    writer = csv.DictWriter(buffer, names, lineterminator="\n")
    writer.writeheader()
    for result in results:
        for path in result.paths:
            writer.writerow({"row": result.row.row, "knot": result.row.knot, **asdict(path)})
    return buffer.getvalue()


def paths_markdown(results: list[Table1Result]) -> str:
    """The displayed measures as a Markdown table with the note."""
    lines = ["| " + " | ".join(PATH_HEADS) + " |", "|---" * len(PATH_HEADS) + "|"]
    lines += ["| " + " | ".join(cells) + " |" for cells in display_paths(results)]
    return "\n".join(["# Table I: paths on LCF's supports", "", *lines, "", measures.NOTE, ""])


def _result(grid: Table1Grid) -> Table1Result:
    result = best_cut(grid.diagram)
    cable = result.cable
    longest = max((len(run) for run in find_staircases(cable, min_length=1)), default=0)
    opening, opening_same, opening_proven = _smallest(cable, Requirements("opening"))
    span, span_same, span_proven = _smallest(cable, Requirements("span"))
    row = Table1Row(
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
        openness=float(opening.requirements.openness),
        lcf_open=opening_same.lcf_report.is_open,
        opening_same_cut=opening_same.robots,
        opening_robots=opening.robots,
        opening_cut=str(opening.cable.cut),
        opening_supports=opening.placed_supports,
        span_same_cut=span_same.robots,
        span_robots=span.robots,
        span_cut=str(span.cable.cut),
        span_supports=span.placed_supports,
        solver=DEFAULT,
        proven=opening_proven and span_proven,
        grid=grid.marks,
    )
    return Table1Result(row, result, opening, span, *both_methods(result))


def _smallest(
    cable: Cable, requirements: Requirements
) -> tuple[MinimalSupports, MinimalSupports, bool]:
    """The smallest sets on the best cut and on the cable's own, and whether both are proven."""
    search = best_supports(cable.diagram, requirements)
    same = minimal_supports(cable, requirements)
    return search.best, same, search.is_proven and same.is_proven


def _cells(row: Table1Row) -> dict[str, Any]:
    cells = {field.name: getattr(row, field.name) for field in fields(Table1Row)}
    return {
        name: json.dumps(value) if isinstance(value, tuple) else value
        for name, value in cells.items()
    }
