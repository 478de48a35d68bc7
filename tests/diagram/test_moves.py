"""Cromwell moves keep the knot type, as SnapPy's packages see it."""

from __future__ import annotations

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from knotopt.diagram.families import random_knot, torus_knot
from knotopt.diagram.grid import GridDiagram
from knotopt.diagram.moves import (
    Symmetry,
    can_commute_columns,
    can_destabilise_column,
    can_destabilise_row,
    commute_columns,
    commute_rows,
    destabilise_column,
    destabilise_row,
    stabilise,
    transform,
    translate,
)
from knotopt.diagram.simplify import simplify
from knotopt.errors import GridError, MoveError
from tests.helpers.snappy_invariants import invariants, mirrored
from tests.helpers.strategies import diagrams

outside = settings(max_examples=40)
T34 = torus_knot(3, 4)


@outside
@given(diagrams(max_size=8), st.sampled_from(Symmetry))
def test_symmetries_keep_or_mirror(diagram: GridDiagram, symmetry: Symmetry) -> None:
    before = invariants(diagram)
    expected = mirrored(before) if symmetry.mirrors else before
    assert invariants(transform(diagram, symmetry)) == expected


@given(diagrams(), st.sampled_from(Symmetry), st.sampled_from(Symmetry))
def test_symmetries_are_a_group_of_eight(
    diagram: GridDiagram, first: Symmetry, second: Symmetry
) -> None:
    images = {transform(diagram, s) for s in Symmetry}
    assert transform(transform(diagram, first), second) in images
    assert len({transform(random_knot(9, 1), s) for s in Symmetry}) == 8


def test_a_quarter_turn_turns_counterclockwise() -> None:
    turned = transform(T34, Symmetry.QUARTER_TURN)
    assert set(turned.marks) == {(T34.size + 1 - r, c) for c, r in T34.marks}


@outside
@given(diagrams(max_size=8), st.integers(-9, 9), st.integers(-9, 9))
def test_translations(diagram: GridDiagram, columns: int, rows: int) -> None:
    moved = translate(diagram, columns, rows)
    assert invariants(moved) == invariants(diagram)
    assert translate(moved, -columns, -rows) == diagram
    size = diagram.size
    assert set(moved.marks) == {
        ((c - 1 + columns) % size + 1, (r - 1 + rows) % size + 1) for c, r in diagram.marks
    }


@outside
@given(diagrams(min_size=3, max_size=8), st.data())
def test_commutations(diagram: GridDiagram, data: st.DataObject) -> None:
    free = [c for c in range(1, diagram.size + 1) if can_commute_columns(diagram, c)]
    if free:
        column = data.draw(st.sampled_from(free))
        exchanged = commute_columns(diagram, column)
        assert invariants(exchanged) == invariants(diagram)
        assert commute_columns(exchanged, column) == diagram
    row = data.draw(st.integers(1, diagram.size))
    try:
        exchanged = commute_rows(diagram, row)
    except MoveError as error:
        assert "interleave" in str(error)
    else:
        assert invariants(exchanged) == invariants(diagram)


def test_commuting_interleaved_columns_is_refused_because_it_changes_the_knot() -> None:
    trefoil = torus_knot(2, 3)
    with pytest.raises(MoveError, match="columns 1 and 2 do not commute"):
        commute_columns(trefoil, 1)
    swapped = [((2, 1, *range(3, 6))[c - 1], r) for c, r in trefoil.marks]
    assert invariants(GridDiagram.from_marks(swapped)) != invariants(trefoil)


@outside
@given(
    diagrams(max_size=7),
    st.integers(0, 100),
    st.sampled_from(["NE", "NW", "SE", "SW"]),
)
def test_stabilisation_and_back(diagram: GridDiagram, mark: int, corner: str) -> None:
    column, row = diagram.marks[mark % len(diagram.marks)]
    larger = stabilise(diagram, column, row, corner)
    assert larger.size == diagram.size + 1
    assert invariants(larger) == invariants(diagram)
    block = {(column, row), (column + 1, row), (column, row + 1), (column + 1, row + 1)}
    missing = {
        "NE": (column + 1, row + 1),
        "NW": (column, row + 1),
        "SE": (column + 1, row),
        "SW": (column, row),
    }
    assert block - set(larger.marks) == {missing[corner]}
    short_row = row if corner[0] == "N" else row + 1
    short_column = column if corner[1] == "E" else column + 1
    assert destabilise_row(larger, short_row) == diagram
    assert destabilise_column(larger, short_column) == diagram


