"""An atlas with several solvers: their answers, files, a killed run, wrong input, the report."""

from __future__ import annotations

import json
import shutil
import signal
import sys
from dataclasses import replace
from pathlib import Path
from typing import Any

import pyarrow.parquet as pq
import pytest

from formulations.backends import BACKENDS
from formulations.instance import Instance
from formulations.solution import BackendError, Limits, Solution, Status
from knotopt.atlas import solvers, store
from knotopt.atlas.columns import FILES
from knotopt.atlas.engine import Local
from knotopt.atlas.measure import KnotResult, measure_knot
from knotopt.atlas.report.performance import SOLVERS as STYLES
from knotopt.atlas.report.report import report_document
from knotopt.atlas.report.results import Results, read_results
from knotopt.atlas.report.solvers import solvers_table, wrong_answers
from knotopt.atlas.run import run_atlas
from knotopt.atlas.schema import MANIFEST, PARTS, File, Manifest, Settings
from knotopt.atlas.solvers import PACKAGES, REFUSED
from knotopt.atlas.store import read_manifest, read_rows
from knotopt.document.columns import Row, names
from knotopt.document.markdown import markdown
from knotopt.errors import MissingExtraError, OutputError, RequirementError, SolverError
from tests.helpers.atlas_process import ended, same_results, start, wait_for_parts
from tests.helpers.command_line import Cli
from tests.helpers.small_atlas import LIST, SETTINGS, Replay, contents

EVERY = Settings(span=True, check=1, solvers=tuple(BACKENDS))


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path: Path = tmp_path_factory.mktemp("solvers") / "run"
    run_atlas(path, LIST[:1], EVERY, Local())
    return path


@pytest.fixture
def results(folder: Path) -> Results:
    return read_results(folder)


def test_all_solvers_find_the_same(folder: Path) -> None:
    atlas, rows = (read_rows(folder, name).to_pylist() for name in (File.ATLAS, File.SOLVERS))
    expected = [
        (row["cut"], formulation, solver, row[f"{formulation}_robots"], row[f"{formulation}_rows"])
        for row in atlas
        for formulation in ("opening", "span")
        for solver in BACKENDS
    ]
    assert [
        (row["cut"], row["formulation"], row["solver"], row["objective"], row["rows"])
        for row in rows
    ] == expected
    for row in rows:
        assert (row["status"], row["bound"]) == ("optimal", row["objective"])
        assert row["proven"] is row["satisfies"] is row["meets_definition"] is True
    times = read_rows(folder, File.SOLVER_TIMES).to_pylist()
    for row, spent in zip(rows, times, strict=True):
        for key in ("number", "knot", "cut", "formulation", "solver"):
            assert row[key] == spent[key]
        assert 0 <= spent["solve_seconds"] <= spent["seconds"]


def test_columns_say_what_they_hold(folder: Path) -> None:
    for name in (File.SOLVERS, File.SOLVER_TIMES):
        schema = read_rows(folder, name).schema
        assert tuple(schema.names) == names(FILES[name])
        for column in FILES[name]:
            assert schema.field(column.name).metadata[b"meaning"].decode() == column.meaning


def test_versions_of_solvers_only_when_asked(folder: Path, whole: Path) -> None:
    assert set(PACKAGES) == set(STYLES) == set(BACKENDS)
    asked = set(read_manifest(folder).versions)
    assert asked == set(read_manifest(whole).versions) | {
        "highspy",
        "cvxpy",
        "pyscipopt",
        "python-sat",
    }


def test_without_solvers_a_folder_is_as_it_was(whole: Path) -> None:
    assert list(json.loads((whole / MANIFEST).read_text())["settings"]) == [
        "openness",
        "seed",
        "span",
        "paths",
        "check",
    ]
    assert sorted(path.name for path in whole.iterdir()) == [
        File.ATLAS,
        File.KNOTS,
        MANIFEST,
        File.TIMES,
    ]
    titles = [each.title for each in report_document(read_results(whole), {}).sections]
    assert "Solvers" not in titles
    assert "Flights" not in titles


def test_parts_with_lists_that_nobody_asked_for(
    half: Path, whole: Path, measured: dict[int, KnotResult]
) -> None:
    """Parts of a run that was begun when each had a list of paths."""
    part = half / PARTS / "part-00000001.parquet"
    table = pq.read_table(part)
    table = table.append_column("paths", [[[]] * table.num_rows])
    part.write_bytes(store._to_bytes(table))
    run_atlas(half, LIST, SETTINGS, Replay(measured))
    assert contents(half) == contents(whole)


