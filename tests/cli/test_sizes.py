"""A grid that is too large for a command is refused before work, with the size that it takes."""

from __future__ import annotations

import json
import re
from pathlib import Path

import pytest

from knotopt.cli import sizes
from knotopt.cli.sizes import LARGEST
from knotopt.diagram.families import random_knot
from tests.helpers.command_line import Cli

JOBS = {
    "show": ("show", "3"),
    "show --plot": ("show", "3", "--plot", "a.png"),
    "show --format": ("show", "3", "--format", "pd"),
    "lcf": ("lcf", "3"),
    "lcf --cut all": ("lcf", "3", "--cut", "all"),
    "lcf --plot": ("lcf", "3", "--plot", "a.png"),
    "solve": ("solve", "3"),
    "solve --formulation span": ("solve", "3", "--formulation", "span"),
    "prove": ("prove", "3"),
    "prove --formulation span": ("prove", "3", "--formulation", "span"),
    "compare": ("compare", "3"),
    "path": ("path", "3"),
    "path --formulation span": ("path", "3", "--formulation", "span"),
    "fly": ("fly", "3", "--supports", "lcf"),
    "fly --supports milp": ("fly", "3"),
    "identify": ("identify", "3"),
    "atlas": ("atlas", "run", "3"),
    "atlas --span": ("atlas", "run", "3", "--span"),
}


def test_every_size_has_a_command_and_stands_on_its_page() -> None:
    assert JOBS.keys() == LARGEST.keys()
    page = (Path(__file__).parents[2] / "docs" / "commands.md").read_text(encoding="utf-8")
    assert dict(re.findall(r"^\| `([a-z -]+)` \| (\d+) \|$", page, re.MULTILINE)) == {
        job: str(most) for job, most in LARGEST.items()
    }


@pytest.mark.parametrize("job", JOBS)
def test_a_size_less_than_the_knot_s_is_said_before_work(
    cli: Cli, tmp_path: Path, job: str
) -> None:
    cli.monkeypatch.chdir(tmp_path)
    cli.monkeypatch.setattr(sizes, "LARGEST", {**LARGEST, job: 4})
    status, out, err = cli(*JOBS[job])
    assert status == 1 and not out and not [*tmp_path.iterdir()]
    assert f"a grid of size 5 is too large for `{job}`, which takes sizes up to 4" in err


@pytest.mark.parametrize(
    ("command", "most"),
    [("lcf", "300"), ("solve", "60"), ("path", "60"), ("fly", "26"), ("compare", "22")],
)
def test_a_grid_of_500(cli: Cli, tmp_path: Path, command: str, most: str) -> None:
    grid = tmp_path / "grid.json"
    grid.write_text(json.dumps(random_knot(500, seed=1).marks))
    status, out, err = cli(command, grid)
    assert status == 1 and not out and f"sizes up to {most}" in err


def test_plans_that_are_too_many(cli: Cli) -> None:
    cli.monkeypatch.setattr("knotopt.topology.plan.MOST_STATES", 3)
    status, out, err = cli("topology", "3_1")
    assert status == 1 and not out
    assert "the ways to this goal of 3 crossings pass through more than 3 states" in err
