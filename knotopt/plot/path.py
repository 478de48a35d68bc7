"""Pictures of a path: plan with gaps, height profile, view in space (matplotlib)."""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection
from matplotlib.lines import Line2D
from mpl_toolkits.mplot3d import Axes3D

from knotopt.arrays import FloatArray
from knotopt.path.curve import length_along
from knotopt.path.result import PathResult
from knotopt.plot.cable import CABLE_COLOUR, HALO, LIFTING_COLOUR, SUPPORT_COLOUR

GAP_SHARE = 0.14  # half-width of the gap in a lower strand, at most [grid steps]
LIFTING: dict[str, Any] = {"marker": "D", "markersize": 7}
GRID_COLOUR = "#CCCCCC"


def draw_plan(axes: Axes, result: PathResult, *, colour: str = CABLE_COLOUR) -> None:
    """The path seen from above, broken where it passes under itself."""
    plan = result.report.samples[:, :2]
    axes.add_collection(
        LineCollection(_pieces(result), colors=colour, linewidths=1.8, capstyle="butt", zorder=3)
    )
    for k, point in enumerate(result.report.crossings.point, 1):
        axes.annotate(
            f"c{k}",
            point,
            (5, -8),
            textcoords="offset points",
            fontsize=5,
            color="#009E73",
            zorder=6,
            path_effects=HALO,
        )
    size = result.cable.diagram.size
    low = np.minimum(plan.min(axis=0), 1) - 0.5
    high = np.maximum(plan.max(axis=0), size) + 0.5
    axes.set(xlim=(low[0], high[0]), ylim=(low[1], high[1]), aspect="equal")
    step = 1 if size <= 20 else 5
    axes.set_xticks(range(step, size + 1, step))
    axes.set_yticks(range(step, size + 1, step))
    axes.tick_params(length=0, labelsize=7, labelcolor="#888888", pad=1)
    axes.spines[:].set_visible(False)
    axes.set_axisbelow(True)


def draw_grid_path(axes: Axes, result: PathResult) -> None:
    """The grid path behind it, in grey."""
    points = result.cable.points
    axes.plot(points[:, 0], points[:, 1], color=GRID_COLOUR, linewidth=1, zorder=1)


def draw_holders(axes: Axes, result: PathResult) -> list[Line2D]:
    """The robots of a path, numbered as turning points; handles for a legend."""
    robots = result.robots[:, :2]
    numbers = [1, *result.supports, len(result.cable.path)]
    for number, at in zip(numbers, robots, strict=True):
        axes.annotate(
            str(number),
            at,
            (7, 5),
            textcoords="offset points",
            fontsize=7,
            color="#444444",
            zorder=6,
            path_effects=HALO,
        )
    return [
        *_points(axes, robots[1:-1], "support robot", marker="o", color=SUPPORT_COLOUR),
        *_points(axes, robots[-1:], "leader $p_n$", marker="D", color=LIFTING_COLOUR),
        *_points(
            axes,
            robots[:1],
            "lifting robot $p_1$",
            marker="D",
            markerfacecolor="white",
            markeredgecolor=LIFTING_COLOUR,
            markeredgewidth=2,
        ),
    ]