def test_manifest_is_its_text() -> None:
    for settings in (EVERY, Settings(solvers=("scip",), solver_limit=0.5), Settings(physics=True)):
        manifest = Manifest(settings, {"knotopt": "1"}, 2, "ab")
        assert Manifest.from_text(manifest.text) == manifest
    for wrong in (0, -1.0, float("nan"), float("inf")):
        with pytest.raises(RequirementError, match="the time limit of a solver must be positive"):
            Settings(solver_limit=wrong)


def test_other_solvers(folder: Path) -> None:
    before = contents(folder)
    for other, words in (
        (Settings(span=True, check=1), "solvers = cp-sat, .*, exhaustive, not none"),
        (replace(EVERY, solvers=("highs",)), "solvers = cp-sat, .*, exhaustive, not highs"),
        (replace(EVERY, solver_limit=1.0), r"solver_limit = 60\.0, not 1\.0"),
    ):
        with pytest.raises(OutputError, match=f"was begun with {words}: finish it with that"):
            run_atlas(folder, LIST[:1], other, Local())
    assert contents(folder) == before


def test_resumed(tmp_path: Path) -> None:
    settings = Settings(check=0, solvers=("cp-sat", "maxsat"))
    found = {knot.number: measure_knot(knot, settings) for knot in LIST[:3]}
    run_atlas(tmp_path / "whole", LIST[:3], settings, Replay(found))
    with pytest.raises(KeyboardInterrupt):
        run_atlas(tmp_path / "half", LIST[:3], settings, Replay(found, 2, KeyboardInterrupt()))
    engine = Replay(found)
    run_atlas(tmp_path / "half", LIST[:3], settings, engine)
    assert engine.asked == [2, 1]
    assert contents(tmp_path / "half") == contents(tmp_path / "whole")
    assert File.SOLVER_TIMES in contents(tmp_path / "half")


@pytest.mark.slow
def test_killed_run_ends_like_others(tmp_path: Path) -> None:
    knots = ("3_1", "4_1", "5_1")
    options = ("--jobs", 1, "--check", 2, "--solvers", "maxsat,highs")
    whole, broken = tmp_path / "whole", tmp_path / "broken"
    status, output, errors = ended(whole, start(whole, knots, *options))
    assert (status, errors) == (0, "")
    assert "highs 24 of 24, maxsat 24 of 24" in output
    process = start(broken, knots, *options, pauses=True)
    wait_for_parts(broken, 1, process)
    process.send_signal(signal.SIGKILL)
    assert ended(broken, process)[0] == -signal.SIGKILL
    assert not (broken / File.ATLAS).exists()
    assert ended(broken, start(broken, knots, *options))[0] == 0
    assert same_results(broken, whole)
    assert (broken / File.SOLVERS).read_bytes() == (whole / File.SOLVERS).read_bytes()
    assert read_rows(broken, File.SOLVER_TIMES).num_rows == 48


class Stub:
    """A solver that answers what it is told to."""

    name, features = "stub", frozenset[Any]()

    def __init__(self, answer: Solution | Exception) -> None:
        self.answer = answer

    def solve(self, instance: Instance, _: Limits) -> Solution:
        if instance.decisions == 2:  # to make it warm
            return Solution(Status.UNKNOWN, "")
        if isinstance(self.answer, Exception):
            raise self.answer
        return self.answer


def answers(answer: Solution | Exception, monkeypatch: pytest.MonkeyPatch) -> list[Row]:
    """The rows of 3_1 where HiGHS is such a solver."""
    real = solvers.find_backend
    solvers.warm.cache_clear()
    with monkeypatch.context() as patch:
        patch.setattr(
            solvers, "find_backend", lambda name: Stub(answer) if name == "highs" else real(name)
        )
        result = measure_knot(LIST[0], Settings(check=1, solvers=("highs",)))
    solvers.warm.cache_clear()
    return list(result.requested[File.SOLVERS])


def test_sets_that_are_none(monkeypatch: pytest.MonkeyPatch) -> None:
    ends = (1, 10)
    lost = answers(Solution(Status.OPTIMAL, "sure", ends, 2, 2), monkeypatch)
    assert {(row["satisfies"], row["meets_definition"], row["proven"]) for row in lost} == {
        (False, False, True)
    }
    failed = answers(Solution(Status.ERROR, "crashed"), monkeypatch)
    assert {(row["status"], row["satisfies"], row["meets_definition"]) for row in failed} == {
        ("error", False, None)
    }
    none = answers(Solution(Status.INFEASIBLE, "none"), monkeypatch)
    assert {(row["proven"], row["satisfies"], row["objective"]) for row in none} == {
        (True, None, None)
    }


