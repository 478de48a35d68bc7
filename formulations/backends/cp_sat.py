"""CP-SAT of OR-tools.

With one thread and no time limit its answer depends on the instance and the seed alone.
"""

from __future__ import annotations

import importlib.metadata
import time
from concurrent.futures import ThreadPoolExecutor, wait
from typing import Any

from ortools.sat.python import cp_model

from formulations.instance import Instance
from formulations.solution import (
    Answer,
    Enumeration,
    Feature,
    Limits,
    Solution,
    Status,
    answer_at_once,
    checked,
)

_STATUS = {s.name: s for s in Status if s is not Status.ERROR}  # CP-SAT's words are ours
SMALL = 40  # variables


class CpSat:
    """Clause learning with linear relaxations; takes a start, gives a bound, enumerates."""

    name = "cp-sat"
    features = frozenset(Feature)

    def solve(self, instance: Instance, limits: Limits) -> Solution:
        """Minimise; Ctrl-C ends with the best solution so far."""
        if (known := answer_at_once(instance, limits, self.name)) is not None:
            return known
        began = time.perf_counter()
        model = _model(instance)
        weights = [(j, weight) for j, weight in enumerate(instance.objective) if weight]
        model.proto.objective.vars.extend([j for j, _ in weights])
        model.proto.objective.coeffs.extend([weight for _, weight in weights])
        solver = _solver(limits)
        start, first = [], None
        if instance.start is not None:
            start, first = instance.complete(instance.start).tolist(), _First()
            model.proto.solution_hint.vars.extend(range(len(start)))
            model.proto.solution_hint.values.extend(start)
        if len(instance.variables) <= SMALL:
            # On instances this small the time goes into presolve, symmetry and linear relaxations.
            solver.parameters.cp_model_presolve = False
            solver.parameters.symmetry_level = 0
            solver.parameters.linearization_level = 0
        build_seconds = time.perf_counter() - began
        began = time.perf_counter()
        status = _search(solver, model, first)
        seconds = time.perf_counter() - began
        answer = Answer(_STATUS.get(status, Status.ERROR), status, solve_seconds=seconds)
        if answer.status in (Status.OPTIMAL, Status.FEASIBLE):
            answer.values = list(solver.response_proto.solution)
        if answer.status is not Status.ERROR:
            answer.bound = solver.best_objective_bound
        if first is not None:
            answer.start_accepted = "hint" in first.origin and not instance.violated(start)
        version = f"{self.name} (ortools {importlib.metadata.version('ortools')})"
        return checked(answer, instance, limits, build_seconds=build_seconds, solver=version)

    def enumerate(self, instance: Instance, limits: Limits, count: int) -> Enumeration:
        """Every set that satisfies the rows, `count` at most; Ctrl-C ends with those so far."""
        if instance.impossible is not None:
            return Enumeration((), complete=True)
        solver = _solver(limits)
        solver.parameters.num_workers = 1
        solver.parameters.enumerate_all_solutions = True
        every = _All(instance.decisions, count)
        complete = _search(solver, _model(instance), every) in ("OPTIMAL", "INFEASIBLE")
        return Enumeration(tuple(sorted(every.sets)[:count]), complete and len(every.sets) <= count)


class _First(cp_model.CpSolverSolutionCallback):
    """Remembers where the first solution came from."""

    def __init__(self) -> None:
        super().__init__()
        self.origin = ""

    def on_solution_callback(self) -> None:
        self.origin = self.origin or self.response_proto.solution_info


class _All(cp_model.CpSolverSolutionCallback):
    """Collects the decisions of every solution, one more than asked for at most."""

    def __init__(self, decisions: int, count: int) -> None:
        super().__init__()
        self.decisions, self.count = decisions, count
        self.sets: set[tuple[int, ...]] = set()

    def on_solution_callback(self) -> None:
        values = self.response_proto.solution
        self.sets.add(tuple(j + 1 for j in range(self.decisions) if values[j]))
        if len(self.sets) > self.count:
            self.stop_search()


def _model(instance: Instance) -> cp_model.CpModel:
    model = cp_model.CpModel()
    proto: Any = model.proto
    for _ in instance.variables:
        proto.variables.add().domain.extend((0, 1))
    for row in instance.rows:
        references = [x - 1 if x > 0 else x for x in row.literals]  # not x_j is written -j - 1
        count = len(references)
        if row.at_least == 1:
            proto.constraints.add().bool_or.literals.extend(references)
        elif row.at_least == count - 1:
            proto.constraints.add().at_most_one.literals.extend([-x - 1 for x in references])
        elif row.at_least > 0:
            linear = proto.constraints.add().linear
            linear.vars.extend([abs(x) - 1 for x in row.literals])
            linear.coeffs.extend([1 if x > 0 else -1 for x in row.literals])
            negative = sum(x < 0 for x in row.literals)
            linear.domain.extend((row.at_least - negative, count))
    return model


def _solver(limits: Limits) -> cp_model.CpSolver:
    solver = cp_model.CpSolver()
    solver.parameters.num_workers = limits.threads
    solver.parameters.random_seed = limits.seed
    solver.parameters.relative_gap_limit = limits.gap
    if limits.seconds is not None:
        solver.parameters.max_time_in_seconds = limits.seconds
    return solver


def _search(
    solver: cp_model.CpSolver,
    model: cp_model.CpModel,
    callback: cp_model.CpSolverSolutionCallback | None,
) -> str:
    """Run the solver and name its status.

    The solver's own handler would leave Ctrl-C to the system afterwards, which ends the process,
    and a callback keeps Python from hearing it: the search runs in a thread and this one listens.
    """
    solver.parameters.catch_sigint_signal = False
    interrupted = False
    with ThreadPoolExecutor(1) as pool:
        search = pool.submit(solver.solve, model, callback)
        while not search.done():
            try:
                wait([search], 0.1)
                if interrupted:  # again and again: before the search has begun it hears nothing
                    solver.stop_search()
            except KeyboardInterrupt:
                interrupted = True
    status: str = search.result().name
    return status
