"""Pictures of a path: plan with gaps, height profile, view in space (matplotlib)."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection
from matplotlib.lines import Line2D
from mpl_toolkits.mplot3d import Axes3D

from knotopt.arrays import FloatArray
from knotopt.path.curve import length_along
from knotopt.path.result import PathResult
from knotopt.plot.cable import CABLE_COLOUR, LIFTING_COLOUR, SUPPORT_COLOUR, grid_axes, mark_robots
from knotopt.plot.figures import measured_axes
from knotopt.plot.labels import HALO, draw_labels

GAP_SHARE = 0.14  # half-width of the gap in a lower strand, at most [grid steps]
ROBOT_WEIGHT = 5  # that a robot's middle counts more than a sample of the path under a label
OVER_COLOUR, UNDER_COLOUR = "#009E73", "#CC79A7"
GRID_COLOUR = "#CCCCCC"


def draw_plan(axes: Axes, result: PathResult) -> list[Line2D]:
    """The path seen from above on the grey grid path, broken where it passes under itself.

    Returns
    -------
    list of Line2D
        The robots, numbered as turning points, as handles for a legend.
    """
    plan, robots = result.report.samples[:, :2], result.robots[:, :2]
    axes.plot(*result.cable.points.T, color=GRID_COLOUR, linewidth=1, zorder=1)
    axes.add_collection(
        LineCollection(_pieces(result), colors=CABLE_COLOUR, linewidths=1.8, zorder=3)
    )
    size = result.cable.diagram.size
    low = np.minimum(plan.min(axis=0), 1) - 0.5
    high = np.maximum(plan.max(axis=0), size) + 0.5
    axes.set(xlim=(low[0], high[0]), ylim=(low[1], high[1]), aspect="equal")
    grid_axes(axes, size)
    axes.set_axisbelow(True)
    crossings = result.report.crossings.point
    numbers = (1, *result.supports, len(result.cable.path))
    held, crossed = len(numbers), len(crossings)
    draw_labels(
        axes,
        np.concatenate((robots, crossings.reshape(-1, 2))),
        [*map(str, numbers), *(f"c{k}" for k in range(1, crossed + 1))],
        np.concatenate((plan, np.repeat(robots, ROBOT_WEIGHT, axis=0))),
        font=[7] * held + [5] * crossed,
        distance=7,
        colours=["#444444"] * held + [OVER_COLOUR] * crossed,
    )
    return mark_robots(axes, robots, size=6)


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
    for chosen, marker, colour, label in (
        (over, "^", OVER_COLOUR, "passes over"),
        (~over, "v", UNDER_COLOUR, "passes under"),
    ):
        x, y = at[chosen], height[chosen]
        handles += axes.plot(x, y, marker, color=colour, markersize=5, label=label, zorder=3)
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
    mark_robots(axes, np.column_stack((robots, 0 * robots)), size=4)
    for number, s in zip((1, *result.supports, len(result.cable.path)), robots, strict=True):
        axes.annotate(
            str(number), (s, 0), (3, 3), textcoords="offset points", fontsize=6, path_effects=HALO
        )
    measured_axes(axes, "length along the cable [grid steps]", "height [grid steps]")
    axes.margins(y=0.25)
    return handles


def draw_space(axes: Axes3D, result: PathResult) -> None:
    """The path in space, coloured by height, with its shadow on the lowest plane."""
    samples = result.report.samples
    size = result.cable.diagram.size
    low = min(-0.5, float(samples[:, 2].min()) - 0.2)
    axes.plot(samples[:, 0], samples[:, 1], low, color=GRID_COLOUR, linewidth=1)
    axes.plot(*samples.T, color=CABLE_COLOUR, linewidth=1.4)
    robots = result.robots
    axes.scatter(*robots[1:-1].T, color=SUPPORT_COLOUR, s=18)
    axes.scatter(*robots[-1], color=LIFTING_COLOUR, marker="D", s=22)
    axes.scatter(*robots[0], color="white", edgecolor=LIFTING_COLOUR, marker="D", s=22)
    axes.set_box_aspect((1, 1, 0.3))
    axes.set_zlim(low, max(0.5, float(samples[:, 2].max()) + 0.2))
    for ends, limits in zip(samples.T, (axes.set_xlim, axes.set_ylim), strict=False):
        limits(min(0.5, ends.min()), max(size + 0.5, ends.max()))
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
