"""The documentation: it shows what happens, its steps are right, and it needs no network."""

from __future__ import annotations

import doctest
import os
import re
import shlex
import shutil
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

from tests.helpers.command_line import Cli
from tests.helpers.console_blocks import commands, expect_shown

ROOT = Path(__file__).parents[2]
PAGES = sorted((ROOT / "docs").rglob("*.md"))
NOTEBOOKS = sorted((ROOT / "examples").glob("*.ipynb"))
SHOWN = {"atlas": 1, "trefoil": 4}  # pictures in each notebook
TITLED = re.compile(r'^```(\w+) title="([^"]+)"\n(.*?)^```$', re.DOTALL | re.MULTILINE)


def name(page: Path) -> str:
    return page.relative_to(ROOT / "docs").with_suffix("").as_posix()


@pytest.mark.parametrize("page", [page for page in PAGES if "\n>>> " in page.read_text()], ids=name)
def test_python_on_the_pages(page: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    failed, tried = doctest.testfile(str(page), module_relative=False, encoding="utf-8")
    assert tried and not failed


def shown_commands() -> list[Any]:
    """Each command of the README and the pages, and what is shown under it.

    How-tos change the package first. What is simulated is slow.
    """
    pages = [page for page in (ROOT / "README.md", *PAGES) if page.parent.name != "howto"]
    return [
        pytest.param(
            *(command, shown),
            marks=[pytest.mark.slow] if "--sim" in command else [],
            id=f"{page.stem}: {command}",
        )
        for page in pages
        for command, shown in commands(page)
    ]


@pytest.mark.parametrize(("command", "shown"), shown_commands())
def test_commands_print_what_is_shown(
    cli: Cli, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, command: str, shown: str
) -> None:
    monkeypatch.chdir(tmp_path)
    arguments = shlex.split(command)
    _, out, err = cli(*arguments)
    expect_shown(command, shown, out)
    assert not err
    for option in ("--out", "--plot"):
        if option in arguments:
            assert Path(arguments[arguments.index(option) + 1]).exists()


def test_commands_are_found() -> None:
    assert len(list(commands(ROOT / "README.md"))) >= 3
    assert len(list(commands(ROOT / "docs/tutorial.md"))) == 8


def _scratch(folder: Path, page: Path) -> dict[str, str]:
    """A copy of the packages with a page's steps made in it, and the environment to use it."""
    for package in ("knotopt", "formulations", "tests"):
        shutil.copytree(
            ROOT / package, folder / package, ignore=shutil.ignore_patterns("__pycache__")
        )
    shutil.copy(ROOT / "pyproject.toml", folder)
    for language, path, text in TITLED.findall(page.read_text()):
        file = folder / path
        if language == "diff":
            content = file.read_text()
            for hunk in re.split(r"^@@\n", text, flags=re.MULTILINE):
                lines = hunk.splitlines(keepends=True)
                old = "".join(line[1:] or "\n" for line in lines if line[0] != "+")
                new = "".join(line[1:] or "\n" for line in lines if line[0] != "-")
                assert content.count(old) == 1, f"{path} has not, once:\n{old}"
                content = content.replace(old, new)
            file.write_text(content)
        else:
            assert not file.exists()
            file.write_text(text)
    own = {"PYTHONPATH": str(folder), "PYTHONIOENCODING": "utf-8", "PYTEST_ADDOPTS": ""}
    return {**os.environ, **own}


@pytest.mark.slow
@pytest.mark.parametrize(
    ("page", "tests"),
    [
        (
            "formulation",
            [
                "formulations/held.py",
                "knotopt/supports/held.py",
                "knotopt/verify/held.py",
                "tests/supports/test_held.py",
                "tests/supports/test_formulations.py",
                "tests/test_architecture.py::test_every_import_is_in_the_table",
            ],
        ),
        (
            "solver",
            [
                "formulations/backends/__init__.py",
                "tests/supports/test_minimal.py::test_every_solver_gives_the_same_canonical_set",
                "tests/formulations/test_instances.py::test_all_solvers_find_the_optimum",
                "tests/formulations/test_backends.py::test_instances_that_need_no_solver",
            ],
        ),
        ("family", ["knotopt/diagram/families.py", "tests/diagram/test_twist.py"]),
    ],
)
def test_steps_of_a_how_to(page: str, tests: list[str], tmp_path: Path) -> None:
    path = ROOT / f"docs/howto/{page}.md"
    environment = _scratch(tmp_path, path)

    def run(*arguments: str) -> str:
        done = subprocess.run(
            [sys.executable, "-m", *arguments],
            cwd=tmp_path,
            env=environment,
            capture_output=True,
            text=True,
            check=False,
        )
        assert done.returncode == 0, done.stdout + done.stderr
        return done.stdout

    for command, shown in commands(path):
        expect_shown(command, shown, run("knotopt", *shlex.split(command)))
    assert " passed" in run("pytest", "-q", "-p", "no:cacheprovider", *tests)
    added = [file for language, file, _ in TITLED.findall(path.read_text()) if language != "diff"]
    changed = [file for language, file, _ in TITLED.findall(path.read_text()) if language == "diff"]
    for tool in (("check", "--no-cache"), ("format", "--check", "--no-cache")):
        if shutil.which("ruff"):  # of the extra `dev`
            files = [file for file in (*added, *changed) if file.endswith(".py")]
            subprocess.run(["ruff", *tool, *files], cwd=tmp_path, check=True)


@pytest.mark.slow
@pytest.mark.parametrize("notebook", NOTEBOOKS, ids=[each.stem for each in NOTEBOOKS])
def test_notebooks_run(notebook: Path, tmp_path: Path) -> None:
    import nbclient
    import nbformat

    content = nbformat.read(notebook, as_version=4)
    assert not any(cell.get("outputs") or cell.get("execution_count") for cell in content.cells)
    here = tmp_path / "examples"
    here.mkdir()
    shutil.copytree(ROOT / "paper_results/atlas", tmp_path / "paper_results/atlas")
    nbclient.NotebookClient(
        content, timeout=60, resources={"metadata": {"path": str(here)}}
    ).execute()
    pictures = [
        output
        for cell in content.cells
        for output in cell.get("outputs", [])
        if "image/png" in output.get("data", {})
    ]
    assert len(pictures) == SHOWN[notebook.stem]
    assert not list(here.iterdir())
