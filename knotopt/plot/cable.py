"""Pictures of a cable, its regions and its robots (matplotlib).

Colours are from the Okabe-Ito palette and differ in lightness and shape as well, so that they can
be told apart without colour vision and in print.
"""

from __future__ import annotations

from collections.abc import Collection, Sequence
from itertools import pairwise
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection
from matplotlib.colors import ListedColormap
from matplotlib.lines import Line2D
from matplotlib.patches import Patch, Rectangle

from knotopt.arrays import FloatArray, IntArray
from knotopt.cable.cable import Cable
from knotopt.diagram.grid import GridDiagram, Mark
from knotopt.path.mesh import between
from knotopt.plot.labels import draw_labels
from knotopt.supports.regions import Regions
from knotopt.viewer.squares import active_layers, squares

CABLE_COLOUR = "#222222"
SUPPORT_COLOUR = "#0072B2"
SPAN_COLOUR = "#009E73"
LIFTING_COLOUR = "#D55E00"
LAYER_COLOURS = ("#FBEBBE", "#F5D57C", "#EBB73A", "#D0930F")
PASSIVE_COLOUR = "#AAAAAA"
LOOP_COLOURS = ("#CC79A7", "#56B4E9", "#F0E442", "#E69F00", "#B2ABD2")
LOOP_WIDTHS = (12, 7)  # [points]
GAP = 0.2  # half-width of the gap in an under-crossing strand [grid steps]
CLOSE = 30  # points on a strand
NUMBER_OFFSET = 8  # from a turning point to its number, along each axis [points]


def draw_cable(axes: Axes, cable: Cable) -> None:
    """The cable with gaps at under-crossings and its turning points numbered along the path."""
    _draw_strands(axes, cable.path, cable.diagram)
    count = len(cable.path)
    corners = cable.points.astype(float)
    draw_labels(
        axes,
        corners,
        [str(index) for index in range(1, count + 1)],
        between(corners, np.linspace(0, count - 1, CLOSE * count)),  # the path itself
        font=[8] * count,
        distance=NUMBER_OFFSET,
        first=_away(cable).astype(float),
        colours=["#444444"] * count,
    )


def draw_closed(axes: Axes, diagram: GridDiagram) -> None:
    """The closed knot of a grid diagram with gaps at under-crossings."""
    _draw_strands(axes, (*diagram.traversal, diagram.traversal[0]), diagram)


def _draw_strands(axes: Axes, path: Sequence[Mark], diagram: GridDiagram) -> None:
    """Strands along a path of turning points, on axes with columns and rows."""
    pieces = []
    for (c0, r0), (c1, r1) in pairwise(path):
        if c0 == c1:
            pieces.append([(c0, r0), (c1, r1)])
            continue
        left, right = min(c0, c1), max(c0, c1)
        under = np.flatnonzero(diagram.crossing_cells[:, r0 - 1]) + 1
        within = under[(left < under) & (under < right)].tolist()
        bounds = [left, *(x + d for x in within for d in (-GAP, GAP)), right]
        pieces += [
            [(start, r0), (end, r0)] for start, end in zip(bounds[0::2], bounds[1::2], strict=True)
        ]
    axes.add_collection(
        LineCollection(pieces, colors=CABLE_COLOUR, linewidths=2, capstyle="round", zorder=3)
    )
    size = diagram.size
    axes.set(xlim=(0.2, size + 0.8), ylim=(0.2, size + 0.8), aspect="equal")
    grid_axes(axes, size)


def grid_axes(axes: Axes, size: int | None = None) -> None:
    """Axes without lines, ticks at columns and rows of a grid of that size, if one is given."""
    if size:
        step = 1 if size <= 20 else 5
        axes.set(xticks=range(step, size + 1, step), yticks=range(step, size + 1, step))
    axes.tick_params(length=0, labelsize=7, labelcolor="#888888", pad=1)
    axes.spines[:].set_visible(False)


def draw_robots(axes: Axes, cable: Cable, supports: Collection[int]) -> list[Line2D]:
    """The robots on a cable: supports round, lifting robots diamonds, the leader's filled.

    Returns
    -------
    list of Line2D
        Handles for a legend.
    """
    return mark_robots(axes, cable.points[[0, *sorted(k - 1 for k in supports), -1]], size=8)


