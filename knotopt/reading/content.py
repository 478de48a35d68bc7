"""A source's text as what it is: a value of nested lists, a table, or plain text."""

from __future__ import annotations

import re
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

from knotopt.reading.lists import Lists, parse_lists
from knotopt.reading.source import REMARK
from knotopt.reading.table import Table, parse_table


@dataclass(frozen=True)
class Content:
    """What is read, in the ways in which a form may look at it.

    Attributes
    ----------
    text : str
        As it stands; "" for a value that came without text.
    given : Lists or None
        A value that came without text, such as that of a JSON object's key.
    key : str
        The JSON object's key that the value stood under, if any.
    """

    text: str
    given: Lists | None = None
    key: str = ""

    @cached_property
    def lists(self) -> Lists | None:
        """The text as nested lists; None for other text, and for lines of numbers alone."""
        if self.given is not None:
            return self.given
        text = self.text.strip()
        if "\n" in text and not re.search(r"[\[({]", text):
            return None  # its lines are rows
        return parse_lists("\n".join(ln for ln in text.splitlines() if not REMARK.match(ln)))

    @cached_property
    def value(self) -> Any:
        """The nested lists or dictionary; None if it is other text."""
        return None if self.lists is None else self.lists.value

    @property
    def heads(self) -> tuple[str, ...]:
        """Words before brackets, such as ("PD", "X")."""
        return () if self.lists is None else self.lists.heads

    @cached_property
    def table(self) -> Table | None:
        """The text as a table; None if it has brackets or fewer than two lines."""
        return None if self.given is not None or self.value is not None else parse_table(self.text)

    @property
    def header(self) -> tuple[str, ...]:
        """Names of the table's columns."""
        return () if self.table is None else self.table.header

    @cached_property
    def rows(self) -> list[list[Any]] | None:
        """A list of lists of numbers or words, however written; None if it is none.

        Numbers that are whole are int.
        """
        if self.table is not None:
            return [list(row) for row in self.table.rows]
        value = self.value
        if not isinstance(value, list) or not value:
            return None
        if not all(isinstance(row, list) for row in value):
            return None
        if any(isinstance(entry, list | dict) for row in value for entry in row):
            return None
        return [[_whole(entry) for entry in row] for row in value]

    @cached_property
    def numbers(self) -> list[int] | None:
        """A flat list of whole numbers; None if it is anything else."""
        value = self.value
        if isinstance(value, int) and not isinstance(value, bool):
            value = [value]
        if not isinstance(value, list) or not value:
            return None
        entries = [_whole(entry) for entry in value]
        if not all(isinstance(entry, int) and not isinstance(entry, bool) for entry in entries):
            return None
        return entries

    def inside(self, key: str, value: Any) -> Content:
        """The content under a key of this object."""
        return Content(value if isinstance(value, str) else "", _given(value), key)

    def without_quotes(self) -> Content:
        """The text inside, of a JSON string."""
        return replace(self, text=str(self.value), given=None)


def _given(value: Any) -> Lists | None:
    return None if isinstance(value, str) else Lists(value)


def _whole(entry: Any) -> Any:
    """1 for 1.0, and for numbers in text; anything else as it is."""
    if isinstance(entry, float) and entry.is_integer() and abs(entry) < 2**53:
        return int(entry)
    if isinstance(entry, str) and re.fullmatch(r"\s*[+-]?\d{1,18}\s*", entry):
        return int(entry)
    return entry
