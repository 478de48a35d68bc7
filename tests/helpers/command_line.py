"""The command line, run in the process of the test."""

from __future__ import annotations

import json
import sys
from typing import Any

import pytest

from knotopt.cli import app


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
