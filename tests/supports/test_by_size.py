"""Sets that are ruled out one by one: rows, order of the sets that are left, all smallest sets."""

from __future__ import annotations

import json
from fractions import Fraction
from itertools import combinations, islice

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from formulations.backends import BACKENDS, get_backend
from formulations.backends.exhaustive import Exhaustive
from formulations.export import FORMATS
from formulations.instance import Instance
from formulations.solution import Limits, Solution, Status
from formulations.team import Team
from knotopt.cable.cable import Cable
from knotopt.cable.cut import crossing_free_cuts, outer_cuts
from knotopt.diagram.families import torus_knot
from knotopt.errors import RequirementError
from knotopt.reading.knot import read_knot
from knotopt.supports.by_size import optimal_sets, sets_in_order
from knotopt.supports.certificate import prove
from knotopt.supports.minimal import all_minimal, minimal_supports
from knotopt.supports.registry import FORMULATIONS
from knotopt.supports.requirements import Requirements
from knotopt.verify.registry import DEFINITIONS
from tests.helpers.strategies import cables

Supports = tuple[int, ...]


def in_order(cable: Cable, asked: Requirements) -> list[Supports]:
    """All sets that are open by the definition: fewest, then most open, then first."""
    check = DEFINITIONS[asked.formulation].checker(with_loops=asked.with_loops)
    found = []
    for size in range(len(cable.path) - 1):
        for supports in combinations(range(2, len(cable.path)), size):
            report = check(
                cable.path, cable.diagram.size, supports, asked.openness, asked.threading
            )
            if report.is_open:
                opening = report.smallest_opening_squared
                capped = Fraction(1) if opening is None else min(opening, Fraction(1))
                found.append((size, -capped, supports))
    return [supports for _, _, supports in sorted(found)]


@pytest.mark.parametrize("points", [2, 3, 4])
def test_a_row_rules_out_one_set(points: int) -> None:
    inner = range(2, points)
    every = [chosen for k in range(points - 1) for chosen in combinations(inner, k)]
    for ruled_out in every:
        rows = tuple(Team(excluded=(ruled_out,)).rows(points))
        names = tuple(f"x{k}" for k in range(1, points + 1))
        instance = Instance("all but one", names, points, (1,) * points, rows)
        left = Exhaustive().enumerate(instance, Limits(), 100).sets
        assert {chosen[1:-1] for chosen in left} == {*every} - {ruled_out}


@settings(max_examples=25)
@given(cables(max_size=5), st.sampled_from(list(FORMULATIONS)), st.data())
def test_the_best_of_what_is_left(cable: Cable, formulation: str, data: st.DataObject) -> None:
    asked = Requirements(formulation, data.draw(st.sampled_from(["0.25", "0.5", "1"])))
    ordered = in_order(cable, asked)
    likely = st.sampled_from(ordered[:6]) if ordered else st.nothing()
    ruled_out = data.draw(st.sets(likely, max_size=5))
    left = [supports for supports in ordered if supports not in ruled_out]
    result = minimal_supports(
        cable, Requirements(formulation, asked.openness, excluded=tuple(ruled_out))
    )
    assert result.found == bool(left)
    if left:
        assert result.supports == left[0] and result.is_proven and result.canonical
        smallest = {supports for supports in left if len(supports) == len(left[0])}
        assert set(all_minimal(result).sets) == smallest


@pytest.mark.parametrize("solver", list(BACKENDS))
@pytest.mark.parametrize("formulation", list(FORMULATIONS))
def test_every_solver_gives_the_next_set(formulation: str, solver: str) -> None:
    cable = Cable(torus_knot(2, 3), "L+")
    ordered = in_order(cable, Requirements(formulation))
    for count in (1, 3):
        asked = Requirements(formulation, excluded=tuple(ordered[:count]))
        result = minimal_supports(cable, asked, solver=solver)
        assert result.supports == ordered[count] and result.is_proven
        solution = get_backend(solver).solve(result.instance, Limits())
        assert solution.objective == len(ordered[count]) + 2


def test_all_smallest_sets_against_exhaustive_search() -> None:
    for name in ("3", "4", "9"):
        for formulation in FORMULATIONS:
            cable = Cable(read_knot(name).diagram, "L+")
            asked = Requirements(formulation, 0.25)
            result = minimal_supports(cable, asked)
            solver = "exhaustive" if len(cable.path) <= 14 else "cp-sat"
            every = all_minimal(result, solver=solver)
            found = optimal_sets(cable.diagram, asked, cuts=[cable.cut])
            sets = [each.supports for each in found.sets]
            assert found.complete and set(sets) == set(every.sets)
            assert sets[0] == result.supports
            one = optimal_sets(cable.diagram, asked, 1, cuts=[cable.cut])
            assert one.sets[0].supports == sets[0] and one.complete == (len(sets) == 1)


def test_all_smallest_sets_of_all_cuts() -> None:
    diagram = read_knot("9").diagram
    asked = Requirements("span", 0.25)
    found = optimal_sets(diagram, asked)
    by_cut = {
        str(cut): set(all_minimal(result).sets)
        for cut in crossing_free_cuts(diagram)
        if (result := minimal_supports(Cable(diagram, cut), asked)).robots == 5
    }
    assert found.complete and {each.robots for each in found.sets} == {5}
    assert set(by_cut) == {"L+", "T+"}
    for cut, sets in by_cut.items():
        assert {each.supports for each in found.sets if str(each.cable.cut) == cut} == sets


