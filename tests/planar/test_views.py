"""Planar diagrams of curves in space: the knot, its chirality, and what is refused."""

from __future__ import annotations

import re

import numpy as np
import pytest
import spherogram
from hypothesis import given, settings
from hypothesis import strategies as st

from knotopt.arrays import FloatArray
from knotopt.catalogue.knots import shipped_knots
from knotopt.diagram.families import random_knot, torus_knot
from knotopt.diagram.grid import GridDiagram
from knotopt.diagram.lifted import lifted
from knotopt.planar.from_grid import planar_diagram
from knotopt.planar.planar_diagram import PlanarDiagram
from knotopt.planar.polygon import without_spare_corners
from knotopt.planar.views import CurveError, closed_view, open_view


def torus(p: int, q: int, count: int) -> FloatArray:
    """A torus knot, right-handed if p q < 0."""
    angle = np.linspace(0, 2 * np.pi, count, endpoint=False)
    radius = 2 + np.cos(q * angle)
    plan = radius * np.cos(p * angle), radius * np.sin(p * angle)
    return np.column_stack((*plan, np.sin(q * angle)))


def turned(points: FloatArray, seed: int) -> FloatArray:
    """The points turned in space, stretched and moved, the same knot."""
    generator = np.random.default_rng(seed)
    frame, _ = np.linalg.qr(generator.normal(size=(3, 3)))
    frame[0] *= np.linalg.det(frame)
    return points @ frame * generator.uniform(0.01, 100, size=(1, 1)) + generator.normal(size=3)


def jones(diagram: PlanarDiagram) -> str:
    """The Jones polynomial, which tells most knots from their mirror images."""
    link = spherogram.Link([list(crossing) for crossing in diagram.crossings])
    link.simplify("global")
    return str(link.jones_polynomial()) if link.crossings else "1"


def floer(diagram: PlanarDiagram) -> dict[object, object]:
    """Knot Floer homology: tells all small knots apart, and from their mirror images."""
    link = spherogram.Link([list(crossing) for crossing in diagram.crossings])
    link.simplify("global")
    if not link.crossings:
        return {(0, 0): 1}
    ranks: dict[object, object] = link.knot_floer_homology(complex=False)["ranks"]
    return ranks


def same_knot(a: PlanarDiagram, b: PlanarDiagram) -> bool:
    return floer(a) == floer(b)


@pytest.mark.parametrize("name", ["3_1", "4_1", "5_2", "6_1", "7_3", "8_19", "9_42", "10_124"])
def test_a_grid_in_space_is_its_knot_from_wherever_it_is_seen(name: str) -> None:
    grid = shipped_knots()[name].diagram
    wanted = planar_diagram(grid)
    assert closed_view(lifted(grid)).diagram.crossings  # lattice points: all is degenerate
    for seed in range(3):
        found = closed_view(turned(lifted(grid), seed)).diagram
        assert same_knot(found, wanted), (name, seed)


@pytest.mark.slow
@pytest.mark.parametrize("number", range(0, 249, 5))
def test_many_knots_in_space(number: int) -> None:
    grid = list(shipped_knots().values())[number].diagram
    wanted = floer(planar_diagram(grid))
    assert floer(closed_view(lifted(grid)).diagram) == wanted
    assert floer(closed_view(turned(lifted(grid), number)).diagram) == wanted


@settings(max_examples=25, deadline=None)
@given(st.integers(5, 12), st.integers(0, 10_000))
def test_random_knots_keep_their_type_when_corners_go(size: int, seed: int) -> None:
    grid = random_knot(size, seed)
    points = lifted(grid)
    kept = without_spare_corners(points, closed=True)
    assert len(kept) <= len(points)
    assert same_knot(closed_view(points).diagram, planar_diagram(grid))


