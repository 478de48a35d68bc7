"""Smallest sets of supports: options against brute force, canonical choice, cuts and diagrams."""

from __future__ import annotations

import math
from dataclasses import replace
from fractions import Fraction
from itertools import combinations, pairwise
from types import SimpleNamespace
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from formulations.backends import BACKENDS
from formulations.solution import Limits, Status
from knotopt.cable.cable import Cable
from knotopt.cable.cut import crossing_free_cuts
from knotopt.catalogue.knots import shipped_knots
from knotopt.diagram.families import torus_knot
from knotopt.reading.knot import read_knot
from knotopt.supports.minimal import MinimalSupports, all_minimal, minimal_supports
from knotopt.supports.regions import Regions
from knotopt.supports.registry import FORMULATIONS
from knotopt.supports.requirements import Requirements
from knotopt.supports.search import best_supports, supports_by_cut
from knotopt.supports.team import compile_team
from knotopt.verify.opening import threading_cells
from knotopt.verify.regions import define_regions, lay
from knotopt.verify.registry import DEFINITIONS
from tests.helpers.strategies import cables

LENGTHS = st.none() | st.sampled_from([1.0, 1.5, 2.0, 3.0, 4.5, 6.0])


@st.composite
def requirements(draw: st.DrawFn, count: int, formulation: str) -> Requirements:
    points = st.integers(2, count - 1)
    forbidden = draw(st.sets(points, max_size=2))
    forced = draw(st.sets(points, max_size=2)) - forbidden
    return Requirements(
        formulation,
        Fraction(draw(st.sampled_from(["0.1", "0.5", "0.707", "1"]))),
        draw(st.sampled_from(["turning-point", "over-under"])),
        with_loops=draw(st.booleans()),
        separation=draw(LENGTHS),
        payload=draw(LENGTHS),
        reach=draw(LENGTHS),
        forbidden=tuple(forbidden),
        forced=tuple(forced),
    )


def examine(cable: Cable, asked: Requirements, supports: tuple[int, ...]) -> Fraction | None:
    """Smallest squared opening if the set does what is asked (a large number if any), else None."""
    check = DEFINITIONS[asked.formulation].checker(with_loops=asked.with_loops)
    size = cable.diagram.size
    report = check(cable.path, size, supports, asked.openness, asked.threading)
    robots = [1, *supports, len(cable.path)]
    if not report.is_open or not meets_options(cable, asked, robots):
        return None
    opening = report.smallest_opening_squared
    return Fraction(10**6) if opening is None else opening


def meets_options(cable: Cable, asked: Requirements, robots: list[int]) -> bool:
    """The optional families as README states them."""
    places = {k: cable.path[k - 1] for k in robots}
    if asked.separation is not None and any(
        math.dist(places[a], places[b]) < asked.separation for a, b in combinations(robots, 2)
    ):
        return False
    if asked.payload is not None and any(
        math.dist(places[a], places[b]) > asked.payload for a, b in pairwise(robots)
    ):
        return False
    if not set(asked.forced) <= set(robots) or set(asked.forbidden) & set(robots):
        return False
    return asked.reach is None or all(
        any(math.dist(cable.path[k - 1], q) <= asked.reach for k in helpers)
        for q, helpers in threadings(cable, asked, robots)
    )


def threadings(
    cable: Cable, asked: Requirements, robots: list[int]
) -> list[tuple[tuple[int, int], list[int]]]:
    """Each threading point and the robots that may help there."""
    cells = lay(cable.path)
    time = {k: cells.index(point) for k, point in enumerate(cable.path, 1)}
    found = []
    for region in define_regions(cable.path, cable.diagram.size):
        entries = set()
        for q in threading_cells(region, cable.path, cells, asked.threading):
            entry = cells.index(q)
            while cells[entry] in region.interior:
                entry -= 1
            if asked.formulation == "span" and entry in entries:
                continue
            entries.add(entry)
            other = next(t for t, cell in enumerate(cells) if cell == cells[entry] and t != entry)
            helpers = [max((k for k in robots if time[k] < cells.index(q)), key=time.__getitem__)]
            laid = [k for k in robots if time[k] < entry]
            if other < entry:
                helpers += [max((k for k in laid if time[k] < other), key=time.__getitem__)]
                helpers += sorted((k for k in laid if time[k] > other), key=time.__getitem__)[:1]
            found.append((q, helpers))
    return found


