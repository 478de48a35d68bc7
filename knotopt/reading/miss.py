"""What is said of a content that is a knot in no form: what it looks like, and what is wrong."""

from __future__ import annotations

import re

from knotopt.errors import FileFormatError, KnotoptError
from knotopt.reading import names
from knotopt.reading.content import Content

_LONGEST_NAME = 60
_OPENING, _CLOSING = "[({", "])}"


def miss(content: Content) -> KnotoptError:
    """The error to raise."""
    text = content.text.strip()
    if content.given is None and not text:
        return FileFormatError("there is nothing in it")
    if content.value is not None:
        numbers, rows = content.numbers, content.rows
        if numbers is not None and len(numbers) > 1:
            return FileFormatError(
                f"a list of {len(numbers)} numbers, but no DT code (even numbers, 2 to 2n), no "
                "Gauss code (each crossing twice) and no braid word whose closure is a knot"
            )
        if rows is not None:
            return FileFormatError(
                f"{len(rows)} rows of {len(rows[0])}, but no matrix, marks, arc presentation, PD "
                "code or curve"
            )
        if not isinstance(content.value, str | int):
            return FileFormatError("lists, but not those of a grid, a code or a curve")
    if "\n" not in text and len(text) <= _LONGEST_NAME and not re.search(r"[\[{]", text):
        return names.unknown(text)
    return FileFormatError(_bracket(text) or _line(content) or f"no knot: {_shown(text)}")


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
        return f"{len(table.rows)} rows of numbers, but no matrix, marks, code or curve"
    if 2 * len(wrong) > len(table.rows):
        return None
    shown = content.text.splitlines()[wrong[0] - 1].strip()
    return f"line {wrong[0]} is {_shown(shown)}, expected whole numbers as in other lines"


def _shown(text: str) -> str:
    return repr(text if len(text) <= _LONGEST_NAME else f"{text[: _LONGEST_NAME - 3]}...")
