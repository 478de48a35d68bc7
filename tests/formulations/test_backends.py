"""What comes of solvers that are wrong, stopped, missing or asked for nonsense."""

from __future__ import annotations

import json
import subprocess
import sys
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import pytest

from formulations import solution
from formulations.backends import BACKENDS, get_backend
from formulations.backends.exhaustive import Exhaustive
from formulations.instance import Instance, InstanceError, Row
from formulations.proof import refute
from formulations.solution import Answer, BackendError, Feature, Limits, Status, checked

COVER = Instance(
    "edges of a triangle",
    ("a", "b", "c"),
    3,
    (1, 1, 1),
    tuple(Row(edge, 1, "cover", str(edge)) for edge in ((1, 2), (2, 3), (1, 3))),
)


def test_a_wrong_answer_is_an_error() -> None:
    """Whatever a solver says of a set that violates a row."""
    for said in (Status.OPTIMAL, Status.FEASIBLE):
        wrong = Answer(said, "kOptimal", [1, 0, 0], bound=1.0)
        found = checked(wrong, COVER, Limits(), build_seconds=0, solver="")
        assert (found.status, found.chosen, found.objective) == (Status.ERROR, None, None)
        assert "violates cover: (2, 3)" in found.raw_status
        none = checked(Answer(said, "ok"), COVER, Limits(), build_seconds=0, solver="")
        assert none.status is Status.ERROR
    unproven = Answer(Status.OPTIMAL, "gap limit", [1, 1, 1], bound=1.2)
    found = checked(unproven, COVER, Limits(), build_seconds=0, solver="")
    assert (found.status, found.objective, found.bound) == (Status.FEASIBLE, 3, 2)
    proven = Answer(Status.FEASIBLE, "time limit", [1, 1, 0], bound=1.2)
    found = checked(proven, COVER, Limits(), build_seconds=0, solver="")
    assert (found.status, found.gap) == (Status.OPTIMAL, 0)


@pytest.mark.parametrize(
    ("seconds", "spent", "interrupted"),
    [(None, 1, True), (10, 1, True), (10, 9.5, False), (1e-3, 2e-4, False)],
)
def test_stopped_early_without_a_limit(
    seconds: float | None, spent: float, interrupted: bool
) -> None:
    answer = Answer(Status.UNKNOWN, "stopped", solve_seconds=spent)
    found = checked(answer, COVER, Limits(seconds), build_seconds=0, solver="")
    assert found.interrupted is interrupted


def test_instances_that_need_no_solver() -> None:
    """Without rows, or with one that has too few literals: all solvers say the same."""
    impossible = replace(COVER, rows=(*COVER.rows, Row((1,), 2, "two of one", "a")))
    for name in BACKENDS:
        found = get_backend(name).solve(impossible, Limits())
        assert (found.status, found.bound) == (Status.INFEASIBLE, None)
        assert "two of one: a" in found.raw_status
        empty = get_backend(name).solve(replace(COVER, rows=()), Limits())
        assert (empty.status, empty.chosen, empty.bound) == (Status.OPTIMAL, (), 0)


def test_starts() -> None:
    for start, accepted in (((1, 2), True), ((1,), False)):
        found = get_backend("cp-sat").solve(replace(COVER, start=start), Limits())
        assert found.start_accepted is accepted and found.objective == 2
    assert get_backend("cp-sat").solve(COVER, Limits()).start_accepted is None
    assert get_backend("highs").solve(replace(COVER, start=(1, 2)), Limits()).start_accepted is None


def hard_instance() -> Instance:
    """Random covers that no solver here finishes within a minute."""
    import random

    source = random.Random(1)
    rows = tuple(
        Row(tuple(source.sample(range(1, 201), 3)), 1, "cover", str(k)) for k in range(900)
    )
    names = tuple(f"x{j}" for j in range(200))
    return Instance("hard", names, 200, (1,) * 200, rows, start=tuple(range(1, 201)))


@pytest.mark.parametrize("name", ["cp-sat", "highs", "scip", "maxsat"])
def test_a_time_limit_gives_what_is_known(name: str) -> None:
    found = get_backend(name).solve(hard_instance(), Limits(seconds=1, seed=3))
    assert found.status is Status.FEASIBLE and found.chosen is not None
    assert found.objective is not None and found.bound is not None
    assert found.bound < found.objective and 0 < (found.gap or 0) <= 1
    assert found.seed == 3 and found.raw_status


