"""Which solvers work here: each solves a small program whose optimum is known, in its own process.

A solver that can be imported may still give wrong answers (HiGHS 1.14.0 does) or crash the process
it shares with another (two builds of HiGHS), so neither an import nor a version is asked for.
"""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Callable, Iterable
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from typing import Any

# Smallest vertex cover of the 5-cycle: 3, while its linear relaxation has 2.5.
CYCLE = [(0, 1), (1, 2), (2, 3), (3, 4), (4, 0)]
COVER = 3.0
# Smallest squared distance of the circle x^2 + y^2 = 1 from (3, 4): (5 - 1)^2.
DISTANCE = 16.0
TOLERANCE = 1e-6
TIME_LIMIT = 60.0  # [s]


@dataclass(frozen=True)
class ProbeResult:
    """Whether one solver works, and what it said if not."""

    solver: str
    works: bool
    message: str


def probe_solvers(names: Iterable[str] | None = None) -> list[ProbeResult]:
    """Try the named solvers, by default all in `PROBES`, side by side.

    Raises
    ------
    KeyError
        No probe has that name.
    """
    chosen = list(PROBES if names is None else names)
    for name in chosen:
        PROBES[name]
    with ThreadPoolExecutor() as pool:
        return list(pool.map(_probe_in_process, chosen))


def _probe_in_process(name: str) -> ProbeResult:
    try:
        run = subprocess.run(
            [sys.executable, "-m", "formulations.probe", name],
            capture_output=True,
            text=True,
            timeout=TIME_LIMIT,
            check=False,
        )
    except subprocess.TimeoutExpired:
        return ProbeResult(name, False, f"no answer within {TIME_LIMIT:.0f} s")
    said = (run.stdout + run.stderr).strip().splitlines()
    if run.returncode == 0:
        return ProbeResult(name, True, said[-1] if said else "")
    return ProbeResult(name, False, said[-1] if said else f"exit status {run.returncode}")


def _cp_sat() -> float:
    from ortools.sat.python import cp_model

    model = cp_model.CpModel()
    x = [model.new_bool_var(f"x{i}") for i in range(len(CYCLE))]
    for i, j in CYCLE:
        model.add_bool_or(x[i], x[j])
    model.minimize(sum(x))
    solver = cp_model.CpSolver()
    solver.solve(model)
    return float(solver.objective_value)


def _highs() -> float:
    from formulations.backends.cvxpy_milp import quiet_highs

    with quiet_highs():
        return _cover_by_cvxpy("HIGHS")


def _scip() -> float:
    return _cover_by_cvxpy("SCIP")


def _cover_by_cvxpy(solver: str) -> float:
    import cvxpy as cp

    x = cp.Variable(len(CYCLE), boolean=True)
    problem = cp.Problem(cp.Minimize(x.sum()), [x[i] + x[j] >= 1 for i, j in CYCLE])
    return float(problem.solve(solver=solver))  # type: ignore[no-untyped-call]


def _pysat() -> float:
    from pysat.examples.rc2 import RC2
    from pysat.formula import WCNF
    from pysat.solvers import Solver

    cover = [[i + 1, j + 1] for i, j in CYCLE]
    formula = WCNF()
    formula.extend(cover)
    formula.extend([[-i - 1] for i in range(len(CYCLE))], weights=[1] * len(CYCLE))
    with Solver(name="cadical195", bootstrap_with=[[1], [-1]], with_proof=True) as cadical:
        if cadical.solve() or not cadical.get_proof():
            return 0.0
    with RC2(formula) as solver:
        solver.compute()
        return float(solver.cost)


def _ipopt() -> float:
    import casadi as ca

    x = ca.SX.sym("x", 2)
    program = {"x": x, "f": (x[0] - 3) ** 2 + (x[1] - 4) ** 2, "g": ca.dot(x, x)}
    options: dict[str, Any] = {"ipopt.print_level": 0, "ipopt.sb": "yes", "print_time": False}
    solver = ca.nlpsol("solver", "ipopt", program, options)
    return float(solver(x0=[1, 0], lbg=1, ubg=1)["f"])


PROBES: dict[str, tuple[Callable[[], float], float]] = {
    "CP-SAT (ortools)": (_cp_sat, COVER),
    "HiGHS (cvxpy)": (_highs, COVER),
    "SCIP (cvxpy)": (_scip, COVER),
    "RC2 and CaDiCaL (pysat)": (_pysat, COVER),
    "IPOPT (casadi)": (_ipopt, DISTANCE),
}
"""Solver to (its probe, the optimum it must find)."""


if __name__ == "__main__":
    probe, optimum = PROBES[sys.argv[1]]
    found = probe()
    if abs(found - optimum) > TOLERANCE:
        sys.exit(f"wrong optimum {found}, expected {optimum}")
    print(f"optimum {optimum:g} found")