def test_smallest_sets_where_there_are_none_or_time_is_short(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    cable = Cable(torus_knot(2, 3), "L+")
    impossible = Requirements(forbidden=tuple(range(2, 10)))
    alone = [cable.cut]
    nothing = optimal_sets(cable.diagram, impossible, cuts=alone)
    assert nothing.sets == () and nothing.complete
    with pytest.raises(RequirementError, match="at least 1 set is asked for, not 0"):
        optimal_sets(cable.diagram, limit=0)
    from formulations.backends.cp_sat import CpSat

    monkeypatch.setattr(CpSat, "solve", lambda *_: Solution(Status.UNKNOWN, "UNKNOWN"))
    stopped = optimal_sets(cable.diagram, impossible, cuts=alone)
    assert stopped.sets == () and not stopped.complete
    not_proven = optimal_sets(cable.diagram, cuts=alone)  # all turning points, which are at hand
    assert not_proven.sets == () and not not_proven.complete


@pytest.mark.parametrize("formulation", list(FORMULATIONS))
def test_the_sets_of_all_cuts_come_in_order(formulation: str) -> None:
    """The k-th set is the k-th of an exhaustive list over eight cuts."""
    diagram = torus_knot(2, 3)
    asked = Requirements(formulation, 0.5)
    expected = [
        (len(supports), index, place, str(cut), supports)
        for index, cut in enumerate(outer_cuts(diagram))
        for place, supports in enumerate(in_order(Cable(diagram, cut), asked))
    ]
    count = 24
    searches = list(islice(sets_in_order(diagram, asked), count))
    found = [(str(search.best.cable.cut), search.best.supports) for search in searches]
    assert found == [(cut, supports) for *_, cut, supports in sorted(expected)[:count]]
    assert all(search.is_proven and search.best.canonical for search in searches)


def test_sets_come_to_an_end() -> None:
    diagram = torus_knot(2, 3)
    cut = outer_cuts(diagram)[0]
    expected = in_order(Cable(diagram, cut), Requirements())
    *searches, last = sets_in_order(diagram, cuts=[cut])
    assert [search.best.supports for search in searches] == expected
    assert not last.best.found and last.status is Status.INFEASIBLE and not last.best.conflict
    passed = {cut: expected[:-2]}
    *searches, _ = sets_in_order(diagram, cuts=[cut], excluded=passed)
    assert [search.best.supports for search in searches] == expected[-2:]
    (never,) = sets_in_order(diagram, Requirements(forbidden=tuple(range(2, 10))), cuts=[cut])
    assert never.best.conflict and never.status is Status.INFEASIBLE


def test_a_solver_that_stops_early_is_told_from_the_end(monkeypatch: pytest.MonkeyPatch) -> None:
    from formulations.backends.cp_sat import CpSat

    diagram = torus_knot(2, 3)
    stopped = Solution(Status.UNKNOWN, "UNKNOWN", bound=3)
    monkeypatch.setattr(CpSat, "solve", lambda *_: stopped)
    asked = Requirements(separation=100)
    (last,) = sets_in_order(diagram, asked)
    assert not last.best.found and last.status is Status.UNKNOWN
    interrupted = Solution(Status.UNKNOWN, "UNKNOWN", interrupted=True)
    monkeypatch.setattr(CpSat, "solve", lambda *_: interrupted)
    with pytest.raises(KeyboardInterrupt):
        next(sets_in_order(diagram, asked))


def test_exports_hold_the_rows_and_certificates_refuse_them() -> None:
    diagram = torus_knot(2, 3)
    cable = Cable(diagram, "L+")
    asked = Requirements(excluded=(minimal_supports(cable).supports,))
    instance = minimal_supports(cable, asked).instance
    rows = json.loads(FORMATS[".json"](instance))["rows"]
    assert [row["family"] for row in rows].count("excluded") == 1
    for write in FORMATS.values():
        plain = write(minimal_supports(cable).instance)
        assert len(write(instance)) > len(plain)
    with pytest.raises(RequirementError, match="leave out the other options"):
        prove("3_1", diagram, asked)


@pytest.mark.parametrize(
    ("excluded", "message"),
    [
        (((1, 4),), "p1 is an end of the cable and part of no excluded set"),
        (((4, 10),), "p10 is an end of the cable"),
        (((11,),), "p11: the cable's turning points are p1 to p10"),
        (((2.5,),), "turning points and robots are counted, not 2.5"),
    ],
)
def test_sets_that_are_none(excluded: tuple[Supports, ...], message: str) -> None:
    with pytest.raises(RequirementError, match=message):
        minimal_supports(Cable(torus_knot(2, 3), "L+"), Requirements(excluded=excluded))
    with pytest.raises(RequirementError, match="not with a largest number"):
        next(sets_in_order(torus_knot(2, 3), Requirements(max_robots=5)))
    with pytest.raises(RequirementError, match="no cut is given"):
        next(sets_in_order(torus_knot(2, 3), cuts=[]))


def test_excluded_sets_are_put_in_order() -> None:
    asked = Requirements(excluded=((5, 4), (3,), (4, 5)))
    assert asked.excluded == ((3,), (4, 5))
