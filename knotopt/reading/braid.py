"""Braid words: lists, `Braid[2, {1,1,1}]`, `BR[...]`, letters such as aBaB, and s1 s2^-1."""

from __future__ import annotations

import re
from typing import Any

from knotopt.errors import DiagramError
from knotopt.planar.braid import from_braid
from knotopt.reading.codes import (
    behind_its_name,
    check_crossings,
    flat_numbers,
    is_named,
    is_something_else,
    looks_like_dt,
    looks_like_gauss,
    numbers_in,
)
from knotopt.reading.content import Content
from knotopt.reading.record import Asked, Reading

_HEADS = ("Braid", "BR")
_GENERATOR = re.compile(
    r"(?:s|σ|sigma)_?\{?(\d{1,6})\}?(?:\^?[{(]?([+-]?\d{1,6})[})]?)?(?=[\s*.·,sσ]|$)[\s*.·,]*"
)
_SUPERSCRIPTS = str.maketrans("⁻⁰¹²³⁴⁵⁶⁷⁸⁹", "-0123456789")


def read(content: Content, asked: Asked) -> Reading | None:
    """The planar diagram of a braid's closure; positive letters are positive crossings.

    Letters alone, small for positive and capital for negative ("aBaB" is [1, -2, 1, -2]), are read
    if they are three or more, and those used are the first of the alphabet without a gap.

    Raises
    ------
    DiagramError
        Naming the letter that is wrong, or how many components the closure has.
    """
    content = behind_its_name(content, "braid", "br|braid")
    named = is_named(content, asked, "braid", _HEADS)
    word = _in_letters(content.text.strip(), named) if content.given is None else None
    if word is not None:
        return _reading(word, None)
    if is_something_else(content, _HEADS):
        return None
    if (pair := _with_strands(content.value)) is not None:
        return _reading(*pair)
    numbers = flat_numbers(content)
    if numbers is not None:
        another = not numbers or looks_like_dt(numbers) or looks_like_gauss(numbers)
        return None if another and not named else _reading(numbers, None)
    rows = content.rows
    if rows and _are_words(rows, named):
        found = _reading(rows[0], None)
        return Reading(found.diagram, (*found.notes, f"the first of {len(rows)} braid words"))
    if named and content.value is not None:
        raise DiagramError("a braid word is a list of whole numbers, +i or -i for each crossing")
    return None


def _reading(word: list[int], strands: int | None) -> Reading:
    check_crossings(len(word))
    return Reading(from_braid(word, strands), ("positive letters are positive crossings",))


def _with_strands(value: Any) -> tuple[list[int], int] | None:
    """Word and number of strands, in either order; None if the value is anything else."""
    if not (isinstance(value, list) and len(value) == 2):
        return None
    for strands, word in (value, value[::-1]):
        count = numbers_in([strands])
        letters = numbers_in(word) if isinstance(word, list) else None
        if count is not None and letters is not None:
            return letters, count[0]
    return None


def _are_words(rows: list[list[Any]], named: bool) -> bool:
    """Whether rows are braid words: KnotInfo gives two, a short one and one of few strands."""
    entries = [entry for row in rows for entry in row]
    if not all(isinstance(entry, int) and entry for entry in entries):
        return False
    lengths = {*map(len, rows)}
    return named or (min(lengths) > 2 and len(lengths) > 1 and min(entries) < 0)


def _in_letters(text: str, named: bool) -> list[int] | None:
    """The word that a text without brackets is; None if it is anything else."""
    word = _alphabetic(text, named)
    return _generators(text) if word is None else word


def _alphabetic(text: str, named: bool) -> list[int] | None:
    """The word in letters a, b, ... for positive and A, B, ... for negative crossings."""
    if not re.fullmatch("[A-Za-z]+", text):
        return None
    used = sorted({*text.lower()})
    gapless = ord(used[-1]) - ord("a") + 1 == len(used)
    if not named and (len(text) < 3 or not gapless):
        return None
    return [
        (1 if letter.islower() else -1) * (ord(letter.lower()) - ord("a") + 1) for letter in text
    ]


def _generators(text: str) -> list[int] | None:
    """The word in generators s1, sigma_2^-1, ...; from s0 on, as Sage prints them, if s0 occurs."""
    text = re.sub("⁻?[⁰¹²³⁴⁵⁶⁷⁸⁹]+", lambda power: f"^{power[0]}".translate(_SUPERSCRIPTS), text)
    if not _GENERATOR.match(text):
        return None
    check_crossings(text.count("s") + text.count("σ"))
    if not re.fullmatch(f"(?:{_GENERATOR.pattern})+", text):
        return None
    powers = [(int(number), int(power or 1)) for number, power in _GENERATOR.findall(text)]
    check_crossings(sum(abs(power) for _, power in powers))
    shift = any(number == 0 for number, _ in powers)
    word = []
    for number, power in powers:
        word += [(number + shift) * (1 if power > 0 else -1)] * abs(power)
    return word
