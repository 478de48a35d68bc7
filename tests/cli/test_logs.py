"""What commands log: to the error stream, to a file, to a line of their own."""

from __future__ import annotations

import logging
import re
from pathlib import Path

import pytest

from knotopt.cli.logs import LOGGER, logging_to, telling
from tests.helpers.command_line import Cli

library = logging.getLogger("knotopt.somewhere")


def test_nothing_is_logged_unless_asked_for(cli: Cli) -> None:
    status, _, err = cli("lcf", "3", "--json")
    assert (status, err) == (0, "")
    assert not LOGGER.handlers and LOGGER.level == logging.NOTSET


@pytest.mark.parametrize("arguments", [("-v", "check"), ("check", "-v")])
def test_verbose_before_and_after_the_command(
    cli: Cli, arguments: tuple[str, ...], tmp_path: Path
) -> None:
    missing = tmp_path / "none.jsonl"
    status, out, err = cli(*arguments, missing)
    assert (status, out) == (1, "")
    first, last, sentence = err.splitlines()
    if arguments[0] == "check":
        assert first.endswith(f"check -v {missing}")
    assert last.startswith("ended by CertificateError: cannot read")
    assert sentence.startswith("knotopt: cannot read")
    assert not LOGGER.handlers


def test_a_log_says_where_the_time_went_and_is_appended_to(cli: Cli, tmp_path: Path) -> None:
    log = tmp_path / "run.log"
    for _ in range(2):
        status, _, err = cli("solve", "3", "--formulation", "opening", "--cut", "L+", "--log", log)
        assert (status, err) == (0, "")
    lines = log.read_text().splitlines()
    assert len(lines) == 6 and lines[:3] != lines[3:]
    words = (r"knotopt \S+: solve 3", r"cuts: 1 of 1 \(L\+\) in [\d.]+ s", r"done after [\d.]+ s")
    for line, said in zip(lines, words * 2, strict=True):
        assert re.match(r"\d{4}-\d\d-\d\d \d\d:\d\d:\d\d,\d{3} INFO knotopt[.\w]*: " + said, line)


def test_every_knot_of_an_atlas_is_logged(cli: Cli, tmp_path: Path) -> None:
    log = tmp_path / "run.log"
    for knots in (("3_1", "4_1"), ("3_1", "4_1")):
        assert cli("atlas", tmp_path / "run", *knots, "--jobs", 1, "--log", log)[0] == 0
    text = log.read_text()
    for number, name in enumerate(("3_1", "4_1"), 1):
        assert len(re.findall(rf"knot {name} measured in [\d.]+ s: {number} of 2", text)) == 1
    assert "0 of 2 knots are measured already" in text
    assert "2 of 2 knots are measured already" in text


def test_a_log_says_how_it_ended(cli: Cli, tmp_path: Path) -> None:
    log = tmp_path / "run.log"
    assert (
        cli("solve", "3", "--formulation", "opening", "--cut", "L+", "--reach", 0.1, "--log", log)[
            0
        ]
        == 1
    )
    assert cli("solve", "3", "--formulation", "opening", "--cut", "nowhere", "--log", log)[0] == 1
    ends = [line.split(": ", 1)[1] for line in log.read_text().splitlines()[-3::2]]
    assert ends[0].startswith("exit status 1 after")
    assert ends[1].startswith("ended by CutError: no cut is named 'nowhere'")


@pytest.mark.parametrize(
    ("place", "words"),
    [("no/run.log", "there is no folder"), ("folder", "Is a directory")],
)
def test_a_log_that_cannot_be_written(cli: Cli, tmp_path: Path, place: str, words: str) -> None:
    (tmp_path / "folder").mkdir()
    status, out, err = cli("lcf", "3", "--log", tmp_path / place)
    assert (status, out) == (1, "")
    assert err.startswith(f"knotopt: cannot write {tmp_path / place}: {words}")
    assert err.count("\n") == 1


def test_twice_verbose_is_in_detail(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    for verbose in (1, 2):
        with logging_to(verbose, tmp_path / f"{verbose}.log"):
            library.info("a set")
            library.debug("a row")
    assert capsys.readouterr().err.split("\n") == ["a set", "a set", "a row", ""]
    assert "a row" not in (tmp_path / "1.log").read_text()
    assert "DEBUG knotopt.somewhere: a row" in (tmp_path / "2.log").read_text()


def test_telling_gives_info_alone_and_only_inside(capsys: pytest.CaptureFixture[str]) -> None:
    told: list[str] = []
    library.info("before")
    with logging_to(2, None), telling(told.append):
        library.debug("in detail")
        library.info("set %d", 1)
        library.warning("amiss")
    with telling(told.append):
        library.info("set 2")
    library.info("after")
    assert told == ["set 1", "set 2"]
    assert capsys.readouterr().err.split("\n") == ["in detail", "set 1", "amiss", ""]
