"""Planar diagrams of grids: the closed knot of every cable, and KnotInfo's knot."""

from __future__ import annotations

from hypothesis import given

from knotopt.cable.cable import Cable
from knotopt.cable.notation import closed_diagram
from knotopt.catalogue.knots import shipped_knots
from knotopt.diagram.grid import GridDiagram
from knotopt.planar.from_grid import planar_diagram
from knotopt.planar.gauss import oriented_gauss_code
from knotopt.planar.signature import signature
from tests.helpers.strategies import diagrams


def rotations(grid: GridDiagram, cut: str) -> set[tuple[int, ...]]:
    """Oriented Gauss codes of the closed cable from each visit on: 4 crossing + 2 over + sign."""
    code, signs = oriented_gauss_code(closed_diagram(Cable(grid, cut)))
    found = set()
    for start in range(max(len(code), 1)):
        number: dict[int, int] = {}
        found.add(
            tuple(
                4 * number.setdefault(abs(entry), len(number)) + 2 * (entry > 0) + (sign > 0)
                for entry in code[start:] + code[:start]
                for sign in [signs[abs(entry) - 1]]
            )
        )
    return found


@given(diagrams(max_size=10))
def test_it_is_the_closed_cable(grid: GridDiagram) -> None:
    code, signs = oriented_gauss_code(planar_diagram(grid))
    own = tuple(
        4 * (abs(entry) - 1) + 2 * (entry > 0) + (signs[abs(entry) - 1] > 0) for entry in code
    )
    for cut in ("L+", "R+", "T+", "B+"):
        assert own in rotations(grid, cut)


def test_the_catalogues_grids_have_its_signatures() -> None:
    for name, knot in shipped_knots().items():
        assert signature(planar_diagram(knot.diagram)) == knot.signature, name
