"""The command `fly`, as somebody with a swarm meets it."""

from __future__ import annotations

import json
import re
import sys
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from knotopt.export.waypoints import read_waypoints
from knotopt.flight.plan import FlightPlan
from knotopt.flight.plan_file import read_plan
from knotopt.flight.planner import FlightPlanner, plan_flight
from knotopt.mission import alternatives
from tests.helpers.command_line import Cli

FILES = {
    "check.json",
    "crazyflies.yaml",
    "flight.png",
    "fly.py",
    "plan.json",
    "viewer.html",
    "waypoints.csv",
}


def names(folder: Path) -> set[str]:
    return {entry.name for entry in folder.iterdir()}


def robots(count: int) -> set[str]:
    return {f"robot_{j:02d}.csv" for j in range(1, count + 1)}


def test_a_plan_and_its_folder(cli: Cli, tmp_path: Path) -> None:
    folder = tmp_path / "flights" / "trefoil"
    status, out, err = cli("fly", "3", "--out", folder)
    assert (status, err) == (0, "")
    assert "3_1 (Table I, row 3), cut L+: 5 robots (milp)" in out
    assert re.search(r"time of flight +\d+\.\d s, optimised schedule; .* % shorter", out)
    assert re.search(r"limits +kept", out) and "span 4 under span 1" in out
    assert out.endswith(f"written: {folder}\n")
    assert names(folder) == FILES | robots(5) and names(folder.parent) == {"trefoil"}
    plan, points = read_plan(folder / "plan.json"), read_waypoints(folder / "waypoints.csv")
    assert np.abs(points.positions - plan.positions).max() < 1e-4
    check = json.loads((folder / "check.json").read_text())
    assert check["ok"] and check["duration"] < 0.8 * check["duration_fixed"]
    (folder / "robot_99.csv").write_text("of a former flight")
    status, _, _ = cli("fly", "3", "--out", folder, "--schedule", "fixed", "--supports", "all")
    assert status == 0 and names(folder) == FILES | robots(10)
    assert read_plan(folder / "plan.json").schedule == "fixed"


def test_the_summary_alone(cli: Cli, tmp_path: Path) -> None:
    cli.monkeypatch.chdir(tmp_path)
    found = cli.json("fly", "3", "--speed", 0.4, "--altitude", 2.0, "--hover-after", 1)
    assert found["written"] is None and not names(tmp_path)
    assert found["limits"]["speed"]["limit"] == 0.4
    assert 0.35 < found["limits"]["speed"]["value"] <= 0.4
    assert [row["result"] for row in found["crossings"]] == ["as planned"] * 3
    assert found["undisturbed"] is None and found["polynomials"]["broken"] == []


def test_a_broken_limit_is_said_and_everything_written(cli: Cli, tmp_path: Path) -> None:
    def too_high(**asked: Any) -> FlightPlan:
        plan = plan_flight(**asked)
        return replace(plan, world=replace(plan.world, ceiling=2.21))

    cli.monkeypatch.setattr(alternatives, "plan_flight", too_high)
    status, out, err = cli("fly", "3", "--out", tmp_path / "high")
    assert (status, err) == (1, "")
    assert re.search(r"not good: the plan: robot \d is at 2.\d+ m at .* above the ceiling of", out)
    assert "not good: the polynomials: robot" in out and re.search(r"limits +NOT kept", out)
    assert names(tmp_path / "high") == FILES | robots(5)
    check = json.loads((tmp_path / "high" / "check.json").read_text())
    assert not check["ok"] and "above the ceiling of 2.21 m" in check["reasons"][0]
    assert '"robot' in (tmp_path / "high" / "fly.py").read_text().split("PARTS")[0]


def test_without_extras(cli: Cli, tmp_path: Path) -> None:
    for name in [name for name in sys.modules if name.startswith("knotopt.plot")]:
        cli.monkeypatch.delitem(sys.modules, name)
    cli.monkeypatch.setitem(sys.modules, "matplotlib", None)
    cli.monkeypatch.setitem(sys.modules, "mujoco", None)
    status, out, err = cli("fly", "3", "--out", tmp_path / "bare")
    assert (status, err) == (0, "")
    assert re.search(r"no pictures: .* needs matplotlib.*pip install 'knotopt\[viz\]'", out)
    assert names(tmp_path / "bare") == FILES - {"flight.png"} | robots(5)
    status, out, err = cli("fly", "3", "--sim", "--out", tmp_path / "none")
    assert status == 1 and not out and "simulating a flight needs mujoco" in err
    assert "pip install 'knotopt[sim]'" in err and names(tmp_path) == {"bare"}


@pytest.mark.parametrize("when", ["planning", "writing"])
def test_an_interrupt_leaves_nothing(cli: Cli, tmp_path: Path, when: str) -> None:
    def interrupted(*_: object) -> None:
        raise KeyboardInterrupt

    if when == "planning":
        cli.monkeypatch.setattr(FlightPlanner, "motion", interrupted)
    else:
        cli.monkeypatch.setattr("os.fsync", interrupted)
    status, out, _ = cli("fly", "3", "--out", tmp_path / "new" / "flight")
    assert status != 0 and "written" not in out and not names(tmp_path)


