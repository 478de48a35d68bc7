"""The command line as a user meets it."""

from __future__ import annotations

import csv
import importlib.metadata
import json
import os
import re
import shlex
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

from formulations import probe
from knotopt.cli import app
from knotopt.table1 import NOTE

HEAVY = ("numpy", "scipy", "networkx", "matplotlib", "cvxpy", "ortools", "casadi", "highspy")


class Cli:
    """Runs the command in this process: exit status, output, errors."""

    def __init__(self, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch) -> None:
        self.capsys, self.monkeypatch = capsys, monkeypatch

    def __call__(self, *arguments: object) -> tuple[int, str, str]:
        self.monkeypatch.setattr(sys, "argv", ["knotopt", *map(str, arguments)])
        with pytest.raises(SystemExit) as stop:
            app.main()
        captured = self.capsys.readouterr()
        if isinstance(stop.value.code, str):  # what Python then prints and returns
            return 1, captured.out, captured.err + stop.value.code + "\n"
        return int(stop.value.code or 0), captured.out, captured.err

    def json(self, *arguments: object) -> Any:
        status, out, err = self(*arguments, "--json")
        assert (status, err) == (0, "")
        return json.loads(out)


@pytest.fixture
def cli(capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch) -> Cli:
    return Cli(capsys, monkeypatch)


def test_help_names_every_command_and_each_has_an_example(cli: Cli) -> None:
    status, out, _ = cli("--help")
    assert status == 0
    for command in (
        *("knots", "show", "lcf", "solve", "compare", "prove", "check", "table1", "doctor"),
    ):
        assert command in out
        status, text, _ = cli(command, "--help")
        assert status == 0 and f"knotopt {command}" in text
        assert ("--json" in text) == (command != "prove")  # it writes a file
        assert "Example:" in text


def test_help_imports_nothing_heavy() -> None:
    """What makes `knotopt --help` answer at once."""
    code = (
        "import sys; sys.argv = ['knotopt', '--help']\n"
        "from knotopt.cli.app import main\n"
        "try: main()\n"
        "except SystemExit: pass\n"
        f"print([name for name in {HEAVY} if name in sys.modules], file=sys.stderr)"
    )
    run = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert run.stderr.strip() == "[]"


def test_version_by_the_module() -> None:
    run = subprocess.run(
        [sys.executable, "-m", "knotopt", "--version"], capture_output=True, text=True, check=True
    )
    assert run.stdout.strip() == importlib.metadata.version("knotopt")


@pytest.mark.parametrize("arguments", [("knots",), ("lcf", "3"), ("lcf", "3", "--json")])
def test_a_full_disk_behind_the_output(arguments: tuple[str, ...]) -> None:
    command = [sys.executable, "-m", "knotopt", *arguments]
    with Path("/dev/full").open("w") as full:
        run = subprocess.run(command, stdout=full, stderr=subprocess.PIPE, text=True, check=False)
    assert run.returncode != 0 and "Traceback" not in run.stderr


def test_drawings_where_only_ascii_is_known() -> None:
    run = subprocess.run(
        [sys.executable, "-m", "knotopt", "lcf", "3"],
        capture_output=True,
        env={**os.environ, "PYTHONIOENCODING": "ascii"},
        check=True,
    )
    assert b"5 robots instead of 10" in run.stdout


def test_table1_prints_the_table_and_the_note(cli: Cli) -> None:
    status, out, _ = cli("table1")
    assert status == 0
    for row in cli.json("table1"):
        cells = (
            *row["row"].split(),
            row["knot"],
            row["cut"],
            *(str(row[key]) for key in ("robots_before", "robots_after", "robots_after_paper")),
            "yes" if row["lcf_open"] else "no",
            str(row["opening_same_cut"]),
            f"({row['opening_robots']})",
            str(row["span_same_cut"]),
            f"({row['span_robots']})",
            "yes",
        )
        assert list(cells) in [line.split() for line in out.splitlines()]
    assert " ".join(NOTE.split()) in " ".join(out.split())


