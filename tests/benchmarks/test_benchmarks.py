"""The benchmark harness: small runs of every benchmark, and runs that were interrupted."""

from __future__ import annotations

import json
import platform
import shutil
import subprocess
from pathlib import Path
from typing import Any

import pytest
from typer.testing import CliRunner

from benchmarks import __main__ as harness
from benchmarks import headlines, results
from benchmarks.__main__ import run_benchmark
from benchmarks.compare import ROOT, compare, fastest
from benchmarks.plots import lcf
from benchmarks.plots.versions import write_parts
from benchmarks.registry import BENCHMARKS, Benchmark, register
from knotopt.errors import FileFormatError, OutputError

in_a_clone = pytest.mark.skipif(not (ROOT / ".git").exists(), reason="not in a clone")
SIMULATED = {"physics", "physics_fewest", "physics_optimal", "physics_safe", "physics_tight"}
"""Flights of half a minute."""


def records(path: Path) -> list[dict[str, Any]]:
    return [json.loads(line) for line in path.read_text().splitlines()]


@pytest.mark.parametrize(
    "names",
    [
        pytest.param(set(BENCHMARKS) - SIMULATED, id="computed"),
        pytest.param(SIMULATED, id="simulated", marks=pytest.mark.slow),
    ],
)
def test_every_benchmark_runs_and_is_drawn(
    names: set[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Small runs of some, beside the results that are kept of the others."""
    run = CliRunner().invoke(
        harness.app, ["run", "--smoke", *sorted(names), "--out", str(tmp_path)]
    )
    assert run.exit_code == 0, run.output
    assert {path.stem for path in tmp_path.iterdir()} == names
    for name in names:
        header, *rows = records(tmp_path / f"{name}.jsonl")
        assert header["smoke"] and header["machine"]["cores"] and rows
    for name in set(BENCHMARKS) - names:
        shutil.copy(results.RESULTS / f"{name}.jsonl", tmp_path)
    monkeypatch.setattr(results, "RESULTS", tmp_path)
    monkeypatch.setattr(lcf, "FIT_FROM", 0)
    drawn = CliRunner().invoke(harness.app, ["plot"])
    assert drawn.exit_code == 0, drawn.output
    assert "At N = " in (tmp_path / "summary.md").read_text()
    assert (tmp_path / "growth.png").stat().st_size > 10_000
    linked = [f"{picture.stem}.pdf" for picture in tmp_path.glob("*.png")]
    drawn = CliRunner().invoke(harness.app, ["plot", "--format", "pdf"])
    assert drawn.exit_code == 0, drawn.output
    assert len(linked) > 5 and all((tmp_path / name).read_bytes()[:4] == b"%PDF" for name in linked)


def test_cases_and_results_of_a_small_run(tmp_path: Path) -> None:
    run_benchmark(BENCHMARKS["lcf_catalogue"], tmp_path, smoke=True)
    _, *rows = records(tmp_path / "lcf_catalogue.jsonl")
    assert rows[0]["case"] == {"knot": "3_1"} and set(rows[0]["result"]["robots"]) >= {"L+", "T-"}


def test_of_small_runs_nothing_is_kept(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    run_benchmark(BENCHMARKS["lcf_catalogue"], tmp_path, smoke=True)
    monkeypatch.setattr(results, "RESULTS", tmp_path)
    kept = CliRunner().invoke(harness.app, ["record"])
    assert kept.exit_code == 2 and "no results of version" in kept.output
    assert not (tmp_path / headlines.FILE).exists()


def test_every_benchmark_is_listed() -> None:
    listed = CliRunner().invoke(harness.app, ["list"]).output
    assert all(name in listed for name in BENCHMARKS)


def test_the_processor_is_named_where_it_is_known(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(platform, "processor", lambda: "")
    monkeypatch.setattr(harness, "CPUINFO", tmp_path / "cpuinfo")
    assert "processor" not in harness.machine_facts()
    harness.CPUINFO.write_text("processor\t: 0\nmodel name\t: Abacus: 9 rows\nflags\t: \n")
    assert harness.machine_facts()["processor"] == "Abacus: 9 rows"


def results_of(version: str, folder: Path) -> None:
    """The results as they are kept, as if measured with that version."""
    for benchmark in {headline.benchmark for headline in headlines.HEADLINES}:
        header, rest = (
            (results.RESULTS / f"{benchmark}.jsonl").read_text("utf-8").split("\n", maxsplit=1)
        )
        facts = json.loads(header)
        facts["machine"]["knotopt"] = version
        (folder / f"{benchmark}.jsonl").write_text(f"{json.dumps(facts)}\n{rest}", "utf-8")


def test_the_figures_of_each_version_are_kept(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    version = harness.machine_facts()["knotopt"]
    results_of(version, tmp_path)
    monkeypatch.setattr(results, "RESULTS", tmp_path)
    older = {"version": "0.0.1", "figures": [["old", "time [s]", 12.5, 3]], "machines": {}}
    versions = tmp_path / headlines.FILE
    versions.write_text(json.dumps(older) + "\n" + json.dumps({**older, "version": version}) + "\n")
    kept, left_out = headlines.record()
    assert left_out == {} and len(kept.figures) == len(headlines.HEADLINES)
    first, second = records(versions)
    assert first == older and second["version"] == version
    assert {name: count for _, name, _, count in kept.figures}["`opening`, a cut [ms, median]"] > 9
    once = versions.read_bytes()
    for name in ("physics", "paths"):
        (tmp_path / f"{name}.jsonl").unlink()
    results_of_another = (tmp_path / "solvers.jsonl").read_text().replace(f'"{version}"', '"0.0.1"')
    (tmp_path / "solvers.jsonl").write_text(results_of_another)
    told = CliRunner().invoke(harness.app, ["record"])
    assert told.exit_code == 0, told.output
    assert "left out: paths, no results" in told.output
    assert "left out: solvers, of 0.0.1" in told.output
    assert versions.read_bytes() != once and len(records(versions)) == 2
    page = "\n".join(write_parts()[0])
    assert f"| benchmark | figure | 0.0.1 | {version} |" in page
    assert "| old | time [s] | 12.5 (3) | - |" in page
    assert "| CP-SAT on" not in page and f"- {version}, `startup`" in page


def test_damaged_results_are_not_recorded(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    results_of(harness.machine_facts()["knotopt"], tmp_path)
    monkeypatch.setattr(results, "RESULTS", tmp_path)
    versions = tmp_path / headlines.FILE
    for name, text, why in (
        (headlines.FILE, '{"version": "0.0.1", "figures": [["a", "b", 1]]}\n', "line 1 is damaged"),
        (headlines.FILE, "<<<<<<<\n", "line 1 is damaged"),
        ("startup.jsonl", "{torn", "startup.jsonl is damaged"),
    ):
        versions.unlink(missing_ok=True)
        (tmp_path / name).write_text(text)
        with pytest.raises(FileFormatError, match=why):
            headlines.record()
        assert (tmp_path / name).read_text() == text
    assert not versions.exists()


def test_an_unknown_benchmark_is_refused(tmp_path: Path) -> None:
    run = CliRunner().invoke(harness.app, ["run", "nothing", "--out", str(tmp_path)])
    assert run.exit_code == 2 and "'nothing'" in run.output
    with pytest.raises(ValueError, match="two benchmarks are named 'startup'"):
        register(BENCHMARKS["startup"])


def test_an_interrupted_run_goes_on_where_it_stopped(tmp_path: Path) -> None:
    measured: list[int] = []
    stop_at = 2

    def measure(case: dict[str, Any]) -> dict[str, Any]:
        if case["k"] == stop_at:
            raise KeyboardInterrupt
        measured.append(case["k"])
        return {"square": case["k"] ** 2}

    counting = Benchmark("counting", "", lambda _: ({"k": k} for k in range(4)), measure)
    with pytest.raises(KeyboardInterrupt):
        run_benchmark(counting, tmp_path)
    partial = tmp_path / "counting.jsonl.partial"
    assert [path.name for path in tmp_path.iterdir()] == [partial.name]
    with partial.open("a") as stream:
        stream.write('{"case": {"k": 2}, "res')  # torn in the middle of a line
    stop_at = -1
    final = run_benchmark(counting, tmp_path)
    assert measured == [0, 1, 2, 3]
    assert [row["result"]["square"] for row in records(final)[1:]] == [0, 1, 4, 9]
    assert not partial.exists()


def test_a_partial_run_of_another_kind_is_kept(tmp_path: Path) -> None:
    counting = Benchmark(
        "counting", "", lambda _: ({"k": k} for k in range(2)), lambda case: {"k": case["k"]}
    )
    partial = tmp_path / "counting.jsonl.partial"
    other = '{"benchmark": "counting"}\n{"case": {"k": 0}}\n'
    partial.write_text(other)
    with pytest.raises(OutputError, match="the beginning of another run"):
        run_benchmark(counting, tmp_path)
    assert partial.read_text() == other
    for damage in (b"\xff\n", other.splitlines(keepends=True)[0].encode() + b"{torn}\n"):
        partial.write_bytes(damage)
        with pytest.raises(OutputError, match="remove the file"):
            run_benchmark(counting, tmp_path)
        assert partial.read_bytes() == damage
    partial.unlink()
    header = {"benchmark": "counting", "smoke": False, "machine": harness.machine_facts()}
    partial.write_text(json.dumps(header) + "\n{torn}\n")
    with pytest.raises(OutputError, match="line 2 is damaged"):
        run_benchmark(counting, tmp_path)
    partial.unlink()
    first, *rows = records(run_benchmark(counting, tmp_path))
    assert first["benchmark"] == "counting" and "machine" in first
    assert [row["result"] for row in rows] == [{"k": 0}, {"k": 1}]


def worktrees() -> list[str]:
    """The folders of the clone's working trees."""
    command = ["git", "-C", str(ROOT), "worktree", "list", "--porcelain"]
    listed = subprocess.run(command, capture_output=True, text=True, check=True).stdout
    return [line for line in listed.splitlines() if line.startswith("worktree ")]


@in_a_clone
@pytest.mark.slow
def test_a_revision_is_compared_with_this_tree() -> None:
    before = worktrees()
    chosen = [BENCHMARKS["startup"], BENCHMARKS["lcf_catalogue"]]
    found = compare("HEAD", chosen, smoke=True, repeats=1)
    assert (found.missing, found.changed) == ((), ())
    costs = {(each.benchmark, each.cost): each for each in found.ratios}
    assert set(costs) == {("startup", "seconds"), ("lcf_catalogue", "ms_per_cut")}
    assert all(0.02 < each.least <= each.mean <= each.most < 50 for each in found.ratios)
    assert worktrees() == before


@in_a_clone
def test_a_revision_that_there_is_not() -> None:
    with pytest.raises(ValueError, match="no revision 'nothing'"):
        compare("nothing", [BENCHMARKS["startup"]], smoke=True)


def test_what_costs_and_what_counts() -> None:
    runs = (
        {"robots": 5, "seconds": 2.0, "paths": [{"ms": 4.0}], "times_faster": 9},
        {"robots": 5, "seconds": 1.0, "paths": [{"ms": 6.0}], "times_faster": 8},
    )
    assert fastest(runs) == ({"seconds": 1.0, "paths[0].ms": 4.0}, {"robots": 5})