def draw_heights(axes: Axes, result: PathResult) -> list[Line2D]:
    """Height along the path, crossings marked as passed over or under, robots at height 0."""
    samples, crossings = result.report.samples, result.report.crossings
    along = length_along(samples)
    axes.plot(along, samples[:, 2], color=CABLE_COLOUR, linewidth=1.2, zorder=2)
    where, which = crossings.visits
    at = np.interp(where, np.arange(len(along)), along)
    height = np.interp(where, np.arange(len(along)), samples[:, 2])
    first = where == crossings.first[which]
    over = np.where(first, crossings.gap[which] > 0, crossings.gap[which] < 0)
    handles = []
    for chosen, marker, label in ((over, "^", "passes over"), (~over, "v", "passes under")):
        handles += axes.plot(
            at[chosen],
            height[chosen],
            linestyle="",
            marker=marker,
            markersize=5,
            color="#009E73" if marker == "^" else "#CC79A7",
            label=label,
            zorder=3,
        )
    for s, z, k in zip(at, height, which, strict=True):
        axes.annotate(
            f"c{k + 1}",
            (s, z),
            (0, 6 if z >= 0 else -6),
            textcoords="offset points",
            fontsize=6,
            ha="center",
            va="bottom" if z >= 0 else "top",
            color="#444444",
            path_effects=HALO,
        )
    robots = along[[int(((samples - robot) ** 2).sum(axis=1).argmin()) for robot in result.robots]]
    inner, ends = robots[1:-1], robots[[0, -1]]
    axes.plot(inner, 0 * inner, "o", color=SUPPORT_COLOUR, markersize=4, zorder=4)
    axes.plot(ends, 0 * ends, "D", color=LIFTING_COLOUR, markersize=4, zorder=4)
    for number, s in zip((1, *result.supports, len(result.cable.path)), robots, strict=True):
        axes.annotate(
            str(number), (s, 0), (3, 3), textcoords="offset points", fontsize=6, path_effects=HALO
        )
    axes.set_xlabel("length along the cable [grid steps]", fontsize=8)
    axes.set_ylabel("height [grid steps]", fontsize=8)
    axes.tick_params(labelsize=7)
    axes.margins(y=0.25)
    axes.grid(alpha=0.3)
    return handles


def draw_space(axes: Axes3D, result: PathResult) -> None:
    """The path in space, coloured by height, with its shadow on the lowest plane."""
    samples = result.report.samples
    size = result.cable.diagram.size
    low = min(-0.5, float(samples[:, 2].min()) - 0.2)
    axes.plot(samples[:, 0], samples[:, 1], low, color=GRID_COLOUR, linewidth=1)
    axes.plot(samples[:, 0], samples[:, 1], samples[:, 2], color=CABLE_COLOUR, linewidth=1.4)
    robots = result.robots
    axes.scatter(*robots[1:-1].T, color=SUPPORT_COLOUR, s=18)
    axes.scatter(*robots[[0, -1]].T, color=LIFTING_COLOUR, marker="D", s=22)
    axes.set_box_aspect((1, 1, 0.3))
    axes.set_zlim(low, max(0.5, float(samples[:, 2].max()) + 0.2))
    for low_end, high_end, limits in (
        (samples[:, 0].min(), samples[:, 0].max(), axes.set_xlim),
        (samples[:, 1].min(), samples[:, 1].max(), axes.set_ylim),
    ):
        limits(min(0.5, low_end), max(size + 0.5, high_end))
    axes.set_title("heights drawn larger; shadow in grey", fontsize=7)
    axes.view_init(elev=32, azim=-60)
    axes.tick_params(labelsize=6, pad=-2)


def _pieces(result: PathResult) -> list[FloatArray]:
    """The path in plan without the surroundings of its lower visits."""
    samples, crossings = result.report.samples, result.report.crossings
    along = length_along(samples)
    under = np.where(crossings.gap > 0, crossings.second, crossings.first)
    at = np.interp(under, np.arange(len(along)), along)
    every = np.sort(np.interp(crossings.visits[0], np.arange(len(along)), along))
    # Between crossings close to each other the gaps are narrower, so that something is left.
    nearest = np.array([np.abs(every - s)[np.abs(every - s) > 1e-9].min(initial=9) for s in at])
    width = np.minimum(GAP_SHARE, 0.25 * nearest)
    drawn = np.ones(len(samples), dtype=bool)
    for s, w in zip(at, width, strict=True):
        drawn[np.abs(along - s) < w] = False
    edges = np.flatnonzero(np.diff(np.concatenate(([0], drawn.astype(int), [0]))))
    return [samples[a:b, :2] for a, b in zip(edges[::2], edges[1::2], strict=True)]


def _points(axes: Axes, at: FloatArray, label: str, **style: Any) -> list[Line2D]:
    return axes.plot(at[:, 0], at[:, 1], linestyle="", markersize=6, label=label, zorder=5, **style)
