"""HiGHS and SCIP by cvxpy, which is given the rows as one sparse matrix.

cvxpy hands over the program; the solver's own words are read from what it returns, because its
statuses do not tell a limit with a solution from one without, and give no bound for SCIP.
"""

from __future__ import annotations

import importlib.metadata
import importlib.util
import time
import warnings
from abc import ABC, abstractmethod
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any
from unittest.mock import patch

import cvxpy as cp
import highspy
import numpy as np

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


class _CvxpyBackend(ABC):
    name: str
    package: str
    cvxpy_name: str

    def solve(self, instance: Instance, limits: Limits) -> Solution:
        """Minimise; Ctrl-C ends with the best solution so far."""
        if (known := answer_at_once(instance, limits, self.name)) is not None:
            return known
        began = time.perf_counter()
        matrix, bound = instance.matrix
        x = cp.Variable(len(instance.variables), boolean=True)
        cost = cp.Minimize(np.array(instance.objective, dtype=float) @ x)
        rows = [matrix.astype(float) @ x >= bound] if len(bound) else []
        problem = cp.Problem(cost, rows)
        data, chain, _ = problem.get_problem_data(self.cvxpy_name)
        build_seconds = time.perf_counter() - began
        began = time.perf_counter()
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            raw = self._run(chain, problem, data, limits)
        answer = self._answer(raw)
        answer.solve_seconds = time.perf_counter() - began
        used, cvxpy = map(importlib.metadata.version, (self.package, "cvxpy"))
        solver = f"{self.name} ({self.package} {used}, cvxpy {cvxpy})"
        return checked(answer, instance, limits, build_seconds=build_seconds, solver=solver)

    @abstractmethod
    def _run(self, chain: Any, problem: cp.Problem, data: Any, limits: Limits) -> Any: ...

    @abstractmethod
    def _answer(self, raw: Any) -> Answer: ...


class _QuietHighs(highspy.Highs):
    """HiGHS that prints nothing, and whose `run`, which cvxpy calls, ends on Ctrl-C."""

    def enableCallbacks(self) -> None:  # noqa: N802
        # The constructor's first call: without the option it would print HiGHS's banner.
        self.silent()
        super().enableCallbacks()  # type: ignore[no-untyped-call]

    def run(self) -> Any:
        # `run` itself cannot be interrupted; a thread of its own can.
        self.HandleUserInterrupt = True
        self.startSolve()
        ended, status = False, None
        while not ended:
            try:
                ended, status = self.wait(0.1)
            except KeyboardInterrupt:
                self.cancelSolve()  # type: ignore[no-untyped-call]
        return status


@contextmanager
def quiet_highs() -> Iterator[None]:
    """While it lasts, the HiGHS that cvxpy makes prints nothing and ends on Ctrl-C."""
    with patch.object(highspy, "Highs", _QuietHighs):
        yield


def _rounded(values: Any) -> list[int]:
    return [round(float(value)) for value in values]


class Highs(_CvxpyBackend):
    """Branch and cut of HiGHS."""

    name = "highs"
    package = "highspy"
    cvxpy_name = cp.HIGHS
    features = frozenset({Feature.BOUND, Feature.GAP, Feature.THREADS, Feature.SEED})

    def _run(self, chain: Any, problem: cp.Problem, data: Any, limits: Limits) -> Any:
        options: dict[str, Any] = {
            "threads": limits.threads,
            "random_seed": limits.seed,
            "mip_rel_gap": limits.gap,
            "mip_abs_gap": 0.0 if limits.gap else 0.999,  # weights are integers
        }
        if limits.seconds is not None:
            options["time_limit"] = limits.seconds
        with quiet_highs():
            return chain.solve_via_data(problem, data, solver_opts=options)

    def _answer(self, raw: Any) -> Answer:
        word, info = raw["model_status"], raw["info"]
        solved = info.primal_solution_status == 2  # feasible
        if word == "kInfeasible":
            return Answer(Status.INFEASIBLE, word)
        bound = float(info.mip_dual_bound)
        return Answer(
            Status.OPTIMAL if word == "kOptimal" else Status.FEASIBLE if solved else Status.UNKNOWN,
            word,
            _rounded(raw["solution"].col_value) if solved else None,
            bound if np.isfinite(bound) else None,
        )


class Scip(_CvxpyBackend):
    """Branch, cut and price of SCIP, which catches Ctrl-C itself."""

    name = "scip"
    package = "pyscipopt"
    cvxpy_name = cp.SCIP
    features = frozenset({Feature.BOUND, Feature.GAP, Feature.SEED})

    def __init__(self) -> None:
        if importlib.util.find_spec("pyscipopt") is None:
            raise MissingSolverError(self.name, "pyscipopt", "scip")

    def _run(self, chain: Any, problem: cp.Problem, data: Any, limits: Limits) -> Any:
        options: dict[str, Any] = {
            "limits/gap": limits.gap,
            "randomization/randomseedshift": limits.seed,
        }
        if limits.seconds is not None:
            options["limits/time"] = limits.seconds
        return chain.solve_via_data(problem, data, solver_opts={"scip_params": options})

    def _answer(self, raw: Any) -> Answer:
        word, model = raw["scip_status"], raw["model"]
        if word == "infeasible":
            return Answer(Status.INFEASIBLE, word)
        values = _rounded(raw["primal"]) if "primal" in raw else None
        bound = float(model.getDualbound())
        found = Status.FEASIBLE if values is not None else Status.UNKNOWN
        return Answer(
            Status.OPTIMAL if word == "optimal" else found,
            word,
            values,
            bound if abs(bound) < model.infinity() else None,
        )
