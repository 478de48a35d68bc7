"""The report of an atlas: all sections, in all formats, as the files of a folder."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from fnmatch import fnmatch
from pathlib import Path

from matplotlib.figure import Figure

from knotopt.atlas.report.assumptions import assumptions_section
from knotopt.atlas.report.atlas_csv import atlas_csv
from knotopt.atlas.report.cases import cases_section, failing, wasteful
from knotopt.atlas.report.cuts import cuts_section
from knotopt.atlas.report.families import families_section
from knotopt.atlas.report.figures import (
    cuts_figure,
    heuristic_figure,
    relations_figure,
    robots_figure,
)
from knotopt.atlas.report.flights import flights_section
from knotopt.atlas.report.gallery import gallery_figure
from knotopt.atlas.report.heuristic import heuristic_section
from knotopt.atlas.report.invariants import Invariants, invariants, knotinfo_version
from knotopt.atlas.report.of_the_knots import of_the_knots_section
from knotopt.atlas.report.relations import relations_section
from knotopt.atlas.report.results import Results
from knotopt.atlas.report.robots import robots_section
from knotopt.atlas.report.solvers import PROFILE, profile_figure, solvers_section
from knotopt.atlas.report.times import paths_section, times_section
from knotopt.document.html import html
from knotopt.document.latex import latex
from knotopt.document.markdown import markdown
from knotopt.document.model import Document
from knotopt.plot.figures import figure_bytes

MARK = "report.md"
"""The file that every such folder has."""
TITLE = "Atlas of smallest supports"
NAMES = (MARK, "report.tex", "report.html", "atlas.csv", "*.png", "*.pdf")


def report_files(results: Results) -> dict[str, str | bytes]:
    """All files of a report by name: the same for the same run and versions."""
    known = invariants(results.knots)
    document = report_document(results, known)
    drawn = _figures(results, known)
    figures = {picture.name: drawn[picture.name]() for picture in document.pictures}
    as_svg = {name: figure_bytes(figure, "svg") for name, figure in figures.items()}
    return {
        MARK: markdown(document),
        "report.tex": latex(document),
        "report.html": html(document, as_svg),
        "atlas.csv": atlas_csv(results),
        **{f"{name}.png": figure_bytes(figure, "png") for name, figure in figures.items()},
        **{f"{name}.pdf": figure_bytes(figure, "pdf") for name, figure in figures.items()},
    }


def report_document(results: Results, known: Mapping[str, Invariants]) -> Document:
    """The report's sections."""
    settings, versions = results.manifest.settings, results.manifest.versions
    table = knotinfo_version()
    facts = (
        ("rests on", results.size),
        ("cuts", "the eight outer ones of each knot's grid diagram"),
        ("openness r", f"{settings.openness} grid steps"),
        ("solver", f"CP-SAT, seed {settings.seed}"),
        ("run with", ", ".join(f"{name} {version}" for name, version in versions.items())),
        ("invariants", f"KnotInfo {table}" if table and known else "the atlas's own"),
        ("list of knots", f"SHA-256 {results.manifest.list_hash[:16]}"),
    )
    sections = (
        assumptions_section(results),
        of_the_knots_section(results),
        robots_section(results),
        heuristic_section(results),
        cuts_section(results),
        families_section(results, known),
        relations_section(results, known),
        cases_section(results),
        paths_section(results),
        flights_section(results),
        solvers_section(results),
        times_section(results),
    )
    return Document(TITLE, facts, tuple(each for each in sections if each is not None))


def why_kept(path: Path) -> str:
    """Why a folder that is there already is not one of a report, to be replaced by a new one.

    A file of the user's own in it would be lost.
    """
    for entry in sorted(path.iterdir()):
        if entry.is_dir() or not any(fnmatch(entry.name, name) for name in NAMES):
            return f"holds {entry.name}, which is no file of a report: name another folder"
    try:
        with (path / MARK).open(encoding="utf-8") as stream:
            is_report = stream.readline().strip() == f"# {TITLE}"
    except (OSError, UnicodeDecodeError):
        is_report = False
    return "" if is_report else f"has no {MARK} of a report in it: name another folder"


def _figures(results: Results, known: Mapping[str, Invariants]) -> dict[str, Callable[[], Figure]]:
    r = results.manifest.settings.r
    return {
        "robots": lambda: robots_figure(results),
        "heuristic": lambda: heuristic_figure(results),
        "cuts": lambda: cuts_figure(results),
        "relations": lambda: relations_figure(results, known),
        "wasteful": lambda: gallery_figure(wasteful(results), r),
        "failing": lambda: gallery_figure(failing(results), r),
        PROFILE: lambda: profile_figure(results),
    }
