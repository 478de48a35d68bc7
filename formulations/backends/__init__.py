"""Solvers, one file each, behind one protocol; a backend is imported when it is asked for."""

from __future__ import annotations

import importlib

from formulations.solution import Backend, BackendError

BACKENDS = {
    "cp-sat": ("cp_sat", "CpSat"),
    "highs": ("cvxpy_milp", "Highs"),
    "scip": ("cvxpy_milp", "Scip"),
    "maxsat": ("maxsat", "MaxSat"),
    "exhaustive": ("exhaustive", "Exhaustive"),
}
"""Name of a backend to its module here and its class there."""

DEFAULT = "cp-sat"


def get_backend(name: str = DEFAULT) -> Backend:
    """The backend of that name.

    Raises
    ------
    BackendError
        There is none; the message lists them.
    MissingSolverError
        Its solver is not installed.

    Examples
    --------
    >>> get_backend("cp-sat").name
    'cp-sat'
    >>> get_backend("gurobi")
    Traceback (most recent call last):
    ...
    formulations.solution.BackendError: no solver is named 'gurobi': expected one of cp-sat, \
highs, scip, maxsat, exhaustive
    """
    if name not in BACKENDS:
        raise BackendError(f"no solver is named {name!r}: expected one of {', '.join(BACKENDS)}")
    module, cls = BACKENDS[name]
    backend: Backend = getattr(importlib.import_module(f"formulations.backends.{module}"), cls)()
    return backend
