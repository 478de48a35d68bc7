"""A grid by its marks: two in each column and each row, `[column, row]`, rows counted upwards."""

from __future__ import annotations

from typing import Any

from knotopt.catalogue.knots import shipped_knots
from knotopt.diagram.grid import GridDiagram
from knotopt.reading.content import Content
from knotopt.reading.over import COLUMNS, ROWS, with_over
from knotopt.reading.record import Asked, Reading

_COLUMN = {"column", "col", "columns", "x", "c"}
_ROW = {"row", "rows", "y", "r"}


def read(content: Content, asked: Asked) -> Reading | None:
    """The grid diagram with those marks; columns pass over rows unless rows are asked for.

    A header `row,column` exchanges the two; marks counted from 0 are counted from 1.

    Raises
    ------
    GridError
        Naming the mark, row or column that is wrong.
    """
    marks, notes = _marks(content)
    if marks is None:
        return None
    diagram, over = with_over(GridDiagram.from_marks(marks), asked, COLUMNS)
    if asked.over is None and not content.key and (name := _knotinfo_name(marks)):
        over += f"; KnotInfo's marks of {name} are these, and there rows do: --over rows"
    own = content.key == "grid" or content.header == ("column", "row")
    ambiguous = asked.over is None and not own
    return Reading(_oriented(diagram), (over, *notes), ambiguous=ambiguous)


def read_grid_notation(content: Content, asked: Asked) -> Reading | None:
    """The grid of KnotInfo's `grid_notation`, where rows pass over columns.

    Measured on all its knots whose signature is not 0: rows over columns, counted upwards, is the
    chirality of KnotInfo's own PD code. Source: https://knotinfo.org/descriptions/grid_notation.html

    Raises
    ------
    GridError
        Naming the mark, row or column that is wrong.
    """
    marks, notes = _marks(content)
    if marks is None:
        return None
    diagram, over = with_over(GridDiagram.from_marks(marks), asked, ROWS, "KnotInfo's way")
    return Reading(_oriented(diagram), (over, *notes))


def _marks(content: Content) -> tuple[list[list[int]] | None, tuple[str, ...]]:
    """Marks counted from 1, and notes on how they were counted; None if there are none."""
    rows = content.rows
    named = content.key in {"grid", "grid_notation"}
    if rows is None or not (named or are_pairs(rows) == "marks"):
        return None, ()
    notes = ["rows are counted upwards"]
    first, *rest = content.header or ("",)
    if first in _ROW and rest and rest[0] in _COLUMN:
        rows = [row[::-1] for row in rows]
        notes.append("each line is row, column")
    entries = [entry for row in rows for entry in row if isinstance(entry, int)]
    if entries and min(entries) == 0 and all(len(row) == 2 for row in rows):
        rows = [[entry + 1 if isinstance(entry, int) else entry for entry in row] for row in rows]
        notes.append("counted from 0")
    return rows, tuple(notes)


def are_pairs(rows: list[list[Any]]) -> str:
    """Whether rows of two numbers are the "marks" of a grid or an "arc" presentation; "" if none.

    A grid of size N has 2 N marks, an arc presentation N pairs, of the same numbers.
    """
    if len(rows) < 2 or sum(len(row) == 2 for row in rows) * 10 < 8 * len(rows):
        return ""
    entries = [entry for row in rows for entry in row if isinstance(entry, int)]
    if not entries or len(entries) * 10 < 16 * len(rows) or -1 in entries:
        return ""
    return "marks" if len(rows) * 4 >= 5 * len({*entries}) else "arc"


def _oriented(diagram: GridDiagram) -> GridDiagram:
    return GridDiagram.from_marks(diagram.marks)


def _knotinfo_name(marks: list[list[int]]) -> str | None:
    """The knot up to 10 crossings whose marks in KnotInfo are these."""
    size = len(marks) // 2
    reversed_rows = tuple(sorted((column, size + 1 - row) for column, row in marks))
    return next((k.name for k in shipped_knots().values() if k.marks == reversed_rows), None)