@outside
@given(diagrams(min_size=3, max_size=8))
def test_every_destabilisation(diagram: GridDiagram) -> None:
    before = invariants(diagram)
    for line in range(1, diagram.size + 1):
        for possible, move in (
            (can_destabilise_row, destabilise_row),
            (can_destabilise_column, destabilise_column),
        ):
            if possible(diagram, line):
                smaller = move(diagram, line)
                assert smaller.size == diagram.size - 1
                assert invariants(smaller) == before
            else:
                with pytest.raises(MoveError, match=f"{line} cannot be contracted"):
                    move(diagram, line)


@outside
@given(diagrams(max_size=9), st.integers(0, 3))
def test_simplify_keeps_the_knot_and_never_grows(diagram: GridDiagram, seed: int) -> None:
    simple = simplify(diagram, patience=500, seed=seed)
    assert simple.size <= diagram.size
    assert invariants(simple) == invariants(diagram)
    assert simplify(diagram, patience=500, seed=seed) == simple


@pytest.mark.parametrize(
    ("knot", "steps"), [(torus_knot(2, 3), 5), (T34, 7), (torus_knot(1, 1), 8)]
)
def test_simplify_undoes_a_scramble(knot: GridDiagram, steps: int) -> None:
    corners = ["NE", "NW", "SE", "SW"]
    scrambled = knot
    for step in range(steps):
        column, row = scrambled.marks[7 * step % len(scrambled.marks)]
        scrambled = stabilise(scrambled, column, row, corners[step % 4])
        for line in range(1, scrambled.size + 1):
            if can_commute_columns(scrambled, line):
                scrambled = commute_columns(scrambled, line)
    assert scrambled.size == knot.size + steps
    assert simplify(scrambled).size == knot.size


def test_simplify_at_the_arc_index_returns_the_diagram_itself() -> None:
    assert simplify(T34, patience=2000) is T34


def test_simplify_stabilises_where_commutations_lead_no_further() -> None:
    """13n_1922, whose arc index is 12, drawn from its PD code and walked down."""
    stuck = GridDiagram(
        (5, 1, 9, 10, 7, 11, 12, 3, 8, 2, 13, 6, 4), (11, 7, 4, 8, 12, 13, 6, 9, 1, 5, 3, 2, 10)
    )
    assert simplify(stuck, rounds=0) is stuck
    assert simplify(stuck, smallest=13) is stuck
    assert simplify(stuck).size == 12
    assert invariants(simplify(stuck)) == invariants(stuck)


@pytest.mark.parametrize(
    ("move", "message"),
    [
        (lambda: commute_columns(T34, 0), "column 0 is outside the grid of size 7"),
        (lambda: commute_rows(T34, 8), "row 8 is outside"),
        (lambda: destabilise_row(T34, 9), "row 9 is outside"),
        (lambda: can_destabilise_row(T34, 99), "row 99 is outside"),
        (lambda: can_destabilise_column(T34, 99), "column 99 is outside"),
        (lambda: can_commute_columns(T34, 8), "column 8 is outside"),
        (lambda: destabilise_column(T34, -1), "column -1 is outside"),
        (lambda: stabilise(T34, 1, 1, "NE"), r"no mark at \[1, 1\]"),
        (lambda: stabilise(T34, *T34.marks[0], "N"), "corner 'N': expected"),
    ],
)
def test_moves_that_do_not_exist(move: object, message: str) -> None:
    with pytest.raises(MoveError, match=message):
        move()  # type: ignore[operator]


@pytest.mark.parametrize(("p", "q"), [(2, 3), (2, -5), (3, 4), (-3, 5), (-2, -7), (1, 4)])
def test_torus_knots(p: int, q: int) -> None:
    found = invariants(torus_knot(p, q))
    degree = (abs(p) - 1) * (abs(q) - 1)  # twice the genus
    assert len(found.alexander) == degree + 1
    assert found == mirrored(invariants(torus_knot(p, -q)))
    # Positive torus knots have Murasugi's sigma(V + V^T) > 0 in Spherogram's sign.
    assert found.signature * p * q > 0 or degree == 0
    assert torus_knot(p, q).size == abs(p) + abs(q)


def test_torus_links_and_bad_sizes() -> None:
    with pytest.raises(GridError, match=r"T\(4,6\) is a link of 2 components"):
        torus_knot(4, 6)
    with pytest.raises(GridError, match="not 100000000001"):
        torus_knot(2, 99_999_999_999)
    with pytest.raises(GridError, match="must not be zero"):
        torus_knot(0, 1)
    with pytest.raises(GridError, match="size 2 to 10000, not 1"):
        random_knot(1, seed=0)


def test_random_knots_reach_every_diagram() -> None:
    """All 3 x 3 knot diagrams: 3! * 3! orders of columns and rows, each diagram from 3 of them."""
    drawn = {random_knot(3, seed) for seed in range(400)}
    assert len(drawn) == 12
