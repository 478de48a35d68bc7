"""DT codes: lists of even numbers, letters, and SnapPy's `DT:` with flips."""

from __future__ import annotations

import re

from knotopt.errors import DiagramError
from knotopt.planar.dt import MOST_LETTERS, dt_numbers, from_dt
from knotopt.reading.codes import (
    check_crossings,
    flat_numbers,
    looks_like_dt,
    up_to_mirror,
)
from knotopt.reading.content import Content
from knotopt.reading.lists import parse_lists
from knotopt.reading.record import Asked, Reading

_HEAD = re.compile(r"\s*DT(?:\s?code)?\s*(?=[:=\[(\s])\s*[:=]?\s*", re.IGNORECASE)
_LETTERS = re.compile(r"[\[(\s\"']*([A-Za-z]+)(?:\.([01]*))?[\])\s\"']*")
_FLIPS = re.compile(r"(\[.*\])\s*,\s*\[([01,\s]*)\]\s*", re.DOTALL)


def read(content: Content, _asked: Asked) -> Reading | None:
    """The planar diagram of a DT code: up to mirror image, or exactly if SnapPy's flips are given.

    Letters alone are read if each of the first letters of the alphabet stands once, as in "bca", or
    if they begin with the numbers of crossings and components, as in "cacbca".

    Raises
    ------
    DiagramError
        Naming the entry or letter that is wrong, or the visit that cannot be reached in the plane.
    """
    head = _HEAD.match(content.text)
    text = content.text[head.end() :] if head else content.text
    named = content.key.startswith("dt") or head is not None
    if letters := _LETTERS.fullmatch(text):
        word, flips = letters.groups()
        if not named and not _is_code(word):
            return None
        return _reading(dt_numbers(word), None if flips is None else [*map(int, flips)])
    if flipped := _FLIPS.fullmatch(text):
        parsed = parse_lists(flipped[1])
        content = Content("", parsed, "dt")
        flips_given = re.findall("[01]", flipped[2])
    elif head and not content.key:
        content = Content("", parse_lists(text), "dt")
        flips_given = None
    else:
        flips_given = None
    numbers = flat_numbers(content)
    if numbers is None:
        if not named:
            return None
        if (rows := content.rows) and len(rows) > 1:
            raise DiagramError(f"this DT code is a link of {len(rows)} components, a knot has 1")
        if content.value == []:
            return _reading((), None)
        raise DiagramError("a DT code is a list of even numbers, or letters")
    if not named and not looks_like_dt(numbers):
        return None
    return _reading(numbers, None if flips_given is None else [*map(int, flips_given)])


def _reading(numbers: tuple[int, ...] | list[int], flips: list[int] | None) -> Reading:
    check_crossings(len(numbers))
    diagram = from_dt(numbers, flips)
    return Reading(diagram, up_to_mirror(diagram) if flips is None else ())


def _is_code(word: str) -> bool:
    """Whether letters without a name are a DT code, and no word: three crossings or more."""
    if not 3 <= len(word) <= MOST_LETTERS + 3:
        return False
    try:
        return len(dt_numbers(word)) >= 3
    except DiagramError:
        return False
