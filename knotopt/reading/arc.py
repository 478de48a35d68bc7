"""Arc presentations: for each row of a grid, from the lowest, the two columns that it joins.

KnotTheory's `ArcPresentation[{a1, b1}, ...]` (https://katlas.org/wiki/Arc_Presentations: "the
lowest horizontal arc connects ...", "the vertical arcs are always above"); the `arc_notation` of
KnotInfo and LinkInfo (https://linkinfo.math.indiana.edu/descriptions/arc_notation.html: "the
vertical arcs overcross the horizontal arcs", "beginning with the horizontal arc at y=1"); and
pyarcknot's row of numbers (https://github.com/inigorrix/pyarcknot: its `xo_arc` fills the last line
of the matrix first, `draw_arc` breaks the rows).
"""

from __future__ import annotations

import re
from collections import Counter

from knotopt.diagram.grid import GridDiagram
from knotopt.errors import GridError
from knotopt.reading.content import Content
from knotopt.reading.marks import are_pairs
from knotopt.reading.over import COLUMNS, with_over
from knotopt.reading.record import Asked, Reading

_FEWEST_IN_A_ROW = 5
"""Smaller presentations are of the unknot; a row of as few numbers is rather a braid word."""


def read(content: Content, asked: Asked) -> Reading | None:
    """The grid of an arc presentation; columns pass over rows unless rows are asked for.

    Raises
    ------
    GridError
        Naming the pair or column that is wrong.
    """
    pairs = _pairs(content)
    if pairs is None:
        return None
    columns = [column for pair in pairs for column in pair]
    notes = ["pairs are rows, counted upwards"]
    if min(columns, default=1) == 0:
        pairs = [[column + 1 for column in pair] for pair in pairs]
        notes.append("columns are counted from 0")
    diagram, over = with_over(_grid(pairs), asked, COLUMNS)
    ambiguous = asked.over is None and not _is_named(content)
    return Reading(diagram, (over, *notes), ambiguous=ambiguous)


def _pairs(content: Content) -> list[list[int]] | None:
    named = _is_named(content)
    rows = content.rows
    if rows is None:
        numbers = content.numbers
        if numbers is None or not (named or _is_in_a_row(content.text, numbers)):
            return None
        if len(numbers) % 2:
            raise GridError(f"{len(numbers)} numbers are no pairs of columns")
        return [numbers[k : k + 2] for k in range(0, len(numbers), 2)]
    if not named and are_pairs(rows) != "arc":
        return None
    for number, row in enumerate(rows, 1):
        if len(row) != 2 or not all(isinstance(column, int) for column in row):
            raise GridError(f"pair {number} is {row}, expected two columns")
    return rows


def _is_named(content: Content) -> bool:
    return content.key.startswith("arc") or "ArcPresentation" in content.heads


def _is_in_a_row(text: str, numbers: list[int]) -> bool:
    """Whether these are pyarcknot's: columns 1 to N twice each, with nothing but blanks between."""
    return (
        len(numbers) >= 2 * _FEWEST_IN_A_ROW
        and re.fullmatch(r"[\d\s]+", text) is not None
        and Counter(numbers) == Counter(dict.fromkeys(range(1, len(numbers) // 2 + 1), 2))
    )


def _grid(pairs: list[list[int]]) -> GridDiagram:
    size = len(pairs)
    for row, (first, second) in enumerate(pairs, 1):
        if first == second:
            raise GridError(f"pair {row} is [{first}, {second}]: a row joins two different columns")
        for column in (first, second):
            if not 1 <= column <= size:
                raise GridError(
                    f"pair {row} is [{first}, {second}], but {size} pairs have columns 1 to {size}"
                )
    return GridDiagram.from_marks(
        [(column, row) for row, pair in enumerate(pairs, 1) for column in pair]
    )
