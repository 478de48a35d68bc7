"""`knotopt atlas`: a run that was interrupted or killed goes on; wrong input is said in words."""

from __future__ import annotations

import json
import os
import signal
import sys
from pathlib import Path

import pytest

from knotopt.atlas.schema import File
from knotopt.atlas.store import read_rows
from knotopt.reading.knot import read_knot
from tests.helpers.atlas_process import ended, parts, same_results, start, wait_for_parts
from tests.helpers.command_line import Cli

SMALL = ["3_1", "4_1"]
NAMES = [
    "3_1",
    "4_1",
    *(f"{n}_{k}" for n, count in ((5, 2), (6, 3), (7, 7)) for k in range(1, count + 1)),
]


def test_killed_and_interrupted_runs_end_like_others(tmp_path: Path) -> None:
    whole, broken = tmp_path / "whole", tmp_path / "broken"
    status, output, errors = ended(whole, start(whole, NAMES, "--jobs", 1, "--check", 0))
    assert (status, errors) == (0, "")
    assert "rows, one a knot and cut   112" in output

    process = start(broken, NAMES, "--jobs", 1, "--check", 0, pauses=True)
    wait_for_parts(broken, 2, process)
    process.send_signal(signal.SIGKILL)
    assert ended(broken, process) == (-signal.SIGKILL, "", "")
    killed = parts(broken)
    assert killed >= 2
    assert not (broken / File.ATLAS).exists()

    process = start(broken, NAMES, "--jobs", 1, "--check", 0, pauses=True)
    wait_for_parts(broken, killed + 2, process)
    process.send_signal(signal.SIGINT)
    status, output, errors = ended(broken, process)
    assert (status, output) == (130, "")
    done = parts(broken)
    assert errors == (
        f"knotopt: interrupted with {done} of 14 knots measured; "
        "the same command goes on from there\n"
    )
    assert killed + 2 <= done < 14

    status, _, errors = ended(broken, start(broken, NAMES, "--jobs", 1, "--check", 0))
    assert (status, errors) == (0, "")
    assert same_results(broken, whole)
    assert read_rows(broken, File.TIMES).num_rows == 112


@pytest.mark.slow
@pytest.mark.parametrize("how", [signal.SIGKILL, signal.SIGINT])
def test_with_worker_processes(tmp_path: Path, how: signal.Signals) -> None:
    whole, broken = tmp_path / "whole", tmp_path / "broken"
    assert ended(whole, start(whole, NAMES, "--jobs", 1))[0] == 0
    process = start(broken, NAMES, "--jobs", 2, pauses=True)
    wait_for_parts(broken, 2, process)
    if how is signal.SIGINT:
        os.killpg(process.pid, how)  # as a terminal does: workers hear it too
    else:
        process.send_signal(how)
    assert ended(broken, process)[0] == (130 if how is signal.SIGINT else -how)
    assert not (broken / File.ATLAS).exists()
    assert ended(broken, start(broken, NAMES, "--jobs", 2))[0] == 0
    assert same_results(broken, whole)


def test_summary(cli: Cli, tmp_path: Path) -> None:
    status, output, errors = cli("atlas", tmp_path / "run", *SMALL, "--jobs", 1, "--check", 1)
    assert (status, errors) == (0, "")
    lines = dict(line.rsplit("  ", 1) for line in output.splitlines()[:-1])
    facts = {name.strip(): value.strip() for name, value in lines.items()}
    assert facts["robots: baseline"] == "11.00"
    assert facts["smallest span"] == "none"
    assert facts["checked by definition"] == "16 rows, 0 wrong"
    assert output.splitlines()[-1] == f"written: {tmp_path / 'run' / File.ATLAS}"
    assert cli("atlas", tmp_path / "run", *SMALL, "--jobs", 2, "--check", 1)[1] == output


def test_grids_of_a_folder(cli: Cli, tmp_path: Path) -> None:
    marks = [list(mark) for mark in read_knot("T(2,5)").diagram.marks]
    (tmp_path / "mine.json").write_text(json.dumps({"grid": marks}))
    status, _, errors = cli("atlas", tmp_path / "run", "--grids", tmp_path, "--jobs", 1, "--r", 1)
    assert (status, errors) == (0, "")
    table = read_rows(tmp_path / "run", File.ATLAS)
    assert table["knot"].to_pylist() == ["mine.json"] * 8
    assert table["crossing_number"].to_pylist() == [None] * 8
    assert json.loads(table.schema.metadata[b"knotopt"])["settings"]["openness"] == "1"


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["3_1", "8_22"], "knotopt: no knot is named '8_22'; KnotInfo has 8_1 to 8_21"),
        (["3_1", "--catalogue"], "give one of: knots, --catalogue, --knotinfo, --grids"),
        (["--grids", "nowhere"], "knotopt: cannot read nowhere: No such file or directory"),
        (["3_1", "--r", "2"], "knotopt: the openness r must lie in (0, 1] grid steps, not 2.0"),
        (["3_1", "--jobs", "0"], "--jobs"),
        (["3_1", "--seed", "-1"], "--seed"),
        (["3_1", "--jobs", "2", "--scheduler", "tcp://x"], "give --jobs or --scheduler"),
        (["3_1", "--scheduler", "nonsense"], "knotopt: no Dask scheduler answers at nonsense"),
    ],
)
def test_wrong_input(cli: Cli, tmp_path: Path, arguments: list[str], words: str) -> None:
    folder = tmp_path / "run"
    status, output, errors = cli("atlas", folder, *arguments)
    assert status in (1, 2)
    assert output == ""
    assert words in " ".join(errors.replace("│", "").split())
    assert not (folder / File.ATLAS).exists()


def test_existing_results_are_untouched(cli: Cli, tmp_path: Path) -> None:
    folder = tmp_path / "run"
    cli("atlas", folder, *SMALL, "--jobs", 1)
    before = {path: path.read_bytes() for path in folder.iterdir()}
    for arguments, words in (
        (["3_1"], "was begun with another list, of 2 knots"),
        ([*SMALL, "--span"], "was begun with span = False, not True"),
        ([*SMALL, "--seed", 1], "was begun with seed = 0, not 1"),
        ([*SMALL, "nothing"], "no knot is named 'nothing'"),
    ):
        status, _, errors = cli("atlas", folder, *arguments, "--jobs", 1)
        assert status == 1
        assert words in errors
        assert {path: path.read_bytes() for path in folder.iterdir()} == before


def test_contradictions_are_said(cli: Cli, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    from knotopt.atlas import measure

    monkeypatch.setattr(measure, "agrees_with_definition", lambda *_: False)
    status, output, errors = cli("atlas", tmp_path / "run", "3_1", "--jobs", 1, "--check", 1)
    assert status == 1
    assert "8 rows, 8 wrong" in output
    assert "8 rows of " in errors
    assert "contradict the definitions" in errors


def test_missing_extra(cli: Cli, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    for module in ("knotopt.atlas.store", "knotopt.atlas.run"):
        monkeypatch.delitem(sys.modules, module, raising=False)
    monkeypatch.setitem(sys.modules, "pyarrow", None)
    status, _, errors = cli("atlas", tmp_path / "run", "3_1")
    assert status == 1
    assert errors.startswith("knotopt: an atlas needs pyarrow, which is not installed; install it")
    assert "pip install 'knotopt[atlas]'" in errors
    assert not (tmp_path / "run").exists()
