"""`knotopt solve KNOT` without a formulation, as a user meets it."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from tests.helpers.command_line import Cli

QUICKLY = ("--budget", "20000")


def test_the_first_screen(cli: Cli) -> None:
    status, out, err = cli("solve", "3_1", *QUICKLY)
    assert (status, err) == (0, "")
    first, _, *facts = out.splitlines()
    assert first == "3_1 (KnotInfo): 3 robots are needed, and 3 fly: settled"
    told = {line[:14].strip(): line[14:].split() for line in facts if line[:14].strip()}
    assert [told[key][0] for key in ("needed", "this diagram", "flown", "LCF")] == ["3"] * 3 + ["5"]
    assert "tie it or its mirror image in 12 of 12 simulated flights with noise of 10 mm" in out
    assert "no fewer: the loop at [4,4]" in out
    assert "the leader never crosses its own tether" in " ".join(out.split())


@pytest.mark.parametrize(
    ("knot", "heading"),
    [
        ("trefoil", "3_1 or its mirror image (KnotInfo): 3"),
        ("DT: [(4, 6, 2)]", "DT code = 3_1 or its mirror image (as given): 3"),
        ("T(2,3)", "T(2,3) = 3_1 (torus knot): 3"),
        (
            "DT: [(4, 6, 2, 10, 12, 8)]",
            "DT code = 3_1#3_1 or 3_1#m3_1 or m3_1#m3_1 (as given): 3",
        ),
    ],
)
def test_the_heading_says_which_knots_it_may_be(cli: Cli, knot: str, heading: str) -> None:
    _, out, _ = cli("solve", knot, "--budget", "200")
    assert out.startswith(heading)


def test_json_holds_sets_that_fly_reads(cli: Cli, tmp_path: Path) -> None:
    content = cli.json("solve", "7 Var2", *QUICKLY)
    assert content["identified"] == ["7_6"] or content["identified"] == ["m7_6"]
    assert content["needed"]["robots"] == 4 and len(content["needed"]["assumptions"]) == 4
    diagram, safe = content["diagram"], content["safe"]
    assert (diagram["robots"], len(diagram["loops"])) == (4, 2) and diagram["proven"]
    assert safe["robots"] == len(safe["supports"]) + 2 <= 11
    saved = tmp_path / "safe.json"
    saved.write_text(json.dumps(safe))
    again = cli.json("solve", saved, "--formulation", "span", "--cut", safe["cut"])
    assert again["robots_after"] == safe["robots"]
    assert content["lcf"]["robots"] == 8 and content["every_corner"] == 18


def test_a_knot_that_nobody_flew_and_the_unknot(cli: Cli) -> None:
    _, out, _ = cli("solve", "10_165", *QUICKLY)
    assert "4 robots are needed; no team that flies is known" in out
    _, out, _ = cli("solve", "0_1", *QUICKLY)
    assert "0_1 (KnotInfo): 2 robots: nothing to hold open" in out


def test_the_picture_shows_the_loops(cli: Cli, tmp_path: Path) -> None:
    picture = tmp_path / "loops.png"
    status, out, _ = cli("solve", "7 Var2", *QUICKLY, "--plot", picture)
    assert status == 0 and picture.stat().st_size > 10_000 and "written: " in out


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (("--cut", "L+"), "--cut: goes with --formulation opening, span, loops"),
        (("--r", "0.3"), "--r: goes with --formulation"),
        (("--all",), "--all: goes with --formulation"),
        (("--verify-physics",), "--verify-physics: goes with --formulation"),
        (("--budget", "soon"), "a budget is seconds, such as 5s"),
    ],
)
def test_what_goes_with_a_formulation(cli: Cli, arguments: tuple[str, ...], message: str) -> None:
    status, out, err = cli("solve", "3_1", *arguments)
    assert status in (1, 2) and not out and message in " ".join(err.split())
