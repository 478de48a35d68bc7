"""Simplification of a grid diagram by commutations and destabilisations.

A random walk over commutations that contracts a row or column whenever one can be contracted. For
the unknot commutations and destabilisations are enough to reach the 2 x 2 grid (Dynnikov,
"Arc-presentations of links: monotonic simplification", doi:10.4064/fm190-0-3); for other knots the
walk may stop above the arc index.
"""

from __future__ import annotations

import random

from knotopt.diagram.grid import GridDiagram
from knotopt.diagram.moves import (
    can_destabilise_column,
    can_destabilise_row,
    destabilise_column,
    destabilise_row,
)


def simplify(diagram: GridDiagram, *, patience: int = 20_000, seed: int = 0) -> GridDiagram:
    """A diagram of the same knot, never larger than the one given.

    Parameters
    ----------
    diagram : GridDiagram
    patience : int
        Commutations tried without a contraction before the walk gives up. Below one hundred
        thousand this is a fraction of a second.
    seed : int
        Seed of the walk; the same seed gives the same diagram.

    Returns
    -------
    GridDiagram
        The smallest diagram met. If nothing could be contracted, the given one as it was.

    Examples
    --------
    >>> from knotopt.diagram.families import torus_knot
    >>> simplify(torus_knot(1, 6)).size  # an unknot
    2
    """
    generator = random.Random(seed)
    smallest = diagram
    while True:
        contracted = _contract(smallest)
        if contracted is None:
            walked = _walk_to_contractible(smallest, patience, generator)
            contracted = None if walked is None else _contract(walked)
        if contracted is None:
            return smallest
        smallest = contracted


def _contract(diagram: GridDiagram) -> GridDiagram | None:
    """The diagram after its first possible contraction, None if there is none."""
    for line in range(1, diagram.size + 1):
        if can_destabilise_row(diagram, line):
            return destabilise_row(diagram, line)
        if can_destabilise_column(diagram, line):
            return destabilise_column(diagram, line)
    return None


def _walk_to_contractible(
    diagram: GridDiagram, patience: int, generator: random.Random
) -> GridDiagram | None:
    """Random commutations until a row or column can be contracted, None if none of them led there.

    Works on lists counted from 0, kept both by column and by row, so that one step costs O(1); the
    moves on `GridDiagram` validate the whole diagram every time.
    """
    size = diagram.size
    minus = [row - 1 for row in diagram.minus]
    plus = [row - 1 for row in diagram.plus]
    columns = (minus, plus)
    rows = ([minus.index(row) for row in range(size)], [plus.index(row) for row in range(size)])
    for _ in range(patience):
        here, there = (columns, rows) if generator.random() < 0.5 else (rows, columns)
        left = generator.randrange(size)
        right = (left + 1) % size
        a, b, c, d = here[0][left], here[1][left], here[0][right], here[1][right]
        low, high = (a, b) if a < b else (b, a)
        shared = c in (a, b) or d in (a, b)
        if not shared and (low < c < high) != (low < d < high):
            continue
        here[0][left], here[0][right] = c, a
        here[1][left], here[1][right] = d, b
        there[0][a], there[0][c] = right, left
        there[1][b], there[1][d] = right, left
        # The exchange changed the spread of these four lines only.
        if any(abs(there[0][line] - there[1][line]) in (1, size - 1) for line in (a, b, c, d)):
            return GridDiagram(tuple(r + 1 for r in minus), tuple(r + 1 for r in plus))
    return None
