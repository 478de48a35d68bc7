"""Cromwell's moves on numbers against those on grid diagrams, which validate all they make."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from knotopt.diagram import moves
from knotopt.diagram.families import random_knot
from knotopt.diagram.grid import GridDiagram
from knotopt.search import lines as numbers
from knotopt.search.annealing import NOTHING, make_move

GRIDS = st.builds(random_knot, st.integers(3, 9), st.integers(0, 10**6))


def grid_of(lines: numbers.Lines, size: int) -> GridDiagram:
    """The grid; that its marks by row and its places agree with those by column is checked."""
    minus, plus, minus_line, plus_line, place, cross_place = lines
    for column in range(size):
        assert minus_line[minus[column]] == column == plus_line[plus[column]]
        assert cross_place[plus[column]] == (place[column] + 1) % (2 * size)
        assert cross_place[minus[column]] == (place[column] - 1) % (2 * size)
    return GridDiagram(
        tuple(row + 1 for row in minus[:size]), tuple(row + 1 for row in plus[:size])
    )


def traced(diagram: GridDiagram, room: int = 1) -> numbers.Lines:
    lines = numbers.lines_of(diagram, diagram.size + room)
    numbers.trace(lines, diagram.size)
    return lines


@given(GRIDS, st.integers(0, 8), st.booleans())
def test_commutations(diagram: GridDiagram, line: int, of_rows: bool) -> None:
    line %= diagram.size
    lines = traced(diagram)
    view = numbers.transposed(lines) if of_rows else lines
    move = moves.commute_rows if of_rows else moves.commute_columns
    if numbers.commute(view, diagram.size, line):
        assert grid_of(lines, diagram.size) == move(diagram, line + 1)
        assert numbers.commute(view, diagram.size, line), "a commutation undoes itself"
    else:
        with pytest.raises(moves.MoveError):
            move(diagram, line + 1)
    assert grid_of(lines, diagram.size) == diagram


@given(GRIDS, st.integers(0, 8), st.integers(0, 8))
def test_translations(diagram: GridDiagram, columns: int, rows: int) -> None:
    lines, size = traced(diagram), diagram.size
    numbers.translate(lines, size, columns % size, rows % size)
    numbers.invert(lines, size)
    numbers.trace(lines, size)
    assert grid_of(lines, size) == moves.translate(diagram, columns % size, rows % size)


@given(GRIDS, st.integers(0, 8), st.integers(0, 3), st.booleans())
def test_stabilisations(diagram: GridDiagram, column: int, corner: int, of_plus: bool) -> None:
    lines, size, column = traced(diagram), diagram.size, column % diagram.size
    numbers.stabilise(lines, size, column, corner, of_plus)
    numbers.invert(lines, size + 1)
    numbers.trace(lines, size + 1)
    row = (diagram.plus if of_plus else diagram.minus)[column]
    name = "NS"[corner < 2] + "WE"[corner % 2]
    expected = moves.stabilise(diagram, column + 1, row, name)  # type: ignore[arg-type]
    assert grid_of(lines, size + 1) == expected


@given(GRIDS, st.integers(0, 8), st.booleans())
def test_destabilisations(diagram: GridDiagram, first: int, of_columns: bool) -> None:
    lines, size = traced(diagram), diagram.size
    view = numbers.transposed(lines) if of_columns else lines
    can, move = moves.can_destabilise_row, moves.destabilise_row
    if of_columns:
        can, move = moves.can_destabilise_column, moves.destabilise_column
    order = [(first + k) % size + 1 for k in range(size)]
    line = next((line for line in order if can(diagram, line)), None)
    assert numbers.destabilise(view, size, first % size) == (line is not None)
    if line is not None:
        numbers.invert(view, size - 1)
        numbers.trace(lines, size - 1)
        assert grid_of(lines, size - 1) == move(diagram, line)


@given(GRIDS, st.integers(1, 2**31 - 300), st.integers(0, 3))
def test_moves_drawn_keep_the_numbers_together(diagram: GridDiagram, drawn: int, room: int) -> None:
    lines, widest = traced(diagram, room), diagram.size + room
    state = [diagram.size, drawn, drawn]
    for _ in range(60):
        before = grid_of(lines, state[0])
        if make_move(lines, state, widest) == NOTHING:
            assert grid_of(lines, state[0]) == before
        assert 2 <= state[0] <= widest
        grid_of(lines, state[0])
