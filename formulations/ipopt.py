"""Solving path programs: IPOPT by way of CasADi."""

from __future__ import annotations

import signal
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from enum import StrEnum

import numpy as np

from formulations.arrays import FloatArray
from formulations.elements import Structure, build_solver, solver_options
from formulations.path import PathProgram
from formulations.path_terms import Constraint, Layout, constraint_terms, objective_terms


class PathStatus(StrEnum):
    """What came of a path program."""

    SOLVED = "solved"  # a local optimum within the tolerances
    STOPPED = "stopped"  # a limit struck first
    INFEASIBLE = "infeasible"  # the solver sees no point near by that meets the constraints
    FAILED = "failed"  # the solver broke down


STATUSES = {
    "Solve_Succeeded": PathStatus.SOLVED,
    "Solved_To_Acceptable_Level": PathStatus.SOLVED,
    "Feasible_Point_Found": PathStatus.SOLVED,
    "Search_Direction_Becomes_Too_Small": PathStatus.STOPPED,
    "Maximum_Iterations_Exceeded": PathStatus.STOPPED,
    "Maximum_CpuTime_Exceeded": PathStatus.STOPPED,
    "Maximum_WallTime_Exceeded": PathStatus.STOPPED,
    "User_Requested_Stop": PathStatus.STOPPED,
    "Infeasible_Problem_Detected": PathStatus.INFEASIBLE,
}
"""IPOPT's return status to ours; any other one is FAILED."""


@dataclass(frozen=True)
class Violation:
    """The worst a family of constraints is violated by, and which of its terms that is.

    `index` counts the rows of the program's triangles, strand pairs, corners, arcs, turns, opening
    pairs, crossings or steep segments.
    """

    family: str
    amount: float
    index: int


@dataclass(frozen=True, eq=False)
class PathSolution:
    """What the solver made of a path program.

    Attributes
    ----------
    status : PathStatus; raw_status : str
        Ours, and IPOPT's own word.
    positions, heights : float arrays as in the program
    objective : float
    iterations : int
    build_seconds, solve_seconds : float
    violations : tuple of Violation
        One for each family that has terms; a negative amount is a margin. Distances and heights
        are lengths; `diagram` is twice an area, `angle`, `turn` and `slope` squared lengths.
    """

    status: PathStatus
    raw_status: str
    positions: FloatArray
    heights: FloatArray
    objective: float
    iterations: int
    build_seconds: float
    solve_seconds: float
    violations: tuple[Violation, ...]


def solve(
    program: PathProgram, *, iterations: int = 200, seconds: float | None = None
) -> PathSolution:
    """Solve a path program from its start by IPOPT.

    Parameters
    ----------
    program : PathProgram
    iterations : int
        How many IPOPT may take.
    seconds : float, optional
        Wall time [s].

    Raises
    ------
    KeyboardInterrupt
        Ctrl-C was pressed, once IPOPT has ended.
    """
    began = time.perf_counter()
    layout = Layout(program)
    objective, constraints = objective_terms(program, layout), constraint_terms(program, layout)
    limits: dict[str, float] = {"max_iter": iterations}
    if seconds is not None:
        limits["max_wall_time"] = max(seconds, 1e-3)
    structure = Structure.of(
        layout.free,
        layout.fixed,
        [terms for terms, _ in objective],
        [terms for _, terms, _, _ in constraints],
    )
    solver = build_solver(structure, solver_options({**IPOPT, **limits}))
    built = time.perf_counter()
    parameters = [layout.start[layout.is_fixed]]
    parameters += [numbers.ravel() for _, numbers in objective]
    parameters += [numbers.ravel() for _, _, numbers, _ in constraints]
    lower = [bound for _, _, _, bound in constraints]
    low, high = _box(program, layout)
    with _interrupts_held_back():
        found = solver(
            x0=layout.start[~layout.is_fixed],
            p=np.concatenate(parameters),
            lbg=np.concatenate([*lower, []]),
            ubg=np.inf,
            lbx=low,
            ubx=high,
        )
    ended = time.perf_counter()
    raw = solver.stats()["return_status"]
    x = np.asarray(found["x"]).ravel()
    positions, heights = layout.values(np.clip(x, low, high))
    return PathSolution(
        STATUSES.get(raw, PathStatus.FAILED),
        raw,
        positions,
        heights,
        float(found["f"]),
        int(solver.stats()["iter_count"]),
        built - began,
        ended - built,
        _violations(constraints, np.asarray(found["g"]).ravel()),
    )


IPOPT = {
    "tol": 1e-2,
    "dual_inf_tol": 1e-1,
    "compl_inf_tol": 1e-2,
    "constr_viol_tol": 1e-5,
    "mu_init": 3e-3,
    # Also done: feasible, and hardly better over some iterations, as happens where a span can bend
    # in many equally good ways.
    "acceptable_tol": 1.0,
    "acceptable_compl_inf_tol": 1e-1,
    "acceptable_constr_viol_tol": 1e-5,
    "acceptable_obj_change_tol": 1e-3,
    "acceptable_iter": 3,
    # These systems are small and well scaled: MUMPS's own scaling only costs time.
    "mumps_scaling": 0,
    "mumps_permuting_scaling": 0,
}


@contextmanager
def _interrupts_held_back() -> Iterator[None]:
    """Ctrl-C takes effect at the end: CasADi would take it for a failed evaluation, and go on."""
    if threading.current_thread() is not threading.main_thread():
        yield
        return
    pressed = []
    before = signal.signal(signal.SIGINT, lambda *_: pressed.append(True))
    try:
        yield
    finally:
        signal.signal(signal.SIGINT, before)
    if pressed:
        raise KeyboardInterrupt


def _box(program: PathProgram, layout: Layout) -> tuple[FloatArray, FloatArray]:
    """Bounds of the free variables: as far as they may reach, and between floor and ceiling."""
    low, high = layout.start - program.reach, layout.start + program.reach
    low[2 * layout.vertices :] = program.bounds.floor
    high[2 * layout.vertices :] = program.bounds.ceiling
    return low[~layout.is_fixed], high[~layout.is_fixed]


def _violations(constraints: list[Constraint], g: FloatArray) -> tuple[Violation, ...]:
    """The worst term of each family, in the units of what it bounds."""
    found, start = [], 0
    for family, terms, _, lower in constraints:
        values = g[start : start + len(terms.variables)]
        start += len(values)
        amounts = lower - values
        if family in ("clearance", "spread", "opening"):
            amounts = np.sqrt(lower) - np.sqrt(np.maximum(values, 0))
        worst = int(np.argmax(amounts))
        found.append(Violation(family, float(amounts[worst]), worst))
    return tuple(found)
