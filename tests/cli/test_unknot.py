"""The unknot goes through every command: two robots, and nothing to hold open."""

from __future__ import annotations

import json
import re
from pathlib import Path

import pytest

from knotopt.diagram.families import random_knot
from knotopt.diagram.grid import GridDiagram
from knotopt.diagram.simplify import simplify
from knotopt.reading.writing import WRITTEN_FORMS
from tests.helpers.command_line import Cli

CROSSED = random_knot(6, 2)
"""A diagram of the unknot with seven crossings."""


def written(folder: Path, grid: GridDiagram) -> Path:
    path = folder / "unknot.json"
    path.write_text(json.dumps({"grid": [list(mark) for mark in grid.marks]}))
    return path


@pytest.fixture(params=["by name", "crossed"])
def knot(request: pytest.FixtureRequest, tmp_path: Path) -> str | Path:
    """The unknot, and a diagram of it that has crossings."""
    return "unknot" if request.param == "by name" else written(tmp_path, CROSSED)


def test_the_larger_diagram_is_one() -> None:
    assert int(CROSSED.crossing_cells.sum()) == 7 and simplify(CROSSED).size == 2


@pytest.mark.parametrize("name", ["0_1", "unknot"])
def test_two_robots_and_nothing_to_hold_open(cli: Cli, name: str) -> None:
    for command in (("lcf",), ("solve",), ("solve", "--formulation", "span"), ("fly",)):
        status, out, _ = cli(command[0], name, *command[1:])
        assert status == 0 and "2 robots" in out
        assert "supports: none: nothing to hold open" in out


def test_show(cli: Cli, knot: str | Path, tmp_path: Path) -> None:
    found = cli_json(cli, "show", knot)
    assert found["alexander"] == [1] and found["determinant"] == 1
    assert found["signature"] in (0, None) and found["smallest_grid_found"] == 2
    status, out, _ = cli("show", knot, "--plot", tmp_path / "u.png")
    assert status == 0 and (tmp_path / "u.png").exists()
    assert ("Gauss code      none" in out) == ("crossings       0, writhe 0" in out)


@pytest.mark.parametrize("form", WRITTEN_FORMS)
def test_show_in_every_form(cli: Cli, knot: str | Path, form: str, tmp_path: Path) -> None:
    status, out, _ = cli("show", knot, "--format", form)
    (tmp_path / "again").write_text(out)
    assert status == 0
    assert cli_json(cli, "show", tmp_path / "again")["smallest_grid_found"] == 2


def test_lcf(cli: Cli, knot: str | Path, tmp_path: Path) -> None:
    assert cli_json(cli, "lcf", knot)["robots_after"] >= 2
    assert len(cli_json(cli, "lcf", knot, "--cut", "all")) >= 8
    assert cli("lcf", knot, "--plot", tmp_path / "u.png")[0] == 0


@pytest.mark.parametrize("formulation", ["opening", "span"])
def test_solve(cli: Cli, knot: str | Path, formulation: str, tmp_path: Path) -> None:
    asked = ("--formulation", formulation)
    found = cli_json(cli, "solve", knot, *asked)
    assert found["status"] == "optimal" and found["bound"] == found["robots_after"]
    for more in (
        ("--all",),
        ("--cut", "all"),
        ("--plot", tmp_path / "u.png"),
        ("--diagrams", "--budget", 2000),
    ):
        assert cli("solve", knot, *asked, *more)[0] == 0
    assert cli("solve", knot, *asked, "--max-robots", 6)[0] == 0


def test_prove_and_check(cli: Cli, knot: str | Path, tmp_path: Path) -> None:
    for method in ("refutation", "count"):
        proof = tmp_path / f"{method}.jsonl"
        assert cli("prove", knot, "--method", method, "--out", proof)[0] == 0
        status, out, _ = cli("check", proof)
        assert status == 0 and "1 accepted, 0 rejected" in out


def test_path(cli: Cli, knot: str | Path, tmp_path: Path) -> None:
    for supports in ("milp", "lcf", "all"):
        found = cli_json(cli, "path", knot, "--supports", supports)
        assert found["status"] == "solved" and found["same_diagram"]
    plots = ("--plot", tmp_path / "u.png", "--method", "both")
    assert cli("path", knot, *plots)[0] == 0


def test_fly(cli: Cli, knot: str | Path, tmp_path: Path) -> None:
    status, out, _ = cli("fly", knot, "--out", tmp_path / "flight")
    # Robots that hold up a loop of the unknot may come closer than is allowed, which is said.
    assert (status, "limits          kept" in out) in ((0, True), (1, False))
    assert status == 0 or knot != "unknot"
    assert (tmp_path / "flight" / "viewer.html").exists()


def test_topology(cli: Cli, knot: str | Path, tmp_path: Path) -> None:
    status, out, _ = cli("topology", knot, "--plot", tmp_path / "u.png")
    assert status == 0 and "plans" in out


def test_compare(cli: Cli, knot: str | Path, tmp_path: Path) -> None:
    (row,) = cli_json(cli, "compare", knot)
    assert row["opening_proven"] and row["span_proven"]
    assert cli("compare", knot, "--out", tmp_path / "table.tex")[0] == 0


@pytest.mark.slow
def test_atlas_and_report(cli: Cli, knot: str | Path, tmp_path: Path) -> None:
    run = tmp_path / "run"
    status, out, _ = cli("atlas", run, knot, "3_1", "--jobs", 1, "--span", "--paths")
    assert status == 0 and "0 wrong" in out
    assert cli("report", run, "--out", tmp_path / "report")[0] == 0


def test_identify(cli: Cli, knot: str | Path) -> None:
    status, out, _ = cli("identify", knot)
    assert status == 0 and re.search(r"^knot  +0_1, by", out, re.MULTILINE)


def test_knots(cli: Cli) -> None:
    """The unknot is prime no more than 1 is: it is in no list."""
    status, out, _ = cli("knots", "0_1")
    assert status == 0 and "0 knots" in out


def test_topology_of_a_trivial_state(cli: Cli) -> None:
    found = cli_json(cli, "topology", "trivial")
    assert found["crossings"] == 0 and found["plan_count"] == 1


def cli_json(cli: Cli, *arguments: object) -> dict[str, object] | list[dict[str, object]]:
    """What a command prints as JSON; how a grid was read may be said beside."""
    status, out, _ = cli(*arguments, "--json")
    assert status == 0
    return json.loads(out)  # type: ignore[no-any-return]