@pytest.mark.parametrize(
    ("arguments", "status", "words"),
    [
        (("--schedule", "quick"), 2, "is one of optimised, fixed"),
        (("--supports", "few"), 1, "supports are milp, lcf, all or a .json file"),
        (("--supports", "lcf", "--r", "0.3"), 2, "goes with --supports milp"),
        (("--supports", "all", "--formulation", "span"), 2, "goes with --supports milp"),
        (("--supports", "lcf", "--with", "none"), 2, "goes with --supports milp"),
        (("--formulation", "loops", "--r", "0.5"), 2, "loops has no openness"),
        (("--formulation", "best"), 1, "no formulation is named 'best'"),
        (("--cut", "col2+"), 1, "carries"),
        (("--speed", "nan"), 1, "speed is a number from 0 up, not nan"),
        (("--acceleration", "0"), 1, "acceleration must be positive"),
        (("--hover-after", "0"), 1, "hover_after must be positive"),
        (("--hover-before", "0.01"), 1, "hover_before lies between 0.05 and 600 s, not at 0.01"),
        (("--hover-before", "inf"), 1, "hover_before is a number from 0 up, not inf"),
        (("--separation", "0.4"), 1, "a downwash of 0.33 m is less than the separation of 0.4 m"),
        (("--spacing", "0.1"), 1, "a spacing of 0.1 m is less than the separation"),
        (("--step", "nan"), 1, "step is a length in metres, not nan"),
        (("--altitude", "9"), 1, "the altitude 9 m is not between the floor"),
        (("--floor", "1.8"), 1, "to pass under span 1, which hangs"),
        (("--step", "0.1"), 1, "robot"),
        (("--noise", "0.1"), 2, "--noise: goes with --sim"),
        (("--wind", "1,0"), 2, "--wind: goes with --sim"),
        (("--runs", "2"), 2, "--runs: goes with --sim"),
        (("--tighten", "5"), 2, "--tighten: goes with --sim"),
        (("--sim", "--tighten", "1.2"), 1, "the knot's ends are 1.50 m apart when it is laid"),
        (("--sim", "--tighten", "nan"), 2, "--tighten: is a distance in metres, not nan"),
        (("--sim", "--noise", "nan"), 1, "noise is a number from 0 up, not nan"),
        (("--sim", "--gust", "-1"), 1, "gust is a number from 0 up, not -1"),
        (("--sim", "--wind", "1"), 2, "is X,Y in m/s, such as 0.3,0; not '1'"),
        (("--sim", "--wind", "nan,0"), 2, "is X,Y in m/s"),
        (("--sim", "--runs", "-1"), 2, "greater than or equal to 0"),
        (("--out", "file"), 1, "cannot write file: a file is in the way"),
        (("--out", "."), 1, ". is the current folder"),
        (("--out", "mine"), 1, "mine holds thesis.tex, which is no file of a flight"),
        (("--out", "/proc/flight"), 1, "cannot write /proc/flight"),
    ],
)
def test_wrong_input(
    cli: Cli, tmp_path: Path, arguments: tuple[str, ...], status: int, words: str
) -> None:
    cli.monkeypatch.chdir(tmp_path)
    (tmp_path / "file").write_text("")
    (tmp_path / "mine").mkdir()
    (tmp_path / "mine" / "thesis.tex").write_text("")
    if "--out" not in arguments:
        arguments = (*arguments, "--out", "flight")
    found, out, err = cli("fly", "3", *arguments)
    assert found == status and words in " ".join(err.replace("│", " ").split()) and not out
    assert "Traceback" not in err and names(tmp_path) == {"file", "mine"}
    assert names(tmp_path / "mine") == {"thesis.tex"}


def test_an_unknown_knot(cli: Cli) -> None:
    status, _, err = cli("fly", "99_9")
    assert status == 1 and "no knot is named '99_9'" in err


@pytest.mark.slow
def test_a_flight_in_physics(cli: Cli, tmp_path: Path) -> None:
    pytest.importorskip("mujoco")
    folder = tmp_path / "trefoil"
    disturbed = ("--runs", 2, "--noise", 0.3, "--wind", "0.1,-0.1", "--seed", 7)
    tight = ("--sim", "--tighten", 5)
    status, out, err = cli("fly", "3", "--r", 0.25, *tight, *disturbed, "--out", folder)
    assert not err
    assert re.search(
        r"pulled tight +in \d+\.\d s more: ends 1\.50, then (4\.9|5\.0)\d m apart", out
    )
    assert "undisturbed flight: tied: 3_1" in out
    assert "0 of 2 tie it (95 % interval 0 to 66 %); noise of 300 mm, wind (0.1, -0.1) m/s" in out
    assert re.search(r"seed 7 flight: stuck: \w+, held back at \d+\.\d s of the plan", out)
    assert "the flight did not get that far" in out and "seed 8 flight" not in out
    assert names(folder) == FILES | robots(5) | {"strip.png", "flight.gif"}
    check = json.loads((folder / "check.json").read_text())
    assert status == (0 if check["ok"] else 1)
    assert check["undisturbed"]["outcome"] == "tied" and check["rehearsal"]["robust"] == 3
    assert [row["result"] for row in check["undisturbed"]["crossings"]] == ["as planned"] * 3
    assert [each["seed"] for each in check["disturbed"]] == [7, 8] and check["tied"] == 0
    page = (folder / "viewer.html").read_text()
    assert "Crossings as executed" in page and "seed 7" in page and "pulling tight" in page
    plan = read_plan(folder / "plan.json")
    assert check["tightening"] == plan.tightening > 5 and check["ends_apart"][1] > 4.9
    assert check["supports_within"][1] < check["supports_within"][0]


@pytest.mark.slow
@pytest.mark.parametrize("knot", ["4_1", "5_1"])
def test_other_knots_in_physics(cli: Cli, tmp_path: Path, knot: str) -> None:
    pytest.importorskip("mujoco")
    folder = tmp_path / knot
    status, out, err = cli("fly", knot, "--supports", "all", "--sim", "--runs", 1, "--out", folder)
    assert f"undisturbed flight: tied: {knot}" in out, out + err
    check = json.loads((folder / "check.json").read_text())
    assert status == (0 if check["ok"] else 1) and check["tied"] == 1
