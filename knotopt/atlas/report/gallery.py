"""Pictures of knots: LCF's set beside a smallest open one, on the same cut."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from knotopt.atlas.report.cases import Case
from knotopt.cable.cable import Cable
from knotopt.plot.cable import draw_cable, draw_robots
from knotopt.plot.figures import LEGEND, PANEL
from knotopt.tables.methods import Supports
from knotopt.verify.opening import check_opening, threading_cells
from knotopt.verify.regions import define_regions

SIDE = PANEL / 2  # of a panel [inch]
CLOSED_COLOUR, POLYGON_COLOUR = "#CC79A7", "#B0005E"
MODE = "turning-point"


def gallery_figure(cases: Sequence[Case], openness: Fraction) -> Figure:
    """Two cases a row, each of two panels: LCF's set and a smallest open one.

    Parameters
    ----------
    cases : sequence of Case
    openness : Fraction
        r [grid steps]. Of LCF's set that region is shown, of those that are not r-open, that has
        the shortest boundary.
    """
    rows = -(-len(cases) // 2)
    figure = Figure(figsize=(4 * SIDE, rows * (SIDE + 0.25) + 0.25), layout="constrained")
    panels = figure.subplots(rows, 4, squeeze=False)
    handles = []
    for axes in panels.flat:
        axes.set_axis_off()
    for index, case in enumerate(cases):
        left, right = panels[index // 2, 2 * (index % 2) : 2 * (index % 2) + 2]
        for axes, supports, whose in (
            (left, case.lcf, f"{case.name} {case.cable.cut}, LCF"),
            (right, case.smallest, "smallest"),
        ):
            draw_cable(axes, case.cable)
            for number in list(axes.texts):  # of turning points: too small to be read here
                number.remove()
            handles = draw_robots(axes, case.cable, supports)
            for marks in handles:
                marks.set_markersize(5)
            axes.set_title(f"{whose}: {len(supports) + 2}", fontsize=8, parse_math=False)
        _draw_closed(left, case.cable, case.lcf, openness)
    figure.legend(handles=handles, loc="outside lower center", ncols=3, **LEGEND)
    return figure


def _draw_closed(axes: Axes, cable: Cable, supports: Supports, openness: Fraction) -> None:
    """The shortest region that is not open: boundary, what is left of it, and what threads it."""
    regions = define_regions(cable.path, cable.diagram.size)
    closed = check_opening(cable.path, cable.diagram.size, supports, openness, MODE).closed_regions
    if not closed:
        return
    region = min((regions[index] for index in closed), key=lambda each: len(each.walk))
    cells = [tuple(cell) for cell in cable.cells.tolist()]
    around = [cells[time] for time in region.walk]
    held = {cable.path[index - 1] for index in (1, *supports, len(cable.path))}
    polygon = [cell for cell in around if cell in held or cell in region.apexes]
    polygon.append(polygon[0])
    axes.plot(*zip(*around, strict=True), color=CLOSED_COLOUR, linewidth=6, alpha=0.45, zorder=1)
    axes.plot(
        *zip(*polygon, strict=True), color=POLYGON_COLOUR, linewidth=1.4, linestyle="--", zorder=3.6
    )
    threads = list(threading_cells(region, cable.path, cells, MODE))
    axes.plot(
        *zip(*threads, strict=True),
        color=CLOSED_COLOUR,
        marker="X",
        markersize=6,
        markeredgecolor="black",
        markeredgewidth=0.5,
        linestyle="",
        zorder=5,
    )
