"""Searches over grids: the same knot, the same every time, gone on with, compiled or not."""

from __future__ import annotations

from importlib.util import find_spec

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from knotopt.catalogue.knots import shipped_knots
from knotopt.diagram.families import random_knot, torus_knot
from knotopt.errors import RequirementError
from knotopt.search import run as single
from knotopt.search.budget import Budget
from knotopt.search.found import FoundGrid, front
from knotopt.search.run import counted, run
from knotopt.search.search import GridSearch, search_grids
from tests.helpers.snappy_invariants import invariants


@pytest.fixture(autouse=True)
def short_runs(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(single, "STEPS", 300)
    monkeypatch.setattr(single, "can_compile", lambda: False)


@pytest.mark.parametrize("name", ["3_1", "4_1", "5_2", "7_7", "8_19", "9_47", "10_161"])
def test_grids_found_are_of_the_same_knot(name: str) -> None:
    """Chirality included, by knot Floer homology."""
    diagram = shipped_knots()[name].diagram
    search = search_grids(diagram, Budget(grids=4000), seed=3)
    expected = invariants(diagram)
    found = {each.diagram for each in search.found}
    assert len(found) > 3
    for each in found:
        assert invariants(each) == expected


@given(st.integers(2, 9), st.integers(0, 10**6))
@settings(max_examples=20)
def test_what_is_kept_of_a_run(size: int, seed: int) -> None:
    diagram = random_knot(size, seed)
    made = run(diagram, 0, seed, compile=False)
    assert (made.looked > 0 and counted(diagram) in made.found) or len(made.found) > 0
    for found in made.found:
        assert found == counted(found.diagram) and found.size <= size + single.ROOM
    given_grid = counted(diagram)
    same = [found for found in made.found if found.robots == given_grid.robots]
    assert same and same[0].counts <= given_grid.counts


@pytest.mark.slow
@pytest.mark.skipif(find_spec("numba") is None, reason="needs numba")
@pytest.mark.parametrize("diagram", [torus_knot(3, 4), random_knot(13, 5), random_knot(40, 2)])
def test_compiled_or_not_the_same_is_found(diagram: object) -> None:
    for number in (0, 1):
        compiled, plain = (
            run(diagram, number, 7, compile=compile)  # type: ignore[arg-type]
            for compile in (True, False)
        )
        assert compiled == plain


def test_grids_too_large_for_64_bits_are_searched_in_python(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.undo()
    monkeypatch.setattr(single, "STEPS", 10)
    made = run(random_knot(single.WIDEST, 1), 0)
    assert made.looked > 0 and made.found


def test_the_same_every_time_and_in_parts() -> None:
    diagram = shipped_knots()["7_6"].diagram
    whole = search_grids(diagram, Budget(grids=4000), seed=5)
    assert whole == search_grids(diagram, Budget(grids=4000), seed=5)
    part = search_grids(diagram, Budget(grids=1000), seed=5)
    assert len(part.runs) < len(whole.runs)
    assert search_grids(part, Budget(grids=4000)) == whole
    assert search_grids(diagram, Budget(grids=4000), seed=6).runs != whole.runs


def test_seconds_end_a_search_after_a_run_at_least() -> None:
    told: list[GridSearch] = []
    search = search_grids(torus_knot(2, 3), Budget(seconds=1e-9), progress=told.append)
    assert len(search.runs) == 1 and told == [search]


def test_ctrl_c_keeps_what_is_found(monkeypatch: pytest.MonkeyPatch) -> None:
    from knotopt.search import search as many

    def stopping(*arguments: object, **options: object) -> object:
        if arguments[1] == 2:
            raise KeyboardInterrupt
        return run(*arguments, **options)  # type: ignore[arg-type]

    monkeypatch.setattr(many, "run", stopping)
    assert len(search_grids(torus_knot(2, 3), Budget(seconds=100)).runs) == 2


def test_the_front() -> None:
    small, large = torus_knot(2, 3), torus_knot(2, 7)
    grids = [
        FoundGrid(5, 3, small),
        FoundGrid(4, 4, small),
        FoundGrid(4, 3, large),
        FoundGrid(3, 8, large),
        FoundGrid(6, 3, small),
    ]
    assert [each.counts for each in front(grids)] == [(3, 8, 9), (4, 3, 9), (5, 3, 5)]


@pytest.mark.parametrize("text", ["", "5", "s", "-1", "0", "0s", "1e9", "5 m", "nan s"])
def test_budgets(text: str) -> None:
    if text == "5":
        assert Budget.parse(text) == Budget(grids=5)
        return
    with pytest.raises(RequirementError, match="budget is"):
        Budget.parse(text)
    with pytest.raises(RequirementError, match="budget is"):
        Budget()
