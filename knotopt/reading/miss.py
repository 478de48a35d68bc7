"""What is said of a content that is a knot in no form: what it looks like, and what is wrong."""

from __future__ import annotations

import re
from collections.abc import Sequence
from typing import Any

from knotopt.errors import FileFormatError, KnotoptError
from knotopt.reading.content import Content
from knotopt.reading.near_names import unknown

_LONGEST_NAME = 60
_OPENING, _CLOSING = "[({", "])}"


def miss(content: Content) -> KnotoptError:
    """The error to raise."""
    text = content.text.strip()
    if content.given is None and not text:
        return FileFormatError("there is nothing in it")
    numbers, no_knot = content.numbers, f"no knot in {_shown(text)}"
    if numbers is not None and len(numbers) > 1:
        return FileFormatError(
            f"a list of {len(numbers)} numbers, but no DT code (even numbers), no Gauss code (each "
            "crossing twice) and no braid word whose closure is a knot"
        )
    is_short = "\n" not in text and len(text) <= _LONGEST_NAME
    if content.given is None and is_short and not re.search(r"[\[{]", text):
        return unknown(text)
    wrong = _of_lists(content) or _bracket(content.text) or _line(content)
    return FileFormatError(wrong or no_knot)


def _of_lists(content: Content) -> str | None:
    """Of a value in brackets; None for other text."""
    rows = content.rows
    if content.value is None or (content.given is None and not re.search(r"[\[{(]", content.text)):
        return None
    if rows is not None:
        return _of_rows(rows)
    return "lists, but not those of a grid, a code or a curve"


def _of_rows(rows: Sequence[Sequence[Any]]) -> str:
    """Of rows of numbers: how many and how long they are, and which knots they are not."""
    widths = sorted({*map(len, rows)})
    if len(widths) > 1:
        numbers = f"{', '.join(map(str, widths[:-1]))} and {widths[-1]}"
        return (
            f"{len(rows)} rows of different lengths, {numbers} numbers: no grid, PD code or curve; "
            "a DT or Gauss code or a braid word is one row"
        )
    are_marks = all(entry in (0, 1, "") for row in rows for entry in row)
    if are_marks and len(rows) == widths[0]:
        return f"{len(rows)} rows of 0 and 1, where a matrix has -1, 0 and 1: one -1 and one 1 each"
    no = "no matrix, marks, arc presentation, PD code or curve"
    return f"{len(rows)} rows of {widths[0]} numbers, but {no}"


def _bracket(text: str) -> str | None:
    """A bracket that is not closed, or closed and not opened."""
    opened: list[tuple[str, int]] = []
    for place, sign in enumerate(text):
        if sign in _OPENING:
            opened.append((sign, place))
        elif sign in _CLOSING:
            if not opened or _OPENING.index(opened[-1][0]) != _CLOSING.index(sign):
                return f"line {_line_number(text, place)} closes {sign!r}, which is not open"
            opened.pop()
    if opened:
        sign, place = opened[-1]
        return f"line {_line_number(text, place)} opens {sign!r}, which is not closed"
    return None


def _line_number(text: str, place: int) -> int:
    return text.count("\n", 0, place) + 1


def _line(content: Content) -> str | None:
    """The first line of a table that is not of whole numbers, where most of it is."""
    table = content.table
    if table is None:
        return None
    wrong = [
        line
        for line, row in zip(table.lines, table.rows, strict=True)
        if not all(isinstance(cell, int) for cell in row)
    ]
    if not wrong:
        return _of_rows(table.rows)
    if 2 * len(wrong) > len(table.rows) and not table.header:
        return None
    shown = content.text.splitlines()[wrong[0] - 1].strip()
    return f"line {wrong[0]} is {_shown(shown)}, expected whole numbers"


def _shown(text: str) -> str:
    return repr(text if len(text) <= _LONGEST_NAME else f"{text[: _LONGEST_NAME - 3]}...")
