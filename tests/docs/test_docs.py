"""The documentation: it shows what happens, its steps are right, and it needs no network."""

from __future__ import annotations

import doctest
import os
import re
import shlex
import shutil
import subprocess
import sys
from html.parser import HTMLParser
from pathlib import Path

import pytest

import knotopt
from tests.helpers.command_line import Cli
from tests.helpers.console_blocks import commands, expect_shown

ROOT = Path(__file__).parents[2]
PAGES = sorted((ROOT / "docs").rglob("*.md"))
NOTEBOOKS = sorted((ROOT / "examples").glob("*.ipynb"))
SHOWN = {"atlas": 1, "trefoil": 4}  # pictures in each notebook
TITLED = re.compile(r'^```(\w+) title="([^"]+)"\n(.*?)^```$', re.DOTALL | re.MULTILINE)
BROWSER = ["--no-sandbox", "--disable-gpu", "--disable-background-networking"]


def name(page: Path) -> str:
    return page.relative_to(ROOT / "docs").with_suffix("").as_posix()


@pytest.mark.parametrize("page", [page for page in PAGES if "\n>>> " in page.read_text()], ids=name)
def test_python_on_the_pages(page: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    failed, tried = doctest.testfile(str(page), module_relative=False, encoding="utf-8")
    assert tried and not failed


@pytest.mark.slow
def test_commands_of_the_tutorial(
    cli: Cli, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    told = list(commands(ROOT / "docs/tutorial.md"))
    assert len(told) == 8
    for command, shown in told:
        _, out, _ = cli(*shlex.split(command))
        expect_shown(command, shown, out)
    assert (tmp_path / "trefoil/report.html").exists()


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
            ["formulations/held.py", "knotopt/supports/held.py", "knotopt/verify/held.py"],
        ),
        (
            "solver",
            [
                "formulations/backends/__init__.py",
                "tests/supports/test_minimal.py::test_every_solver_gives_the_same_canonical_set",
                "tests/formulations/test_instances.py::test_all_solvers_find_the_optimum",
                "tests/supports/test_solving.py::test_instances_that_need_no_solver",
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


class _Loaded(HTMLParser):
    """What a page loads: everything it names but what its links lead to."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.targets: list[str] = []
        self.feed(text)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        for key, value in attrs:
            if key in ("src", "data", "poster") or (key == "href" and tag != "a"):
                self.targets.append(value or "")


@pytest.mark.slow
def test_the_site(tmp_path: Path) -> None:
    """Built once, with every warning an error; then looked at from disk, without a network."""
    done = subprocess.run(
        [sys.executable, "-m", "mkdocs", "build", "--strict", "--site-dir", str(tmp_path)],
        cwd=ROOT,
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stdout + done.stderr
    built = {page.relative_to(tmp_path).with_suffix("").as_posix() for page in _html(tmp_path)}
    assert built >= {*map(name, PAGES), "reference/public"}
    text = (tmp_path / "reference/public.html").read_text("utf-8")
    headings = re.findall(r"<h3.*?</h3>", text, re.DOTALL)
    shown = {word for heading in headings for word in re.findall(r"knotopt\.(\w+)\s*<", heading)}
    assert shown == set(knotopt.__all__)
    _needs_no_network(tmp_path)
    _is_searched(tmp_path)


def _html(site: Path) -> list[Path]:
    return [page for page in site.rglob("*.html") if page.name != "404.html"]


def _needs_no_network(site: Path) -> None:
    """What pages and style sheets load lies in the site."""
    for page in _html(site):
        for target in _Loaded(page.read_text("utf-8")).targets:
            there = target.startswith("data:") or (page.parent / target.split("?")[0]).exists()
            assert there, f"{page.name} loads {target}"
    for sheet in site.rglob("*.css"):
        assert not re.search(r"(url\(|@import)\s*[\"']?(https?:)?//", sheet.read_text("utf-8")), (
            sheet
        )


def _is_searched(site: Path) -> None:
    """In a browser that is offline; no page logs an error, or loads anything from elsewhere."""
    playwright = pytest.importorskip("playwright.sync_api")
    chromium = shutil.which("chromium") or shutil.which("google-chrome")
    if chromium is None:
        pytest.skip("no Chromium is installed: the site's search was not tried")
    complaints: list[str] = []
    asked: list[str] = []
    with playwright.sync_playwright() as started:
        browser = started.chromium.launch(executable_path=chromium, args=BROWSER)
        page = browser.new_context(offline=True).new_page()
        page.on("console", lambda message: complaints.append(message.text))
        page.on("request", lambda request: asked.append(request.url))
        page.on("pageerror", lambda error: complaints.append(str(error)))
        for each in _html(site):
            page.goto(each.as_uri())
        page.goto((site / "index.html").as_uri())
        page.click("input[name=query]")
        page.wait_for_function("typeof __index === 'object'")
        page.keyboard.type("minimal supports", delay=50)
        page.wait_for_selector(".md-search-result__link", state="attached", timeout=60_000)
        found = page.eval_on_selector_all(
            ".md-search-result__link", "links => links.map(link => link.href)"
        )
        browser.close()
    assert any("reference/public.html#knotopt.supports.minimal" in link for link in found)
    assert not complaints
    assert not [url for url in asked if not url.startswith(("file:", "data:", "blob:"))]


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