def test_table1_json_has_the_columns_of_the_csv(cli: Cli, tmp_path: Path) -> None:
    rows = cli.json("table1")
    assert [row["robots_after"] for row in rows] == [5, 5, 5, 7, 8, 6]
    assert [row["robots_after_paper"] for row in rows] == [5, 5, 5, 7, 8, 6]
    assert [row["robots_before"] for row in rows] == [10, 12, 14, 18, 18, 22]
    assert [row["crossings"] for row in rows] == [3, 4, 5, 7, 7, 9]
    assert rows[5]["reduction_percent"] == 72.7
    assert [row["lcf_open"] for row in rows] == [False, False, False, False, True, False]
    assert [row["opening_same_cut"] for row in rows] == [5, 5, 6, 12, 6, 6]
    assert [row["opening_robots"] for row in rows] == [5, 5, 6, 12, 6, 5]
    assert all(row["proven"] for row in rows)
    status, out, _ = cli("table1", "--out", tmp_path)
    assert status == 0 and "written:" in out
    with (tmp_path / "table1.csv").open(newline="") as stream:
        reader = csv.DictReader(stream)
        stored = list(reader)
        assert reader.fieldnames == list(rows[0])
    assert [json.loads(row["supports"]) for row in stored] == [row["supports"] for row in rows]
    markdown = (tmp_path / "table1.md").read_text()
    assert markdown.count("\n| ") >= 6 and NOTE in markdown
    figures = sorted(path.name for path in (tmp_path / "figures").iterdir())
    assert len(figures) == 12 and "table1_7_Var1_7_2_minimal.png" in figures


def test_table1_over_all_grids(cli: Cli, tmp_path: Path) -> None:
    rows = cli.json("table1", "--all-grids")
    assert len(rows) == 15
    assert all(row["robots_after"] == row["robots_after_paper"] for row in rows)
    status, _, err = cli("table1", "--all-grids", "--out", tmp_path)
    assert status == 2 and "leave out --all-grids" in err and not list(tmp_path.iterdir())


def test_table1_is_written_the_same_every_time(cli: Cli, tmp_path: Path) -> None:
    for run in "ab":
        cli("table1", "--out", tmp_path / run)
    for path in (tmp_path / "a").rglob("*.*"):
        assert path.read_bytes() == (tmp_path / "b" / path.relative_to(tmp_path / "a")).read_bytes()


def test_lcf(cli: Cli, tmp_path: Path) -> None:
    status, out, _ = cli("lcf", "3")
    assert status == 0
    assert "cut L+: 5 robots instead of 10 (50.0 % fewer)" in out and "p_8 is the first" in out
    found = cli.json("lcf", "3")
    assert found["supports"] == [[3, 3, 2], [4, 5, 2], [6, 2, 5]]
    assert found["robots_after"] == 5 and found["cut"] == "L+"
    active = [region for region in found["regions"] if region["active"]]
    assert {k for region in active for k in region["selects"]} == {3, 4, 6}
    assert all("why" in region for region in found["regions"])
    assert max(map(max, found["layers"])) == len(active) == 2
    one = cli.json("lcf", "4", "--cut", "R+")
    assert one["robots_after"] == 7
    assert cli.json("lcf", "8_20", "--layered")["layered"] is True
    picture = tmp_path / "p.svg"
    assert cli("lcf", "T(3,4)", "--plot", picture)[0] == 0
    assert picture.read_text().startswith("<?xml")


def test_lcf_over_all_cuts(cli: Cli) -> None:
    rows = cli.json("lcf", "4", "--cut", "all")
    expected = {"L+": 5, "L-": 7, "R+": 7, "R-": 5, "B+": 5, "B-": 7, "T+": 7, "T-": 5}
    assert {row["cut"]: row["robots_after"] for row in rows} == expected
    status, out, _ = cli("lcf", "4", "--cut", "all")
    assert status == 0 and "T-" in out
    status, _, err = cli("lcf", "4", "--cut", "all", "--plot", "x.png")
    assert status == 2 and "--plot: draws one cut" in err


