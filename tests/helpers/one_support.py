"""Diagrams of a cable with one support: a straight ray to its end, and a strand that crosses it."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import product

from knotopt.errors import DiagramError
from knotopt.planar.gauss import from_visits
from knotopt.planar.planar_diagram import PlanarDiagram

Winding = tuple[int, bool]
"""How many crossings, and whether they run inwards."""


@dataclass(frozen=True)
class RayLetter:
    """A crossing of the strand with the ray.

    `distance` from the ray's end; `over` or under; `sense` +1 from the ray's right, seen towards
    its end, to its left.
    """

    distance: int
    over: bool
    sense: int


def diagram(letters: Sequence[RayLetter]) -> PlanarDiagram | None:
    """The closed cable's diagram, the strand's letters in order; None if it crosses itself."""
    along = sorted(range(len(letters)), key=lambda k: -letters[k].distance)
    over = [not letters[k].over for k in along] + [letter.over for letter in letters]
    signs = [-letter.sense if letter.over else letter.sense for letter in letters]
    try:
        return from_visits([*along, *range(len(letters))], over, signs)
    except DiagramError:
        return None


def windings(count: int) -> Iterator[tuple[Winding, ...]]:
    """Every way of dividing letters into windings: (letters, inwards) of each."""
    if count == 0:
        yield ()
    for first in range(1, count + 1):
        for rest in windings(count - first):
            for inwards in (True, False) if first > 1 else (True,):
                yield ((first, inwards), *rest)


def distances(turns: Sequence[Winding]) -> list[int]:
    """Of each letter: every winding lies beyond those before, and is monotone."""
    found: list[int] = []
    for count, inwards in turns:
        beyond = range(len(found) + 1, len(found) + count + 1)
        found += reversed(beyond) if inwards else beyond
    return found


def shadows(at: Sequence[int]) -> Iterator[tuple[int, ...]]:
    """Senses of letters at these distances with which the strand does not cross itself."""
    for senses in product((1, -1), repeat=len(at)):
        letters = [RayLetter(d, True, s) for d, s in zip(at, senses, strict=True)]
        if diagram(letters) is not None:
            yield senses
