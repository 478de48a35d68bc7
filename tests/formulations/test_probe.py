"""The probe tells working solvers from broken ones."""

from __future__ import annotations

import subprocess
import sys
from itertools import product
from pathlib import Path

import pytest

import formulations
from formulations import probe
from formulations.backends import BACKENDS
from formulations.instance import Instance, Row


def test_the_optimum_of_the_probe_by_brute_force() -> None:
    covers = [x for x in product((0, 1), repeat=5) if all(x[i] or x[j] for i, j in probe.CYCLE)]
    assert min(map(sum, covers)) == probe.COVER


@pytest.mark.parametrize("name", list(probe.PROBES))
def test_probes_in_this_process_in_this_order(name: str) -> None:
    solve, optimum = probe.PROBES[name]
    assert solve() == pytest.approx(optimum, abs=probe.TOLERANCE)


@pytest.mark.parametrize(
    "order",
    [
        "from ortools.sat.python import cp_model; import cvxpy",
        "import cvxpy; from ortools.sat.python import cp_model",
    ],
)
def test_cvxpy_and_cp_sat_share_a_process_in_either_import_order(order: str) -> None:
    code = (
        f"{order}\nfrom formulations.probe import PROBES\n"
        "print(all(abs(solve() - best) < 1e-6 for solve, best in PROBES.values()))"
    )
    run = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
    assert run.stdout.strip() == "True", run.stderr


@pytest.mark.parametrize("solver", [*BACKENDS, *probe.PROBES])
def test_no_solver_writes_to_the_terminal(solver: str) -> None:
    """Nor to the process's standard streams below Python, where a solver's own code writes."""
    instance = Instance(
        "edges of the 5-cycle",
        tuple("abcde"),
        5,
        (1,) * 5,
        tuple(Row((i + 1, j + 1), 1, "cover", f"{i} {j}") for i, j in probe.CYCLE),
        start=(1, 2, 3, 4, 5),
    )
    code = (
        "from formulations.backends import BACKENDS, get_backend\n"
        "from formulations.instance import Instance\n"
        "from formulations.probe import PROBES\n"
        "from formulations.solution import Feature, Limits\n"
        f"instance, solver = Instance.from_json({instance.to_json()!r}), {solver!r}\n"
        "if solver in PROBES:\n"
        "    PROBES[solver][0]()\n"
        "else:\n"
        "    backend = get_backend(solver)\n"
        "    for _ in range(2):\n"
        "        assert backend.solve(instance, Limits(seconds=10)).objective == 3\n"
        "    if Feature.ENUMERATION in backend.features:\n"
        "        assert len(backend.enumerate(instance, Limits(), 100).sets) == 11\n"
    )
    run = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
    assert (run.returncode, run.stdout, run.stderr) == (0, "", "")


def test_an_unknown_solver_has_no_probe() -> None:
    with pytest.raises(KeyError, match="GLPK"):
        probe.probe_solvers(["GLPK"])


@pytest.mark.parametrize(
    ("script", "message"),
    [
        ("import sys; sys.exit('wrong optimum 2.5, expected 3.0')", "wrong optimum 2.5"),
        ("import os; os.abort()", "exit status -6"),
        ("import time; time.sleep(60)", "no answer within"),
    ],
)
def test_wrong_answers_crashes_and_hangs(
    script: str, message: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    real = subprocess.run

    def run(command: list[str], **options: object) -> subprocess.CompletedProcess[str]:
        return real([command[0], "-c", script], **options)  # type: ignore[call-overload,no-any-return]

    monkeypatch.setattr(probe, "TIME_LIMIT", 1.0)
    monkeypatch.setattr(probe.subprocess, "run", run)
    (result,) = probe.probe_solvers(["CP-SAT (ortools)"])
    assert not result.works and message in result.message


def test_formulations_know_no_knots() -> None:
    folder = Path(formulations.__file__).parent
    assert not [path for path in folder.rglob("*.py") if "import knotopt" in path.read_text()]
    assert not [path for path in folder.rglob("*.py") if "from knotopt" in path.read_text()]