def test_show_and_its_json_as_a_file(cli: Cli, tmp_path: Path) -> None:
    status, out, _ = cli("show", "8_19", "--cut", "T-", "--plot", tmp_path / "8_19.pdf")
    assert status == 0
    assert "1 - t + t^3 - t^5 + t^6" in out and "◆" in out and "│" in out
    assert (tmp_path / "8_19.pdf").read_bytes().startswith(b"%PDF")
    shown = cli.json("show", "8_19")
    assert shown["determinant"] == 3 and shown["signature"] == -6 and shown["grid_size"] == 7
    assert len(shown["pd_code"]) == shown["crossings"] == 8
    path = tmp_path / "again.json"
    path.write_text(json.dumps(shown))
    assert len(shown["crossing_list"]) == 8 and len(shown["arcs"]) == 17
    assert {crossing["sign"] for crossing in shown["crossing_list"]} == {1}
    again = cli.json("show", path)
    assert again["grid"] == shown["grid"] and again["alexander"] == shown["alexander"]
    assert again["signature"] is None


def test_show_of_a_large_diagram_uses_a_simpler_one(cli: Cli, tmp_path: Path) -> None:
    from knotopt.diagram.families import random_knot, torus_knot

    path = tmp_path / "random.json"
    path.write_text(json.dumps(random_knot(34, seed=3).marks))
    shown = cli.json("show", path)
    assert shown["crossings"] > 120 > 2 * shown["smallest_grid_found"]
    assert abs(sum(shown["alexander"])) == 1
    path.write_text(json.dumps(torus_knot(12, 13).marks))
    assert cli.json("show", path)["alexander"] is None
    assert "the smallest grid found has 143 crossings, more than 120" in cli("show", path)[1]


def test_knots(cli: Cli) -> None:
    assert len(cli.json("knots")) == 249
    names = [entry["knot"] for entry in cli.json("knots", "--crossings", 8, "--non-alternating")]
    assert names == ["8_19", "8_20", "8_21"]
    assert [k["knot"] for k in cli.json("knots", "--determinant", 1)] == ["10_124", "10_153"]
    assert [k["knot"] for k in cli.json("knots", "8_*", "--arc-index", 7)] == ["8_19"]
    assert all(k["alternating"] for k in cli.json("knots", "9_*", "--alternating"))
    assert len(cli.json("knots", "--all", "--crossings", 11)) == 552
    status, out, _ = cli("knots", "12n_*")
    assert status == 0 and "0 knots" in out and "--all" in out
    assert "1 knot\n" in cli("knots", "3_1")[1]
    status, out, _ = cli("knots", "7_*")
    assert status == 0 and "7 knots" in out and "3 - 5t + 3t^2" in out


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (("show", "8_22"), "no knot is named '8_22'; nearest: 8_2"),
        (("lcf", "3_1", "--cut", "Q"), "no cut is named 'Q'"),
        (("lcf", "3_1", "--cut", "col3+"), "carries 1 crossing"),
        (("show", "missing.csv"), "cannot read missing.csv"),
        (("show", "T(3,3)"), "a link of 3 components"),
        (("show", "3_1", "--plot", "x.gif"), "pictures are written as .png, .pdf, .svg"),
    ],
)
def test_wrong_input_ends_with_one_sentence(
    cli: Cli, arguments: tuple[str, ...], message: str
) -> None:
    status, out, err = cli(*arguments)
    assert status == 1 and out == ""
    assert err.startswith("knotopt: ") and message in err and err.count("\n") == 1


def test_usage_errors(cli: Cli) -> None:
    for arguments in (("lcf",), ("nonsense",), ("knots", "--crossings", "many")):
        status, _, err = cli(*arguments)
        assert status == 2 and "Usage" in err


def test_pictures_without_matplotlib(cli: Cli, monkeypatch: pytest.MonkeyPatch) -> None:
    for name in [name for name in sys.modules if name.startswith("knotopt.plot")]:
        monkeypatch.delitem(sys.modules, name)
    monkeypatch.setitem(sys.modules, "matplotlib", None)
    status, _, err = cli("show", "3_1", "--plot", "x.png")
    assert status == 1 and "pip install 'knotopt[viz]'" in err


