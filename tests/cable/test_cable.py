"""Cables: cuts, crossings, arcs and staircases."""

from __future__ import annotations

from dataclasses import FrozenInstanceError
from itertools import pairwise

import pytest
from hypothesis import given

from benchmarks.lcf_by_definition import lay
from knotopt.cable.cable import Cable
from knotopt.cable.cut import OUTER_CUTS, Cut, crossing_free_cuts
from knotopt.cable.staircase import find_staircases
from knotopt.catalogue.knots import shipped_knots
from knotopt.catalogue.table1_grids import table1_grids
from knotopt.diagram.families import torus_knot
from knotopt.diagram.grid import GridDiagram
from knotopt.errors import CutError
from tests.helpers.strategies import cables, diagrams

TREFOIL = torus_knot(2, 3)


@given(cables(max_size=12))
def test_the_path_is_the_traversal_opened_at_the_cut(cable: Cable) -> None:
    loop = list(cable.diagram.traversal)
    if cable.cut.direction == "-":
        loop.reverse()
    start = loop.index(cable.path[0])
    assert list(cable.path) == loop[start:] + loop[:start]
    axis = 0 if cable.cut.axis == "column" else 1
    assert cable.path[0][axis] == cable.path[-1][axis] == cable.cut.index


@given(cables(max_size=12))
def test_crossings_are_the_cells_visited_twice(cable: Cable) -> None:
    cells = lay(list(cable.path))
    assert [tuple(cell) for cell in cable.cells.tolist()] == cells
    assert cable.length == len(cells) - 1
    for k, point in enumerate(cable.path):
        assert cells[cable.times[k]] == point
    twice = {cell for cell in cells if cells.count(cell) == 2}
    assert {(c.column, c.row) for c in cable.crossings} == twice
    assert all(cells.count(cell) <= 2 for cell in cells)
    for crossing in cable.crossings:
        assert cells[crossing.first] == cells[crossing.second] == (crossing.column, crossing.row)
        assert crossing.first < crossing.second
        # Columns pass over: the over visit is the one along the column.
        first_along_column = cells[crossing.first + 1][0] == crossing.column
        assert crossing.first_over == first_along_column
    firsts = [crossing.first for crossing in cable.crossings]
    assert firsts == sorted(firsts)


@given(cables(max_size=10))
def test_arcs_tile_the_cable(cable: Cable) -> None:
    arcs = cable.arcs
    assert len(arcs) == 2 * len(cable.crossings) + 1
    assert arcs[0].start == 0 and arcs[-1].end == cable.length
    for before, after in pairwise(arcs):
        assert before.end == after.start and before.crossings[1] == after.crossings[0]
    assert [k for arc in arcs for k in arc.turning_points] == list(range(1, len(cable.path) + 1))
    for arc in arcs:
        assert all(arc.start <= cable.times[k - 1] <= arc.end for k in arc.turning_points)
    assert arcs[0].crossings[0] is None and arcs[-1].crossings[1] is None


@given(diagrams(max_size=10))
def test_reversing_the_cut_reverses_the_cable_and_keeps_the_signs(diagram: GridDiagram) -> None:
    forward, backward = Cable(diagram, "B+"), Cable(diagram, "B-")
    assert forward.path == backward.path[::-1]
    signs = {(c.column, c.row): c.sign for c in forward.crossings}
    assert {(c.column, c.row): c.sign for c in backward.crossings} == signs


@given(diagrams(max_size=10))
def test_crossing_free_cuts(diagram: GridDiagram) -> None:
    cuts = crossing_free_cuts(diagram)
    assert tuple(str(cut) for cut in cuts[:8]) == OUTER_CUTS
    every = [f"{line}{k}+" for line in ("col", "row") for k in range(1, diagram.size + 1)]
    free = {str(cut) for cut in cuts}
    for name in every:
        cut = Cut.parse(name, diagram.size)
        if str(cut) in free:
            assert len(Cable(diagram, cut).crossings) == len(Cable(diagram, "L+").crossings)
        else:
            with pytest.raises(CutError, match=r"carries .* crossing"):
                Cable(diagram, cut)


