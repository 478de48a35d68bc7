"""The command `path`, the supports it takes, and its pictures, as a user meets them."""

from __future__ import annotations

import csv
import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from matplotlib.collections import LineCollection

from knotopt import best_cut, optimise_path, read, relax, relaxed_path
from knotopt.plot.path import draw_heights, draw_plan
from knotopt.plot.path_figures import braid_figure, path_figure, relaxation_figure
from tests.helpers.command_line import Cli


def test_path_prints_and_writes(cli: Cli, tmp_path: Path) -> None:
    picture, curve = tmp_path / "a.png", tmp_path / "a.csv"
    status, out, err = cli("path", "3", "--plot", picture, "--out", curve)
    assert (status, err) == (0, "") and "3_1, cut L+: 5 robots (milp)" in out
    assert "C2 spline" in out and "nlp" in out and "relaxation" not in out.split("Paths of")[0]
    assert picture.stat().st_size > 10_000
    head, *rows = csv.reader(curve.read_text().splitlines())
    assert head == ["s", "x", "y", "z", "tx", "ty", "tz", "curvature"]
    points = np.array(rows, dtype=float)
    length = np.linalg.norm(np.diff(points[:, 1:4], axis=0), axis=1).sum()
    assert length == pytest.approx(points[-1, 0], rel=1e-3)
    assert points[0, 1:4].tolist() == [1.0, 4.0, 0.0]
    assert np.linalg.norm(points[:, 4:7], axis=1) == pytest.approx(np.ones(len(points)), abs=1e-5)


def test_path_json(cli: Cli) -> None:
    relaxed, ours = cli.json("path", "9", "--supports", "lcf", "--method", "both")
    assert [relaxed["method"], ours["method"]] == ["relaxation", "nlp"]
    assert ours["same_diagram"] and ours["same_knot"] and ours["status"] == "solved"
    assert ours["length"] < relaxed["length"] and ours["cut"] == relaxed["cut"] == "L-"
    assert len(ours["rounds"]) >= 2 and relaxed["steps"] > 50
    assert ours["metres"] is None and len(ours["points"][0]) == 3


def test_path_in_metres(cli: Cli) -> None:
    found = cli.json("path", "3", "--step", 0.5)
    assert found["requirements"]["gap"] == 0.66
    assert found["metres"]["cable_length"] == pytest.approx(found["length"] / 2, abs=1e-3)
    _, out, _ = cli("path", "3", "--step", 0.5)
    assert "vertical gap needed" in out and "0.330 m" in out


def test_path_takes_what_solve_and_lcf_print(cli: Cli, tmp_path: Path) -> None:
    for command in (
        ("solve", "5", "--formulation", "opening"),
        ("lcf", "5", "--cut", "R-"),
        ("path", "5", "--cut", "T+"),
    ):
        file = tmp_path / "set.json"
        content = cli.json(*command)
        file.write_text(json.dumps(content))
        found = cli.json("path", "5", "--supports", file)
        assert found["cut"] == content["cut"]
        assert found["supports"] == content["supports"]
    every = cli.json("path", "5", "--supports", "all", "--cut", "T-")
    assert every["robots"] == 14 and every["cut"] == "T-"


@pytest.mark.parametrize(
    ("content", "words"),
    [
        ("{", "is not JSON"),
        ("[]", 'has no "supports"'),
        ("[{}, {}]", "holds 2 sets of supports: it must be one"),
        ('{"supports": [3]}', 'has no "cut"; give one with --cut'),
        ('{"supports": [3], "cut": "L+", "grid": [[1, 1]]}', "its grid is not the knot's"),
        ('{"supports": [99], "cut": "L+"}', "support p99 is none of the turning points p2 to p9"),
        ('{"supports": [[3, 1, 1]], "cut": "L+"}', "is no turning point of the cable cut at L+"),
        ('{"supports": ["p3"], "cut": "L+"}', "a support is an index on the path or"),
        ('{"supports": [true], "cut": "L+"}', "a support is an index on the path or"),
        ('{"supports": [3, 3], "cut": "L+"}', "two supports at p3"),
        ('{"supports": [3], "cut": "col2+"}', "carries"),
    ],
)
def test_files_that_hold_no_supports(cli: Cli, tmp_path: Path, content: str, words: str) -> None:
    file = tmp_path / "set.json"
    file.write_text(content)
    status, out, err = cli("path", "3", "--supports", file)
    assert status == 1 and words in err and not out


