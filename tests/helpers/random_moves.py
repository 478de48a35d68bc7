"""Random moves between grid diagrams of one knot."""

from __future__ import annotations

import random

from knotopt.diagram.grid import GridDiagram
from knotopt.diagram.moves import stabilise
from knotopt.diagram.walk import diagram_of, lists_of, walk


def moved_about(diagram: GridDiagram, seed: int, stabilisations: int = 3) -> GridDiagram:
    """The diagram stabilised at random places, with random commutations after each."""
    generator = random.Random(seed)
    for _ in range(stabilisations):
        column, row = generator.choice(diagram.marks)
        diagram = stabilise(diagram, column, row, generator.choice(["NE", "NW", "SE", "SW"]))
        lists = lists_of(diagram)
        walk(lists, 40 * diagram.size, generator, past_contractions=True)
        diagram = diagram_of(lists)
    return diagram
