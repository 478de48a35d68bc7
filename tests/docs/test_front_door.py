"""The README and what surrounds it: short, linked, each thing said once, versions that agree."""

from __future__ import annotations

import csv
import json
import re
import tomllib
from collections import defaultdict
from pathlib import Path

import pytest
import yaml

import knotopt
from knotopt.catalogue.stored_grids import stored_grids

ROOT = Path(__file__).parents[2]
README = (ROOT / "README.md").read_text("utf-8")
PAGES = [ROOT / "README.md", ROOT / "formulations/README.md", *sorted(ROOT.glob("docs/**/*.md"))]
LINK = re.compile(r"\]\(([^)\s]+)\)|<img src=\"([^\"]+)\"")


def prose(text: str) -> str:
    """A page without its code, tables and links' targets."""
    text = re.sub(r"^```.*?^```$", "\n\n", text, flags=re.DOTALL | re.MULTILINE)
    text = re.sub(r"^\|.*$", "", text, flags=re.MULTILINE)
    return re.sub(r"\]\([^)]*\)|\]\[[^\]]*\]|[\[*_]", "", text)


def anchors(path: Path) -> set[str]:
    """What the headings of a page are linked by."""
    text = re.sub(r"^```.*?^```$", "", path.read_text("utf-8"), flags=re.DOTALL | re.MULTILINE)
    headings = re.findall(r"^#+ (.*)$", text, re.MULTILINE)
    return {re.sub(r"[^\w\- ]", "", each.lower()).replace(" ", "-") for each in headings}


def test_the_readme_is_short() -> None:
    assert len(README.splitlines()) <= 200
    assert (ROOT / "docs/assets/trefoil.gif").stat().st_size < 1_000_000


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.relative_to(ROOT).as_posix())
def test_links_lead_somewhere(page: Path) -> None:
    """In the repository; what the site alone has is left out: what it draws, and public names."""
    text = re.sub(r"^```.*?^```$", "", page.read_text("utf-8"), flags=re.DOTALL | re.MULTILINE)
    for target in [one or other for one, other in LINK.findall(text)]:
        name, _, anchor = target.partition("#")
        assert not re.match(r"\w+:", name), f"{target} needs a network"
        if not name.startswith("drawn/") and name not in ("reference/public.md", "public.md"):
            place = page.parent / name if name else page
            assert place.exists(), target
            assert not anchor or anchor in anchors(place), target


def test_no_sentence_stands_twice() -> None:
    where: dict[str, set[str]] = defaultdict(set)
    for page in PAGES:
        for sentence in re.split(r"(?<=[.:;])\s+|\n\s*\n|\n- ", prose(page.read_text("utf-8"))):
            words = re.findall(r"[\w.]+", sentence.lower())
            if len(words) >= 8:
                where[" ".join(words)].add(page.relative_to(ROOT).as_posix())
    assert len(where) > 500
    assert {words: pages for words, pages in where.items() if len(pages) > 1} == {}


def test_versions_agree() -> None:
    project = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))["project"]
    assert project["dynamic"] == ["version"]  # of the package
    citation = yaml.safe_load((ROOT / "CITATION.cff").read_text("utf-8"))
    (released,) = re.findall(r"^  version = \{(.*)\},$", README, re.MULTILINE)
    changes = re.findall(r"^## (\S+)", (ROOT / "CHANGELOG.md").read_text("utf-8"), re.MULTILINE)
    assert citation["version"] == released == changes[0] == knotopt.__version__


@pytest.mark.parametrize("place", ["badge", "readme"])
def test_python_versions_agree(place: str) -> None:
    project = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))["project"]
    said = [each.rpartition(" ")[2] for each in project["classifiers"] if "Python :: 3." in each]
    first, last = said[0], said[-1]
    text = (ROOT / "docs/assets/python.svg").read_text("utf-8") if place == "badge" else README
    assert f"{first} to {last}" in text and project["requires-python"].startswith(f">={first}")


def test_papers_are_cited_as_in_the_citation_file() -> None:
    citation = yaml.safe_load((ROOT / "CITATION.cff").read_text("utf-8"))
    papers = [each for each in citation["references"] if each["type"] == "conference-paper"]
    assert len(papers) == 2
    plain = README.replace(r"{\~n}", "ñ")
    for paper in papers:
        assert f"{{{paper['title']}}}" in plain and f"{{{paper['year']}}}" in plain
        authors = " and ".join(f"{a['family-names']}, {a['given-names']}" for a in paper["authors"])
        assert f"{{{authors}}}" in plain


def test_the_result_is_what_was_measured() -> None:
    """Robots as in Table I and the stored grids, flights as in the benchmark."""
    with (ROOT / "paper_results/table1.csv").open(encoding="utf-8", newline="") as file:
        table = {row["row"]: row for row in csv.DictReader(file)}
    lines = (ROOT / "benchmarks/results/physics.jsonl").read_text("utf-8").splitlines()[1:]
    flown = {
        each["case"]["row"]: each["result"]
        for each in map(json.loads, lines)
        if each["case"]["method"] == "lcf"
    }
    shown = re.findall(r"^\| (\d.*), (\d+_\d+) \| (\d+) \| (.*) \|$", README, re.MULTILINE)
    assert [row for row, *_ in shown] == list(table)
    for row, knot, corners, rest in shown:
        measured, lcf = table[row], flown[row]
        assert (knot, corners) == (measured["knot"], measured["robots_before"])
        assert measured["robots_after"] == measured["robots_after_paper"]
        tied = lcf["tied_disturbed"] if lcf["planned"] else 0
        assert rest.replace("*", "").split(" | ") == [
            *(measured["robots_after"], f"{tied} of 5"),
            *(measured["needed"], measured["flown"]),
            f"{measured['flown_tied']} of {measured['flown_flights']}",
            str(stored_grids()[knot, "safe0.5"].robots),
        ]
