"""The stored grids: of the right knot, and as good as they say, counted from the grid alone."""

from __future__ import annotations

from importlib.util import find_spec

import pytest

from knotopt.cable.alexander import alexander_polynomial
from knotopt.cable.cable import Cable
from knotopt.cable.cut import crossing_free_cuts
from knotopt.catalogue.knots import shipped_knots
from knotopt.catalogue.stored_grids import GRIDS, StoredGrid, stored_grids
from knotopt.diagram.grid import GridDiagram
from knotopt.errors import UnknownKnotError
from knotopt.planar.from_grid import planar_diagram
from knotopt.planar.signature import signature
from knotopt.reading.knot import read_knot
from knotopt.search.budget import Budget
from knotopt.search.search import search_grids
from knotopt.supports.requirements import Requirements
from knotopt.supports.search import best_supports
from tests.helpers.snappy_invariants import invariants

NO_TWO_ARCS = 42
"""Knots for whose two-arc crossing number more than their crossing number was found."""


def fewest_robots(diagram: GridDiagram) -> int:
    """Of the best cut: loops in the order in which they close, each pierced as late as can be."""
    fewest = 2 * diagram.size
    for cut in crossing_free_cuts(diagram):
        cable = Cable(diagram, cut)
        robots, last = 2, -1
        for crossing in sorted(cable.crossings, key=lambda each: each.second):
            if crossing.first > last:
                last = max(time for time in cable.times.tolist() if time < crossing.second)
                assert last > crossing.first
                robots += 1
        fewest = min(fewest, robots)
    return fewest


def stored(name: str) -> list[StoredGrid]:
    return [grid for (_, each), grid in stored_grids().items() if each == name]


def test_every_knot_has_every_grid() -> None:
    assert set(stored_grids()) == {(knot, name) for knot in shipped_knots() for name in GRIDS}


@pytest.mark.parametrize("name", GRIDS)
def test_they_are_of_their_knots(name: str) -> None:
    """By Alexander polynomial, and by signature, which tells most knots from mirror images."""
    for grid in stored(name):
        knot = shipped_knots()[grid.knot]
        assert alexander_polynomial(Cable(grid.diagram, "L+")) == knot.alexander, grid.knot
        assert signature(planar_diagram(grid.diagram)) == knot.signature, grid.knot


@pytest.mark.slow
@pytest.mark.parametrize("name", GRIDS)
def test_they_are_of_their_knots_by_knot_floer_homology(name: str) -> None:
    for grid in stored(name):
        expected = invariants(shipped_knots()[grid.knot].diagram)
        assert invariants(grid.diagram) == expected, grid.knot


def test_robots_and_crossings_of_those_that_few_robots_lay() -> None:
    excess = {}
    for name in ("best3", "best4"):
        for grid in stored(name):
            assert fewest_robots(grid.diagram) == grid.robots <= int(name[-1]), grid.knot
            crossings = int(grid.diagram.crossing_cells.sum())
            excess[grid.knot, name] = crossings - shipped_knots()[grid.knot].crossing_number
    assert all(excess[knot, "best4"] == 0 for knot in shipped_knots())
    more = [knot for knot in shipped_knots() if excess[knot, "best3"]]
    assert len(more) == NO_TWO_ARCS and {"8_16", "8_18", "9_47", "10_164", "10_165"} <= set(more)
    assert not any(excess[knot, "best3"] < 0 for knot in shipped_knots())


def test_safe_sets_are_no_larger_at_smaller_r() -> None:
    for knot in shipped_knots():
        half, quarter = (stored_grids()[knot, name].robots for name in ("safe0.5", "safe0.25"))
        assert fewest_robots(stored_grids()[knot, "safe0.25"].diagram) <= quarter <= half


@pytest.mark.slow
@pytest.mark.parametrize("knot", ["3_1", "4_1", "7_2", "8_19", "9_47"])
def test_safe_sets_are_as_small_as_stored(knot: str) -> None:
    for openness in ("0.5", "0.25"):
        grid = stored_grids()[knot, f"safe{openness}"]
        best = best_supports(grid.diagram, Requirements("span", openness), canonical=False).best
        assert best.report.is_open and best.is_proven and best.robots == grid.robots


@pytest.mark.slow
@pytest.mark.skipif(find_spec("numba") is None, reason="needs numba, or many minutes")
@pytest.mark.parametrize("knot", ["3_1", "8_19", "10_132"])
def test_they_are_found_again(knot: str) -> None:
    grid = stored_grids()[knot, "best3"]
    search = search_grids(shipped_knots()[knot].diagram, Budget(grids=1), seed=grid.seed)
    while len(search.runs) < grid.runs:
        search = search_grids(search, Budget(grids=search.looked + 1))
    assert grid.diagram in [found.diagram for found in search.found]


def test_they_have_names() -> None:
    found = read_knot("8_19 best3")
    assert found.diagram == stored_grids()["8_19", "best3"].diagram and found.name == "8_19"
    assert read_knot("m8_19 best 3").diagram == found.diagram.mirrored
    assert read_knot("8_19 SAFE .25").diagram == stored_grids()["8_19", "safe0.25"].diagram
    assert read_knot("7 Var1 safe").diagram == stored_grids()["7_2", "safe0.5"].diagram
    assert "fewest crossings for at most 3 robots" in found.source
    with pytest.raises(UnknownKnotError, match="no grid best3 is stored of T"):
        read_knot("T(2,11) best3")
    with pytest.raises(UnknownKnotError, match="no knot is named '8_19 best5'"):
        read_knot("8_19 best5")