@settings(max_examples=60)
@given(cables(max_size=5), st.sampled_from(list(FORMULATIONS)), st.data())
def test_the_optimum_by_brute_force(cable: Cable, formulation: str, data: st.DataObject) -> None:
    assert_optimum_by_brute_force(cable, formulation, data)


@pytest.mark.slow
@settings(max_examples=40)
@given(
    st.sampled_from(["3_1", "4_1"]),
    st.integers(0, 7),
    st.sampled_from(list(FORMULATIONS)),
    st.data(),
)
def test_the_optimum_of_knots_by_brute_force(
    name: str, cut: int, formulation: str, data: st.DataObject
) -> None:
    diagram = read_knot(name).diagram
    cable = Cable(diagram, crossing_free_cuts(diagram)[cut])
    assert_optimum_by_brute_force(cable, formulation, data)


def assert_optimum_by_brute_force(cable: Cable, formulation: str, data: st.DataObject) -> None:
    """Smallest, then largest smallest opening, then lexicographically first, by trying all."""
    count = len(cable.path)
    asked = data.draw(requirements(count, formulation))
    candidates = {
        supports: opening
        for size in range(count - 1)
        for supports in combinations(range(2, count), size)
        for opening in [examine(cable, asked, supports)]
        if opening is not None
    }
    result = minimal_supports(cable, asked)
    if not candidates:
        assert result.solution.status is Status.INFEASIBLE and not result.found
        assert result.conflict and not result.is_proven
        return
    fewest = min(map(len, candidates))
    smallest = [supports for supports in candidates if len(supports) == fewest]
    widest = max(min(candidates[s], Fraction(1)) for s in smallest)
    first = min(s for s in smallest if min(candidates[s], Fraction(1)) == widest)
    assert result.is_proven and result.canonical
    assert result.supports == first and result.robots == fewest + 2
    assert set(all_minimal(result).sets) == set(smallest)


@settings(max_examples=40)
@given(cables(max_size=5), st.integers(2, 8))
def test_at_most_so_many_robots(cable: Cable, most: int) -> None:
    count = len(cable.path)
    asked = Requirements(max_robots=most)
    openings = {
        supports: opening
        for size in range(min(most - 2, count - 2) + 1)
        for supports in combinations(range(2, count), size)
        for opening in [examine(cable, Requirements(openness=Fraction(1, 1000)), supports)]
        if opening is not None
    }
    result = minimal_supports(cable, asked)
    if not openings:
        assert not result.found and result.solution.status is Status.INFEASIBLE
        assert any(family == "at most" for family, _ in result.conflict)
        return
    widest = min(max(openings.values()), Fraction(1))
    found = openings[result.supports]
    assert result.is_proven and min(found, Fraction(1)) == widest


@pytest.mark.parametrize("solver", list(BACKENDS))
def test_every_solver_gives_the_same_canonical_set(solver: str) -> None:
    for formulation in FORMULATIONS:
        asked = Requirements(formulation)
        cable = Cable(read_knot("4_1").diagram, "B-")
        expected = minimal_supports(cable, asked)
        found = minimal_supports(cable, asked, solver=solver, limits=Limits(seed=7))
        assert found.supports == expected.supports and found.canonical and found.is_proven
        assert found.solution.seed == 7


def test_lcf_as_start_and_what_it_closes() -> None:
    not_open = minimal_supports(Cable(read_knot("5").diagram, "L+"))
    assert not_open.lcf.robots < not_open.robots
    assert not_open.solution.start_accepted is False and not not_open.lcf_report.is_open
    closed = [not_open.lcf.regions[k].name for k in not_open.lcf_report.closed_regions]
    assert closed == ["loop c1", "loop c2", "loop c3", "loop c4"]
    is_open = minimal_supports(Cable(read_knot("7 Var2").diagram, "L+"))
    assert is_open.solution.start_accepted is True and is_open.lcf_report.is_open
    assert is_open.lcf.robots > is_open.robots


