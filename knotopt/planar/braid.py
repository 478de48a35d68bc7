"""Braid words: the knot that is the closure of a braid.

A word lists letters, +i or -i for a crossing of strands i and i + 1, which run side by side in one
direction; **a positive letter is a positive crossing**. So it is for KnotInfo, KnotTheory and, from
version 3.0 on, SnapPy; Birman's book has the mirror image.

Sources: KnotInfo, "Braid notation"; SnapPy's documentation of `Link(braid_closure=...)`.
"""

from __future__ import annotations

from collections.abc import Sequence

from knotopt.errors import DiagramError
from knotopt.planar.gauss import from_visits
from knotopt.planar.planar_diagram import PlanarDiagram


def from_braid(word: Sequence[int], strands: int | None = None) -> PlanarDiagram:
    """The diagram of a braid's closure, a crossing for each letter.

    Parameters
    ----------
    word : sequence of int
        +i or -i, 1 <= i < strands.
    strands : int, optional
        As many as the letters need, if not given; 1 for the empty word.

    Raises
    ------
    DiagramError
        Naming the first letter that is wrong, or how many components the closure has.

    Examples
    --------
    >>> from_braid([1, 1, 1]).signs
    (1, 1, 1)
    >>> from_braid([1, 1])
    Traceback (most recent call last):
    ...
    knotopt.errors.DiagramError: the closure of this braid is a link of 2 components, a knot has 1
    """
    needed = max(map(abs, word), default=0) + 1
    strands = needed if strands is None else strands
    if strands < 1:
        raise DiagramError(f"a braid of {strands} strands, expected at least 1")
    for place, letter in enumerate(word, 1):
        if not 0 < abs(letter) < strands:
            raise DiagramError(
                f"letter {place} of the braid word is {letter}; a braid of {strands} strands has "
                f"letters from 1 to {strands - 1}, and their negatives"
            )
    # Strands come into a letter at (letter, 0) on the left and (letter, 1) on the right.
    first: dict[int, tuple[int, int]] = {}  # of each position, where the strand above 0 comes in
    last: dict[int, tuple[int, int]] = {}  # of each position, where it came out so far
    after: dict[tuple[int, int], tuple[int, int]] = {}
    for t, letter in enumerate(word):
        left = abs(letter)
        for side in (0, 1):
            if left + side in last:
                after[last[left + side]] = (t, side)
            else:
                first[left + side] = (t, side)
        last[left], last[left + 1] = (t, 1), (t, 0)  # the strand from the right goes out left
    for position, out in last.items():
        after[out] = first[position]
    visits = _one_walk(after, untouched=strands - len(last))
    over = [(side == 0) == (word[t] > 0) for t, side in visits]
    signs = [1 if letter > 0 else -1 for letter in word]
    return from_visits([t for t, _ in visits], over, signs)


def _one_walk(
    after: dict[tuple[int, int], tuple[int, int]], untouched: int
) -> list[tuple[int, int]]:
    """The cycle through all places; raised if there are several, or strands without letters."""
    walk: list[tuple[int, int]] = []
    left = dict(after)
    components = untouched
    while left:
        here = next(iter(left))
        components += 1
        while here in left:
            walk.append(here)
            here = left.pop(here)
    if components > 1:
        raise DiagramError(
            f"the closure of this braid is a link of {components} components, a knot has 1"
        )
    return walk
