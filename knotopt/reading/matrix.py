"""A grid as its matrix of -1, 0 and +1, row N in the first line."""

from __future__ import annotations

import math
from typing import Any

from knotopt.diagram.grid import GridDiagram
from knotopt.reading.content import Content
from knotopt.reading.over import COLUMNS, with_over
from knotopt.reading.record import Asked, Reading


def read(content: Content, asked: Asked) -> Reading | None:
    """The grid diagram with that matrix, in any dialect of lists and tables; empty cells are zeros.

    Raises
    ------
    GridError
        Naming the row, column or entry that is wrong.
    """
    rows = content.rows
    if rows is None:
        return None
    rows = [[0 if _is_empty(entry) else entry for entry in row] for row in rows]
    if not (content.key == "matrix" or _is_matrix(rows)):
        return None
    diagram, over = with_over(GridDiagram.from_matrix(rows), asked, COLUMNS)
    ambiguous = asked.over is None and not content.key
    return Reading(diagram, (over, "the first line is the top row"), ambiguous=ambiguous)


def _is_empty(entry: Any) -> bool:
    """Whether it is an empty cell: of a table, of JSON, or of an array, where it is no number."""
    return entry is None or entry == "" or (isinstance(entry, float) and math.isnan(entry))


def _is_matrix(rows: list[list[Any]]) -> bool:
    """Whether most entries are 0, 1 and -1, in about as many columns as rows."""
    entries = [entry for row in rows for entry in row]
    fits = sum(entry in (-1, 0, 1) for entry in entries)
    is_square = len(rows[0]) >= 2 and abs(len(rows) - len(rows[0])) <= 2
    return is_square and fits * 10 >= 8 * len(entries) and -1 in entries
