"""Crossings and fewest robots against their definitions."""

from __future__ import annotations

from itertools import combinations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from knotopt.cable.cable import Cable
from knotopt.cable.cut import crossing_free_cuts
from knotopt.catalogue.table1_grids import table1_grids
from knotopt.diagram.families import random_knot
from knotopt.diagram.grid import GridDiagram
from knotopt.search.run import counted


def robots_by_definition(diagram: GridDiagram) -> int:
    """Subsets in the order of size until one has a turning point on every loop of some cut."""
    loops_of_cuts = []
    for cut in crossing_free_cuts(diagram):
        cable = Cable(diagram, cut)
        times = cable.times.tolist()
        loops_of_cuts.append(
            [
                {k for k, time in enumerate(times) if crossing.first < time < crossing.second}
                for crossing in cable.crossings
            ]
        )
    points = range(1, 2 * diagram.size - 1)
    return 2 + next(
        count
        for count in range(len(points) + 1)
        for chosen in map(set, combinations(points, count))
        if any(all(chosen & loop for loop in loops) for loops in loops_of_cuts)
    )


@given(st.integers(2, 8), st.integers(0, 10**6))
def test_random_grids(size: int, seed: int) -> None:
    diagram = random_knot(size, seed)
    found = counted(diagram)
    assert found.crossings == diagram.crossing_cells.sum()
    assert found.robots == robots_by_definition(diagram)


@pytest.mark.parametrize(
    ("row", "robots"), [("3", 3), ("4", 3), ("5", 3), ("7 Var1", 3), ("7 Var2", 4), ("9", 3)]
)
def test_rows_of_table_1(row: str, robots: int) -> None:
    for grid in table1_grids():
        if grid.row == row and grid.preferred:
            assert counted(grid.diagram).robots == robots
