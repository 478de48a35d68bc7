"""Formulation `loops`: the fewest points on a path that pierce each of many stretches of it.

    loops   sum of x_v, first <= v <= last, >= 1      for every stretch first ... last

The rows are an interval matrix (their ones follow each other), hence totally unimodular: the linear
relaxation has an integral optimum, and so has its dual, as many stretches as possible of which no
two have a point in common. A sweep finds both at once: whoever takes the stretch that ends first,
holds its last point and goes on with those that begin behind it has pierced all, and each stretch
taken needs a point of its own (A. Schrijver, "Combinatorial Optimization", 2003, section 19.3).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np

from formulations.arrays import FloatArray
from formulations.instance import Instance
from formulations.solution import Solution, Status
from formulations.team import Stretch, Team

SWEEP = "sweep"


@dataclass(frozen=True)
class LoopsProgram:
    """`loops`, which does not depend on an openness.

    Attributes
    ----------
    name : str
    points : int
        n; the decisions are x_1 ... x_n.
    team : Team
        With the stretches.
    start : tuple of int or None

    Examples
    --------
    >>> stretches = (Stretch(2, 3, "a"), Stretch(3, 5, "b"))
    >>> program = LoopsProgram("", 6, Team(stretches))
    >>> [row.literals for row in program.instance().rows]
    [(1,), (6,), (2, 3), (3, 4, 5)]
    >>> program.at_once.chosen
    (1, 3, 6)
    """

    name: str
    points: int
    team: Team = field(default_factory=Team)
    start: tuple[int, ...] | None = None

    @property
    def levels(self) -> FloatArray:
        """Squared openness values between which the rows change: none."""
        return np.zeros(0)

    def instance(self, openness_squared: float = 0.0) -> Instance:  # noqa: ARG002 -- of the protocol
        """The 0-1 program, the same for every openness."""
        definitions, reach = self.team.reach_rows(self.points + 1)
        helpers = range(self.points + 1, self.points + 1 + len(definitions))
        return Instance(
            name=self.name,
            variables=(
                *(f"x{k}" for k in range(1, self.points + 1)),
                *(f"z{helper}" for helper in helpers),
            ),
            decisions=self.points,
            objective=(1,) * self.points + (0,) * len(definitions),
            rows=(*self.team.rows(self.points), *reach),
            definitions=tuple(definitions),
            start=self.start,
        )

    @property
    def at_once(self) -> Solution | None:
        """The smallest set, the lexicographically first one, without a solver.

        None if the team asks for more than that every stretch is pierced.
        """
        if self.team != Team(self.team.stretches):
            return None
        chosen = (1, *pierce(self.team.stretches), self.points)
        return Solution(
            Status.OPTIMAL,
            "as many stretches share no point",
            chosen,
            len(chosen),
            len(chosen),
            solver=SWEEP,
        )


def disjoint(stretches: Sequence[tuple[int, int]]) -> list[int]:
    """As many stretches as possible without a common point, in order: their indices.

    As many as the smallest set that pierces all stretches has points; such a set are their last
    points.

    Notes
    -----
    O(C log C) for C stretches.

    Examples
    --------
    >>> disjoint([(2, 3), (3, 5), (4, 6)])
    [0, 2]
    """
    chosen: list[int] = []
    end = -float("inf")
    for index in sorted(range(len(stretches)), key=lambda k: stretches[k][1]):
        if stretches[index][0] > end:
            chosen.append(index)
            end = stretches[index][1]
    return chosen


def pierce(stretches: Sequence[Stretch]) -> tuple[int, ...]:
    """The smallest set of points with one on every stretch; of several the first, when sorted.

    The sweep from the other end: each of its points lies as far to the left as that of any
    smallest set can.

    Examples
    --------
    >>> pierce([Stretch(2, 3, "a"), Stretch(3, 5, "b"), Stretch(4, 6, "c")])
    (2, 4)
    """
    found = disjoint([(-stretch.last, -stretch.first) for stretch in stretches])
    return tuple(stretches[index].first for index in reversed(found))


def relaxation(program: LoopsProgram) -> tuple[float, FloatArray]:
    """The linear relaxation, 0 <= x <= 1: its optimum and a vertex x, shape (n,), that attains it.

    Without further wishes of the team both are integral.

    Raises
    ------
    BackendError
        HiGHS has no solution.
    """
    from scipy.optimize import linprog  # which takes long to import

    from formulations.solution import BackendError

    instance = program.instance()
    matrix, at_least = instance.matrix
    found = linprog(
        instance.objective, A_ub=-matrix, b_ub=-at_least, bounds=(0, 1), method="highs-ds"
    )
    if found.x is None:
        raise BackendError(f"the linear relaxation: {found.message}")
    return float(found.fun), np.asarray(found.x)
