"""The commands solve, compare, prove and check as a user meets them."""

from __future__ import annotations

import csv
import json
from pathlib import Path
from typing import Any

import pytest

from knotopt.supports import diagram_search
from tests.helpers.command_line import Cli


def test_solve(cli: Cli, tmp_path: Path) -> None:
    picture, program = tmp_path / "a.png", tmp_path / "a.mps"
    status, out, err = cli(
        "solve", "9", "--formulation", "opening", "--plot", picture, "--export", program
    )
    assert (status, err) == (0, "")
    assert "cut L+: 5 robots instead of 22 (77.3 % fewer)" in out
    assert "no set of 4 robots is open over 8 cuts" in out and "open by the definition" in out
    assert picture.stat().st_size > 10_000 and "ENDATA" in program.read_text()
    content = cli.json("solve", "5", "--formulation", "opening", "--cut", "L+")
    assert (content["robots_after"], content["bound"], content["status"]) == (6, 6, "optimal")
    assert content["proven"] and content["checked_open"] and content["canonical"]
    assert (content["lcf_robots"], content["lcf_open"]) == (5, False)
    assert content["lcf_closes"] == ["loop c1", "loop c2", "loop c3", "loop c4"]
    assert content["start_accepted"] is False and len(content["instance"]) == 64
    saved = tmp_path / "5.json"
    saved.write_text(json.dumps(content))
    assert (
        cli.json("solve", saved, "--formulation", "opening", "--cut", "L+")["supports"]
        == content["supports"]
    )


def test_solve_over_cuts_sets_and_diagrams(cli: Cli) -> None:
    rows = cli.json("solve", "7 Var2", "--formulation", "opening", "--cut", "all")
    assert [row["robots_after"] for row in rows] == [6, 12, 10, 10, 6, 12, 10, 10]
    status, out, _ = cli("solve", "7 Var2", "--formulation", "opening", "--cut", "all")
    assert status == 0 and out.count("optimal") == 8 and "7_6: opening, threading" in out
    rows = cli.json("solve", "5", "--formulation", "opening", "--cut", "all", "--separation", "4")
    assert {(row["status"], row["bound"], row["robots_after"]) for row in rows} == {
        ("infeasible", None, None)
    }
    content = cli.json("solve", "9", "--formulation", "opening", "--all", "--cut", "L+")
    assert content["minimal_sets"] == [[9, 10, 11], [9, 10, 12], [9, 10, 13]]
    assert content["minimal_sets_complete"]
    status, out, _ = cli(
        "solve", "9", "--formulation", "opening", "--all", "--count", "2", "--cut", "L+"
    )
    assert "2 smallest sets, and maybe more (--count 2" in out


def test_solve_over_diagrams(cli: Cli) -> None:
    cli.monkeypatch.setattr(diagram_search, "LOOKED_PER_SOLVED", 5000)
    searched = ("--diagrams", "--budget", "60_000", "--seed", "1")
    command = ("solve", "7 Var1", "--formulation", "opening", *searched)
    content = cli.json(*command)
    assert content["robots_after"] < 12 and content["proven"] and content["checked_open"]
    assert content["diagrams_tried"] >= 60_000 and content["diagrams_solved"] == 12
    first = content["front"][0]
    assert (first["robots"], first["crossings"]) == (3, 7) and len(first["grid"]) == 2 * first[
        "size"
    ]
    status, out, err = cli("solve", "5", "--diagrams", "--formulation", "loops", "--budget", "1")
    assert (status, err) == (0, "") and "fewest robots that lay a diagram" in out
    assert "best of 1 solved, from" in out and "cut L+: 3 robots instead of" in out


def test_a_search_over_diagrams_is_gone_on_with(cli: Cli, tmp_path: Path) -> None:
    file = tmp_path / "a.json"
    command = ("solve", "5", "--diagrams", "--formulation", "span", "--budget")
    in_parts = [cli.json(*command, budget, "--out", file) for budget in ("40_000", "80_000")]
    whole = cli.json(*command, "80_000")
    timed = ("build_seconds", "solve_seconds")
    assert {**in_parts[1], **dict.fromkeys(timed)} == {**whole, **dict.fromkeys(timed)}
    assert in_parts[0]["diagrams_solved"] < whole["diagrams_solved"]
    status, _, err = cli(*command, "1", "--seed", "2", "--out", file)
    assert status == 1 and "holds another search" in " ".join(err.split())
    file.write_text("[]")
    status, _, err = cli(*command, "1", "--out", file)
    assert status == 1 and "holds no search over diagrams" in " ".join(err.split())


