"""Loops and bigons that are taken off leave the knot."""

from __future__ import annotations

from hypothesis import given, settings
from hypothesis import strategies as st

from knotopt.diagram.families import random_knot
from knotopt.planar.from_grid import planar_diagram
from knotopt.planar.loosened import loosened
from knotopt.planar.planar_diagram import PlanarDiagram
from tests.planar.test_views import floer


@settings(max_examples=40, deadline=None)
@given(st.integers(4, 16), st.integers(0, 10_000))
def test_the_knot_stays(size: int, seed: int) -> None:
    diagram = planar_diagram(random_knot(size, seed))
    found = loosened(diagram)
    assert len(found.crossings) <= len(diagram.crossings)
    assert floer(found) == floer(diagram)
    assert loosened(found) == found


def test_a_fifth_of_a_random_grid_s_crossings_goes() -> None:
    diagram = planar_diagram(random_knot(30, 1))
    assert 5 * len(loosened(diagram).crossings) < 4 * len(diagram.crossings)


def test_a_diagram_without_loops_is_itself() -> None:
    trefoil = PlanarDiagram(((0, 4, 1, 3), (2, 0, 3, 5), (4, 2, 5, 1)))
    assert loosened(trefoil) is trefoil
    assert loosened(PlanarDiagram(((0, 0, 1, 1),))) == PlanarDiagram(())
