"""The command `topology` as a user meets it."""

from __future__ import annotations

import json
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from knotopt.diagram.families import random_knot
from knotopt.reading.goal import GoalSet
from knotopt.topology.actions import parse_action
from knotopt.topology.legal import R2Rule, apply
from knotopt.topology.state import TRIVIAL, RopeState
from tests.helpers.command_line import Cli

OVERHAND = "U1+ O2+ U3+ O1+ U2+ O3+"


def test_topology_prints(cli: Cli) -> None:
    status, out, err = cli("topology", "3_1")
    assert (status, err) == (0, "")
    facts, table = out.split("\n\n")[0], out
    for words in (
        "goal       3_1 (KnotInfo), cut L+",
        "state      O1+ U2+ O3+ U1+ O2+ U3+",
        "crossings  3",
        "canonical  U1- O2- U3- O1- U2- O3-",
        "plans      4 of 3 actions; 6 states, 8 edges",
        "flown      3 actions, no plan has fewer",
        "LCF        2 of 5 regions active, 2 entered by the leader; inner faces it enters: 1, in "
        "active regions: 1",
    ):
        assert words in facts
    rows = [line.split() for line in table.splitlines() if " R1(" in line]
    assert [row[:2] for row in rows] == [[name, "3"] for name in ("1", "2", "3", "4", "flown")]
    assert rows[1][2:] == rows[4][2:] == ["R1(0,-1,1)", "C(2,1,1)", "C(2,4,1)"]
    assert "are listed" not in out


@pytest.mark.parametrize(
    ("knot", "plans", "length", "states"),
    [("3_1", 4, 3, 6), ("5_1", 16, 5, 10), ("7_1", 64, 7, 14), ("T(2,9)", 256, 9, 18)],
)
def test_counts(cli: Cli, knot: str, plans: int, length: int, states: int) -> None:
    found = cli.json("topology", knot)
    assert found["plan_count"] == plans and found["plans_by_length"] == {str(length): plans}
    assert len(found["states"]) == states and len(found["plans"]) == min(plans, 10)
    assert found["flown"]["is_shortest"] and len(found["flown"]["actions"]) == length


def test_mirror_images_and_reverses_are_goals_too(cli: Cli) -> None:
    counts = {
        which: cli.json("topology", "3_1", "--goals", which)["plan_count"] for which in GoalSet
    }
    assert counts == {"one": 4, "mirror": 8, "orbit": 16}
    _, out, _ = cli("topology", OVERHAND, "--goals", "mirror")
    assert "goal       Gauss code (as given)\n" in out
    assert "or         U1- O2- U3- O1- U2- O3-\n" in out and "LCF" not in out


@pytest.mark.parametrize("arguments", [("8_19",), ("4_1", "--rule", "any"), (OVERHAND,)])
def test_json_is_complete_and_true(cli: Cli, tmp_path: Path, arguments: tuple[str, ...]) -> None:
    found = cli.json("topology", *arguments, "--plans", 1000)
    states = [RopeState.from_gauss(entry["state"]) for entry in found["states"]]
    assert states[0] == TRIVIAL and sum(entry["goal"] for entry in found["states"]) == 1
    for before, label, after in found["steps"]:
        assert apply(states[before], parse_action(label), "any") == states[after]
    assert len(found["plans"]) == found["plan_count"] == sum(found["plans_by_length"].values())
    for plan in found["plans"]:
        state = TRIVIAL
        for label, number in zip(plan["actions"], plan["states"][1:], strict=True):
            state = apply(state, parse_action(label), "any")
            assert state == states[number]
        assert str(state) == found["state"]
    flown = found["flown"]
    assert flown["actions"] in [plan["actions"] for plan in found["plans"]]
    assert flown["states"][-1] == found["state"]
    assert found["is_canonical"] == (found["canonical"] == found["state"])
    if found["lcf"] is not None:
        assert len(found["lcf"]["actions"]) == found["crossings"]
        assert all(entry["entered_by"] for entry in found["lcf"]["regions"] if entry["active"])
    file = tmp_path / "goal.json"
    file.write_text(json.dumps(found))
    again = cli.json("topology", file, "--rule", found["rule"])
    assert again["state"] == found["state"] and again["plan_count"] == found["plan_count"]


def test_shortest_plans_and_rules(cli: Cli) -> None:
    every = cli.json("topology", "4_1")
    fewest = cli.json("topology", "4_1", "--shortest")
    assert every["plans_by_length"] == {"4": 3, "5": 16}
    assert fewest["plans_by_length"] == {"4": 3} and not fewest["flown"]["is_shortest"]
    _, out, _ = cli("topology", "4_1", "--shortest", "--plans", 2)
    assert "flown      5 actions; with R2, 4 do" in out
    assert "2 of 3 plans are listed; --plans lists more." in out
    counts = [cli.json("topology", "10_123", "--rule", rule)["plan_count"] for rule in R2Rule]
    assert counts == sorted(counts) and counts[0] < counts[-1]


