"""One optimum among many: the largest smallest opening, then the lexicographically first set."""

from __future__ import annotations

from dataclasses import replace
from typing import Protocol

from formulations.arrays import FloatArray
from formulations.instance import Instance, Row
from formulations.solution import Backend, Limits, Solution, Status
from formulations.timing import Deadline


class Program(Protocol):
    """A formulation whose rows depend on an openness.

    It may also have `at_once`: the canonical one of its smallest sets as a `Solution` that needs no
    solver, or None where it cannot tell.
    """

    @property
    def levels(self) -> FloatArray:
        """Squared openness values between which the rows do not change, ascending."""
        ...

    def instance(self, openness_squared: float) -> Instance:
        """The 0-1 program for one openness."""
        ...


def at_once(program: Program) -> Solution | None:
    """The canonical one of a program's smallest sets, if the program gives it without a solver."""
    known: Solution | None = getattr(program, "at_once", None)
    return known


def widest(
    program: Program, backend: Backend, limits: Limits, at_least: float, at_most: int
) -> tuple[tuple[float, tuple[int, ...]] | None, bool]:
    """The largest squared openness (1 at most) at which `at_most` decisions suffice.

    Binary search over the levels from `at_least` on.

    Returns
    -------
    openness squared and a set (None if no set was found), and whether that is sure: whether every
    solve that found no set has shown that there is none
    """
    deadline = Deadline(limits)
    levels = [at_least, *(level for level in program.levels.tolist() if level > at_least)]
    if levels[-1] < 1.0:
        levels.append(1.0)
    low, high = 0, len(levels) - 1
    best: tuple[float, tuple[int, ...]] | None = None
    sure = True
    while low <= high:
        middle = (low + high) // 2 if best is not None else low
        instance = program.instance(levels[middle])
        status, found = attempt(instance, backend, deadline.left(), [instance.at_most(at_most)])
        if found is not None:
            best = levels[middle], found
            low = middle + 1
            continue
        sure = sure and status is Status.INFEASIBLE
        if best is None:
            break
        high = middle - 1
    return best, sure


def lexicographically_first(
    instance: Instance, backend: Backend, limits: Limits, size: int, known: tuple[int, ...]
) -> tuple[tuple[int, ...], bool]:
    """The set of at most `size` decisions that comes first when sorted, and whether that is sure.

    Goes through the decisions in order and takes each if the rest can still be completed; a known
    set that agrees so far answers without the solver.
    """
    deadline = Deadline(limits)
    rows: list[Row] = [instance.at_most(size)]
    taken: list[int] = []
    for variable in range(1, instance.decisions + 1):
        if len(taken) == size:
            break
        if variable not in known:
            trial = [*rows, _unit(variable)]
            status, found = attempt(instance, backend, deadline.left(), trial)
            if status is Status.INFEASIBLE:
                rows.append(_unit(-variable))
                continue
            if found is None:
                return known, False
            known = found
        taken.append(variable)
        rows.append(_unit(variable))
    return known, True


def attempt(
    instance: Instance, backend: Backend, limits: Limits, rows: list[Row]
) -> tuple[Status, tuple[int, ...] | None]:
    """Any set that satisfies the instance and further rows, whatever it costs.

    The status tells an impossible one from an unfinished search.
    """
    free = replace(
        instance, objective=(0,) * len(instance.variables), rows=(*instance.rows, *rows), start=None
    )
    solution = backend.solve(free, limits)
    return solution.status, solution.chosen


def _unit(literal: int) -> Row:
    return Row((literal,), 1, "lexicographic", f"{'' if literal > 0 else 'not '}x{abs(literal)}")