@pytest.mark.parametrize("formulation", list(FORMULATIONS))
def test_the_check_takes_nothing_but_the_cable_from_the_maker(formulation: str) -> None:
    cable = Cable(read_knot("5").diagram, "L+")
    result = minimal_supports(cable, Requirements(formulation))
    bare: Any = SimpleNamespace(cable=cable)  # in the place of regions
    again = replace(result, lcf=replace(result.lcf, regions=bare))
    assert (again.report, again.lcf_report) == (result.report, result.lcf_report)
    assert result.report.is_open and result.lcf_report.is_open == (formulation == "loops")


@pytest.mark.parametrize("formulation", list(FORMULATIONS))
@pytest.mark.parametrize("name", ["7_4", "8_19", "9_35"])
def test_best_cut_is_the_best_of_all(name: str, formulation: str) -> None:
    diagram = read_knot(name).diagram
    asked = Requirements(formulation)
    single = list(supports_by_cut(diagram, asked))
    search = best_supports(diagram, asked)
    fewest = min(result.robots for result in single)
    first = next(result for result in single if result.robots == fewest)
    assert search.is_proven and search.best.robots == fewest
    assert (search.best.cable.cut, search.best.supports) == (first.cable.cut, first.supports)
    assert [outcome.cut for outcome in search.outcomes] == list(crossing_free_cuts(diagram))
    for outcome, result in zip(search.outcomes, single, strict=True):
        assert outcome.bound is not None and outcome.bound <= result.robots
        assert outcome.robots in (None, result.robots)
        assert outcome.robots is not None or outcome.bound >= fewest


def test_infeasible_requests_name_what_cannot_be_met() -> None:
    cable = Cable(read_knot("5").diagram, "L+")

    def conflict(**options: Any) -> tuple[MinimalSupports, set[str]]:
        result = minimal_supports(cable, Requirements(**options))
        return result, {family for family, _ in result.conflict}

    result, families = conflict(forbidden=(5, 6, 7, 8))
    assert not result.found and families == {"forbidden", "opening"}
    assert ("opening", "loop c1, threaded at p10") in result.conflict
    result, _ = conflict(separation=2.1, forced=(5, 6))
    assert set(result.conflict) == {
        ("separation", "p5 and p6"),
        ("forced", "p5"),
        ("forced", "p6"),
    }
    _, families = conflict(payload=2, openness=0.5)
    assert "payload" in families
    infeasible = best_supports(cable.diagram, Requirements(forbidden=tuple(range(2, 14))))
    assert not infeasible.best.found and infeasible.best.conflict and not infeasible.is_proven
    assert all(outcome.status is Status.INFEASIBLE for outcome in infeasible.outcomes)


def test_a_time_limit_says_what_is_known() -> None:
    """However short, there is a status; the set, if any, is open."""
    cable = Cable(shipped_knots()["10_123"].diagram, "L+")
    result = minimal_supports(cable, Requirements("span"), limits=Limits(seconds=1e-3))
    assert result.solution.status in (Status.OPTIMAL, Status.FEASIBLE, Status.UNKNOWN)
    assert not result.found or result.report.is_open
    assert result.found or result.solution.status is Status.UNKNOWN


def test_a_set_at_hand_when_the_solver_has_none(monkeypatch: pytest.MonkeyPatch) -> None:
    """LCF's if it is open, else all turning points, whatever the solver failed to do."""
    from formulations.backends.cp_sat import CpSat
    from formulations.solution import Solution

    unknown = Solution(Status.UNKNOWN, "UNKNOWN", bound=3)
    monkeypatch.setattr(CpSat, "solve", lambda *_: unknown)
    limits = Limits(seconds=1e-6)
    lcf_is_open = minimal_supports(Cable(read_knot("7 Var2").diagram, "L+"), limits=limits)
    assert lcf_is_open.supports == lcf_is_open.lcf.supports
    assert "LCF's set" in lcf_is_open.solution.raw_status
    everywhere = minimal_supports(Cable(read_knot("5").diagram, "L+"), limits=limits)
    assert everywhere.robots == everywhere.baseline == 14 and not everywhere.is_proven
    assert (everywhere.solution.status, everywhere.solution.gap) == (Status.FEASIBLE, 11 / 14)
    impossible = Requirements(separation=4)
    nothing = minimal_supports(Cable(read_knot("5").diagram, "L+"), impossible, limits=limits)
    assert not nothing.found and nothing.solution.status is Status.UNKNOWN