@pytest.mark.parametrize(
    ("arguments", "status", "words"),
    [
        (("--method", "springs"), 2, "is one of nlp, relaxation, both"),
        (("--supports", "few"), 1, "supports are milp, lcf, all or a .json file"),
        (("--supports", "missing.json"), 1, "cannot read missing.json"),
        (("--clearance", "-1"), 1, "clearance must be a positive number"),
        (("--gap", "nan"), 1, "gap must be a finite number"),
        (("--step", "0"), 1, "a grid step is a positive length"),
        (("--step", "0.01"), 1, "a gap of 0.33 m is more than 10 grid steps of 0.01 m"),
        (("--step", "0.5", "--floor", "1.4", "--ceiling", "1.6"), 1, "no room for a gap of 0.33 m"),
        (("--step", "0.5", "--gap", "0.3"), 2, "with --step it follows from --drone-height"),
        (("--altitude", "2"), 2, "goes with --step"),
        (("--supports", "lcf", "--r", "0.3"), 2, "goes with --supports milp"),
        (("--opening", "50"), 1, "opening 50 is more than 10 grid steps"),
        (("--step", "0.5", "--altitude", "9"), 1, "the altitude 9 m is not between"),
        (("--plot", "a.gif"), 1, "pictures are written as .png, .pdf, .svg"),
        (("--out", "a.txt"), 1, "curves are written as .csv"),
        (("--out", "a.csv", "--method", "both"), 2, "writes one curve"),
        (("--time-limit", "0"), 1, "time limit must be positive"),
        (("--cut", "col2+"), 1, "carries"),
    ],
)
def test_wrong_input(
    cli: Cli, tmp_path: Path, arguments: tuple[str, ...], status: int, words: str
) -> None:
    cli.monkeypatch.chdir(tmp_path)
    found, _, err = cli("path", "3", *arguments)
    assert found == status and words in " ".join(err.replace("│", " ").split())
    assert "Traceback" not in err and not list(tmp_path.iterdir())


def test_what_is_not_met_is_said_and_the_exit_status_is_1(cli: Cli) -> None:
    status, out, _ = cli("path", "5", "--supports", "all", "--opening", 1.5)
    assert status == 1 and "not met      opening 0.99" in out
    relaxation = ("path", "3", "--supports", "lcf", "--method", "relaxation")
    assert cli(*relaxation)[0] == 0
    status, out, _ = cli(*relaxation, "--slope", 0.2)
    assert status == 1 and "converged" in out and "not met      slope" in out


@pytest.fixture(scope="module")
def paths() -> Any:
    chosen = best_cut(read("4").diagram)
    ours = optimise_path(chosen.cable, chosen.supports)
    return relaxed_path(chosen.cable, chosen.supports), ours


def test_the_plan_is_broken_where_it_passes_under(paths: Any) -> None:
    from matplotlib.figure import Figure

    for result in paths:
        axes = Figure().subplots()
        draw_plan(axes, result)
        (lines,) = [each for each in axes.collections if isinstance(each, LineCollection)]
        pieces = lines.get_segments()
        crossings = result.report.crossings
        assert len(pieces) == len(crossings) + 1
        for point in crossings.point:
            through = [np.linalg.norm(piece - point, axis=1).min() for piece in pieces]
            assert sorted(through)[0] < 0.02 < sorted(through)[1]


def test_the_profile_marks_every_visit(paths: Any) -> None:
    from matplotlib.figure import Figure

    for result in paths:
        axes = Figure().subplots()
        over, under = draw_heights(axes, result)
        assert len(over.get_xdata()) == len(under.get_xdata()) == len(result.report.crossings)
        assert min(over.get_ydata()) > max(under.get_ydata()) - 0.5
        names = [text.get_text() for text in axes.texts]
        assert sum(name.startswith("c") for name in names) == 2 * len(result.report.crossings)
        assert {"1", "12"} < set(names)


def test_figures_have_their_panels(paths: Any) -> None:
    relaxed, ours = paths
    assert len(path_figure(paths, "both").axes) == 6
    figure = relaxation_figure(relax(ours.cable, ours.supports), relaxed, ours, "Fig. 5")
    assert [axes.get_title()[:3] for axes in figure.axes[:5]] == ["(a)", "(b)", "(c)", "(d)", "(e)"]
    left, right = braid_figure(ours, "Fig. 7").axes
    assert left.get_title() == "every corner held: 12 robots"
    assert right.get_title() == "reduced: 5 robots"
