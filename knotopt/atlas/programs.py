"""The 0-1 programs of a cut, each with a smallest set."""

from __future__ import annotations

import time
from dataclasses import dataclass

from formulations.instance import Instance
from formulations.solution import Limits, Solution
from knotopt.atlas.schema import Settings
from knotopt.errors import RequirementError
from knotopt.supports.lcf import LcfResult
from knotopt.supports.minimal import compile_program, find_backend
from knotopt.supports.requirements import Requirements
from knotopt.supports.support_set import SupportSet
from knotopt.supports.threading import Threading

SOLVER = "cp-sat"


@dataclass(frozen=True)
class Solved:
    """A program, a smallest set, and the time of both [s]."""

    instance: Instance
    solution: Solution
    seconds: float

    @property
    def supports(self) -> tuple[int, ...] | None:
        """The set without p_1 and p_n."""
        return None if self.solution.chosen is None else self.solution.chosen[1:-1]

    def allows(self, chosen: SupportSet) -> bool:
        """Whether a set satisfies every row of the program."""
        ends = (1, *chosen.supports, len(chosen.cable.path))
        return not self.instance.violated(self.instance.complete(ends))


def solve(
    plain: LcfResult, settings: Settings, formulation: str, threading: Threading | None = None
) -> Solved:
    """Compile a program and solve it.

    Raises
    ------
    KeyboardInterrupt
        Ctrl-C, also where the solver caught it.
    RequirementError
        The diagram is too large for `span`.
    """
    began = time.perf_counter()
    asked = Requirements(formulation, settings.r, threading)
    instance = compile_program(plain, asked).instance(float(asked.openness**2))
    solution = find_backend(SOLVER).solve(instance, Limits(seed=settings.seed))
    if solution.interrupted:
        raise KeyboardInterrupt
    return Solved(instance, solution, time.perf_counter() - began)


def try_span(plain: LcfResult, settings: Settings) -> Solved | None:
    """The smallest set of `span`; None if not asked for, or the diagram is too large for it."""
    if not settings.span:
        return None
    try:
        return solve(plain, settings, "span")
    except RequirementError:
        return None
