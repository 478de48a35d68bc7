"""`--formulation loops` and `--with`: what is said of them, drawn, proven and refused."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from tests.helpers.command_line import Cli


def said(text: str) -> str:
    return " ".join(text.split())


def test_solve_says_what_it_is_the_least_of(cli: Cli, tmp_path: Path) -> None:
    picture = tmp_path / "loops.png"
    status, out, _ = cli("solve", "7 Var2", "--formulation", "loops", "--plot", picture)
    assert status == 0 and picture.stat().st_size > 10_000
    for words in (
        "4 robots instead of 18",
        "the fewest robots that lay this diagram with straight spans, the leader following the",
        "no set of 3 robots is piercing over 8 cuts",
        "c2[4,6] c7[6,2]: no two share a turning point, so each needs a support of its own",
        "piercing by the definition",
        "8 robots, not piercing: none on loop c6, loop c7",
        "solver sweep",
    ):
        assert words in said(out)
    assert "clearance" not in out and "threading" not in out and ", r 0" not in out
    one = cli("solve", "3", "--formulation", "loops", "--cut", "L+")[1]
    assert "loops c1[2,4] needs a support" in said(one)
    team = cli("solve", "3", "--formulation", "loops", "--reach", "3", "--cut", "L+")[1]
    assert "loops, threading turning-point, reach 3" in said(team) and "solver cp-sat" in said(team)


def test_json(cli: Cli) -> None:
    loops = cli.json("solve", "7 Var2", "--formulation", "loops")
    assert loops["disjoint_loops"] == [[4, 6], [6, 2]] and loops["with"] == "none"
    assert loops["robots_after"] == 4 and loops["smallest_opening"] is None
    span = ("solve", "4", "--formulation", "span", "--cut", "T-")
    safe, plain = cli.json(*span), cli.json(*span, "--with", "none")
    assert (safe["with"], plain["with"]) == ("loops", "none") and plain["disjoint_loops"] == []
    assert len(safe["disjoint_loops"]) == 1 and safe["instance"] != plain["instance"]
    opening = ("solve", "4", "--formulation", "opening", "--cut", "L+")
    assert cli.json(*opening)["robots_after"] == 5
    assert cli.json(*opening, "--with", "loops")["robots_after"] == 6


def test_each_cut_by_itself(cli: Cli) -> None:
    out = cli("solve", "4", "--formulation", "loops", "--cut", "all")[1]
    assert out.startswith("4_1: loops\n")
    out = cli("solve", "3", "--formulation", "opening", "--with", "loops", "--cut", "all")[1]
    assert "opening with loops, threading turning-point, r 0.5" in out


def test_prove_and_check(cli: Cli, tmp_path: Path) -> None:
    for options, words in (
        (("--formulation", "loops"), "loops - 3"),
        (("--formulation", "span", "--cut", "L+"), "span with loops 1/2 7"),
        (("--formulation", "span", "--cut", "L+", "--with", "none"), "span 1/2 7"),
    ):
        file = tmp_path / "a.jsonl"
        status, out, _ = cli("prove", "3", *options, "--out", file)
        assert status == 0 and words in said(out)
        status, out, _ = cli("check", file)
        assert status == 0 and "1 accepted" in out and words.replace("1/2", "0.5") in said(out)
        (accepted,) = cli.json("check", file)["accepted"]
        assert accepted["with"] == json.loads(file.read_text()).get("with", "none")


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (("solve", "3", "--formulation", "span", "--with", "pockets"), "is one of loops, none"),
        (("solve", "3", "--formulation", "loops", "--r", "0.3"), "loops has no openness"),
        (("prove", "3", "--formulation", "loops", "--r", "0.3"), "loops has no openness"),
        (("prove", "3", "--method", "disjoint loops"), "expected refutation or count"),
        (("path", "3", "--supports", "lcf", "--with", "none"), "goes with --supports milp"),
        (("path", "3", "--formulation", "loops", "--r", "0.3"), "loops has no openness"),
    ],
)
def test_what_is_refused(cli: Cli, arguments: tuple[str, ...], message: str) -> None:
    status, _, err = cli(*arguments)
    assert status == 2 and message in said(err)
