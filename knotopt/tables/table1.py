"""Table I of the paper, recomputed: robots before and after reduction by LCF, and the fewest.

Beside LCF's count stand the provably smallest ones of each formulation, on LCF's cut and on the
best one.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import asdict, dataclass, fields

from formulations.backends import DEFAULT
from knotopt.cable.staircase import find_staircases
from knotopt.catalogue.table1_grids import Table1Grid, table1_grids
from knotopt.document.cells import yes
from knotopt.document.columns import Column, Row, names
from knotopt.document.formats import Tabulation
from knotopt.document.model import table, tables
from knotopt.path import measures
from knotopt.path.measures import PathMeasures, both_methods, measure
from knotopt.path.result import PathResult
from knotopt.supports.lcf import LcfResult, best_cut
from knotopt.supports.minimal import MinimalSupports, minimal_supports
from knotopt.supports.search import best_supports
from knotopt.tables import of_the_knot
from knotopt.tables.methods import LCF, OPENING, USUAL_PROGRAMS, columns_of

Placed = tuple[tuple[int, int, int], ...]
"""[index on the path (1-based), column, row] of each support."""

NOTE = """\
The paper shows its grids as pictures only, so which knots its rows show is not known: the knots \
and grids here are ours, named up to mirror image, and agree with the paper in crossings, in \
robots before and in robots after reduction. Table I does not single \
out one reading of LCF. When the reading used here was fixed, 5,508 sets of rules were tried: 176 \
of them give 5, 5, 5 on 3_1, 4_1 and 5_1, and each of those 176 gives all six rows on some grid. \
LCF gives no guarantee: its set need neither keep every threaded region open nor be the smallest \
that does; "open" says whether it does (formulation opening, r = 0.5). Under opening, span, safe \
(span with a support on every loop of the cable, too) and loops (only that) stand the smallest \
numbers of robots on LCF's cut and, in brackets, on the best of all crossing-free cuts; they are \
proven if no smaller set exists under that definition. Loops is the fewest robots that lay this \
diagram with straight spans, no bound for flights of the knot. """
NOTE += of_the_knot.NOTE
"""What the table does and does not show; printed wherever the table is."""

COLUMNS = (
    Column("row", str, "of the paper's table"),
    Column("knot", str, "name"),
    Column("grid_size", int, "N"),
    Column("crossings", int, "of the diagram"),
    Column("cut", str, "outer cut where LCF has the fewest robots, the first of them"),
    Column("robots_before", int, "robots at all 2N turning points"),
    Column("robots_after", int, "robots of LCF's set"),
    Column("robots_after_paper", int, "robots after reduction, as the paper has them"),
    *of_the_knot.COLUMNS,
    Column("reduction_percent", float, "robots that LCF saves [percent]"),
    Column("longest_staircase", int, "crossings in the longest diagonal run (Fig. 7)"),
    Column("supports", Placed, "LCF's: index on the path (1-based), column, row of each"),
    Column("openness", float, "r of every formulation [grid steps]"),
    *LCF.columns("open"),
    *columns_of(USUAL_PROGRAMS, "same_cut", "robots", "cut", "supports"),
    Column("solver", str, "of the smallest sets"),
    Column("proven", bool, "whether each of them is, on every cut"),
    Column("grid", tuple[tuple[int, int], ...], "marks of the grid diagram: column, row of each"),
)
"""Columns of `table1.csv` and keys of the JSON. Supports of a smallest set belong to its own cut,
and each of them is [index on the path (1-based), column, row]."""

HEADS = (
    *("row", "knot", *of_the_knot.HEADS, "paper", "LCF", "open", "before", "cut"),
    *(method.head for method in USUAL_PROGRAMS),
    "proven",
)


