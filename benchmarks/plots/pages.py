"""Every page and its figures, written beside the results."""

from __future__ import annotations

from collections.abc import Callable

from matplotlib.figure import Figure

from benchmarks import headlines, results
from benchmarks.plots import (
    diagrams,
    formulations,
    grids,
    heuristics,
    lcf,
    paths,
    physics,
    topology,
    versions,
)
from knotopt.files import write_atomically
from knotopt.plot.figures import save_figure

PAGES: dict[str, Callable[[], tuple[list[str], dict[str, Figure]]]] = {
    "summary.md": lcf.write_parts,
    "grids.md": grids.write_parts,
    "formulations.md": formulations.write_parts,
    "heuristics.md": heuristics.write_parts,
    "paths.md": paths.write_parts,
    "physics.md": physics.write_parts,
    "topology.md": topology.write_parts,
    "diagrams.md": diagrams.write_parts,
    "versions.md": versions.write_parts,
}
"""File of a page to what gives its parts and its figures by file name."""


def write_pages(suffix: str) -> None:
    """Write all pages, whose links are to .png, and their figures as that kind of picture."""
    for page, write_parts in PAGES.items():
        if page == "versions.md" and not (results.RESULTS / headlines.FILE).exists():
            continue
        parts, figures = write_parts()
        write_atomically(results.RESULTS / page, "\n\n".join(parts) + "\n")
        for name, figure in figures.items():
            save_figure(figure, (results.RESULTS / name).with_suffix(suffix))
