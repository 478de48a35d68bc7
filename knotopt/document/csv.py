"""Rows as comma-separated values, for programs that read them."""

from __future__ import annotations

import csv
import io
import json
from collections.abc import Iterable, Mapping, Sequence
from typing import Any


class _Lines(io.StringIO):
    """Text whose lines end in a line feed.

    The writer of the standard library quotes a carriage return only if it ends the lines, too.
    """

    def write(self, line: str) -> int:
        return super().write(line.removesuffix("\r\n") + "\n")


def csv_text(names: Sequence[str], rows: Iterable[Mapping[str, Any]]) -> str:
    """One line a row, under the names of the columns; a missing cell is empty.

    Parameters
    ----------
    names : sequence of str
        In their order.
    rows : iterable of mapping
        Cells by column. Tuples and lists are written as JSON.

    Raises
    ------
    ValueError
        A row has a cell under no name.

    Examples
    --------
    >>> print(csv_text(["knot", "supports"], [{"knot": "3_1", "supports": (3, 4)}]), end="")
    knot,supports
    3_1,"[3, 4]"
    """
    lines = _Lines(newline="")
    writer = csv.DictWriter(lines, names)
    writer.writeheader()
    writer.writerows({name: _cell(value) for name, value in row.items()} for row in rows)
    return lines.getvalue()


def _cell(value: Any) -> Any:
    return json.dumps(value) if isinstance(value, tuple | list) else value
