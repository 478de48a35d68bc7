"""The command line as a user meets it."""

from __future__ import annotations

import importlib
import importlib.metadata
import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

from formulations import probe
from knotopt.cli.app import COMMANDS
from knotopt.cli.printing import print_table
from tests.helpers.command_line import Cli

HEAVY = ("numpy", "scipy", "networkx", "matplotlib", "cvxpy", "ortools", "casadi", "highspy")


def test_help_names_every_command_and_each_has_an_example(cli: Cli) -> None:
    status, out, _ = cli("--help")
    assert status == 0
    printing = "knots show lcf solve path fly topology compare check table1 doctor"
    writing = "atlas report prove"
    for command in f"{printing} {writing}".split():
        assert command in out
        status, text, _ = cli(command, "--help")
        assert status == 0 and f"knotopt {command}" in text
        assert ("--json" in text) == (command not in writing.split())
        assert "Example:" in text


def test_help_imports_nothing_heavy() -> None:
    """What makes `knotopt --help` answer at once."""
    code = (
        "import sys; sys.argv = ['knotopt', '--help']\n"
        "from knotopt.cli.app import main\n"
        "try: main()\n"
        "except SystemExit: pass\n"
        f"print([name for name in {HEAVY} if name in sys.modules], file=sys.stderr)\n"
        "assert not {'knotopt.cli.solve', 'knotopt.cli.lcf'} & sys.modules.keys()"
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
    assert again["signature"] == -6


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
        (("show", "8_22"), "no knot is named '8_22'; KnotInfo has 8_1 to 8_21"),
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
    assert "Did you mean 'solve'" in cli("slove")[2]


def test_every_command_is_where_the_list_says() -> None:
    for name, (module, words) in COMMANDS.items():
        command = getattr(importlib.import_module(f"knotopt.cli.{module}"), name)
        assert command.__name__ == name and words.endswith(".") and len(words) < 60


def test_pictures_without_matplotlib(cli: Cli, monkeypatch: pytest.MonkeyPatch) -> None:
    for name in [name for name in sys.modules if name.startswith("knotopt.plot")]:
        monkeypatch.delitem(sys.modules, name)
    monkeypatch.setitem(sys.modules, "matplotlib", None)
    status, _, err = cli("show", "3_1", "--plot", "x.png")
    assert status == 1 and "pip install 'knotopt[viz]'" in err


def test_pictures_as_bytes() -> None:
    from matplotlib.figure import Figure

    from knotopt.plot.figures import figure_bytes

    for name, magic in (("png", b"\x89PNG"), ("pdf", b"%PDF"), ("svg", b"<?xml")):
        picture = figure_bytes(Figure(figsize=(1, 1)), name)
        assert picture.startswith(magic)
        assert picture == figure_bytes(Figure(figsize=(1, 1)), name)


def test_heads_of_tables_keep_their_brackets(capsys: pytest.CaptureFixture[str]) -> None:
    print_table(("length [m]", "[bold]"), [(1.5, "[red]"), (12.5, "x")])
    lines = capsys.readouterr().out.split("\n")
    assert lines[1].split() == ["length", "[m]", "[bold]"]
    assert lines[3].split() == ["1.5", "[red]"]


def test_ctrl_c_after_a_solve_is_an_exception() -> None:
    """So that files half written are cleaned up; CP-SAT leaves it to the system."""
    code = (
        "import signal\n"
        "from formulations.backends.cp_sat import CpSat\n"
        "from formulations.instance import Instance, Row\n"
        "from formulations.solution import Limits\n"
        "row = Row((1, 2), 1, 'cover', 'a')\n"
        "print(CpSat().solve(Instance('i', ('x', 'y'), 2, (1, 1), (row,)), Limits()).objective)\n"
        "try: signal.raise_signal(signal.SIGINT)\n"
        "except KeyboardInterrupt: print('heard')\n"
    )
    run = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
    assert (run.returncode, run.stdout.split()) == (0, ["1", "heard"]), run


def test_doctor(cli: Cli, monkeypatch: pytest.MonkeyPatch) -> None:
    found = cli.json("doctor")
    assert [solver["works"] for solver in found["solvers"]] == [True] * 5
    assert found["versions"]["numpy"][0].isdigit()
    extras = {
        "viz",
        "knotinfo",
        "snappy",
        "scip",
        "sat",
        "sim",
        "atlas",
        "cluster",
        "pandas",
        "fast",
    }
    assert set(found["extras"]) == extras
    broken = [probe.ProbeResult("CP-SAT (ortools)", False, "wrong optimum 2")]
    asked: list[str] = []
    monkeypatch.setattr(probe, "probe_solvers", lambda names: asked.extend(names) or broken)

    def version(package: str) -> str:
        raise importlib.metadata.PackageNotFoundError(package)

    monkeypatch.setattr("importlib.metadata.version", version)
    status, out, _ = cli("doctor")
    assert status == 1 and "wrong optimum 2" in out and "pip install 'knotopt[viz]'" in out
    assert len(asked) == 3 and not any("SCIP" in name or "pysat" in name for name in asked)