@pytest.mark.parametrize("sign", [1, -1])
def test_thousands_of_points_become_a_few_crossings(sign: int) -> None:
    found = closed_view(torus(3, -5 * sign, 3000)).diagram
    assert len(found.crossings) <= 15
    assert same_knot(found, planar_diagram(torus_knot(3, 5 * sign)))


def test_features_of_any_size_count() -> None:
    """A trefoil a millionth of a millionth as large as the curve that it is tied in."""
    small = torus(2, -3, 60)[:-3] * 1e-12
    far = np.array([[1, 0, 0], [1, 5, 3], [-4, 2, 3]], dtype=float)
    for scale in (1e-200, 1.0, 1e140):
        view = closed_view(np.vstack((small, far)) * scale)
        assert view.diagram.signs == (1, 1, 1)


def test_a_random_walk_that_returns_is_a_small_diagram() -> None:
    steps = np.random.default_rng(1).normal(size=(300, 3))
    walk = (steps - steps.mean(axis=0)).cumsum(axis=0)
    assert len(closed_view(walk).diagram.crossings) < 30


def test_an_open_rope_is_closed_where_its_ends_share_a_face() -> None:
    """The ends of an overhand knot, led out of it."""
    knot = torus(2, -3, 60)[2:-2]
    ends = np.array([[3.0, -6, 0], [3.0, 6, 0]])
    view = open_view(np.vstack((ends[:1], knot, ends[1:])))
    assert view.direction == (0, 0, 1) and len(view.diagram.crossings) <= 5
    assert same_knot(view.diagram, closed_view(torus(2, -3, 60)).diagram)


def test_an_open_rope_keeps_what_is_led_past_its_ends() -> None:
    """A strand over an end cannot be drawn off: seen from above the ends are in two faces."""
    spiral = [(np.cos(a) * (1 + a), np.sin(a) * (1 + a), 0.1 * a) for a in np.linspace(0, 20, 200)]
    inner = [(0.0, 0.0, 9.0), (40.0, 1.0, 9.0)]
    view = open_view(np.array([*reversed(spiral), *inner]))
    assert jones(view.diagram) == "1"


def test_an_open_rope_whose_ends_stay_inside_is_refused() -> None:
    generator = np.random.default_rng(5)
    walk = generator.normal(size=(4000, 3))
    walk /= np.linalg.norm(walk, axis=1)[:, None]  # points on a ball: all of them near its rim
    walk[[0, -1]] *= 0.01
    with pytest.raises(CurveError, match="its two ends lie in one face"):
        open_view(walk[:60])


DEGENERATE = {
    "the points of the curve lie on one line": [[0, 0, 0], [1, 1, 1], [3, 3, 3], [2, 2, 2]],
    "meets itself, near points 1 and 2": [[0, 0, 0], [4, 0, 0], [2, 0, 0], [2, 2, 1]],
    "meets itself, near points 1 and 3": [[0, 0, 0], [2, 2, 0], [2, 0, 0], [0, 2, 0]],
}


@pytest.mark.parametrize("words", DEGENERATE)
def test_a_curve_that_is_no_knot_is_refused(words: str) -> None:
    with pytest.raises(CurveError, match=re.escape(words)):
        closed_view(np.array(DEGENERATE[words], dtype=float))


def test_flat_and_straight_pieces_are_no_trouble() -> None:
    square = np.array([[0, 0, 0], [1, 0, 0], [2, 0, 0], [2, 2, 0], [1, 2, 0], [0, 2, 0]])
    assert closed_view(square.astype(float)).diagram == PlanarDiagram(())
    staircase = np.array([[k // 2, (k + 1) // 2, 0] for k in range(20)] + [[-1, 9, 0]])
    assert closed_view(staircase.astype(float)).diagram == PlanarDiagram(())


def test_a_grid_of_two_lines_in_space_is_a_square() -> None:
    unknot = GridDiagram((1, 2), (2, 1))
    assert closed_view(lifted(unknot)).diagram == PlanarDiagram(())
