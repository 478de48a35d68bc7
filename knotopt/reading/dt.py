"""DT codes: lists of even numbers, letters, and SnapPy's `DT:` with flips."""

from __future__ import annotations

import re
from collections.abc import Sequence

from knotopt.errors import DiagramError
from knotopt.planar.dt import MOST_LETTERS, dt_numbers, from_dt
from knotopt.reading.codes import (
    behind_its_name,
    check_crossings,
    flat_numbers,
    is_named,
    is_something_else,
    looks_like_dt,
    up_to_mirror,
)
from knotopt.reading.content import Content
from knotopt.reading.record import Asked, Reading

_HEADS = ("DT", "DTCode")
_LETTERS = re.compile(r"\s*+(?:DT(?=[\[(]))?[\[(\s\"']*+([A-Za-z]++)(?:\.([01]*))?[\])\s\"']*")
_FLIPS = re.compile(r"(\[.*\])\s*,\s*\[([01,\s]*)\]\s*", re.DOTALL)


def read(content: Content, asked: Asked) -> Reading | None:
    """The planar diagram of a DT code: up to mirror image, or exactly if SnapPy's flips are given.

    Letters alone are read if each of the first letters of the alphabet stands once, as in "bca", or
    if they begin with the numbers of crossings and components, as in "cacbca".

    Raises
    ------
    DiagramError
        Naming the entry or letter that is wrong, or the visit that cannot be reached in the plane.
    """
    content = behind_its_name(content, "dt")
    named = is_named(content, asked, "dt", _HEADS)
    flips: list[int] | None = None
    if content.given is None and (letters := _LETTERS.fullmatch(content.text)):
        word, bits = letters.groups()
        if not named and not _is_code(word):
            return None
        return _reading(dt_numbers(word), None if bits is None else [*map(int, bits)])
    if named and (flipped := _FLIPS.fullmatch(content.text)):
        flips = [int(bit) for bit in re.findall("[01]", flipped[2])]
        content = Content(flipped[1], None, "dt")
    if is_something_else(content, _HEADS):
        return None
    numbers = flat_numbers(content)
    if numbers is not None:
        return _reading(numbers, flips) if named or looks_like_dt(numbers) else None
    if named and (rows := content.rows) and len(rows) > 1:
        raise DiagramError(f"this DT code is a link of {len(rows)} components, a knot has 1")
    if named:
        raise DiagramError("a DT code is a list of even numbers, or letters")
    return None


def _reading(numbers: Sequence[int], flips: list[int] | None) -> Reading:
    check_crossings(len(numbers))
    diagram = from_dt(numbers, flips)
    return up_to_mirror(diagram) if flips is None else Reading(diagram)


def _is_code(word: str) -> bool:
    """Whether letters without a name are a DT code, and no word: three crossings or more."""
    if not 3 <= len(word) <= MOST_LETTERS + 3:
        return False
    try:
        return len(dt_numbers(word)) >= 3
    except DiagramError:
        return False
