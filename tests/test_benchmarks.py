"""The benchmark harness: small runs of every benchmark, and runs that were interrupted."""

from __future__ import annotations

import json
import subprocess
from pathlib import Path
from typing import Any

import pytest
from typer.testing import CliRunner

from benchmarks import __main__ as harness
from benchmarks import plot
from benchmarks.compare import ROOT, compare, fastest
from benchmarks.registry import BENCHMARKS, Benchmark, register
from knotopt.errors import OutputError


def records(path: Path) -> list[dict[str, Any]]:
    return [json.loads(line) for line in path.read_text().splitlines()]


def test_every_benchmark_runs(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    run = CliRunner().invoke(harness.app, ["run", "--smoke", "--out", str(tmp_path)])
    assert run.exit_code == 0, run.output
    assert {path.stem for path in tmp_path.iterdir()} == set(BENCHMARKS)
    header, *rows = records(tmp_path / "lcf_catalogue.jsonl")
    assert header["smoke"] and header["machine"]["cores"]
    assert rows[0]["case"] == {"knot": "3_1"} and set(rows[0]["result"]["robots"]) >= {"L+", "T-"}
    listed = CliRunner().invoke(harness.app, ["list"]).output
    assert all(name in listed for name in BENCHMARKS)
    monkeypatch.setattr(plot, "RESULTS", tmp_path)
    monkeypatch.setattr(plot, "FIT_FROM", 0)
    plot.main()
    assert "At N = " in (tmp_path / "summary.md").read_text()
    assert (tmp_path / "growth.png").stat().st_size > 10_000


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
        harness.run_benchmark(counting, tmp_path)
    partial = tmp_path / "counting.jsonl.partial"
    assert [path.name for path in tmp_path.iterdir()] == [partial.name]
    with partial.open("a") as stream:
        stream.write('{"case": {"k": 2}, "res')  # torn in the middle of a line
    stop_at = -1
    final = harness.run_benchmark(counting, tmp_path)
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
        harness.run_benchmark(counting, tmp_path)
    assert partial.read_text() == other
    for damage in (b"\xff\n", other.splitlines(keepends=True)[0].encode() + b"{torn}\n"):
        partial.write_bytes(damage)
        with pytest.raises(OutputError, match="remove the file"):
            harness.run_benchmark(counting, tmp_path)
        assert partial.read_bytes() == damage
    partial.unlink()
    header = {"benchmark": "counting", "smoke": False, "machine": harness.machine_facts()}
    partial.write_text(json.dumps(header) + "\n{torn}\n")
    with pytest.raises(OutputError, match="line 2 is damaged"):
        harness.run_benchmark(counting, tmp_path)
    partial.unlink()
    first, *rows = records(harness.run_benchmark(counting, tmp_path))
    assert first["benchmark"] == "counting" and "machine" in first
    assert [row["result"] for row in rows] == [{"k": 0}, {"k": 1}]


def test_a_revision_is_compared_with_this_tree() -> None:
    if not (ROOT / ".git").exists():
        pytest.skip("not in a clone")
    worktrees = ["git", "-C", str(ROOT), "worktree", "list"]
    before = subprocess.run(worktrees, capture_output=True, check=True).stdout
    chosen = [BENCHMARKS["startup"], BENCHMARKS["lcf_catalogue"]]
    found = compare("HEAD", chosen, smoke=True, repeats=1)
    assert (found.missing, found.changed) == ((), ())
    costs = {(each.benchmark, each.cost): each for each in found.ratios}
    assert set(costs) == {("startup", "seconds"), ("lcf_catalogue", "ms_per_cut")}
    assert all(0.02 < each.least <= each.mean <= each.most < 50 for each in found.ratios)
    assert subprocess.run(worktrees, capture_output=True, check=True).stdout == before
    with pytest.raises(ValueError, match="no revision 'nothing'"):
        compare("nothing", chosen, smoke=True)


def test_what_costs_and_what_counts() -> None:
    runs = (
        {"robots": 5, "seconds": 2.0, "paths": [{"ms": 4.0}], "times_faster": 9},
        {"robots": 5, "seconds": 1.0, "paths": [{"ms": 6.0}], "times_faster": 8},
    )
    assert fastest(runs) == ({"seconds": 1.0, "paths[0].ms": 4.0}, {"robots": 5})
