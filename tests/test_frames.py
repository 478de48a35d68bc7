"""Tables as data frames of pandas."""

from __future__ import annotations

from pathlib import Path

import pytest

import knotopt
from knotopt.errors import MissingExtraError
from tests.helpers.command_line import Cli


def test_the_catalogue() -> None:
    frame = knotopt.shipped_knots().to_dataframe()
    assert len(frame) == 249 and frame.set_index("name").arc_index["8_19"] == 7
    assert repr(knotopt.shipped_knots()) == "<KnotTable: 249 knots>"


def test_a_comparison() -> None:
    rows = [knotopt.compare(name, knotopt.read(name).diagram) for name in ("3_1", "4_1")]
    frame = knotopt.comparison_table(rows).to_dataframe()
    assert frame.knot.tolist() == ["3_1", "4_1"]
    assert frame.robots_before.tolist() == [10, 12]
    assert "lcf_nlp_length" in frame.columns


def test_an_atlas(cli: Cli, tmp_path: Path) -> None:
    from knotopt.atlas.report.results import read_results

    status, _, _ = cli("atlas", tmp_path / "run", "3_1", "--jobs", "1")
    frame = read_results(tmp_path / "run").to_dataframe()
    assert status == 0 and len(frame) == 8 and set(frame.knot) == {"3_1"}


def test_without_pandas(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("importlib.util.find_spec", lambda _: None)
    with pytest.raises(MissingExtraError, match=r"data frame needs pandas.*'\.\[pandas\]'"):
        knotopt.shipped_knots().to_dataframe()
