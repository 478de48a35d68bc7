"""Connected sums of grids, and back to the summands."""

from __future__ import annotations

import random

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from knotopt.catalogue.knots import PrimeKnot, shipped_knots
from knotopt.diagram.families import torus_knot
from knotopt.diagram.grid import GridDiagram
from knotopt.diagram.moves import commute_columns, commute_rows, stabilise
from knotopt.diagram.sums import connected_sum, split_sum
from knotopt.errors import GridError, MoveError
from tests.helpers.snappy_invariants import invariants, mirrored
from tests.helpers.strategies import diagrams

KNOTS = [knot for knot in shipped_knots().values() if 3 <= knot.crossing_number <= 6]


@settings(max_examples=40)
@given(diagrams(max_size=8))
def test_the_mirror_image(diagram: GridDiagram) -> None:
    assert invariants(diagram.mirrored) == mirrored(invariants(diagram))
    assert diagram.mirrored.mirrored == diagram


@settings(max_examples=40)
@given(st.lists(diagrams(max_size=7), min_size=1, max_size=3))
def test_signatures_add_and_polynomials_multiply(grids: list[GridDiagram]) -> None:
    total = connected_sum(grids)
    assert total.size == sum(grid.size for grid in grids) - 2 * (len(grids) - 1)
    found, parts = invariants(total), [invariants(grid) for grid in grids]
    assert found.signature == sum(part.signature for part in parts)
    at_7 = [sum(c * 7**k for k, c in enumerate(part.alexander)) for part in parts]
    product = 1
    for value in at_7:
        product *= value
    assert sum(c * 7**k for k, c in enumerate(found.alexander)) == product


def test_homology_of_a_sum_is_the_product() -> None:
    """By the Kunneth formula (Ozsvath and Szabo, doi:10.1016/j.aim.2003.05.001)."""
    right, left = torus_knot(2, 3), torus_knot(2, -3)
    square, granny = (invariants(connected_sum([right, other])).ranks for other in (left, right))
    assert sum(square.values()) == sum(granny.values()) == 9
    assert square == {(-a, -m): rank for (a, m), rank in square.items()} != granny


def test_orientations_agree_along_the_sum() -> None:
    """What is above keeps the direction of each of its columns."""
    one, two = torus_knot(3, 4), torus_knot(2, 5)
    for above in (one, one.reversed):
        for below in (two, two.reversed):
            total = connected_sum([above, below])
            columns = set(zip(total.minus, total.plus, strict=True))
            shift = below.size - 2
            for low, high in zip(above.minus, above.plus, strict=True):
                assert 1 in (low, high) or (low + shift, high + shift) in columns
            for low, high in zip(below.minus, below.plus, strict=True):
                assert below.size in (low, high) or (low, high) in columns


def test_a_sum_of_none() -> None:
    with pytest.raises(GridError, match="at least one grid diagram"):
        connected_sum([])
    grid = torus_knot(2, 3)
    assert connected_sum([grid]) is grid


def scrambled(diagram: GridDiagram, seed: int) -> GridDiagram:
    """Two stabilisations and many commutations away."""
    generator = random.Random(seed)
    for _ in range(2):
        column, row = generator.choice(diagram.marks)
        diagram = stabilise(diagram, column, row, generator.choice(("NE", "NW", "SE", "SW")))
    for _ in range(400):
        move = generator.choice((commute_columns, commute_rows))
        try:
            diagram = move(diagram, generator.randint(1, diagram.size))
        except MoveError:
            continue
    return diagram


@settings(max_examples=8)
@given(st.lists(st.sampled_from(KNOTS), min_size=2, max_size=3), st.integers(0, 9))
def test_summands_are_recovered(knots: list[PrimeKnot], seed: int) -> None:
    total = connected_sum([knot.diagram for knot in knots])
    found = split_sum(scrambled(total, seed))
    assert sorted(invariants(part).alexander for part in found) == sorted(
        knot.alexander for knot in knots
    )
    assert sorted(part.size for part in found) == sorted(knot.diagram.size for knot in knots)
    signatures = sorted(invariants(part).signature for part in found)
    assert signatures == sorted(invariants(knot.diagram).signature for knot in knots)


@pytest.mark.parametrize("name", ["3_1", "4_1", "8_19", "10_123"])
def test_prime_knots_stay_whole(name: str) -> None:
    diagram = shipped_knots()[name].diagram
    assert [part.size for part in split_sum(diagram)] == [diagram.size]


def test_the_unknot_is_one_summand() -> None:
    assert [part.size for part in split_sum(torus_knot(1, 6))] == [2]
