"""Lists of numbers as programs print them, nested by any brackets.

JSON, Python and numpy (`[[0, -1], [1, 0]]`, `array([[0 -1]\\n [1 0]])`, `(1, 2)`), Mathematica and
KnotTheory (`PD[X[1,5,2,4], ...]`, `{{1, 2}, {3, 4}}`), Sage, KnotInfo's cells (`{1;2;3}`).
"""

from __future__ import annotations

import json
import re
from dataclasses import dataclass
from typing import Any

DEPTH = 20  # of nested brackets; a knot's codes have 4

_TOKEN = re.compile(
    r"(?P<blank>[\s,;]+)"
    r"|(?P<number>[+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d{1,4})?(?=[\s,;:\[\](){}]|$))"
    r"|(?P<text>\"[^\"\\]*\"|'[^'\\]*')"
    r"|(?P<word>[A-Za-z_][\w.]*(?=[\s,;:=\[\](){}]|$))"
    r"|(?P<open>[\[({])"
    r"|(?P<close>[\])}])"
    r"|(?P<is>[:=])"
)
_BRACKETS = str.maketrans("(){};", "[][],")
_LONG = 10_000  # characters, from which on speed counts
_LONGEST_NUMBER = 30  # digits; Python refuses to read 4,300


@dataclass(frozen=True)
class Lists:
    """A value, and the words that stand before its brackets.

    Attributes
    ----------
    value : list, dict, int, float or str
        Numbers in nested lists, or a dictionary of such.
    heads : tuple of str
        Such as ("PD", "X"): each once, in order.
    """

    value: Any
    heads: tuple[str, ...] = ()


def parse_lists(text: str) -> Lists | None:
    """The value that a text is; None if it is none.

    Examples
    --------
    >>> parse_lists("PD[X[1,5,2,4], X[3,1,4,6], X[5,3,6,2]]")
    Lists(value=[[1, 5, 2, 4], [3, 1, 4, 6], [5, 3, 6, 2]], heads=('PD', 'X'))
    >>> parse_lists("[ 0 -1]\\n[-1  0]").value, parse_lists("{'X': (1, 0)}").value
    ([[0, -1], [-1, 0]], {'X': [1, 0]})
    >>> parse_lists("8_19")
    """
    for attempt in (text, _as_json(text)):
        try:
            return Lists(json.loads(attempt))
        except (ValueError, RecursionError):
            continue
    return _parse(text)


def _as_json(text: str) -> str:
    """Numbers in any brackets as JSON, which is read a hundred times faster; "" for other text.

    Numbers that JSON has in no such way, as +1 and 1., are left to `_parse`.
    """
    if re.search(r"[^-\d.,;\s\[\](){}]", text) or len(text) < _LONG:
        return ""
    text = text.translate(_BRACKETS).strip(" \t\r\n,")
    text = re.sub(r"(?<=[\d\]])\s+(?=[-\d\[])", ",", text)
    return re.sub(r",\s*\]", "]", text)


class _NoListsError(Exception):
    """The text is something else."""


class _Level:
    """A bracket that is open: its entries, and the key of the next one."""

    def __init__(self, bracket: str) -> None:
        self.bracket = bracket
        self.entries: list[Any] = []
        self.keyed: dict[Any, Any] = {}
        self.key: Any = None
        self.has_key = False

    def add(self, value: Any) -> None:
        if self.has_key:
            self.keyed[self.key] = value
            self.has_key = False
        else:
            self.entries.append(value)

    def make_key(self) -> None:
        """The last entry was a key: a colon or an equals sign follows it."""
        if self.has_key or not self.entries or isinstance(self.entries[-1], list | dict):
            raise _NoListsError
        self.key, self.has_key = self.entries.pop(), True

    @property
    def value(self) -> Any:
        # What is named beside entries, `array([...], dtype=int8)`, says nothing of the knot.
        return self.keyed if self.keyed and not self.entries else self.entries


_PAIRS = {"[": "]", "(": ")", "{": "}"}


def _parse(text: str) -> Lists | None:
    levels = [_Level("")]
    heads: dict[str, None] = {}
    place = 0
    try:
        while place < len(text):
            token = _TOKEN.match(text, place)
            if token is None:
                return None
            place = token.end()
            if token.lastgroup == "word" and text[place : place + 1] in _PAIRS:
                heads[token.group()] = None
            else:
                _take(levels, str(token.lastgroup), token.group())
    except _NoListsError:
        return None
    if len(levels) > 1:
        return None
    value = levels[0].value
    if isinstance(value, list) and len(value) == 1:
        (value,) = value
    # Brackets around the whole: "array([[...]])" is its list.
    while isinstance(value, list) and len(value) == 1 and isinstance(value[0], list):
        (value,) = value
    return Lists(value, tuple(heads))


def _take(levels: list[_Level], kind: str, found: str) -> None:
    """Take one token into the brackets that are open."""
    top = levels[-1]
    if kind == "number":
        if len(found) > _LONGEST_NUMBER:
            raise _NoListsError
        top.add(float(found) if re.search(r"[.eE]", found) else int(found))
    elif kind in {"text", "word"}:
        top.add(found.strip("\"'"))
    elif kind == "is":
        top.make_key()
    elif kind == "open":
        if len(levels) > DEPTH:
            raise _NoListsError
        levels.append(_Level(found))
    elif kind == "close":
        if _PAIRS.get(top.bracket) != found:
            raise _NoListsError
        levels.pop()
        levels[-1].add(top.value)
