"""Figures of one cable, and of a cable before and after LCF, as image files."""

from __future__ import annotations

import io
from collections.abc import Collection, Sequence
from pathlib import Path
from typing import Any

import matplotlib
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from knotopt.cable.cable import Cable
from knotopt.diagram.grid import GridDiagram
from knotopt.errors import OutputError
from knotopt.files import write_atomically
from knotopt.plot.cable import (
    draw_cable,
    draw_closed,
    draw_loops,
    draw_regions,
    draw_robots,
    draw_spans,
)
from knotopt.supports.lcf import LcfResult
from knotopt.supports.minimal import MinimalSupports
from knotopt.supports.regions import Regions
from knotopt.supports.registry import find_formulation
from knotopt.supports.support_set import SupportSet

PANEL = 3.4  # width of a panel [inch]: one column of a two-column paper
FORMATS = (".png", ".pdf", ".svg")


def diagram_figure(diagram: GridDiagram, title: str) -> Figure:
    """One panel: the closed knot of a grid diagram."""
    figure, (axes,) = _panels(1, diagram.size)
    draw_closed(axes, diagram)
    figure.suptitle(title, fontsize=9, parse_math=False)
    return figure


def cable_figure(cable: Cable, title: str) -> Figure:
    """One panel: the grid diagram opened at its cut, turning points numbered."""
    figure, (axes,) = _panels(1, cable.diagram.size)
    draw_cable(axes, cable)
    return titled(figure, title, draw_robots(axes, cable, [])[1:])


def set_figure(chosen: SupportSet, title: str) -> Figure:
    """One panel: the cable and its robots."""
    figure, (axes,) = _panels(1, chosen.cable.diagram.size)
    draw_cable(axes, chosen.cable)
    return titled(figure, title, draw_robots(axes, chosen.cable, chosen.supports))


def supports_figure(regions: Regions, supports: Collection[int], title: str) -> Figure:
    """One panel: supports, active regions shaded by layer, passive ones hatched."""
    figure, (axes,) = _panels(1, regions.cable.diagram.size)
    shades = draw_regions(axes, regions)
    draw_cable(axes, regions.cable)
    handles = draw_robots(axes, regions.cable, supports)
    return titled(figure, title, [*handles, *shades])


def smallest_figure(result: MinimalSupports, title: str) -> Figure:
    """One panel: a smallest set, and what it is needed for."""
    figure, (axes,) = _panels(1, result.cable.diagram.size)
    return titled(figure, title, _draw_smallest(axes, result))


def before_after_figure(result: LcfResult, title: str) -> Figure:
    """Two panels: above the baseline, a robot at every turning point, and below LCF's supports."""
    cable = result.cable
    figure, (before, after) = _panels(2, cable.diagram.size)
    draw_cable(before, cable)
    draw_robots(before, cable, range(2, len(cable.path)))
    before.set_title(f"before: {result.baseline} robots", fontsize=9)
    regions = draw_regions(after, result.regions)
    draw_cable(after, cable)
    handles = draw_robots(after, cable, result.supports)
    after.set_title(f"after: {result.robots} robots", fontsize=9)
    return titled(figure, title, [*handles, *regions])


def save_figure(figure: Figure, path: Path) -> None:
    """Write a figure as .png, .pdf or .svg, atomically and the same bytes every time."""
    suffix = check_format(path)
    write_atomically(path, figure_bytes(figure, suffix[1:]))


def figure_bytes(figure: Figure, format: str) -> bytes:
    """A figure as a file of format "png" (200 dpi), "pdf" or "svg"."""
    # Without a date and with a fixed salt, the same figure gives the same file.
    metadata = {"png": {}, "pdf": {"CreationDate": None}, "svg": {"Date": None}}[format]
    buffer = io.BytesIO()
    with matplotlib.rc_context({"svg.hashsalt": "knotopt"}):
        figure.savefig(buffer, format=format, dpi=200, metadata=metadata)
    return buffer.getvalue()


def minimal_figure(results: Sequence[MinimalSupports], title: str) -> Figure:
    """One panel a result, one above the other: its smallest set, and what it is needed for."""
    figure, panels = _panels(len(results), *(result.cable.diagram.size for result in results))
    handles: dict[str, Artist] = {}
    for axes, result in zip(panels, results, strict=True):
        handles |= {str(each.get_label()): each for each in _draw_smallest(axes, result)}
        words = f"{result.requirements.words}, cut {result.cable.cut}: {result.robots} robots"
        axes.set_title(words, fontsize=9)
    return titled(figure, title, list(handles.values()))


def _draw_smallest(axes: Axes, result: MinimalSupports) -> list[Artist]:
    """A smallest set, and below it the regions that it keeps open, or the loops that show that no
    smaller one would do.
    """
    cable, rules = result.cable, find_formulation(result.requirements.formulation)
    below: Sequence[Artist] = (
        draw_regions(axes, result.lcf.regions)
        if rules.has_openness
        else draw_loops(axes, cable, result.disjoint_loops)
    )
    draw_cable(axes, cable)
    handles = draw_robots(axes, cable, result.supports)
    if rules.is_taut:
        handles += draw_spans(axes, cable, result.supports)
    return [*handles, *below]


def titled(figure: Figure, title: str, handles: Sequence[Artist], columns: int = 2) -> Figure:
    """The figure with a title above it and a legend below."""
    figure.suptitle(title, fontsize=9, parse_math=False)
    figure.legend(handles=handles, loc="outside lower center", ncols=columns, **LEGEND)
    return figure


def measured_axes(axes: Axes, across: str, up: str) -> None:
    """Label both axes, units in brackets, in small letters on a pale grid."""
    axes.set_xlabel(across, fontsize=8)
    axes.set_ylabel(up, fontsize=8)
    axes.tick_params(labelsize=7)
    axes.grid(alpha=0.3)


def check_format(path: Path) -> str:
    """The suffix of a picture's file.

    Raises
    ------
    OutputError
        It is none of `FORMATS`.
    """
    suffix = path.suffix.lower()
    if suffix not in FORMATS:
        raise OutputError(f"{path}: pictures are written as {', '.join(FORMATS)}")
    return suffix


LEGEND: dict[str, Any] = {
    "fontsize": 7,
    "frameon": False,
    "handletextpad": 0.4,
    "columnspacing": 1.0,
}


def _panels(count: int, *sizes: int) -> tuple[Figure, list[Axes]]:
    side = max(PANEL, *(0.25 * size for size in sizes))
    figure = Figure(figsize=(side, count * side + 0.9), layout="constrained")
    axes = figure.subplots(count, 1, squeeze=False)[:, 0]
    return figure, list(axes)
