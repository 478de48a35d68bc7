"""The options by which a KNOT is read, and what is said of a reading that was a choice."""

from __future__ import annotations

import io
import json
import sys
from pathlib import Path

import pytest

from knotopt.cli.app import COMMANDS
from tests.helpers.command_line import Cli

ARCS = "[[5,2],[1,3],[2,4],[3,5],[4,1]]"
PD = "PD[X[1,5,2,4], X[3,1,4,6], X[5,3,6,2]]"
TAKING_KNOTS = {
    *("show", "identify", "lcf", "solve", "path", "fly", "topology", "compare", "atlas", "prove"),
}


@pytest.mark.parametrize("command", [*COMMANDS])
def test_every_command_that_takes_a_knot_has_the_options(cli: Cli, command: str) -> None:
    _, out, _ = cli(command, "--help")
    for option in ("--over LINES", "--mirror", "--as FORM"):
        assert (option in out) == (command in TAKING_KNOTS)


def test_show_says_how_it_read(cli: Cli) -> None:
    found = cli.json("show", ARCS)
    assert found["form"] == "arc presentation" and found["writhe"] == -3
    assert found["notes"] == ["columns pass over rows", "pairs are rows, counted upwards"]
    assert cli.json("show", ARCS, "--over", "rows")["writhe"] == 3
    mirrored = cli.json("show", ARCS, "--mirror")
    assert mirrored["writhe"] == 3 and mirrored["notes"][-1] == "mirror image, as asked"
    _, out, err = cli("show", ARCS)
    assert "read as         arc presentation: columns pass over rows; pairs are rows" in out
    assert not err
    assert "read as" not in cli("show", "8_19")[1]


@pytest.mark.parametrize("knot", [ARCS, "DT: [(4,6,2)]", "[[1,1],[1,2],[2,1],[2,2]]"])
def test_other_commands_say_so_on_the_error_stream(cli: Cli, knot: str) -> None:
    status, out, err = cli("lcf", knot, "--json")
    assert status == 0 and json.loads(out)
    assert err.startswith("read as ") and err.count("\n") == 1
    assert not cli("lcf", knot, "--mirror")[2]


@pytest.mark.parametrize("knot", ["8_19", PD, '{"grid": [[1,1],[1,2],[2,1],[2,2]]}'])
def test_nothing_is_said_where_nothing_is_open(cli: Cli, knot: str) -> None:
    assert not cli("lcf", knot)[2]


def test_mirror_images_have_names(cli: Cli) -> None:
    assert cli.json("show", "8_19", "--mirror")["knot"] == "m8_19"
    assert cli.json("show", "m8_19", "--mirror")["knot"] == "8_19"


@pytest.mark.parametrize("command", ["lcf", "topology"])
def test_standard_input_and_files_of_any_name(
    cli: Cli, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, command: str
) -> None:
    expected = cli(command, PD)[1]
    (tmp_path / "3_1").write_text(PD)
    monkeypatch.chdir(tmp_path)
    assert cli(command, "3_1")[1] == expected.replace("PD code (as given)", "3_1 (file 3_1)")
    monkeypatch.setattr(sys, "stdin", io.TextIOWrapper(io.BytesIO(PD.encode())))
    words = "standard input (standard input)"
    assert cli(command, "-")[1] == expected.replace("PD code (as given)", words)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (("lcf", "3_1", "--over", "left"), "who passes over is 'left', not columns or rows"),
        (("show", "3_1", "--as", "knot"), "no form is named 'knot'; name, matrix"),
        (("topology", PD, "--as", "dt"), "this cannot be read as dt (DT code)"),
        (("solve", "[[0,-1,1],[1,0,-1],[-1,1,2]]"), "entry 2 at column 3, row 1"),
    ],
)
def test_wrong_options(cli: Cli, arguments: tuple[str, ...], message: str) -> None:
    status, out, err = cli(*arguments)
    assert (status, out) == (1, "") and message in err and err.count("\n") == 1
