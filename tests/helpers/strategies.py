"""Hypothesis strategies for grid diagrams and cables."""

from __future__ import annotations

from hypothesis import strategies as st

from knotopt.cable.cable import Cable
from knotopt.cable.cut import crossing_free_cuts
from knotopt.diagram.families import random_knot
from knotopt.diagram.grid import GridDiagram
from knotopt.planar.from_grid import planar_diagram
from knotopt.planar.planar_diagram import PlanarDiagram


def diagrams(min_size: int = 2, max_size: int = 9) -> st.SearchStrategy[GridDiagram]:
    return st.builds(random_knot, st.integers(min_size, max_size), st.integers(0, 2**32))


@st.composite
def cables(draw: st.DrawFn, min_size: int = 2, max_size: int = 9) -> Cable:
    diagram = draw(diagrams(min_size, max_size))
    return Cable(diagram, draw(st.sampled_from(crossing_free_cuts(diagram))))


def planar_diagrams(max_size: int = 12) -> st.SearchStrategy[PlanarDiagram]:
    """Diagrams of grids: up to 60 crossings and more, with kinks and summands among them."""
    return diagrams(max_size=max_size).map(planar_diagram)
