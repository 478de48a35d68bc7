"""Gauss codes: KnotInfo's lists, KnotTheory's `GaussCode[...]`, Sage's with signs, and O1-U2-."""

from __future__ import annotations

import re
from typing import Any

from knotopt.errors import DiagramError
from knotopt.planar.gauss import from_gauss
from knotopt.reading.codes import (
    behind_its_name,
    check_crossings,
    flat_numbers,
    is_named,
    is_something_else,
    looks_like_gauss,
    numbers_in,
    up_to_mirror,
    whole,
)
from knotopt.reading.content import Content
from knotopt.reading.record import Asked, Reading

_HEADS = ("GaussCode",)
_VISITS = re.compile(r"\s*(?:[OU]\d|\d+[+-](?:\W|$))", re.IGNORECASE)
_VISIT = re.compile(r"([OU]?)(\d{1,9})([+-]?)", re.IGNORECASE)
_SIGNS = {"+": 1, "-": -1}


def read(content: Content, asked: Asked) -> Reading | None:
    """The planar diagram of a Gauss code: exactly with crossing signs, else up to mirror image.

    Raises
    ------
    DiagramError
        Naming the visit, crossing or sign that is wrong, or how many components a link has.
    """
    content = behind_its_name(content, "gauss")
    text = content.text
    is_grid = "\n" in text and "x" in text.lower()  # lines such as "O000X"
    if content.given is None and _VISITS.match(text) and not is_grid:
        return _visits(text)
    if is_something_else(content, _HEADS):
        return None
    named = is_named(content, asked, "gauss", _HEADS)
    if (oriented := _oriented(content.value)) is not None:
        return _reading(*oriented)
    numbers = flat_numbers(content)
    if numbers is not None:
        return _reading(numbers, None) if named or looks_like_gauss(numbers) else None
    if named and (rows := content.rows) and len(rows) > 1:
        raise DiagramError(f"this Gauss code is a link of {len(rows)} components, a knot has 1")
    if named and content.value is not None:
        raise DiagramError("a Gauss code is a list of whole numbers, +k over and -k under")
    return None


def _reading(code: list[int], signs: list[int] | None) -> Reading:
    check_crossings(len(code) // 2)
    diagram = from_gauss(code, signs)
    return up_to_mirror(diagram) if signs is None else Reading(diagram)


def _oriented(value: Any) -> tuple[list[int], list[int]] | None:
    """Code and signs of Sage's [[code], [signs]]; None if it is anything else."""
    if not (isinstance(value, list) and len(value) == 2):
        return None
    components, signs = value
    if not (isinstance(components, list) and components and isinstance(signs, list) and signs):
        return None
    if not all(sign in (1, -1, "+", "-") for sign in signs):
        return None
    if not isinstance(components[0], list):
        if len(components) != 2 * len(signs):
            return None
        components = [components]
    if len(components) > 1:
        raise DiagramError(
            f"this Gauss code is a link of {len(components)} components, a knot has 1"
        )
    code = numbers_in(components[0])
    if code is None:
        code = [whole(entry, f"visit {k}") for k, entry in enumerate(components[0], 1)]
    return code, [1 if sign in (1, "+") else -1 for sign in signs]


def _visits(text: str) -> Reading:
    """A code of letters O and U, with or without signs, or of numbers with a sign behind them."""
    found = re.findall(r"[A-Za-z]?[^\sA-Za-z,;]+|[A-Za-z]", text.strip(" \t\r\n[](){}"))
    check_crossings(len(found) // 2)
    code: list[int] = []
    signs: dict[int, str] = {}
    letters = _VISIT.match(found[0])
    for visit, word in enumerate(found, 1):
        parts = _VISIT.fullmatch(word)
        if parts is None or bool(parts[1]) != bool(letters and letters[1]):
            shown = word if len(word) <= 20 else f"{word[:17]}..."
            raise DiagramError(
                f"visit {visit} is {shown!r}, expected O or U, the crossing's number and its sign"
            )
        passes, digits, sign = parts.groups()
        number = int(digits)
        if not passes:  # 1-, 2+: the sign says over or under
            code.append(-number if sign == "-" else number)
            continue
        code.append(number if passes in "Oo" else -number)
        if signs.setdefault(number, sign) != sign:
            raise DiagramError(
                f"crossing {number} has the sign {signs[number] or 'none'} at its first visit and "
                f"{sign or 'none'} at visit {visit}"
            )
    given = [sign for _, sign in sorted(signs.items())]
    if not any(given):
        return _reading(code, None)
    if not all(given):
        missing = next(number for number, sign in signs.items() if not sign)
        raise DiagramError(f"crossing {missing} has no sign, others have one")
    return _reading(code, [_SIGNS[sign] for sign in given])