def test_programs_that_a_solver_does_not_take(monkeypatch: pytest.MonkeyPatch) -> None:
    rows = answers(BackendError("too many variables"), monkeypatch)
    assert {(row["status"], row["said"], row["proven"]) for row in rows} == {
        (REFUSED, "too many variables", False)
    }


def test_an_interrupted_solver_ends_the_run(monkeypatch: pytest.MonkeyPatch) -> None:
    with pytest.raises(KeyboardInterrupt):
        answers(Solution(Status.FEASIBLE, "", interrupted=True), monkeypatch)


def test_who_is_wrong(results: Results) -> None:
    assert wrong_answers(results) == [False] * len(results.solvers)
    rows = [dict(row) for row in results.solvers]
    robots = rows[0]["objective"]
    rows[0] |= {"objective": robots + 1, "bound": robots + 1}  # proven, yet too large
    rows[1] |= {"status": "error", "objective": None, "bound": None, "satisfies": False}
    rows[2] |= {"meets_definition": False}
    rows[3] |= {"status": "infeasible", "objective": None, "bound": None, "satisfies": None}
    rows[4] |= {"status": "feasible", "objective": robots + 3, "bound": 2, "proven": False}
    rows[6] |= {"status": "unknown", "objective": None, "bound": None, "satisfies": None}
    changed = replace(results)
    changed.__dict__["solvers"] = rows
    assert wrong_answers(changed) == [True] * 4 + [False] * (len(rows) - 4)
    table = solvers_table(changed)
    place = table.heads.index("wrong")
    assert [row[place] for row in table.rows[:5]] == ["1", "1", "1", "1", "0"]


def test_section(results: Results) -> None:
    text = markdown(report_document(results, {}))
    assert "## Solvers" in text
    assert "The sets of 80 answers were examined" in text
    assert "(solvers.png)" in text
    assert "is in section Solvers." in text
    assert [row[:6] for row in solvers_table(results).rows[:2]] == [
        ("`opening`", "CP-SAT", "8", "8", "8", "0"),
        ("`opening`", "HiGHS (cvxpy)", "8", "8", "8", "0"),
    ]


def test_files_that_do_not_fit(folder: Path, tmp_path: Path) -> None:
    shutil.copytree(folder, tmp_path / "run")
    path = tmp_path / "run" / File.SOLVER_TIMES
    path.write_bytes(store._to_bytes(pq.read_table(path).slice(1)))
    with pytest.raises(OutputError, match=r"solvers.parquet and solver_times.parquet do not have"):
        read_results(tmp_path / "run")
    path.unlink()
    with pytest.raises(OutputError, match=r"has no solver_times.parquet"):
        read_results(tmp_path / "run")


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["--solvers", "cp-sat,rc2"], "knotopt: no solver is named 'rc2': expected one of cp-sat,"),
        (["--solvers", ""], "knotopt: no solver is named '': expected one of cp-sat,"),
        (["--solver-limit", "5"], "goes with --solvers"),
        (["--solvers", "highs", "--solver-limit", "0"], "must be positive, not 0.0 s"),
    ],
)
def test_wrong_input(cli: Cli, tmp_path: Path, arguments: list[str], words: str) -> None:
    status, output, errors = cli("atlas", tmp_path / "run", "3_1", *arguments)
    assert status in (1, 2)
    assert output == ""
    assert words in " ".join(errors.replace("│", "").split())
    assert not (tmp_path / "run").exists()


def test_missing_solver(cli: Cli, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "pyscipopt", None)
    status, _, errors = cli("atlas", tmp_path / "run", "3_1", "--solvers", "scip,highs")
    assert status == 1
    assert "solver scip needs pyscipopt, which is not installed" in errors
    assert "pip install 'knotopt[scip]'" in errors
    for settings, error in (
        (Settings(solvers=("scip",)), MissingExtraError),
        (Settings(solvers=("none",)), SolverError),
    ):
        with pytest.raises(error):
            run_atlas(tmp_path / "run", LIST, settings, Local())
    assert not (tmp_path / "run").exists()


def test_solvers_in_any_order_are_the_same_run(cli: Cli, tmp_path: Path) -> None:
    assert cli("atlas", tmp_path / "run", "3_1", "--jobs", 1, "--solvers", "maxsat,cp-sat")[0] == 0
    before = contents(tmp_path / "run")
    again = cli("atlas", tmp_path / "run", "3_1", "--jobs", 1, "--solvers", "cp-sat, maxsat")
    assert again[0] == 0
    assert "cp-sat 8 of 8, maxsat 8 of 8" in again[1]
    assert contents(tmp_path / "run") == before
