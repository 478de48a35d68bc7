"""Property tests draw the same examples every time, so that a failure on one machine is one on all.

`pytest --hypothesis-profile=explore` draws new ones.
"""

from __future__ import annotations

import json
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pytest
from hypothesis import settings

from knotopt.cli import app

if TYPE_CHECKING:
    from knotopt.atlas.measure import KnotResult

settings.register_profile("fixed", derandomize=True, deadline=None)
settings.register_profile("explore", deadline=None, max_examples=1000, print_blob=True)
settings.load_profile("fixed")


class Cli:
    """Runs the command in this process: exit status, output, errors."""

    def __init__(self, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch) -> None:
        self.capsys, self.monkeypatch = capsys, monkeypatch

    def __call__(self, *arguments: object) -> tuple[int, str, str]:
        self.monkeypatch.setattr(sys, "argv", ["knotopt", *map(str, arguments)])
        with pytest.raises(SystemExit) as stop:
            app.main()
        captured = self.capsys.readouterr()
        if isinstance(stop.value.code, str):  # what Python then prints and returns
            return 1, captured.out, captured.err + stop.value.code + "\n"
        return int(stop.value.code or 0), captured.out, captured.err

    def json(self, *arguments: object) -> Any:
        status, out, err = self(*arguments, "--json")
        assert (status, err) == (0, "")
        return json.loads(out)


@pytest.fixture
def cli(capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch) -> Cli:
    return Cli(capsys, monkeypatch)


@pytest.fixture
def results() -> dict[int, KnotResult]:
    """Of the knots of the small atlas, by number."""
    from tests.small_atlas import measured

    return measured()


@pytest.fixture
def whole(tmp_path: Path) -> Path:
    """The folder of a run of the small atlas."""
    from tests.small_atlas import whole_run

    return whole_run(tmp_path)


@pytest.fixture
def half(tmp_path: Path) -> Path:
    """The folder of a run of the small atlas that was interrupted."""
    from tests.small_atlas import half_run

    return half_run(tmp_path)
