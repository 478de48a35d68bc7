"""What is said before work begins: of folders, extras and tables that are not there."""

from __future__ import annotations

import importlib
from pathlib import Path

import pytest

from tests.helpers.command_line import Cli


def test_knots_beyond_the_catalogue_are_looked_up(cli: Cli) -> None:
    assert len(cli.json("knots", "--crossings", 12)) == 2176
    status, out, _ = cli("knots", "--crossings", 14)
    assert status == 0 and "KnotInfo's table ends at 13 crossings" in out


def test_knots_beyond_the_catalogue_need_an_extra(cli: Cli) -> None:
    from knotopt.catalogue.knotinfo import knotinfo_knots

    knotinfo_knots.cache_clear()
    cli.monkeypatch.setattr("importlib.util.find_spec", lambda _: None)
    status, out, err = cli("knots", "--crossings", 12)
    assert status == 1 and not out
    assert "needs database_knotinfo, which is not installed" in err
    assert "pip install '.[knotinfo]' in a clone, elsewhere pip install 'knotopt[knotinfo]'" in err


@pytest.mark.parametrize("command", ["show", "lcf", "solve", "path", "topology"])
@pytest.mark.parametrize(
    ("picture", "words"),
    [
        ("no_folder/a.png", "cannot write no_folder/a.png: there is no folder no_folder"),
        ("folder.png", "cannot write folder.png: that is a folder"),
        ("file/a.png", "cannot write file/a.png: "),
    ],
)
def test_where_no_picture_can_be_is_said_before_work(
    cli: Cli, tmp_path: Path, command: str, picture: str, words: str
) -> None:
    for module in ("knotopt.api", "knotopt.atlas.knot_list", "knotopt.reading.goal"):
        importlib.import_module(module)  # before the reader that it takes is replaced

    def work(*_: object, **__: object) -> None:
        pytest.fail("the knot is read")

    cli.monkeypatch.chdir(tmp_path)
    cli.monkeypatch.setattr("knotopt.reading.knot.read_knot", work)
    cli.monkeypatch.setattr("knotopt.reading.goal.read_goal", work)
    (tmp_path / "folder.png").mkdir()
    (tmp_path / "file").write_text("")
    status, out, err = cli(command, "3", "--plot", picture)
    assert status == 1 and not out and words in err


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (("topology", "3_1", "--plans", "99999999999999999999"), "'--plans'"),
        (("atlas", "run", "3", "--scheduler", ""), "is an address such as tcp://host:8786, not ''"),
        (("solve", "3", "--threads", "99999999999999999999"), "threads is at most 1024"),
        (
            ("solve", "3", "--formulation", "opening", "--max-robots", "99999999999999999999"),
            "at most 1000000 robots",
        ),
        (("path", "3", "--slope", "1e300"), "slope is at most 1000, not 1e+300"),
        (("prove", "3", "--out", ""), "cannot write .: that is a folder"),
    ],
)
def test_a_sentence_for_what_is_beyond_all_measure(
    cli: Cli, tmp_path: Path, arguments: tuple[str, ...], words: str
) -> None:
    cli.monkeypatch.chdir(tmp_path)
    status, out, err = cli(*arguments)
    assert status in (1, 2) and not out
    assert words.replace(" ", "") in "".join(err.replace("│", " ").split())