def test_a_limit_between_two_calls_of_an_oracle_is_no_proof(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    from pysat.examples.rc2 import RC2

    def interrupted(self: RC2, process: Callable[[RC2], None] = RC2.process_core) -> None:
        self.interrupt()
        process(self)

    monkeypatch.setattr(RC2, "process_core", interrupted)
    found = get_backend("maxsat").solve(replace(COVER, start=(1, 2, 3)), Limits(seconds=1000))
    assert (found.status, found.chosen, found.bound) == (Status.FEASIBLE, (1, 2, 3), 1)
    assert found.raw_status == "time limit"


def interrupt(name: str, folder: Path, code: str) -> list[str]:
    """What `code` prints when Ctrl-C reaches it after two seconds on the hard instance.

    A second Ctrl-C, once the solver is done, must reach Python again.
    """
    file = folder / "hard.json"
    file.write_text(hard_instance().to_json())
    code = (
        "import os, signal, subprocess, time\n"
        "from formulations.backends import get_backend\n"
        "from formulations.instance import Instance\n"
        "from formulations.solution import Limits\n"
        f"instance = Instance.from_json(open({str(file)!r}).read())\n"
        f"backend = get_backend({name!r})\n"
        "subprocess.Popen(f'sleep 2; kill -INT {os.getpid()}', shell=True)\n"
        f"{code}\n"
        "try:\n"
        "    os.kill(os.getpid(), signal.SIGINT)\n"
        "    time.sleep(10)\n"
        "except KeyboardInterrupt:\n"
        "    print('heard')\n"
    )
    run = subprocess.run(
        [sys.executable, "-c", code], capture_output=True, text=True, check=True, timeout=120
    )
    *said, last = run.stdout.splitlines()
    assert last == "heard" and not run.stderr
    return said


@pytest.mark.slow
@pytest.mark.parametrize("name", ["cp-sat", "highs", "scip", "maxsat"])
def test_ctrl_c_gives_the_best_so_far(name: str, tmp_path: Path) -> None:
    code = (
        "found = backend.solve(instance, Limits(seconds=60))\n"
        "print(found.status, found.objective, found.interrupted, found.solve_seconds < 30)"
    )
    status, objective, *sooner = interrupt(name, tmp_path, code)[-1].split()
    assert status == "feasible" and int(objective) > 0 and sooner == ["True", "True"]


@pytest.mark.slow
def test_ctrl_c_ends_an_enumeration_with_the_sets_so_far(tmp_path: Path) -> None:
    code = (
        "found = backend.enumerate(instance, Limits(seconds=60), 10**6)\n"
        "print(found.complete, len(found.sets) > 1, not any(\n"
        "    instance.violated(instance.complete(chosen)) for chosen in found.sets[:100]))"
    )
    assert interrupt("cp-sat", tmp_path, code) == ["False True True"]


def test_what_makes_no_sense_is_refused() -> None:
    for limits, message in (
        ({"seconds": 0}, "time limit"),
        ({"gap": 1}, "gap"),
        ({"threads": 0}, "threads"),
        ({"seed": -1}, "seed"),
    ):
        with pytest.raises(BackendError, match=message):
            Limits(**limits)  # type: ignore[arg-type]
    with pytest.raises(BackendError, match="no solver is named 'gurobi'"):
        get_backend("gurobi")
    one = (Row((1, 2), 1, "cover", "12"),)
    wide = Instance("wide", tuple(map(str, range(23))), 23, (1,) * 23, one)
    with pytest.raises(BackendError, match="at most 22 variables; this instance has 23"):
        Exhaustive().solve(wide, Limits())
    with pytest.raises(BackendError, match="one weight"):
        Exhaustive().solve(replace(COVER, objective=(1, 2, 1)), Limits())


def test_a_missing_solver_is_named(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("importlib.util.find_spec", lambda _: None)
    for name, package, extra in (("scip", "pyscipopt", "scip"), ("maxsat", "python-sat", "sat")):
        with pytest.raises(solution.MissingSolverError) as caught:
            get_backend(name)
        assert (caught.value.package, caught.value.extra) == (package, extra)
    with pytest.raises(solution.MissingSolverError, match="cadical"):
        refute([(1,), (-1,)])


def test_features() -> None:
    assert get_backend("cp-sat").features == set(Feature)
    assert Feature.START not in get_backend("highs").features
    assert {n for n in BACKENDS if Feature.ENUMERATION in get_backend(n).features} == {
        "cp-sat",
        "exhaustive",
    }


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"objective": (1, 1)}, "2 weights for 3 variables"),
        ({"objective": (1, 1, -1)}, "found -1"),
        ({"decisions": 2}, "2 decisions and 0 definitions"),
        ({"rows": (Row((4,), 1, "f", "o"),)}, r"row 1 \(f\): a literal names no variable"),
        ({"rows": (Row((1, -1), 1, "f", "o"),)}, r"row 1 \(f\): a variable stands there twice"),
        ({"decisions": 2, "definitions": ((3,),)}, "variable 3 is not defined by earlier ones"),
        ({"start": (4,)}, "4 is no decision variable"),
    ],
)
def test_bad_instances(change: dict[str, object], message: str) -> None:
    with pytest.raises(InstanceError, match=message):
        replace(COVER, **change)  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("{", "not JSON: line 1"),
        ("[]", "not an instance"),
        (COVER.to_json()[:-2], "not JSON"),
        (COVER.to_json().replace('"rows"', '"row"'), "key 'rows' is missing"),
        (COVER.to_json().replace('"decisions":3', '"decisions":"x"'), "wrong kind"),
        (COVER.to_json().replace('"decisions":3', '"decisions":4'), "4 decisions"),
        (COVER.to_json().replace('"at_least":1', '"at_least":1.5'), "1.5 is no integer"),
        (COVER.to_json().replace('"literals":[1,2]', '"literals":"12"'), "'12' is no list"),
    ],
)
def test_bad_files(text: str, message: str) -> None:
    with pytest.raises(InstanceError, match=message):
        Instance.from_json(text)


def test_solvers_share_a_process_in_either_order() -> None:
    for order in (("cp-sat", "highs", "scip"), ("scip", "highs", "cp-sat")):
        code = (
            "from formulations.backends import get_backend\n"
            "from formulations.instance import Instance\n"
            "from formulations.solution import Limits\n"
            f"instance = Instance.from_json({COVER.to_json()!r})\n"
            f"print([get_backend(n).solve(instance, Limits()).objective for n in {order!r}])\n"
        )
        run = subprocess.run(
            [sys.executable, "-c", code],
            capture_output=True,
            text=True,
            check=True,
        )
        assert json.loads(run.stdout) == [2, 2, 2]
