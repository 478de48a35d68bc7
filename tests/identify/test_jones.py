"""The Jones polynomial against KnotInfo's, and what it is at 1 and -1."""

from __future__ import annotations

import json
from collections import Counter

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from knotopt.cable.alexander import determinant
from knotopt.catalogue.knots import shipped_knots
from knotopt.diagram.families import random_knot
from knotopt.identify.invariants import alexander
from knotopt.identify.jones import Polynomial, jones_polynomial, mirrored
from knotopt.planar.from_grid import planar_diagram
from knotopt.planar.planar_diagram import PlanarDiagram
from tests.helpers.random_moves import moved_about


def of_knotinfo(row: dict[str, str]) -> Polynomial:
    """The Euler characteristic of KnotInfo's reduced rational Khovanov homology."""
    polynomial: Counter[int] = Counter()
    for _, rank, height, degree in json.loads(row["khovanov_reduced_rational_vector"]):
        polynomial[degree // 2] += (-1) ** height * rank
    return {power: value for power, value in sorted(polynomial.items()) if value}


@pytest.mark.slow
def test_every_third_knot_of_knotinfo() -> None:
    from database_knotinfo import link_list

    _, _, *rows = link_list()
    for row in rows[::3]:
        planar = PlanarDiagram.from_edges(json.loads(row["pd_notation"]))
        assert jones_polynomial(planar) == of_knotinfo(row), row["name"]


def test_the_catalogue_s_grids_have_knotinfo_s_polynomials_and_their_mirror_images() -> None:
    from database_knotinfo import link_list

    rows = {row["name"]: row for row in link_list()}
    for name, knot in shipped_knots().items():
        expected = of_knotinfo(rows[name])
        assert jones_polynomial(planar_diagram(knot.diagram)) == expected, name
        assert jones_polynomial(planar_diagram(knot.diagram.mirrored)) == mirrored(expected), name


def test_small_diagrams() -> None:
    assert jones_polynomial(PlanarDiagram(())) == {0: 1}
    assert jones_polynomial(PlanarDiagram(((0, 0, 1, 1),))) == {0: 1}
    assert jones_polynomial(PlanarDiagram(((1, 0, 0, 1),))) == {0: 1}


@settings(max_examples=40)
@given(st.integers(4, 16), st.integers(0, 10**6))
def test_values_of_random_knots(size: int, seed: int) -> None:
    planar = planar_diagram(random_knot(size, seed))
    polynomial, alexander_polynomial = jones_polynomial(planar), alexander(planar)
    assert polynomial is not None and alexander_polynomial is not None
    assert sum(polynomial.values()) == 1
    at_minus_one = sum(-c if power % 2 else c for power, c in polynomial.items())
    assert abs(at_minus_one) == determinant(alexander_polynomial)
    moved = planar_diagram(moved_about(random_knot(size, seed), seed))
    assert jones_polynomial(moved) in (polynomial, None)


def test_too_wide_a_diagram_is_left_alone() -> None:
    assert jones_polynomial(planar_diagram(random_knot(60, 1))) is None
