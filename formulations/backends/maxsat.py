"""MaxSAT by RC2 of PySAT: core-guided, so its lower bound rises and its solution is the optimum."""

from __future__ import annotations

import importlib.metadata
import importlib.util
import threading
import time

from formulations.cnf import clauses
from formulations.instance import Instance
from formulations.solution import (
    Answer,
    Feature,
    Limits,
    MissingSolverError,
    Solution,
    Status,
    answer_at_once,
    checked,
)


class MaxSat:
    """RC2 (Ignatiev, Morgado, Marques-Silva 2019, doi:10.3233/SAT190116), one thread.

    It has no solution before it has the optimum: stopped early, it gives the start if that
    satisfies the rows.
    """

    name = "maxsat"
    features = frozenset({Feature.BOUND, Feature.START})

    def __init__(self) -> None:
        if importlib.util.find_spec("pysat") is None:
            raise MissingSolverError(self.name, "python-sat", "sat")

    def solve(self, instance: Instance, limits: Limits) -> Solution:
        """Minimise; Ctrl-C ends with the start, if that is a solution, and the bound so far."""
        if (known := answer_at_once(instance, limits, self.name)) is not None:
            return known
        began = time.perf_counter()
        hard = [list(clause) for clause in clauses(instance)]
        build_seconds = time.perf_counter() - began
        began = time.perf_counter()
        answer = _compute(instance, hard, limits)
        if answer.status is Status.UNKNOWN and instance.start is not None:
            values = instance.complete(instance.start).tolist()
            answer.start_accepted = not instance.violated(values)
            if answer.start_accepted:
                answer.status, answer.values = Status.FEASIBLE, values
        answer.solve_seconds = time.perf_counter() - began
        solver = f"{self.name} (python-sat {importlib.metadata.version('python-sat')})"
        return checked(answer, instance, limits, build_seconds=build_seconds, solver=solver)


def _compute(instance: Instance, hard: list[list[int]], limits: Limits) -> Answer:
    from pysat.examples.rc2 import RC2
    from pysat.formula import WCNF

    formula = WCNF()
    formula.extend(hard)
    for variable, weight in enumerate(instance.objective, 1):
        if weight:
            formula.append([-variable], weight=weight)
    with RC2(formula, solver="g4") as solver:
        timer = threading.Timer(limits.seconds or 0, solver.interrupt)
        if limits.seconds is not None:
            timer.start()
        try:
            model = solver.compute(expect_interrupt=True)
        except KeyboardInterrupt:
            return Answer(Status.UNKNOWN, "interrupted", bound=solver.cost)
        finally:
            timer.cancel()
        if model is not None:
            values = [0] * len(instance.variables)
            for literal in model:
                if 0 < literal <= len(values):
                    values[literal - 1] = 1
            return Answer(Status.OPTIMAL, "optimum", values, solver.cost)
        # Between two calls, a limit leaves the oracle with the last one's answer: a core.
        if solver.interrupted or solver.oracle.get_status() is None:
            return Answer(Status.UNKNOWN, "time limit", bound=solver.cost)
        return Answer(Status.INFEASIBLE, "unsatisfiable")