def test_doctor(cli: Cli, monkeypatch: pytest.MonkeyPatch) -> None:
    found = cli.json("doctor")
    assert [solver["works"] for solver in found["solvers"]] == [True] * 5
    assert found["versions"]["numpy"][0].isdigit()
    broken = [probe.ProbeResult("CP-SAT (ortools)", False, "wrong optimum 2")]
    asked: list[str] = []
    monkeypatch.setattr(probe, "probe_solvers", lambda names: asked.extend(names) or broken)

    def version(package: str) -> str:
        raise importlib.metadata.PackageNotFoundError(package)

    monkeypatch.setattr("importlib.metadata.version", version)
    status, out, _ = cli("doctor")
    assert status == 1 and "wrong optimum 2" in out and "pip install 'knotopt[viz]'" in out
    assert len(asked) == 3 and not any("SCIP" in name or "pysat" in name for name in asked)


def test_solve(cli: Cli, tmp_path: Path) -> None:
    picture, program = tmp_path / "a.png", tmp_path / "a.mps"
    status, out, err = cli("solve", "9", "--plot", picture, "--export", program)
    assert (status, err) == (0, "")
    assert "cut L+: 5 robots instead of 22 (77.3 % fewer)" in out
    assert "no set of 4 robots is open over 8 cuts" in out and "open by the definition" in out
    assert picture.stat().st_size > 10_000 and "ENDATA" in program.read_text()
    content = cli.json("solve", "5", "--cut", "L+")
    assert (content["robots_after"], content["bound"], content["status"]) == (6, 6, "optimal")
    assert content["proven"] and content["checked_open"] and content["canonical"]
    assert (content["lcf_robots"], content["lcf_open"]) == (5, False)
    assert content["lcf_closes"] == ["loop c1", "loop c2", "loop c3", "loop c4"]
    assert content["start_accepted"] is False and len(content["instance"]) == 64
    saved = tmp_path / "5.json"
    saved.write_text(json.dumps(content))
    assert cli.json("solve", saved, "--cut", "L+")["supports"] == content["supports"]


def test_solve_over_cuts_sets_and_diagrams(cli: Cli) -> None:
    rows = cli.json("solve", "7 Var2", "--cut", "all")
    assert [row["robots_after"] for row in rows] == [6, 12, 10, 10, 6, 12, 10, 10]
    status, out, _ = cli("solve", "7 Var2", "--cut", "all")
    assert status == 0 and out.count("optimal") == 8 and "7_6: opening, threading" in out
    rows = cli.json("solve", "5", "--cut", "all", "--separation", "4")
    assert {(row["status"], row["bound"], row["robots_after"]) for row in rows} == {
        ("infeasible", None, None)
    }
    content = cli.json("solve", "9", "--all", "--cut", "L+")
    assert content["minimal_sets"] == [[9, 10, 11], [9, 10, 12], [9, 10, 13]]
    assert content["minimal_sets_complete"]
    status, out, _ = cli("solve", "9", "--all", "--count", "2", "--cut", "L+")
    assert "2 smallest sets, and maybe more (--count 2" in out
    content = cli.json("solve", "7 Var1", "--diagrams", "20", "--seed", "1")
    assert content["diagrams_tried"] == 20 and content["robots_after"] < 12
    status, out, _ = cli("solve", "7 Var1", "--diagrams", "20", "--seed", "1")
    assert "best of 20 found by translations and commutations" in out


def test_solve_with_what_a_team_asks(cli: Cli) -> None:
    status, out, _ = cli("solve", "5", "--separation", "4")
    assert status == 1 and "no set of supports does what is asked on any of 8 cuts" in out
    assert "  separation: p5 and p6\n" in out and "  opening: loop c1, threaded at p10" in out
    one = ("--cut", "L+")
    content = cli.json("solve", "5", "--payload", "6", "--forbid", "8", "--force", "9", *one)
    assert {support[0] for support in content["supports"]} >= {9}
    status, out, _ = cli("solve", "5", "--max-robots", "5", "--reach", "6")
    assert status == 0 and "no larger opening over 8 cuts" in out and "reach 6" in out
    assert cli.json("solve", "5", "--max-robots", "5")["openness"] is None


