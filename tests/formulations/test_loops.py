"""Stretches of a path to be pierced: sweep, linear relaxation and solvers against each other."""

from __future__ import annotations

from itertools import combinations, pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from formulations.backends import BACKENDS, get_backend
from formulations.canonical import at_once, lexicographically_first
from formulations.loops import LoopsProgram, disjoint, pierce, relaxation
from formulations.solution import Limits, Status
from formulations.team import Stretch, Team

POINTS = 12
STRETCHES = st.lists(
    st.tuples(st.integers(2, POINTS - 1), st.integers(2, POINTS - 1)).map(
        lambda ends: Stretch(min(ends), max(ends), "stretch")
    ),
    max_size=14,
)


def is_pierced(stretches: list[Stretch], points: tuple[int, ...]) -> bool:
    return all(any(first <= k <= last for k in points) for first, last, _ in stretches)


def smallest_by_trying_all(stretches: list[Stretch]) -> tuple[int, ...]:
    return next(
        points
        for size in range(POINTS)
        for points in combinations(range(2, POINTS), size)
        if is_pierced(stretches, points)
    )


@settings(max_examples=100)
@given(STRETCHES)
def test_sweep_relaxation_and_solver_agree(stretches: list[Stretch]) -> None:
    expected = smallest_by_trying_all(stretches)
    program = LoopsProgram("", POINTS, Team(tuple(stretches)))
    assert pierce(stretches) == expected  # the first of the smallest
    ends = disjoint([(first, last) for first, last, _ in stretches])
    assert len(ends) == len(expected)
    assert all(stretches[a].last < stretches[b].first for a, b in pairwise(ends))
    assert is_pierced(stretches, tuple(stretches[k].last for k in ends))
    value, x = relaxation(program)
    assert value == pytest.approx(len(expected) + 2)
    assert np.allclose(x, np.round(x)), "an interval matrix has integral vertices"
    solution = get_backend().solve(program.instance(), Limits())
    assert solution.status is Status.OPTIMAL and solution.objective == len(expected) + 2
    known = at_once(program)
    assert known is not None and known.chosen == (1, *expected, POINTS)
    assert (known.status, known.objective) == (Status.OPTIMAL, solution.objective)


@pytest.mark.parametrize("solver", list(BACKENDS))
def test_every_solver(solver: str) -> None:
    stretches = (Stretch(2, 5, "a"), Stretch(4, 6, "b"), Stretch(7, 9, "c"), Stretch(3, 11, "d"))
    program = LoopsProgram("", POINTS, Team(stretches))
    instance, backend = program.instance(), get_backend(solver)
    solution = backend.solve(instance, Limits())
    assert solution.objective == 4 and solution.chosen is not None
    first = lexicographically_first(instance, backend, Limits(), 4, solution.chosen)
    assert first == ((1, 4, 7, 12), True) and pierce(stretches) == (4, 7)


@given(STRETCHES, st.integers(2, POINTS - 1))
def test_what_else_a_team_asks_is_left_to_a_solver(stretches: list[Stretch], k: int) -> None:
    program = LoopsProgram("", POINTS, Team(tuple(stretches), forbidden=(k,)))
    assert at_once(program) is None and program.instance().fixed[k] == 0


def test_nothing_to_pierce() -> None:
    program = LoopsProgram("", 4)
    assert program.at_once is not None and program.at_once.chosen == (1, 4)
    assert disjoint([]) == [] and pierce([]) == () and relaxation(program)[0] == 2
    assert len(program.levels) == 0