def test_a_fifth_crossing_free_segment() -> None:
    """KnotInfo's grids up to 8 crossings have exactly one: 282 pairs instead of 280."""
    inner = {
        knot.name: [str(cut) for cut in crossing_free_cuts(knot.diagram) if not cut.is_outer]
        for knot in shipped_knots().values()
        if knot.crossing_number <= 8
    }
    ((first, second),) = [cuts for cuts in inner.values() if cuts]
    assert first[:-1] == second[:-1] and {first[-1], second[-1]} == {"+", "-"}


@pytest.mark.parametrize(
    ("name", "message"),
    [
        ("X+", "no cut is named 'X\\+': expected one of L\\+, L-"),
        ("L", "no cut is named 'L'"),
        ("col9+", "cut at column 9: outside the grid of size 5"),
        ("row0-", "cut at row 0: outside"),
    ],
)
def test_bad_cut_names(name: str, message: str) -> None:
    with pytest.raises(CutError, match=message):
        Cut.parse(name, 5)


def test_bad_cuts() -> None:
    with pytest.raises(CutError, match="not at 'diagonal'"):
        Cut("diagonal", 1, "+", 5)  # type: ignore[arg-type]
    with pytest.raises(CutError, match="direction '0'"):
        Cut("row", 1, "0", 5)  # type: ignore[arg-type]


def test_cuts_with_crossings_and_of_other_grids() -> None:
    with pytest.raises(CutError, match=r"the segment in column 3 carries 1 crossing.*: L\+, L-"):
        Cable(TREFOIL, "col3+")
    with pytest.raises(CutError, match="of a grid of size 7, not 5"):
        Cable(TREFOIL, Cut.parse("L+", 7))
    assert Cut.parse(" l+ ", 5) == Cut.parse("col1+", 5)


def test_cables_are_frozen() -> None:
    cable = Cable(TREFOIL, "L+")
    with pytest.raises(FrozenInstanceError):
        cable.cut = cable.cut  # type: ignore[misc]
    for array in (cable.points, cable.times, cable.cells, cable.crossings.sign):
        with pytest.raises(ValueError, match="read-only"):
            array[0] = 0
    assert cable == Cable(TREFOIL, "L+") and len({cable, Cable(TREFOIL, "L+")}) == 1


def test_staircases_where_the_paper_sees_them() -> None:
    """The paper names rows 5, 7 (Var. 1) and 9: those alone have runs of 4 crossings or more."""
    longest = {
        grid.row: max(len(run) for run in find_staircases(Cable(grid.diagram, "L+"), 2))
        for grid in table1_grids()
        if grid.preferred
    }
    assert longest == {"3": 3, "4": 2, "5": 5, "7 Var1": 5, "7 Var2": 2, "9": 7}


@given(cables(max_size=12))
def test_staircases_are_maximal_diagonal_runs(cable: Cable) -> None:
    cells = {(c.column, c.row) for c in cable.crossings}
    runs = find_staircases(cable, min_length=2)
    for run in runs:
        places = [(cable.crossings[k].column, cable.crossings[k].row) for k in run.crossings]
        step = 1 if run.direction == "rising" else -1
        (c, r), length = places[0], len(run)
        assert places == [(c + k, r + step * k) for k in range(length)]
        assert (c - 1, r - step) not in cells and (c + length, r + step * length) not in cells
    assert [len(run) for run in runs] == sorted((len(run) for run in runs), reverse=True)
    diagonal = sum((c + 1, r + s) in cells for c, r in cells for s in (1, -1))
    assert diagonal == sum(len(run) - 1 for run in runs)


def test_a_staircase_that_is_no_twist() -> None:
    """In the 3-strand braid of T(3,4) neighbours on the diagonal are not joined twice."""
    assert not find_staircases(Cable(torus_knot(3, 4), "L+"), 2)[0].is_twist
    assert find_staircases(Cable(torus_knot(2, 7), "L+"))[0].is_twist