@dataclass(frozen=True)
class Table1Result:
    """A row, and what it summarises: LCF on its best outer cut, the smallest sets on theirs.

    Attributes
    ----------
    cells : Row
        Of `COLUMNS`.
    lcf : LcfResult
    smallest : tuple of MinimalSupports
        By `USUAL_PROGRAMS`, in that order.
    relaxed, optimised : PathResult
        The paths of LCF's set.
    """

    cells: Row
    lcf: LcfResult
    smallest: tuple[MinimalSupports, ...]
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
    >>> rows = [result.cells for result in compute_table1()]
    >>> [(row["robots_after"], row["opening_robots"]) for row in rows]
    [(5, 5), (5, 5), (5, 6), (7, 12), (8, 6), (6, 5)]
    """
    return (_result(grid) for grid in chosen_grids(all_grids=all_grids))


def chosen_grids(*, all_grids: bool = False) -> list[Table1Grid]:
    """The preferred grid of every row, or all that reproduce one."""
    return [grid for grid in table1_grids() if grid.preferred or all_grids]


def tabulated(results: Sequence[Table1Result]) -> Tabulation:
    """The table, and every cell of it."""
    rows = [_display(result.cells) for result in results]
    document = tables("Table I, recomputed", table(HEADS, rows, NOTE, "l" * len(HEADS)))
    return Tabulation(document, names(COLUMNS), tuple(result.cells for result in results))


def tabulated_paths(results: Sequence[Table1Result]) -> Tabulation:
    """The measures of the paths of every row."""
    heads = ("row", "knot", *measures.HEADS)
    paths = [
        ((result.cells["row"], result.cells["knot"]), path)
        for result in results
        for path in result.paths
    ]
    rows = [(*place, *measures.display(path)) for place, path in paths]
    shown = table(heads, rows, measures.NOTE, "l" * len(heads))
    return Tabulation(
        tables("Table I: paths on LCF's supports", shown),
        ("row", "knot", *(field.name for field in fields(PathMeasures))),
        tuple({"row": row, "knot": knot, **asdict(path)} for (row, knot), path in paths),
    )


def _display(row: Row) -> list[str]:
    """The cells of a row under `HEADS`."""
    return [
        *(row["row"], row["knot"], *of_the_knot.display(row)),
        *(str(row[name]) for name in ("robots_after_paper", "robots_after")),
        *(yes(row["lcf_open"]), str(row["robots_before"]), row["cut"]),
        *(f"{row[f'{m.key}_same_cut']} ({row[f'{m.key}_robots']})" for m in USUAL_PROGRAMS),
        yes(row["proven"]),
    ]


def _result(grid: Table1Grid) -> Table1Result:
    result = best_cut(grid.diagram)
    cable = result.cable
    longest = max((len(run) for run in find_staircases(cable, min_length=1)), default=0)
    openness = OPENING.requirements().openness
    smallest, proven = [], []
    cells: Row = {}
    for method in USUAL_PROGRAMS:
        search = best_supports(cable.diagram, method.requirements())
        same = minimal_supports(cable, method.requirements())
        best = search.best
        smallest.append(best)
        proven += [search.is_proven, same.is_proven]
        cells |= method.cells(
            same_cut=same.robots,
            robots=best.robots,
            cut=str(best.cable.cut),
            supports=best.placed_supports,
        )
    cells |= {
        "row": grid.row,
        "knot": grid.knot,
        "grid_size": cable.diagram.size,
        "crossings": len(cable.crossings),
        "cut": str(cable.cut),
        "robots_before": result.baseline,
        "robots_after": result.robots,
        "robots_after_paper": grid.robots_after_paper,
        **of_the_knot.cells([grid.knot]),
        "reduction_percent": result.reduction_percent,
        "longest_staircase": longest,
        "supports": result.placed_supports,
        "openness": float(openness),
        **LCF.cells(open=OPENING.is_met(cable, result.supports, openness)),
        "solver": DEFAULT,
        "proven": all(proven),
        "grid": grid.marks,
    }
    in_order = {name: cells[name] for name in names(COLUMNS)}
    return Table1Result(in_order, result, tuple(smallest), *both_methods(result))