def test_solve_with_what_a_team_asks(cli: Cli) -> None:
    status, out, _ = cli("solve", "5", "--formulation", "opening", "--separation", "4")
    assert status == 1 and "no set of supports does what is asked on any of 8 cuts" in out
    assert "  separation: p5 and p6\n" in out and "  opening: loop c1, threaded at p10" in out
    one = ("--cut", "L+")
    content = cli.json(
        "solve",
        "5",
        "--formulation",
        "opening",
        "--payload",
        "6",
        "--forbid",
        "8",
        "--force",
        "9",
        *one,
    )
    assert {support[0] for support in content["supports"]} >= {9}
    status, out, _ = cli(
        "solve", "5", "--formulation", "opening", "--max-robots", "5", "--reach", "6"
    )
    assert status == 0 and "no larger opening over 8 cuts" in out and "reach 6" in out
    assert (
        cli.json("solve", "5", "--formulation", "opening", "--max-robots", "5")["openness"] is None
    )


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
        (("--cut", "L+", "--diagrams"), 2, "goes with --cut best"),
        (("--budget", "5s"), 2, "goes with --diagrams"),
        (("--out", "a.json"), 2, "goes with --verify-physics or --diagrams"),
        (("--diagrams", "--budget", "soon"), 1, "a budget is seconds, such as 5s, or a number"),
        (("--diagrams", "--budget", "0"), 1, "a budget is a positive number"),
        (("--diagrams", "--out", "a.txt"), 1, "searches are written as .json"),
        (("--cut", "col2+"), 1, "carries"),
        (("--all", "--solver", "highs"), 1, "cannot list all sets"),
        (("--solver", "exhaustive", "--cut", "X"), 1, "no cut is named 'X'"),
    ],
)
def test_solve_refuses(
    cli: Cli, arguments: tuple[str, ...], status: int, message: str, tmp_path: Path
) -> None:
    cli.monkeypatch.chdir(tmp_path)
    found, _, err = cli("solve", "5", "--formulation", "opening", *arguments)
    assert found == status and message in " ".join(err.replace("│", " ").split())
    assert "Traceback" not in err and not list(tmp_path.iterdir())


def test_compare(cli: Cli, tmp_path: Path) -> None:
    rows = cli.json("compare", "3", "5", "8_19")
    assert [row["opening_robots"] for row in rows] == [5, 6, 9]
    assert [row["span_robots"] for row in rows] == [7, 9, 10]
    assert [row["safe_robots"] for row in rows] == [7, 9, 10]
    assert [row["loops_robots"] for row in rows] == [3, 3, 4]
    assert [row["lcf_open"] for row in rows] == [False, False, True]
    for suffix in ("csv", "md", "tex"):
        status, out, _ = cli("compare", "3", "5", "--out", tmp_path / f"a.{suffix}")
        assert status == 0 and "written:" in out and "mean of 2" in out
    with (tmp_path / "a.csv").open(newline="") as stream:
        names = csv.DictReader(stream).fieldnames or []
    assert names[: len(rows[0]) - 1] == list(rows[0])[:-1]
    assert {"lcf_relaxation_length", "opening_nlp_same_knot"} < set(names)
    assert len(names) == len(rows[0]) - 1 + 4 * 12
    for row in rows:
        assert [(p["supports"], p["method"]) for p in row["paths"]] == [
            ("lcf", "relaxation"),
            ("lcf", "nlp"),
            ("opening", "relaxation"),
            ("opening", "nlp"),
        ]
        assert all(p["same_diagram"] and p["same_knot"] for p in row["paths"][1::2])
    assert "| mean of 2 |" in (tmp_path / "a.md").read_text()
    latex = (tmp_path / "a.tex").read_text()
    assert (
        "\\toprule" in latex
        and "5\\_1 (Table I, row 5) & 3 & 3 (11 of 12) & 14 & 5 & no &" in latex
    )
    assert latex.count("&") == 12 * 4 + 9 * 5 and "opening & nlp & 2 of 2 & 2 of 2" in latex
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
    from knotopt.supports import certificate

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


def test_compare_goes_on_where_it_stopped(
    cli: Cli, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    from knotopt.document.columns import Row
    from knotopt.tables import comparison

    original = comparison.compare
    compared: list[str] = []

    def interrupted(name: str, *arguments: Any, **options: Any) -> Row:
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