def test_from_another_state(cli: Cli, tmp_path: Path) -> None:
    _, out, _ = cli("topology", OVERHAND, "--from", "U1+ O1+")
    assert "from       U1+ O1+" in out and "2 of 2 actions; " in out
    assert "flown      2 actions, no plan has fewer" in out
    found = cli.json("topology", OVERHAND, "--from", "O1+ U1+")
    assert found["flown"] is None and found["plan_count"] == 2
    same = cli.json("topology", OVERHAND, "--from", OVERHAND)
    assert same["plan_count"] == 1 and same["plans"] == [{"actions": [], "states": [0]}]
    file = tmp_path / "none.png"
    status, out, err = cli("topology", OVERHAND, "--from", "O1- U1-", "--plot", file)
    assert (status, err) == (1, "") and "none: the start is on no way to the goal" in out
    assert "the flight does not pass the start" in out and not file.exists()


def test_a_rope_without_crossings(cli: Cli) -> None:
    found = cli.json("topology", "trivial")
    assert (found["plan_count"], found["matrix"], found["steps"]) == (1, [[], [], [], []], [])


def test_cuts(cli: Cli) -> None:
    found = {cut: cli.json("topology", "5_2", "--cut", cut) for cut in ("L+", "L-", "T+")}
    assert [entry["cut"] for entry in found.values()] == [*found]
    forward, back = (RopeState.from_gauss(found[cut]["state"]) for cut in ("L+", "L-"))
    assert back == forward.reverse()


def test_topology_plots(cli: Cli, tmp_path: Path) -> None:
    for name, magic in (("a.png", b"\x89PNG"), ("a.pdf", b"%PDF"), ("a.svg", b"<?xml")):
        file = tmp_path / name
        status, out, err = cli("topology", "3_1", "--plot", file)
        assert (status, err) == (0, "") and f"written: {file}" in out
        assert file.read_bytes().startswith(magic)


def test_pictures_without_matplotlib(cli: Cli) -> None:
    for name in [name for name in sys.modules if name.startswith("knotopt.plot")]:
        cli.monkeypatch.delitem(sys.modules, name)
    cli.monkeypatch.setitem(sys.modules, "matplotlib", None)
    status, out, err = cli("topology", "3_1", "--plot", "x.png")
    assert status == 1 and "pip install 'knotopt[viz]'" in err and not out
    assert cli("topology", "3_1")[0] == 0


@pytest.mark.parametrize(
    ("arguments", "status", "words"),
    [
        (("grammy",), 1, "no knot is named 'grammy'"),
        (("T(2,4)",), 1, "is a link of 2 components"),
        (("U1+ O2+ U1+ O2+",), 1, "visits 1 and 3 of one crossing are both under"),
        (("O1+ O2+ U1+ U2+",), 1, "visit 4: a rope in the plane cannot come back to visit 2"),
        (("missing.txt",), 1, "cannot read missing.txt: No such file"),
        (("missing.json",), 1, "cannot read missing.json"),
        ((OVERHAND, "--cut", "L+"), 1, "which has no grid to cut at L+"),
        (("3_1", "--cut", "col3+"), 1, "carries 1 crossing"),
        (("3_1", "--from", "O1+"), 1, "1 visits: every crossing has two"),
        (("3_1", "--rule", "R2"), 2, "is one of public, paper, any"),
        (("3_1", "--goals", "two"), 2, "is one of one, mirror, orbit"),
        (("3_1", "--plans", "-1"), 2, "--plans"),
        (("3_1", "--plot", "a.gif"), 1, "pictures are written as .png, .pdf, .svg"),
        (("3_1", "--plot", "a.png", "--plans", "0"), 2, "is at least 1 with --plot"),
        ((), 2, "Missing argument"),
    ],
)
def test_wrong_input(
    cli: Cli, tmp_path: Path, arguments: tuple[str, ...], status: int, words: str
) -> None:
    cli.monkeypatch.chdir(tmp_path)
    found, out, err = cli("topology", *arguments)
    assert found == status and words in " ".join(err.replace("│", " ").split())
    assert "Traceback" not in err and not out and not list(tmp_path.iterdir())


@pytest.mark.slow
def test_an_interrupt_leaves_nothing_behind(tmp_path: Path) -> None:
    grid = tmp_path / "grid.json"
    grid.write_text(json.dumps({"grid": random_knot(40, seed=1).marks}))
    arguments = ["topology", "grid.json", "--plot", "plans.png"]
    run = subprocess.Popen(
        [sys.executable, "-m", "knotopt", *arguments],
        cwd=tmp_path,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    )
    time.sleep(4)
    run.send_signal(signal.SIGINT)
    out, err = run.communicate(timeout=30)
    assert run.returncode != 0 and not out and "Traceback" not in err
    assert [path.name for path in tmp_path.iterdir()] == ["grid.json"]
