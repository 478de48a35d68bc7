"""What the readers of codes share: how long a code may be, and what it leaves open.

A flat list of whole numbers may be a DT code, a Gauss code or a braid word. Its content decides:

1. even numbers, each once up to sign: a DT code;
2. numbers that occur twice, once with either sign: a Gauss code;
3. else a braid word.

Two thirds of a list are enough for a DT code and half of it for a Gauss code; if it is wrong as
such, that is what is said, and it is read as a braid word only if it is named one. No braid word of
KnotInfo's table is so near to another code.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Collection, Sequence
from typing import Any

from knotopt.errors import DiagramError
from knotopt.planar.gauss import parts_by_themselves
from knotopt.planar.planar_diagram import PlanarDiagram
from knotopt.reading.content import Content
from knotopt.reading.lists import Lists
from knotopt.reading.record import Asked, Reading, ReadSummand

_PLAIN = ("array", "list", "tuple", "vector", "matrix")

MAX_CROSSINGS = 1000
"""Of a code that is read: to draw so many crossings on a grid and simplify it takes 20 s."""


def check_crossings(count: int) -> None:
    """Refuse a code that is too long.

    Raises
    ------
    DiagramError
    """
    if count > MAX_CROSSINGS:
        raise DiagramError(f"a code of {count} crossings; up to {MAX_CROSSINGS} are read")


def is_named(content: Content, asked: Asked, form: str, heads: Collection[str] = ()) -> bool:
    """Whether the content is said to be of a form: by who asks, its key, or a word in it."""
    return (
        asked.form == form
        or any(word in content.key.split("_") for word in (form, form[:2]))
        or not {*content.heads}.isdisjoint(heads)
    )


def behind_its_name(content: Content, form: str, words: str = "") -> Content:
    """What follows "DT: ", "Gauss code = " or the like in a text; else the content as it is."""
    name = rf"\s*(?:{words or form})(?:[ _](?:code|word|notation))?\s*[:=]\s*"
    head = re.match(name, content.text, re.IGNORECASE)
    return content if head is None else Content(content.text[head.end() :], None, form)


def is_something_else(content: Content, heads: Collection[str] = ()) -> bool:
    """Whether a word before the brackets says that it is neither a plain list nor of these."""
    return not {head.split(".")[-1] for head in content.heads} <= {*heads, *_PLAIN}


def flat_numbers(content: Content) -> list[int] | None:
    """A list of whole numbers, in one pair of brackets or in two; None if it is anything else."""
    value = content.value
    if isinstance(value, list) and len(value) == 1 and isinstance(value[0], list):
        content = content.inside(content.key, value[0])
    if content.value == []:
        return []
    return content.numbers if isinstance(content.value, list) else None


def numbers_in(value: Any) -> list[int] | None:
    """A list of whole numbers, however written, as int; None if it is anything else."""
    return value if value == [] else Content("", Lists(value)).numbers


def looks_like_dt(numbers: Sequence[int]) -> bool:
    """Whether most of the numbers are even, and most occur once."""
    even = sum(number % 2 == 0 for number in numbers)
    once = len({*map(abs, numbers)})
    return 3 * min(even, once) >= 2 * len(numbers) > 0


def looks_like_gauss(numbers: Sequence[int]) -> bool:
    """Whether half of the numbers occur twice, once with either sign."""
    signed, either = Counter(numbers), Counter(map(abs, numbers))
    paired = sum(
        count == 2 and signed[number] == signed[-number] == 1 for number, count in either.items()
    )
    return 2 * paired >= len(either) > 0


def up_to_mirror(diagram: PlanarDiagram) -> Reading:
    """The reading of a code without crossing signs: what it leaves open, if it is a knot.

    Parts of the diagram of one or two crossings are no knots, so that nothing depends on theirs.
    """
    knotted = [part for part in parts_by_themselves(diagram) if len(part.crossings) > 2]
    if len(knotted) < 2:
        return Reading(diagram, ("up to mirror image",) * len(knotted), ambiguous=bool(knotted))
    note = f"up to mirror image, of each of the diagram's {len(knotted)} parts by itself"
    summands = tuple(ReadSummand(part, either_hand=True) for part in knotted)
    return Reading(diagram, (note,), ambiguous=True, summands=summands)


def whole(entry: Any, what: str) -> int:
    """The entry, if it is a whole number.

    Raises
    ------
    DiagramError
        It is not; the message names it by `what`.
    """
    if not isinstance(entry, int) or isinstance(entry, bool):
        shown = repr(entry) if len(repr(entry)) <= 30 else f"{repr(entry)[:27]}..."
        raise DiagramError(f"{what} is {shown}, expected a whole number")
    return entry
