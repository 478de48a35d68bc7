"""Simplification of a grid diagram by Cromwell's moves.

A random walk over commutations that contracts a row or column whenever one can be contracted. For
the unknot commutations and destabilisations are enough to reach the 2 x 2 grid (Dynnikov,
"Arc-presentations of links: monotonic simplification", doi:10.4064/fm190-0-3). For other knots the
diagrams of one size that commutations join may have no way down; there the diagram is stabilised,
walked about and contracted again, some rounds over.
"""

from __future__ import annotations

import random
from typing import get_args

from knotopt.diagram.grid import GridDiagram
from knotopt.diagram.moves import Corner, stabilise
from knotopt.diagram.walk import contract, diagram_of, lists_of, walk

STABILISATIONS = 2
"""In one round: after one alone, the walk more often comes back to where it was."""

SMALLEST_KNOTTED = 5
"""Size of a trefoil's grid; a smaller one is an unknot's."""


def simplify(
    diagram: GridDiagram,
    *,
    patience: int = 200,
    rounds: int = 16,
    smallest: int = 2,
    seed: int = 0,
) -> GridDiagram:
    """A diagram of the same knot, never larger than the one given.

    Parameters
    ----------
    diagram : GridDiagram
    patience : int
        Commutations tried without a contraction before a walk gives up, for each row of the grid.
    rounds : int
        Times that a diagram is stabilised and walked down again without becoming smaller before
        it is returned. With the defaults a grid of size 12 takes about 50 ms.
    smallest : int
        A size known to be the least possible (the arc index): the search ends there.
    seed : int
        Seed of the walks; the same seed gives the same diagram.

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

    def walked_down(larger: GridDiagram) -> GridDiagram:
        lists = lists_of(larger)
        contract(lists)
        while len(lists[0]) > smallest and walk(lists, patience * len(lists[0]), generator):
            contract(lists)
        return diagram_of(lists)

    here = best = walked_down(diagram)
    left = rounds
    while left and best.size > max(smallest, SMALLEST_KNOTTED):
        # Onward from where the last round ended, of the same size as the best but not the best.
        there = walked_down(stirred(here, generator, patience=patience))
        if there.size <= here.size:
            here = there
        if here.size < best.size:
            best, left = here, rounds
        else:
            left -= 1
    return best if best.size < diagram.size else diagram


def stirred(diagram: GridDiagram, generator: random.Random, *, patience: int = 200) -> GridDiagram:
    """The diagram stabilised at random marks, and after a walk that contracts nothing.

    Examples
    --------
    >>> from knotopt.diagram.families import torus_knot
    >>> stirred(torus_knot(2, 3), random.Random(1)).size
    7
    """
    for _ in range(STABILISATIONS):
        column, row = generator.choice(diagram.marks)
        diagram = stabilise(diagram, column, row, generator.choice(get_args(Corner)))
    lists = lists_of(diagram)
    walk(lists, patience * diagram.size, generator, past_contractions=True)
    return diagram_of(lists)
