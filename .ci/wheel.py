#!/usr/bin/env python3
"""Build the wheel, check what is in it, and use it where the tree is out of sight.

It is installed into a fresh environment of the Python that runs this, at first without extras, and
of every other Python named in pyproject.toml that is here and starts.
"""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import sys
import tempfile
import tomllib
from collections.abc import Iterator
from pathlib import Path
from zipfile import ZipFile

ROOT = Path(__file__).parent.parent
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]
PACKAGES = ("knotopt", "formulations")
CORE = (
    "show 3_1",
    "lcf 7_6",
    "solve 3_1 --formulation span",
    "path 3_1",
    "table1",
    "doctor",
)
EXTRAS = (
    "show 8_19 --plot 8_19.pdf",
    "fly 3_1 --out trefoil",
    "prove 3_1 --out 3_1.jsonl",
    "check 3_1.jsonl",
    "doctor",
)
EVERY_MODULE = """
import importlib, pkgutil, sys
for name in sys.argv[1:]:
    package = importlib.import_module(name)
    for module in pkgutil.walk_packages(package.__path__, f"{name}."):
        importlib.import_module(module.name)
    print(f"all of {name} can be imported")
"""


def run(*command: str | Path, **options: object) -> None:
    """Run a command; end with its status where it fails."""
    print("+", *command, flush=True)
    status = subprocess.run(command, check=False, **options).returncode  # type: ignore[call-overload]
    if status:
        sys.exit(f"{command[0]} ended with {status}")


def build(folder: Path) -> Path:
    """The wheel of the tracked files, built apart from what else lies in the tree."""
    tree = folder / "tree"
    for name in tracked("."):
        (tree / name).parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(ROOT / name, tree / name)
    pip = (sys.executable, "-m", "pip", "wheel", "--quiet", "--no-deps", "--wheel-dir", folder)
    run(*pip, tree)
    (wheel,) = folder.glob("*.whl")
    return wheel


def tracked(*folders: str) -> set[str]:
    command = ["git", "ls-files", "-z", "--cached", "--others", "--exclude-standard", *folders]
    listed = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=True).stdout
    return {name for name in listed.split("\0") if name and (ROOT / name).is_file()}


def check_content(wheel: Path) -> None:
    """Every file of the packages but their READMEs, and nothing else but metadata."""
    with ZipFile(wheel) as archive:
        found = {name for name in archive.namelist() if ".dist-info/" not in name}
    wanted = {name for name in tracked(*PACKAGES) if not name.endswith(".md")}
    for name in sorted(wanted - found):
        print(f"missing in the wheel: {name}")
    for name in sorted(found - wanted):
        print(f"should not be in the wheel: {name}")
    if found != wanted:
        sys.exit(1)
    print(f"{wheel.name}: {len(found)} files, as in the tree")


def others() -> Iterator[str]:
    """Paths of the other Pythons that the project names and that start here."""
    for classifier in PROJECT["classifiers"]:
        named = re.fullmatch(r"Programming Language :: Python :: (3\.(\d+))", classifier)
        if named is None or int(named[2]) == sys.version_info.minor:
            continue
        path = shutil.which(f"python{named[1]}")
        if shutil.which("pyenv"):  # whose commands on the path start its chosen versions only
            command = ["pyenv", "prefix", named[1]]
            prefix = subprocess.run(command, capture_output=True, text=True, check=False).stdout
            path = f"{prefix.strip()}/bin/python3" if prefix else path
        if path and starts(path):
            yield path
        else:
            print(f"Python {named[1]} is not here")


def starts(python: str) -> bool:
    return subprocess.run([python, "-c", ""], capture_output=True, check=False).returncode == 0


def use(python: str, wheel: Path, folder: Path, *, bare: bool) -> None:
    """Install the wheel into a new environment and run its commands there."""
    venv = folder / "venv"
    run(python, "-m", "venv", "--clear", venv)
    elsewhere = tempfile.mkdtemp(dir=folder)
    environment = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}

    def there(program: str, *arguments: str) -> None:
        output = None if program == "python" else subprocess.DEVNULL
        run(venv / "bin" / program, *arguments, cwd=elsewhere, env=environment, stdout=output)

    pip = (venv / "bin/pip", "install", "--quiet")
    if bare:
        run(*pip, wheel)
        for line in CORE:
            there("knotopt", *line.split())
    run(*pip, f"{wheel}[all]")
    there("python", "-c", EVERY_MODULE, *PACKAGES)
    for line in EXTRAS:
        there("knotopt", *line.split())


def main() -> None:
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        wheel = build(folder)
        check_content(wheel)
        use(sys.executable, wheel, folder, bare=True)
        for python in others():
            use(python, wheel, folder, bare=False)


if __name__ == "__main__":
    main()
