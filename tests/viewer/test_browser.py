"""When the tests in a browser are skipped, and when they fail."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

from tests.helpers.chromium import NAMES

ROOT = Path(__file__).parents[2]
IN_A_BROWSER = "tests/viewer/test_page.py::test_mouse_and_keys_turn_the_scene"


def outcome(programs: Path) -> tuple[int, str]:
    """Exit status and words of a test in a browser, where only these programs are installed."""
    places = {"PATH": str(programs), "PLAYWRIGHT_BROWSERS_PATH": str(programs)}
    run = subprocess.run(
        [sys.executable, "-m", "pytest", "-rA", "-p", "no:cacheprovider", IN_A_BROWSER],
        cwd=ROOT,
        env={**os.environ, **places, "PYTEST_ADDOPTS": ""},
        capture_output=True,
        text=True,
        check=False,
    )
    return run.returncode, run.stdout


def test_without_a_chromium_they_are_skipped(tmp_path: Path) -> None:
    status, out = outcome(tmp_path)
    assert status == 0, out
    assert "1 skipped" in out and "no Chromium is installed" in out


@pytest.mark.parametrize("name", [NAMES[0], NAMES[-1]])
def test_with_a_chromium_that_does_not_start_they_fail(tmp_path: Path, name: str) -> None:
    broken = tmp_path / name
    broken.write_text("#!/bin/sh\nexit 1\n")
    broken.chmod(0o755)
    status, out = outcome(tmp_path)
    assert status == 1, out
    assert "1 error" in out and f"the Chromium at {broken} does not start" in out