@pytest.mark.parametrize(
    ("arguments", "status", "message"),
    [
        (("--r", "1.5"), 1, "must lie in (0, 1]"),
        (("--r", "0"), 1, "must lie in (0, 1]"),
        (("--formulation", "springs"), 1, "no formulation is named 'springs'"),
        (("--threading", "x"), 1, "no threading mode is named 'x'"),
        (("--solver", "gurobi"), 1, "no solver is named 'gurobi'"),
        (("--force", "3", "--forbid", "3"), 1, "p3 is both forced and forbidden"),
        (("--force", "99", "--cut", "L+"), 1, "p99: the cable's turning points are p1 to p14"),
        (("--force", "3"), 2, "turning points are numbered along one cable"),
        (("--count", "3"), 2, "goes with --all"),
        (("--solver", "maxsat", "--gap", "0.1"), 1, "solver maxsat cannot be given a gap"),
        (("--max-robots", "5", "--r", "0.5"), 1, "exclude each other"),
        (("--time-limit", "0"), 1, "time limit must be positive"),
        (("--gap", "2"), 1, "the gap must lie in [0, 1)"),
        (("--threads", "0"), 1, "threads must be at least 1"),
        (("--seed", "-1"), 1, "the seed must lie in"),
        (("--export", "a.lp"), 1, "programs are written as .json, .mps, .opb, .wcnf"),
        (("--plot", "a.gif"), 1, "pictures are written as"),
        (("--cut", "all", "--all"), 2, "is about one cut"),
        (("--cut", "all", "--plot", "a.png"), 2, "is about one cut"),
        (("--cut", "L+", "--diagrams", "5"), 2, "goes with --cut best"),
        (("--cut", "col2+"), 1, "carries"),
        (("--all", "--solver", "highs"), 1, "cannot list all sets"),
        (("--solver", "exhaustive", "--cut", "X"), 1, "no cut is named 'X'"),
    ],
)
def test_solve_refuses(
    cli: Cli, arguments: tuple[str, ...], status: int, message: str, tmp_path: Path
) -> None:
    cli.monkeypatch.chdir(tmp_path)
    found, _, err = cli("solve", "5", *arguments)
    assert found == status and message in " ".join(err.replace("│", " ").split())
    assert "Traceback" not in err and not list(tmp_path.iterdir())


def test_compare(cli: Cli, tmp_path: Path) -> None:
    rows = cli.json("compare", "3", "5", "8_19")
    assert [row["opening_robots"] for row in rows] == [5, 6, 9]
    assert [row["span_robots"] for row in rows] == [7, 9, 10]
    assert [row["lcf_open"] for row in rows] == [False, False, True]
    for suffix in ("csv", "md", "tex"):
        status, out, _ = cli("compare", "3", "5", "--out", tmp_path / f"a.{suffix}")
        assert status == 0 and "written:" in out and "mean of 2" in out
    with (tmp_path / "a.csv").open(newline="") as stream:
        assert csv.DictReader(stream).fieldnames == list(rows[0])
    assert "| mean of 2 |" in (tmp_path / "a.md").read_text()
    latex = (tmp_path / "a.tex").read_text()
    assert "\\toprule" in latex and "5\\_1 (Table I, row 5) & 14 & 5 & no &" in latex
    assert latex.count("&") == 8 * latex.count("\\\\\n")
    assert cli("compare", "3", "--cut", "T-")[0] == 0
    for arguments, code, message in (
        ((), 2, "give knots, or --catalogue"),
        (("3", "--catalogue"), 2, "give knots, or --catalogue"),
        (("3", "--out", "a.xls"), 1, "tables are written as .csv, .md, .tex"),
        (("3", "--time-limit", "-1"), 1, "time limit must be positive"),
        (("8_99",), 1, "no knot is named '8_99'"),
    ):
        status, _, err = cli("compare", *arguments)
        assert status == code and message in err


