"""Random moves between grid diagrams of one knot."""

from __future__ import annotations

import random

from knotopt.diagram.grid import GridDiagram
from knotopt.diagram.simplify import stirred


def moved_about(diagram: GridDiagram, seed: int, times: int = 1) -> GridDiagram:
    """The diagram stabilised at random places, with random commutations, so many times over."""
    generator = random.Random(seed)
    for _ in range(times):
        diagram = stirred(diagram, generator)
    return diagram
