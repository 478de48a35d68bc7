"""The programs of a cut by several solvers, and what their sets are worth."""

from __future__ import annotations

import time
from collections.abc import Mapping
from functools import cache

from formulations.instance import Instance
from formulations.instance import Row as ProgramRow
from formulations.solution import BackendError, Limits, Solution, Status
from knotopt.atlas.programs import Solved
from knotopt.atlas.schema import KnotRow, Settings
from knotopt.cable.cable import Cable
from knotopt.document.columns import Row
from knotopt.supports.minimal import find_backend
from knotopt.tables.methods import SmallestSet

REFUSED = "refused"
PACKAGES = {
    "cp-sat": ("ortools",),
    "highs": ("highspy", "cvxpy"),
    "scip": ("pyscipopt", "cvxpy"),
    "maxsat": ("python-sat",),
    "exhaustive": (),
}
"""What the answers of each solver depend on, besides numpy."""


def compare_solvers(
    knot: KnotRow,
    cable: Cable,
    programs: Mapping[SmallestSet, Solved],
    settings: Settings,
    *,
    checked: bool,
) -> tuple[list[Row], list[Row]]:
    """Solve each program by each solver of the settings.

    Parameters
    ----------
    knot : KnotRow
    cable : Cable
        On one cut.
    programs : mapping of SmallestSet to Solved
    settings : Settings
    checked : bool
        Whether the independent checkers look at the sets too.

    Raises
    ------
    SolverError, MissingExtraError
        A solver that does not exist, or is not installed.
    KeyboardInterrupt
        Ctrl-C, also where a solver caught it.
    """
    rows, times = [], []
    for method, program in programs.items():
        for solver in settings.solvers:
            warm(solver)
            began = time.perf_counter()
            status, solution = _ask(solver, program.instance, settings)
            seconds = time.perf_counter() - began
            chosen = solution.chosen
            satisfies = None if status != Status.ERROR else False
            meets = None
            if chosen is not None:
                satisfies = not program.instance.violated(program.instance.complete(chosen))
                if checked:
                    meets = method.is_met(cable, chosen[1:-1], settings.r)
            keys = {**knot.keys(cable.cut), "formulation": method.key, "solver": solver}
            rows.append(
                {
                    **keys,
                    "status": status,
                    "said": solution.raw_status,
                    "objective": solution.objective,
                    "bound": solution.bound,
                    "proven": status in (Status.OPTIMAL, Status.INFEASIBLE),
                    "rows": len(program.instance.rows),
                    "satisfies": satisfies,
                    "meets_definition": meets,
                }
            )
            times.append({**keys, "seconds": seconds, "solve_seconds": solution.solve_seconds})
    return rows, times


@cache
def warm(solver: str) -> None:
    """Import a solver and solve something with it, once a process: that is no program's time."""
    tiny = Instance("tiny", ("a", "b"), 2, (1, 1), (ProgramRow((1, 2), 1, "cover", "ab"),))
    find_backend(solver).solve(tiny, Limits())


def _ask(solver: str, instance: Instance, settings: Settings) -> tuple[str, Solution]:
    """What the solver says; `REFUSED` where the program is none for it, with the reason."""
    limits = Limits(seconds=settings.solver_limit, seed=settings.seed)
    try:
        solution = find_backend(solver).solve(instance, limits)
    except BackendError as error:
        return REFUSED, Solution(Status.UNKNOWN, str(error))
    if solution.interrupted:
        raise KeyboardInterrupt
    return str(solution.status), solution
