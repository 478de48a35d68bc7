"""Grids a move or a few away from a grid."""

from __future__ import annotations

import random

from knotopt.diagram.grid import GridDiagram
from knotopt.search.annealing import DRAWN, NOTHING, make_move
from knotopt.search.lines import lines_of, trace

MOST_MOVES = 3


def neighbour(diagram: GridDiagram, source: random.Random, widest: int) -> GridDiagram:
    """A grid of the same knot, up to `MOST_MOVES` moves away, of at most `widest` lines.

    Examples
    --------
    >>> from knotopt.diagram.families import torus_knot
    >>> neighbour(torus_knot(2, 3), random.Random(0), 7).size <= 7
    True
    """
    lines = lines_of(diagram, max(widest, diagram.size))
    trace(lines, diagram.size)
    state = [diagram.size, source.randrange(1, DRAWN), source.randrange(1, DRAWN)]
    for _ in range(source.randint(1, MOST_MOVES)):
        while make_move(lines, state, widest) == NOTHING:
            pass
    rows = slice(state[0])
    return GridDiagram(
        tuple(row + 1 for row in lines[0][rows]), tuple(row + 1 for row in lines[1][rows])
    )
