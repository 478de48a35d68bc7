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
        from pysat.examples.rc2 import RC2
        from pysat.formula import WCNF

        began = time.perf_counter()
        formula = WCNF()
        trivially_false = False
        for clause in clauses(instance):
            trivially_false |= not clause
            formula.append(list(clause))
        for variable, weight in enumerate(instance.objective, 1):
            if weight:
                formula.append([-variable], weight=weight)
        build_seconds = time.perf_counter() - began
        began = time.perf_counter()
        if trivially_false:
            answer = Answer(Status.INFEASIBLE, "empty clause")
        else:
            with RC2(formula, solver="g4") as solver:
                timer = threading.Timer(limits.seconds or 0, solver.interrupt)
                if limits.seconds is not None:
                    timer.start()
                word = "interrupted"
                try:
                    model = solver.compute(expect_interrupt=True)
                    if model is None and not solver.oracle.get_status() is None:
                        word = "unsatisfiable"
                except KeyboardInterrupt:
                    model = None
                finally:
                    timer.cancel()
                if model is not None:
                    values = [int(literal > 0) for literal in model[: len(instance.variables)]]
                    answer = Answer(Status.OPTIMAL, "optimum", values, solver.cost)
                elif word == "unsatisfiable":
                    answer = Answer(Status.INFEASIBLE, word)
                else:
                    answer = Answer(Status.UNKNOWN, word, bound=solver.cost)
        if answer.status is Status.UNKNOWN and instance.start is not None:
            values = instance.complete(instance.start).tolist()
            if not instance.violated(values):
                answer.status, answer.values = Status.FEASIBLE, values
        answer.solve_seconds = time.perf_counter() - began
        solver_name = f"{self.name} (python-sat {importlib.metadata.version('python-sat')})"
        return checked(answer, instance, limits, build_seconds=build_seconds, solver=solver_name)