def test_prove_and_check(cli: Cli, tmp_path: Path) -> None:
    file = tmp_path / "a.jsonl"
    status, out, _ = cli("prove", "3", "4", "--out", file)
    assert status == 0 and f"written: {file}\n" in out and list(tmp_path.iterdir()) == [file]
    assert out.count("8 cuts") == 2
    status, out, _ = cli("check", file)
    assert status == 0 and "2 accepted, 0 rejected" in out and "all 8 cuts" in out
    verdicts = cli.json("check", file, file)
    assert [verdict["robots_after"] for verdict in verdicts["accepted"]] == [5, 5, 5, 5]
    assert {verdict["grid"] for verdict in verdicts["accepted"]} == {"catalogue"}
    whole = file.read_text()
    file.write_text(whole[:-100])
    status, out, _ = cli("check", file)
    assert status == 1 and "1 accepted, 1 rejected" in out
    assert f"rejected: {file}, line 2: not JSON, or cut off" in out
    file.write_text(whole.replace('"robots":5', '"robots":6'))
    status, out, _ = cli("check", file)
    assert status == 1 and "line 1: 3 supports and 2 lifting robots are not 6" in out
    file.write_text(whole.replace('"knot":"3_1"', '"knot":"8_19"'))
    assert cli.json("check", file)["accepted"][0]["grid"] == "other"
    file.write_text("")
    assert "is empty" in cli("check", file)[2]
    assert "cannot read" in cli("check", tmp_path / "none")[2]
    for arguments, code, message in (
        ((), 2, "give knots, or --catalogue"),
        (("3", "--method", "faith"), 2, "expected refutation or count"),
        (("3", "--r", "2"), 1, "must lie in (0, 1]"),
        (("3", "--time-limit", "-1"), 1, "time limit must be positive"),
        (("7 Var1", "--method", "count"), 1, "too many to count"),
    ):
        status, _, err = cli("prove", *arguments, "--out", tmp_path / "b.jsonl")
        assert status == code and message in err
        assert [path.name for path in tmp_path.iterdir()] == ["a.jsonl"]


def test_prove_goes_on_where_it_stopped(
    cli: Cli, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    from knotopt import certificate

    file, whole = tmp_path / "a.jsonl", tmp_path / "whole.jsonl"
    knots = ("3", "4", "5")
    cli("prove", *knots, "--out", whole)
    proven: list[str] = []
    original = certificate.prove

    def interrupted(name: str, *arguments: Any, **options: Any) -> str:
        if name == "5_1" and "5_1" not in proven:
            proven.append(name)
            raise KeyboardInterrupt
        proven.append(name)
        return original(name, *arguments, **options)

    monkeypatch.setattr(certificate, "prove", interrupted)
    status, _, err = cli("prove", *knots, "--out", file)
    assert status == 130 and not file.exists()
    assert f"stopped: 2 of 3 certificates are in {file}.partial" in err
    status, _, err = cli("prove", "3", "--out", file)
    assert status == 1 and "the beginning of another run" in err
    cli("prove", *knots, "--out", file)
    assert proven == ["3_1", "4_1", "5_1", "5_1"]
    assert file.read_text() == whole.read_text()
    assert sorted(path.name for path in tmp_path.iterdir()) == ["a.jsonl", "whole.jsonl"]


def test_the_readme_shows_what_is_printed(cli: Cli) -> None:
    """Each `$ knotopt ...` in README.md, up to the dots."""
    readme = (Path(__file__).parents[1] / "README.md").read_text()
    blocks = re.findall(r"```console\n\$ knotopt ([^\n]*)\n(.*?)```", readme, re.DOTALL)
    assert len(blocks) == 3
    for command, shown in blocks:
        _, out, _ = cli(*shlex.split(command))
        assert out.startswith(shown.removesuffix("...\n")), command


def test_compare_goes_on_where_it_stopped(
    cli: Cli, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    from knotopt import comparison

    original = comparison.compare
    compared: list[str] = []

    def interrupted(name: str, *arguments: Any, **options: Any) -> comparison.ComparisonRow:
        compared.append(name)
        if compared == ["3_1", "4_1"]:
            raise KeyboardInterrupt
        return original(name, *arguments, **options)

    monkeypatch.setattr(comparison, "compare", interrupted)
    command = ("compare", "3", "4", "--out", tmp_path / "a.csv")
    assert cli(*command)[0] == 130
    assert [path.name for path in tmp_path.iterdir()] == ["a.csv.partial"]
    status, out, _ = cli(*command)
    assert status == 0 and "mean of 2" in out and compared == ["3_1", "4_1", "4_1"]
    assert [path.name for path in tmp_path.iterdir()] == ["a.csv"]
    rows = list(csv.DictReader((tmp_path / "a.csv").read_text().splitlines()))
    assert [row["knot"] for row in rows] == ["3_1", "4_1"]
