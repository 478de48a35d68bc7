"""Rows as comma-separated values, for programs that read them."""

from __future__ import annotations

import csv
import json
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any


@dataclass(frozen=True)
class _Lines:
    """What the module of the standard library takes for a file."""

    lines: list[str]

    def write(self, line: str) -> None:
        self.lines.append(line.removesuffix("\r\n") + "\n")


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
    lines: list[str] = []
    # A carriage return in a cell is quoted only if it ends the lines, too.
    writer = csv.DictWriter(_Lines(lines), names)
    writer.writeheader()
    writer.writerows({name: _cell(value) for name, value in row.items()} for row in rows)
    return "".join(lines)


def _cell(value: Any) -> Any:
    return json.dumps(value) if isinstance(value, tuple | list) else value
