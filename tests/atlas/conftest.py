"""A small atlas at hand: its results, and runs of it that are whole or were interrupted."""

from __future__ import annotations

from pathlib import Path

import pytest

from knotopt.atlas.measure import KnotResult, measure_knot
from knotopt.atlas.run import run_atlas
from tests.helpers.small_atlas import LIST, SETTINGS, Replay


@pytest.fixture(scope="session")
def measured() -> dict[int, KnotResult]:
    """Results of each knot of the list, by its number."""
    return {knot.number: measure_knot(knot, SETTINGS) for knot in LIST}


@pytest.fixture
def whole(tmp_path: Path, measured: dict[int, KnotResult]) -> Path:
    """The folder of a run of the small atlas."""
    run_atlas(tmp_path / "whole", LIST, SETTINGS, Replay(measured))
    return tmp_path / "whole"


@pytest.fixture
def half(tmp_path: Path, measured: dict[int, KnotResult]) -> Path:
    """The folder of a run of the small atlas that was interrupted."""
    with pytest.raises(KeyboardInterrupt):
        run_atlas(tmp_path / "half", LIST, SETTINGS, Replay(measured, 2, KeyboardInterrupt()))
    return tmp_path / "half"
