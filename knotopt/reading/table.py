"""Tables of numbers as spreadsheets, numpy, pandas and people write them.

Cells by comma, semicolon, tab, bar or blanks; a header; an index before each row; lines of remarks;
a separator at each line's end; numbers such as 1.0 or, between semicolons, 1,0.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from knotopt.reading.source import REMARK

Cell = int | float | str

_NUMBER = re.compile(r"[+-]?(\d{1,30}\.?\d{0,30}|\.\d{1,30})([eE][+-]?\d{1,3})?")
_SEPARATORS = (";", "\t", "|", ",")


@dataclass(frozen=True)
class Table:
    """Rows of cells.

    Attributes
    ----------
    header : tuple of str
        Names of the columns, in lower case; empty if there are none.
    rows : tuple of tuple
        Cells: whole numbers as int, others as float, all else as text; "" where nothing stands.
    lines : tuple of int
        Of each row: its line in the text, from 1.
    """

    header: tuple[str, ...]
    rows: tuple[tuple[Cell, ...], ...]
    lines: tuple[int, ...]


def parse_table(text: str) -> Table | None:
    """The table that a text of two lines or more is; None if it has fewer.

    Examples
    --------
    >>> parse_table("# a trefoil's marks\\nx,y\\n1,4\\n1,1\\n")
    Table(header=('x', 'y'), rows=((1, 4), (1, 1)), lines=(3, 4))
    >>> parse_table(",0,1\\n0,-1.0,1.0\\n1,1.0,-1.0\\n").rows
    ((-1, 1), (1, -1))
    """
    lines = [
        (number, line)
        for number, line in enumerate(text.splitlines(), 1)
        if line.strip() and not REMARK.match(line)
    ]
    if len(lines) < 2:
        return None
    separator = next((s for s in _SEPARATORS if all(s in line for _, line in lines)), None)
    cells = [[_cell(cell, separator) for cell in _split(line, separator)] for _, line in lines]
    numbers = [number for number, _ in lines]
    _drop_ends(cells)
    if _has_index(cells):
        header, cells = cells[0], [row[1:] for row in cells[1:]]
        names: Sequence[Cell] = header[1:] if len(header) > len(cells[0]) else header
        return _table(names, cells, numbers[1:])
    if _is_header(cells):
        return _table(cells[0], cells[1:], numbers[1:])
    return _table((), cells, numbers)


def _table(header: Sequence[Cell], cells: Sequence[Sequence[Cell]], lines: Sequence[int]) -> Table:
    # Names that count the columns, as pandas gives them, say nothing.
    names = tuple(str(name).strip().lower() for name in header)
    if all(isinstance(name, int) for name in header):
        names = ()
    return Table(names, tuple(map(tuple, cells)), tuple(lines))


def _split(line: str, separator: str | None) -> list[str]:
    if separator is None:
        return re.split(r"[\s,]+", line.strip(" ,"))
    return line.split(separator)


def _cell(cell: str, separator: str | None) -> Cell:
    cell = cell.strip().strip("\"'").strip()
    number = cell.replace(",", ".") if separator == ";" else cell
    if not _NUMBER.fullmatch(number):
        return cell
    if re.fullmatch(r"[+-]?\d+", number):
        return int(number)
    value = float(number)
    return int(value) if value.is_integer() and abs(value) < 2**53 else value


def _drop_ends(cells: list[list[Cell]]) -> None:
    """Drop a last cell that is empty in every row: the lines end in a separator."""
    while all(row and row[-1] == "" for row in cells) and any(len(row) > 1 for row in cells):
        if len({len(row) for row in cells}) > 1:
            break
        for row in cells:
            row.pop()


def _has_index(cells: Sequence[Sequence[Cell]]) -> bool:
    """Whether a header and an index stand around the table, as pandas and spreadsheets have them.

    The index counts the rows, or has words where the other cells have none.
    """
    header, *rows = cells
    counted = [*range(len(rows))]
    firsts = [row[0] for row in rows]
    from_one = [k + 1 for k in counted]
    if firsts not in (counted, from_one, from_one[::-1]):
        others = [cell for row in rows for cell in row[1:]]
        return header[0] == "" and all(map(_is_word, firsts)) and not any(map(_is_word, others))
    is_named = str(header[0]).lower() in ("", "index", "unnamed: 0")  # as pandas has a nameless one
    is_square = len(header) == len(cells) and all(map(_is_word, header))
    return is_named or is_square or {*map(len, rows)} == {len(header) + 1}


def _is_word(cell: Cell) -> bool:
    """Whether a cell has text that is no number."""
    return isinstance(cell, str) and cell != ""


def _is_header(cells: Sequence[Sequence[Any]]) -> bool:
    """Whether the first row names the columns: by words, or by counting them above as many rows.

    Single letters are names above rows that have no words at all; elsewhere they may be marks.
    """
    header, *rows = cells
    words = [cell for cell in header if isinstance(cell, str)]
    if any(re.search(r"[^\W_]{2}|[xyzijr]$", word, re.I) for word in words):
        return not any(map(_is_word, rows[0]))
    if len(words) == len(header) and all(re.match(r"[^\W\d_]", word) for word in words):
        return not any(_is_word(cell) for row in rows for cell in row)
    counted = [*range(len(header))]
    return list(header) in (counted, [k + 1 for k in counted]) and len(rows) == len(header) > 2