def mark_robots(axes: Axes, robots: FloatArray | IntArray, *, size: float) -> list[Line2D]:
    """The robots in their order along a cable, shape (k, 2), with handles for a legend."""
    hollow = {
        "marker": "D",
        "markerfacecolor": "white",
        "markeredgecolor": LIFTING_COLOUR,
        "markeredgewidth": size / 4,
    }
    handles = []
    kinds: tuple[tuple[FloatArray | IntArray, str, dict[str, Any]], ...] = (
        (robots[1:-1], "support robot", {"marker": "o", "color": SUPPORT_COLOUR}),
        (robots[-1:], "leader $p_n$", {"marker": "D", "color": LIFTING_COLOUR}),
        (robots[:1], "lifting robot $p_1$", hollow),
    )
    for at, label, style in kinds:
        handles += axes.plot(
            at[:, 0], at[:, 1], linestyle="", markersize=size, label=label, zorder=5, **style
        )
    return handles


def draw_spans(axes: Axes, cable: Cable, supports: Collection[int]) -> list[Line2D]:
    """The taut cable: straight spans between consecutive robots, as a handle for a legend."""
    robots = cable.points[[0, *sorted(index - 1 for index in supports), -1]]
    return axes.plot(
        *robots.T,
        color=SPAN_COLOUR,
        linestyle=(0, (4, 2)),
        linewidth=1.2,
        label="taut cable",
        zorder=3.5,
    )


def draw_loops(axes: Axes, cable: Cable, loops: Collection[int]) -> list[Line2D]:
    """Loops of the cable, by their crossings' indices, as broad lines below it.

    Two loops that follow each other may share cable between two turning points: widths alternate,
    so that both are seen.

    Returns
    -------
    list of Line2D
        Handles for a legend.
    """
    handles = []
    for number, index in enumerate(loops):
        crossing = cable.crossings[index]
        along = cable.cells[crossing.first : crossing.second + 1]
        handles += axes.plot(
            *along.T,
            color=LOOP_COLOURS[number % len(LOOP_COLOURS)],
            linewidth=LOOP_WIDTHS[number % len(LOOP_WIDTHS)],
            solid_joinstyle="miter",
            solid_capstyle="butt",
            label=f"loop c{index + 1} at [{crossing.column},{crossing.row}]",
            zorder=1 + number / 1000,
        )
    return handles


def draw_regions(axes: Axes, regions: Regions) -> list[Patch]:
    """Active regions shaded by how many overlap, passive ones hatched.

    A region is drawn as the unit squares that touch an interior cell, which fills it up to its
    boundary; one without interior cells has nothing to draw.
    """
    size = regions.cable.diagram.size
    layers = active_layers(regions)
    deepest = int(layers.max())
    shades = min(deepest, len(LAYER_COLOURS))
    handles = []
    if deepest:
        axes.imshow(
            np.ma.masked_equal(-(-layers * shades // deepest), 0).T,
            origin="lower",
            extent=(0, size + 1, 0, size + 1),
            cmap=ListedColormap(LAYER_COLOURS[:shades]),
            vmin=0.5,
            vmax=shades + 0.5,
            zorder=0,
        )
        for layer in range(1, shades + 1):
            low, high = (layer - 1) * deepest // shades + 1, layer * deepest // shades
            count = str(high) if low == high else f"{low}\N{EN DASH}{high}"
            label = f"{count} active region" + ("s" if high > 1 else "")
            handles.append(Patch(color=LAYER_COLOURS[layer - 1], label=label))
    passive = [squares(region.interior) for region in regions if not region.is_active]
    if np.any(passive):
        style: dict[str, Any] = {
            "fill": False,
            "hatch": "////",
            "edgecolor": PASSIVE_COLOUR,
            "linewidth": 0,
        }
        for column, row in np.argwhere(np.any(passive, axis=0)).tolist():
            axes.add_patch(Rectangle((column, row), 1, 1, zorder=1, **style))
        handles.append(Patch(label="passive region", **style))
    return handles


def _away(cable: Cable) -> IntArray:
    """Direction from each turning point to the outside of its corner, (+-1, +-1), shape (n, 2)."""
    steps = np.sign(np.diff(cable.points, axis=0))
    none = np.zeros((1, 2), dtype=np.int64)
    away: IntArray = np.concatenate((none, steps)) - np.concatenate((steps, none))
    # An end of the cable has one strand only: its number stands off to the side as well.
    away[[0, -1]] += np.abs(away[[0, -1], ::-1])
    return away
