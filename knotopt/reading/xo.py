"""Grids with X and O: letters in a table, two permutations, pyarcknot's numbers.

The knot runs along each column from X to O and along each row from O to X, and columns pass over
rows, as in grid homology (Ozsvath, Stipsicz, Szabo, "Grid Homology for Knots and Links", section
3.1), Gridlink, GridPyM and pyarcknot. They write the marks down differently:

- Gridlink's save file and grid homology, `X = [...]`, `O = [...]`: the row of each column's mark,
  from the bottom (its `get_XOlists`; https://github.com/3-manifolds/gridlink).
- GridPyM, `[[...], [...]]`: the column of each row's X and O, from the bottom (its `draw_grid`;
  arXiv:2210.07399).
- pyarcknot's matrix: 1 for X, 2 for O, 3 where a column crosses a row, the top row first.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from typing import Any

from knotopt.diagram.grid import GridDiagram
from knotopt.errors import GridError
from knotopt.reading.content import Content
from knotopt.reading.over import COLUMNS, with_over
from knotopt.reading.record import Asked, Reading

_LETTERS = {"x": "X", "o": "O", "\u00d7": "X"}
_BLANK = {"", ".", "-", "_", "*", "0", " ", "\u00b7"}
_NUMBERS = {1: "X", 2: "O"}
_NAMES = (("x", "o"), ("xlist", "olist"), ("xs", "os"), ("minus", "plus"))
PAIRS_OF_KEYS = frozenset(_NAMES)


def read(content: Content, asked: Asked) -> Reading | None:
    """The grid with those marks; columns pass over rows unless rows are asked for.

    Raises
    ------
    GridError
        Naming the line, row or column that is wrong.
    """
    found = _by_column(content) or _by_row(content) or _in_a_table(content)
    if found is None:
        return None
    diagram, note = found
    diagram, over = with_over(diagram, asked, COLUMNS)
    return Reading(diagram, (over, note), ambiguous=asked.over is None)


def _by_column(content: Content) -> tuple[GridDiagram, str] | None:
    """Two named permutations: rows of the marks by column."""
    if not isinstance(content.value, dict):
        return None
    named = {str(key).lower(): value for key, value in content.value.items()}
    names = next((pair for pair in _NAMES if named.keys() >= {*pair}), None)
    if names is None:
        return None
    first, second = (named[name] for name in names)
    xs, os, note = _permutations(first, second, *(name.upper() for name in names), of="column")
    return GridDiagram(tuple(xs), tuple(os)), f"rows of the marks by column{note}"


def _by_row(content: Content) -> tuple[GridDiagram, str] | None:
    """Two permutations without names: columns of the marks by row."""
    rows = content.rows
    if rows is None or content.header or len(rows) != 2 or len(rows[0]) != len(rows[1]):
        return None
    size = len(rows[0])
    if not all(isinstance(entry, int) and 0 <= entry <= size for row in rows for entry in row):
        return None
    if min(len({*row}) for row in rows) * 4 < max(3 * size, 8):  # far from permutations
        return None
    if size == 2 and rows[0] != rows[1][::-1]:
        return None
    xs, os, note = _permutations(rows[0], rows[1], "the first list", "the second list", of="row")
    minus, plus = [0] * size, [0] * size
    for row, (x, o) in enumerate(zip(xs, os, strict=True), 1):
        minus[x - 1], plus[o - 1] = row, row
    return GridDiagram(tuple(minus), tuple(plus)), f"columns of the marks by row{note}"


def _permutations(
    first: Any, second: Any, *names: str, of: str
) -> tuple[list[int], list[int], str]:
    """Both lists counted from 1, and a note on how they were counted."""
    lists = []
    for name, entries in zip(names, (first, second), strict=True):
        if not isinstance(entries, list) or not all(type(entry) is int for entry in entries):
            raise GridError(f"{name} is no list of whole numbers")
        lists.append(entries)
    xs, os = lists
    if len(xs) != len(os) or len(xs) < 2:
        raise GridError(f"{names[0]} has {len(xs)} numbers and {names[1]} has {len(os)}")
    base = min(*xs, *os, 1)
    for name, entries in zip(names, lists, strict=True):
        counts = Counter(entries)
        for place, entry in enumerate(entries, 1):
            if not base <= entry < base + len(xs):
                raise GridError(
                    f"{name} has {entry} for {of} {place}: expected {base} to {base + len(xs) - 1}"
                )
            if counts[entry] > 1:
                raise GridError(f"{name} has {entry} {counts[entry]} times, expected once")
    for place, (x, o) in enumerate(zip(xs, os, strict=True), 1):
        if x == o:
            raise GridError(f"{of} {place} has both marks in one place, {x}")
    if base == 0:
        return [x + 1 for x in xs], [o + 1 for o in os], ", counted from 0, upwards"
    return xs, os, ", counted upwards"


def _in_a_table(content: Content) -> tuple[GridDiagram, str] | None:
    """Letters or numbers in a table, the top row first."""
    lines = _lines(content)
    if lines is None:
        return None
    size = len(lines)
    rows: dict[str, list[int]] = {mark: [0] * size for mark in "XO"}  # of each column's mark
    for number, line in enumerate(lines, 1):
        for mark, found in rows.items():
            if line.count(mark) != 1:
                raise GridError(f"line {number} has {line.count(mark)} {mark}, expected one")
            column = line.index(mark) + 1
            if column > size:
                raise GridError(f"line {number} has {mark} in column {column}, of {size} lines")
            if found[column - 1]:
                first = size + 1 - found[column - 1]
                raise GridError(f"lines {first} and {number} have {mark} in column {column}")
            found[column - 1] = size + 1 - number
    return GridDiagram(tuple(rows["X"]), tuple(rows["O"])), "the first line is the top row"


def _lines(content: Content) -> list[list[str]] | None:
    """Rows of "X", "O" and ""; None if the content is no such table."""
    rows: Sequence[Sequence[Any]] | None = content.rows
    value = content.value
    if isinstance(value, list) and value and all(isinstance(line, str) for line in value):
        rows = value
    elif rows is not None and all(len(row) == 1 and isinstance(row[0], str) for row in rows):
        rows = [row[0] for row in rows]
    if rows is None or content.header or len(rows) < 2:
        return None
    lines = [[_mark(cell) for cell in row] for row in rows]
    if any(mark is None for line in lines for mark in line):
        return None
    words = any(isinstance(cell, str) and cell.strip().isalpha() for row in rows for cell in row)
    numbers = any(isinstance(cell, int) and cell > 0 for row in rows for cell in row)
    fits = sum({line.count("X"), line.count("O")} == {1} for line in lines)
    if words == numbers or 4 * fits < 2 * len(lines):
        return None
    if numbers and (4 * fits < 3 * len(lines) or not 2 < len(lines[0]) <= len(lines) + 1):
        return None
    return [[mark or "" for mark in line] for line in lines]


def _mark(cell: Any) -> str | None:
    """X, O, or "" for an empty cell and a crossing; None for anything else."""
    if isinstance(cell, str):
        cell = cell.strip().lower()
        return _LETTERS.get(cell, "" if cell in _BLANK else None)
    if type(cell) is int and 0 <= cell <= 4:
        return _NUMBERS.get(cell, "")
    return None