def test_ctrl_c_ends_a_search_with_what_is_known(monkeypatch: pytest.MonkeyPatch) -> None:
    """In the solver, which then stops early, or outside of it."""
    from dataclasses import replace

    from knotopt.supports import search

    diagram = read_knot("7 Var2").diagram
    original = search.minimal_supports

    def early(cable: Cable, *arguments: Any, **options: Any) -> MinimalSupports:
        result = original(cable, *arguments, **options)
        if str(cable.cut) != "L-":
            return result
        stopped = replace(result.solution, status=Status.UNKNOWN, interrupted=True)
        return replace(result, solution=stopped, found=False, supports=())

    def outside(cable: Cable, *arguments: Any, **options: Any) -> MinimalSupports:
        if str(cable.cut) == "L-":
            raise KeyboardInterrupt
        return original(cable, *arguments, **options)

    for stopping in (early, outside):
        monkeypatch.setattr(search, "minimal_supports", stopping)
        found = best_supports(diagram)
        assert found.interrupted and not found.is_proven and found.bound is None
        assert found.best.robots == 6 and str(found.best.cable.cut) == "L+"
        assert [outcome.status for outcome in found.outcomes][2:] == [Status.UNKNOWN] * 6
    with pytest.raises(KeyboardInterrupt):
        best_supports(diagram, cuts=crossing_free_cuts(diagram)[1:])


def test_an_unfinished_widening_is_not_called_canonical(monkeypatch: pytest.MonkeyPatch) -> None:
    """One solve of the binary search ends without an answer."""
    from formulations import canonical

    original = canonical.attempt
    cable = Cable(read_knot("5").diagram, "L+")
    for options in ({}, {"max_robots": 8}):
        whole = minimal_supports(cable, Requirements(**options))
        for lost in range(1, 4):
            calls = iter(range(1, 1000))

            def attempt(*arguments: Any, calls: Any = calls, lost: int = lost) -> Any:
                if next(calls) == lost:
                    return Status.UNKNOWN, None
                return original(*arguments)

            monkeypatch.setattr(canonical, "attempt", attempt)
            found = minimal_supports(cable, Requirements(**options))
            assert not found.canonical or found.supports == whole.supports
            assert not found.found or found.report.is_open
            if options:
                assert not found.is_proven or found.smallest_opening == whole.smallest_opening
            monkeypatch.setattr(canonical, "attempt", original)


@pytest.mark.parametrize("seconds", [0.02, 0.1, 0.4])
def test_a_limited_search_keeps_what_it_has(seconds: float) -> None:
    search = best_supports(shipped_knots()["10_123"].diagram, limits=Limits(seconds=seconds))
    assert search.best.found and search.best.report.is_open
    known = [outcome.robots for outcome in search.outcomes if outcome.robots is not None]
    assert search.best.robots == min(known)
    assert search.bound is None or search.bound <= search.best.robots
    assert search.status in (Status.OPTIMAL, Status.FEASIBLE)


def test_no_regions_need_no_supports() -> None:
    result = minimal_supports(Cable(torus_knot(1, 2), "L+"))
    assert result.robots == 2 and result.supports == () and result.is_proven
    assert result.smallest_opening is None and result.report.is_open
    assert all_minimal(result).sets == ((),)


@pytest.mark.slow
def test_reach_rows_on_larger_cables() -> None:
    """Random sets satisfy the rows of `reach` exactly if the definition does."""
    import random

    source = random.Random(0)
    for name in ("6_2", "7_6", "8_20"):
        for cut in crossing_free_cuts(read_knot(name).diagram):
            cable = Cable(read_knot(name).diagram, cut)
            for formulation in FORMULATIONS:
                asked = Requirements(formulation, reach=source.choice([2.0, 3.0, 4.0]))
                team = compile_team(Regions(cable), asked)
                count = len(cable.path)
                definitions, rows = team.reach_rows(count + 1)
                for _ in range(20):
                    robots = [1, *(k for k in range(2, count) if source.random() < 0.7), count]
                    true = {k: k in robots for k in range(1, count + 1)}
                    for helper, literals in enumerate(definitions, count + 1):
                        true[helper] = all(true[abs(x)] == (x > 0) for x in literals)
                    holds = all(any(true[abs(x)] == (x > 0) for x in row.literals) for row in rows)
                    assert holds == meets_options(cable, asked, robots)
