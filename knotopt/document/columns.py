"""Columns of data: the name, what a cell may be, and what it means."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any

Row = dict[str, Any]
"""Cells by the names of their columns."""


@dataclass(frozen=True)
class Column:
    """One column of a file.

    Attributes
    ----------
    name : str
    kind : type
        int, float, str, bool, or tuple[int, ...].
    meaning : str
        In words, with the unit in brackets.
    optional : bool
        Whether a cell may be empty.
    """

    name: str
    kind: Any
    meaning: str
    optional: bool = False


def names(columns: Iterable[Column]) -> tuple[str, ...]:
    """The columns' names, in their order."""
    return tuple(column.name for column in columns)


def check_rows(columns: Iterable[Column], rows: Iterable[Row]) -> None:
    """Whether each row has a cell for each column, and no other.

    Raises
    ------
    ValueError
        One has not: it was made for other columns.
    """
    expected = {*names(columns)}
    for row in rows:
        if wrong := expected.symmetric_difference(row):
            raise ValueError(f"a row lacks, or has too much: {', '.join(sorted(wrong))}")
