"""Figures whose names a command chooses, in the format asked for."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.helpers.command_line import Cli


@pytest.mark.slow
def test_figures_of_table1_as_pdf(cli: Cli, tmp_path: Path) -> None:
    status, out, _ = cli("table1", "--out", tmp_path, "--format", "pdf")
    figures = list((tmp_path / "figures").iterdir())
    assert status == 0 and len(figures) == 30
    assert all(path.suffix == ".pdf" and path.read_bytes()[:4] == b"%PDF" for path in figures)
    assert out.count(".pdf") == 30 and ".png" not in out


def test_a_format_that_there_is_not(cli: Cli, tmp_path: Path) -> None:
    status, _, err = cli("table1", "--out", tmp_path, "--format", "gif")
    assert status == 2 and "gif" in err and not list(tmp_path.iterdir())
