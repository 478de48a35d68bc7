"""What is said of the number of robots: each number by another way to it."""

from __future__ import annotations

from itertools import combinations

import pytest

from knotopt.cable.cable import Cable
from knotopt.cable.cut import crossing_free_cuts
from knotopt.catalogue.knots import shipped_knots
from knotopt.errors import UnknownKnotError
from knotopt.reading.knot import read_knot
from knotopt.sandwich.answer import Answer, answer
from knotopt.sandwich.known import flown_team, known_of_knot
from knotopt.search.budget import Budget
from knotopt.verify.loops import check_loops
from knotopt.verify.registry import DEFINITIONS

FEW = Budget(grids=20_000)


@pytest.fixture(scope="module", params=["3", "m4_1", "T(2,7)", "3_1#4_1", "0_1"])
def found(request: pytest.FixtureRequest) -> Answer:
    return answer(read_knot(request.param), budget=FEW)


def test_each_number_by_another_way(found: Answer) -> None:
    diagram = found.named.diagram
    needed = {"3_1": 3, "m4_1": 4, "T(2,7)": 3, "3_1#4_1": 4, "0_1": 2}[found.named.name]
    assert found.known.needed.robots == needed
    fewest = min(
        next(
            len(chosen) + 2
            for size in range(len(path))
            for chosen in combinations(range(2, len(path)), size)
            if check_loops(path, diagram.size, chosen).is_open
        )
        for path in (Cable(diagram, cut).path for cut in crossing_free_cuts(diagram))
    )
    assert found.laid.robots == fewest
    safe = found.safe
    assert safe is not None
    check = DEFINITIONS["span"].checker(with_loops=True)
    asked = safe.requirements
    report = check(
        safe.cable.path, safe.cable.diagram.size, safe.supports, asked.openness, asked.threading
    )
    assert report.is_open and safe.robots >= found.known.needed.robots
    assert found.baseline == 2 * diagram.size


def test_settled_where_as_few_fly_as_are_needed(found: Answer) -> None:
    settled = {"3_1": True, "m4_1": True, "T(2,7)": None, "3_1#4_1": False, "0_1": True}
    expected = settled[found.named.name]
    if expected is not None:
        assert found.is_settled is expected


def test_a_mirror_image_has_the_same_team() -> None:
    for name in ("3_1", "4_1", "5_1"):
        assert known_of_knot([name]) == known_of_knot([f"m{name}"])
    assert known_of_knot(["5_1", "10_132"]).flown is None
    assert known_of_knot(["5_1", "10_132"]).needed.robots == 3


def test_needed_of_the_catalogue() -> None:
    three = [name for name in shipped_knots() if known_of_knot([name]).needed.robots == 3]
    assert three == ["3_1", "5_1", "7_1", "9_1"]


def test_a_knot_in_no_table_is_no_unknot() -> None:
    """The pretzel knot P(-3, 5, 7) has Alexander polynomial 1."""
    twists = (-3, 5, 7)
    from spherogram import RationalTangle

    tangle = RationalTangle(1, twists[0]) + RationalTangle(1, twists[1])
    link = (tangle + RationalTangle(1, twists[2])).numerator_closure()
    found = answer(read_knot(link), budget=FEW)
    assert found.identified.candidates == () and found.identified.invariants.alexander == (1,)
    assert found.known.needed.robots == 4 and not found.is_unknot and not found.is_settled


def test_a_torus_knot_beyond_the_tables_is_known_by_its_name() -> None:
    found = answer(read_knot("T(2,15)"), budget=Budget(grids=100))
    assert (found.identified.candidates, found.known) == ((), known_of_knot(["T(2,15)"]))


def test_an_unknot_is_settled_on_any_diagram() -> None:
    marks = [[1, 3], [1, 5], [2, 1], [2, 4], [3, 1], [3, 2], [4, 2], [4, 3], [5, 4], [5, 5]]
    found = answer(read_knot(marks), budget=FEW)
    assert found.is_unknot and found.is_settled and found.laid.robots == 3


def test_a_flown_team_says_which_of_two_mirror_images_it_ties() -> None:
    assert flown_team(read_knot("3_1").diagram)[1:] == ("3_1", False)
    assert flown_team(read_knot("m3_1").diagram)[1:] == ("3_1", True)
    with pytest.raises(UnknownKnotError, match="no team is known to tie 10_165"):
        flown_team(read_knot("10_165").diagram)
