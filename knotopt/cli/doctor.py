"""`knotopt doctor`: versions, and which solvers and extras work here."""

from __future__ import annotations

from dataclasses import asdict, astuple

import typer

from knotopt.cli.options import JsonOption
from knotopt.cli.printing import print_json, print_table
from knotopt.errors import install_line

EXTRAS = {
    "viz": "matplotlib",
    "knotinfo": "database_knotinfo",
    "snappy": "snappy",
    "scip": "pyscipopt",
    "sat": "python-sat",
    "sim": "mujoco",
    "atlas": "pyarrow",
    "cluster": "distributed",
    "pandas": "pandas",
    "fast": "numba",
}
PACKAGES = (
    "knotopt",
    "numpy",
    "scipy",
    "networkx",
    "shapely",
    "pythoncdt",
    "casadi",
    "cvxpy",
    "highspy",
    "ortools",
)


def doctor(as_json: JsonOption = False) -> None:
    """Check versions, solvers (each solves a program) and extras.

    Exit status 1 if a solver does not work. Example: knotopt doctor
    """
    import importlib.metadata
    import platform

    from formulations.probe import PROBES, probe_solvers

    def version(package: str) -> str:
        try:
            return importlib.metadata.version(package)
        except importlib.metadata.PackageNotFoundError:
            return "not installed"

    versions = {"python": platform.python_version()} | {name: version(name) for name in PACKAGES}
    needed = {"SCIP (cvxpy)": "scip", "RC2 and CaDiCaL (pysat)": "sat"}
    extras = {extra: version(package) for extra, package in EXTRAS.items()}
    missing = {extra for extra, found in extras.items() if found == "not installed"}
    extras |= {extra: f"not installed: {install_line(extra)}" for extra in missing}
    solvers = probe_solvers([name for name in PROBES if needed.get(name) not in missing])
    if as_json:
        probes = [asdict(probe) for probe in solvers]
        print_json({"versions": versions, "solvers": probes, "extras": extras})
    else:
        print_table(("package", "version"), versions.items())
        print_table(("solver", "works", "message"), map(astuple, solvers))
        print_table(("extra", "state"), extras.items())
    if not all(probe.works for probe in solvers):
        raise typer.Exit(1)
