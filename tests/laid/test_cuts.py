"""Clauses that cut sets off, and the smallest sets found with them, against trying all sets."""

from __future__ import annotations

import random
from collections.abc import Callable
from itertools import combinations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from formulations.solution import Status
from knotopt.cable.cable import Cable
from knotopt.cable.cut import Cut, crossing_free_cuts
from knotopt.catalogue.knots import shipped_knots
from knotopt.diagram.families import random_knot, torus_knot
from knotopt.diagram.grid import GridDiagram
from knotopt.errors import RequirementError
from knotopt.laid.cuts import clause
from knotopt.laid.laid import LaidTest
from knotopt.laid.smallest import LaidCuts, smallest_laid
from knotopt.reading.knot import read_knot
from knotopt.supports.by_size import sets_in_order
from knotopt.supports.requirements import Requirements
from knotopt.verify.laid import check_laid
from knotopt.verify.piercing import bare_loops
from knotopt.verify.registry import DEFINITIONS

Supports = tuple[int, ...]


def knotted_cable(source: random.Random, size: int) -> Cable:
    """Of a random grid that is no unknot, by its polynomial, cut anywhere."""
    while True:
        diagram = random_knot(size, source.randrange(2**32))
        cable = Cable(diagram, source.choice(crossing_free_cuts(diagram)))
        if len(LaidTest(cable).knot.alexander) > 1:
            return cable


def smallest_by_trying(cable: Cable, holds: Callable[[Supports], bool]) -> int:
    """Robots of the smallest set that holds, the smaller ones tried first."""
    points = range(2, len(cable.path))
    for size in range(len(points) + 1):
        if any(holds(supports) for supports in combinations(points, size)):
            return size + 2
    raise AssertionError("no set at all")


@given(st.integers(0, 2**32), st.integers(5, 8))
def test_a_clause_is_met_by_every_set_that_lays_the_knot(seed: int, size: int) -> None:
    source = random.Random(seed)
    cable = knotted_cable(source, size)
    test, points = LaidTest(cable), range(2, len(cable.path))
    for _ in range(3):
        supports = tuple(sorted(source.sample(points, source.randint(0, 4))))
        cut = clause(test, supports)
        assert (cut is None) == test.laid(supports).is_knot
        if cut is None:
            continue
        assert not any((literal > 0) == (abs(literal) in supports) for literal in cut)
        held = [-literal for literal in cut if literal < 0]
        free = [k for k in points if k not in cut and k not in held]
        for _ in range(5):
            others = source.sample(free, source.randint(0, len(free)))
            assert (
                not check_laid(cable.path, (*held, *others)).is_knot
                or not test.laid(tuple(sorted((*held, *others)))).is_knot
            )


@pytest.mark.slow
def test_smallest_sets_of_300_grids_by_trying_all() -> None:
    source = random.Random(300)
    found = []
    for number in range(300):
        cable = knotted_cable(source, 5 + number % 5)
        solution, _ = smallest_laid(cable)
        assert solution.status is Status.OPTIMAL and solution.chosen is not None
        best = smallest_by_trying(cable, lambda held, c=cable: check_laid(c.path, held).is_knot)
        assert len(solution.chosen) == best, (cable.diagram.marks, cable.cut)
        found.append(best)
    assert set(found) >= {3, 4}


@pytest.mark.parametrize("formulation", ["opening", "loops"])
def test_smallest_sets_that_are_laid_too(formulation: str) -> None:
    source = random.Random(7)
    check = DEFINITIONS[formulation].checker(with_loops=False)
    asked = Requirements(formulation)
    for number in range(12):
        cable = knotted_cable(source, 5 + number % 3)
        size = cable.diagram.size
        search = next(sets_in_order(cable.diagram, asked, cuts=[cable.cut], lacks=LaidCuts()))

        def holds(held: Supports, cable: Cable = cable, size: int = size) -> bool:
            report = check(cable.path, size, held, asked.openness, str(asked.threading))
            return report.is_open and LaidTest(cable).laid(held).is_knot

        assert search.is_proven
        assert search.best.robots == smallest_by_trying(cable, holds)
        assert holds(search.best.supports)


def test_what_laying_the_knot_costs_8_12() -> None:
    """Three robots hold every loop of its grid, and none of these sets lays the knot."""
    diagram = shipped_knots()["8_12"].diagram
    loops = Requirements("loops")
    without = next(sets_in_order(diagram, loops))
    search = next(sets_in_order(diagram, loops, lacks=LaidCuts()))
    assert (without.best.robots, without.cut_off) == (3, None)
    assert search.best.robots == 4 and search.is_proven
    assert search.cut_off
    for cut in crossing_free_cuts(diagram):
        cable = Cable(diagram, cut)
        for k in range(2, len(cable.path)):
            lays = LaidTest(cable).laid((k,)).is_knot
            assert bare_loops(cable.path, (k,)) or not lays


def test_where_nothing_fails_nothing_is_cut_off() -> None:
    search = next(sets_in_order(read_knot("9").diagram, Requirements("span"), lacks=LaidCuts()))
    assert (search.best.robots, search.cut_off) == (5, 0)


def test_no_set_is_left_where_none_may_lay_the_knot() -> None:
    diagram = torus_knot(2, 3)
    cable = Cable(diagram, "L+")
    asked = Requirements("opening", 0.001, forbidden=tuple(range(3, len(cable.path))))
    cuts = [Cut.parse("L+", diagram.size)]
    (search,) = sets_in_order(diagram, asked, cuts=cuts, lacks=LaidCuts())
    assert not search.best.found and search.status is Status.INFEASIBLE


def test_reflections_give_the_same_numbers() -> None:
    """Of columns, or of rows: columns stay over rows. Exchanged, other visits are the hooks."""
    for row in ("3", "4", "5"):
        diagram = read_knot(row).diagram
        last = diagram.size + 1
        for flips, names in (((True, False), "LR"), ((False, True), "BT"), ((True, True), "LRBT")):
            reflected = GridDiagram.from_marks(
                [
                    (last - column if flips[0] else column, last - level if flips[1] else level)
                    for column, level in diagram.marks
                ]
            )
            other = dict(zip(names, [names[k ^ 1] for k in range(len(names))], strict=True))
            numbers = [
                sorted(
                    len(smallest_laid(Cable(each, f"{side}{way}"))[0].chosen or ()) for way in "+-"
                )
                for each, side in (
                    pair
                    for side in "LRBT"
                    for pair in ((diagram, side), (reflected, other.get(side, side)))
                )
            ]
            assert numbers[::2] == numbers[1::2]


def test_clauses_name_turning_points() -> None:
    asked = Requirements(clauses=((3, -99),))
    with pytest.raises(RequirementError, match="p99: the cable's turning points are p1 to p10"):
        asked.check_points(10)
