"""What the pages show that lies elsewhere: pictures, the public names, the example notebooks.

A picture under `drawn/` is made by the command that the gallery shows above it. What lies outside
of `docs/` is linked as in the repository, and lies in the site where `PLACES` says.
"""

from __future__ import annotations

import ast
import os
import re
import shlex
import subprocess
import sys
import tempfile
from collections import defaultdict
from functools import lru_cache
from pathlib import Path

from mkdocs.config.defaults import MkDocsConfig
from mkdocs.exceptions import PluginError
from mkdocs.structure.files import File, Files
from mkdocs.structure.pages import Page

ROOT = Path(__file__).resolve().parents[1]
PLACES = {
    "paper_results/figures/": "figures/",
    "benchmarks/results/": "results/",
    "examples/": "examples/",
    "formulations/README.md": "programs.md",
}
SUBJECTS = {
    "api": "From a knot to its supports and its flight",
    "diagram": "Grid diagrams",
    "catalogue": "Catalogue",
    "cable": "Cables",
    "supports": "Supports",
    "path": "Paths",
    "flight": "Flights",
    "verify": "Checks",
}
OTHERS = "Further names"


def on_files(files: Files, config: MkDocsConfig) -> Files:
    """Add what the pages show to the files of the site."""
    text = "".join(file.content_string for file in files.documentation_pages())
    for path in sorted(set(re.findall(r"\.\./([\w./]+\.png)", text))):
        source = ROOT / path
        if not source.exists():
            raise PluginError(f"a page shows {path}, but there is none")
        files.append(File.generated(config, in_the_site(path), abs_src_path=str(source)))
    gallery = (ROOT / "docs/gallery.md").read_text("utf-8")
    for name, content in drawn(tuple(re.findall(r"^\$ (knotopt .*)$", gallery, re.MULTILINE))):
        files.append(File.generated(config, f"drawn/{name}", content=content))
    files.append(File.generated(config, "reference/public.md", content=public_names()))
    for notebook in sorted((ROOT / "examples").glob("*.ipynb")):
        uri = f"examples/{notebook.name}"
        files.append(File.generated(config, uri, abs_src_path=str(notebook)))
    return files


def on_page_markdown(markdown: str, page: Page, **_: object) -> str:
    """The links of a page out of `docs/` as they lead in the site."""
    up = "../" * page.file.src_uri.count("/")
    outside = rf"\]\({re.escape(up)}\.\./([^)]*)"
    return re.sub(outside, lambda link: f"]({up}{in_the_site(link[1])}", markdown)


def in_the_site(path: str) -> str:
    """Where something of the repository lies in the site."""
    for there, here in PLACES.items():
        if path.startswith(there):
            return here + path.removeprefix(there)
    return f"../{path}"


@lru_cache(maxsize=1)
def drawn(commands: tuple[str, ...]) -> list[tuple[str, bytes]]:
    """What commands write: names relative to where they run, and contents."""
    environment = {**os.environ, "PYTHONPATH": str(ROOT), "PYTHONIOENCODING": "utf-8"}
    with tempfile.TemporaryDirectory() as folder:
        for command in commands:
            done = subprocess.run(
                [sys.executable, "-m", *shlex.split(command)],
                cwd=folder,
                env=environment,
                capture_output=True,
                text=True,
                check=False,
            )
            if done.returncode:
                raise PluginError(f"`{command}` ended with {done.returncode}: {done.stderr}")
        paths = sorted(path for path in Path(folder).rglob("*") if path.is_file())
        return [(path.relative_to(folder).as_posix(), path.read_bytes()) for path in paths]


def public_names() -> str:
    """The page of the public names: those of `__init__.pyi`, by the package they come from."""
    by_subject: dict[str, dict[str, str]] = defaultdict(dict)
    for line in ast.parse((ROOT / "knotopt/__init__.pyi").read_text("utf-8")).body:
        if isinstance(line, ast.ImportFrom):
            module = line.module or ""
            paths = by_subject[SUBJECTS.get(module.partition(".")[0], OTHERS)]
            for alias in line.names:
                paths[alias.asname or alias.name] = f"knotopt.{module}.{alias.name}"
    text = [
        "# Public names",
        "",
        "All are imported as `knotopt.NAME`. What takes or gives coordinates has them as",
        "[column, row], from 1, rows upwards.",
    ]
    for subject in [*SUBJECTS.values(), OTHERS]:
        if paths := by_subject.get(subject, {}):
            text += ["", f"## {subject}"]
        for name, path in sorted(paths.items(), key=lambda entry: entry[0].lower()):
            options = f"{{ heading: knotopt.{name}, toc_label: {name} }}"
            text += ["", f"::: {path}", f"    options: {options}"]
    return "\n".join(text) + "\n"
