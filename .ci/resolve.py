#!/usr/bin/env python3
"""Prove that every Python named in pyproject.toml finds wheels of all that a user installs.

Nothing is installed: pip resolves the dependencies and the extra `all` for a Python that need not
be here. A package without a wheel for it is named, and the exit status is 1.
"""

from __future__ import annotations

import re
import subprocess
import sys
import tempfile
import tomllib
from pathlib import Path

PROJECT = tomllib.loads((Path(__file__).parent.parent / "pyproject.toml").read_text())["project"]
PYTHON = re.compile(r"Programming Language :: Python :: (3\.\d+)")


def requirements(extra: str) -> list[str]:
    """Requirements of an extra, those of the extras it names in their places."""
    found = []
    for requirement in PROJECT["optional-dependencies"][extra]:
        own = re.fullmatch(rf"{PROJECT['name']}\[(.+)\]", requirement)
        found += (
            [each for name in own[1].split(",") for each in requirements(name)]
            if own
            else [requirement]
        )
    return found


def resolve(python: str, wanted: list[str]) -> str:
    """What pip says against it; empty if it can all be installed from wheels."""
    with tempfile.TemporaryDirectory() as target:
        options = ["--dry-run", "--ignore-installed", "--quiet", "--only-binary=:all:"]
        options += ["--python-version", python, "--target", target]
        run = subprocess.run(
            [sys.executable, "-m", "pip", "install", *options, *wanted],
            capture_output=True,
            text=True,
            check=False,
        )
    return run.stderr.strip() or f"pip ended with {run.returncode}" if run.returncode else ""


def main() -> None:
    wanted = [*PROJECT["dependencies"], *requirements("all")]
    pythons = [match[1] for line in PROJECT["classifiers"] if (match := PYTHON.fullmatch(line))]
    failed = False
    for python in pythons:
        objection = resolve(python, wanted)
        failed |= bool(objection)
        print(f"Python {python}: {objection or f'wheels of all {len(wanted)} requirements'}")
    sys.exit(failed)


if __name__ == "__main__":
    main()
