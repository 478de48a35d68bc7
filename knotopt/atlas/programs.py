"""The 0-1 programs of a cut, each with a smallest set."""

from __future__ import annotations

import time
from dataclasses import dataclass

from formulations.canonical import at_once
from formulations.instance import Instance
from formulations.solution import Limits, Solution
from knotopt.atlas.schema import Settings
from knotopt.document.columns import Row
from knotopt.errors import RequirementError
from knotopt.supports.lcf import LcfResult
from knotopt.supports.minimal import compile_program, find_backend
from knotopt.supports.support_set import SupportSet
from knotopt.tables.methods import SmallestSet

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

    @property
    def cells(self) -> Row:
        """Of the atlas, by the columns' names without the method's key."""
        return {
            "robots": self.solution.objective,
            "bound": self.solution.bound,
            "status": str(self.solution.status),
            "supports": self.supports,
            "rows": len(self.instance.rows),
            "instance": self.instance.hash[:16],
        }

    def allows(self, chosen: SupportSet) -> bool:
        """Whether a set satisfies every row of the program."""
        ends = (1, *chosen.supports, len(chosen.cable.path))
        return not self.instance.violated(self.instance.complete(ends))


def solve(plain: LcfResult, settings: Settings, method: SmallestSet) -> Solved | None:
    """Compile a program and solve it; None if not asked for, or the diagram is too large for it.

    Raises
    ------
    KeyboardInterrupt
        Ctrl-C, also where the solver caught it.
    RequirementError
        The diagram is too large for what every atlas has.
    """
    if not is_asked(method, settings):
        return None
    began = time.perf_counter()
    asked = method.requirements(settings.r)
    try:
        program = compile_program(plain, asked)
        instance = program.instance(float(asked.openness**2))
    except RequirementError:
        if not method.setting:
            raise
        return None
    solution = at_once(program) or find_backend(SOLVER).solve(instance, Limits(seed=settings.seed))
    if solution.interrupted:
        raise KeyboardInterrupt
    return Solved(instance, solution, time.perf_counter() - began)


def is_asked(method: SmallestSet, settings: Settings) -> bool:
    """Whether a run computes the smallest sets of a method."""
    return not method.setting or bool(getattr(settings, method.setting))
