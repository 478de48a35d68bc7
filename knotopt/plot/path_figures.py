"""Figures of paths: any path, the relaxation step by step (Fig. 5), staircase braids (Fig. 7)."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection
from matplotlib.figure import Figure

from knotopt.path.measures import status_word
from knotopt.path.relaxation import RelaxationRun, straightening
from knotopt.path.result import PathResult
from knotopt.plot.cable import draw_cable, draw_robots, grid_axes, mark_robots
from knotopt.plot.figures import PANEL, titled
from knotopt.plot.path import GRID_COLOUR, draw_heights, draw_plan, draw_space

NAMES = {"nlp": "program", "relaxation": "relaxation"}
SPRING_COLOUR, FORCE_COLOUR, BEFORE_COLOUR = "#56B4E9", "#D55E00", "#999999"


def path_figure(results: Sequence[PathResult], title: str) -> Figure:
    """A row for each path: plan view with gaps, view in space, height profile below them."""
    rows = len(results)
    figure = Figure(figsize=(2.3 * PANEL, rows * 1.55 * PANEL), layout="constrained")
    grid = figure.add_gridspec(2 * rows, 2, height_ratios=[1.0, 0.5] * rows)
    handles: list[Any] = []
    for row, result in enumerate(results):
        plan = figure.add_subplot(grid[2 * row, 0])
        handles = draw_plan(plan, result)
        plan.set_title(_caption(result), fontsize=8, parse_math=False)
        draw_space(figure.add_subplot(grid[2 * row, 1], projection="3d"), result)
        handles += draw_heights(figure.add_subplot(grid[2 * row + 1, :]), result)
    return titled(figure, title, handles, 5)


def relaxation_figure(
    run: RelaxationRun, relaxed: PathResult, optimised: PathResult, title: str
) -> Figure:
    """Fig. 5: (a) supports on the grid, (b) springs, (c) straightening, (d) final; and (e) ours."""
    figure = Figure(figsize=(3 * PANEL, 2.15 * PANEL), layout="constrained")
    panels = figure.subplots(2, 3).ravel()
    half = _step_at(run, 0.5)
    cable = relaxed.cable
    draw_cable(panels[0], cable)
    handles = draw_robots(panels[0], cable, relaxed.supports)
    panels[0].set_title("(a) supports on the grid", fontsize=8)
    _draw_nodes(panels[1], run, half, springs=True)
    panels[1].set_title(f"(b) springs and dampers, step {half}", fontsize=8)
    _draw_nodes(panels[2], run, half, springs=False)
    panels[2].set_title(f"(c) straightening force, step {half}", fontsize=8)
    for axes, result, name in (
        (panels[3], relaxed, "(d) relaxed"),
        (panels[4], optimised, "(e) program"),
    ):
        draw_plan(axes, result)
        axes.set_title(f"{name}: {_caption(result, brief=True)}", fontsize=8, parse_math=False)
    _draw_trajectories(panels[5], run)
    panels[5].set_title(f"nodes over {run.steps} steps", fontsize=8)
    for axes in panels:
        axes.set_aspect("equal")
    return titled(figure, title, handles, 3)


def braid_figure(result: PathResult, title: str) -> Figure:
    """Fig. 7: a robot at every corner on the left, the path with fewer on the right."""
    figure = Figure(figsize=(2 * PANEL, 1.2 * PANEL), layout="constrained")
    left, right = figure.subplots(1, 2)
    count = len(result.cable.path)
    draw_cable(left, result.cable)
    handles = draw_robots(left, result.cable, range(2, count))
    left.set_title(f"every corner held: {count} robots", fontsize=8)
    draw_plan(right, result)
    right.set_title(f"reduced: {len(result.supports) + 2} robots", fontsize=8)
    return titled(figure, title, handles, 3)


def _caption(result: PathResult, *, brief: bool = False) -> str:
    report = result.report
    words = f"length {result.curve.length:.1f}, {result.stretch:.2f} of the taut string"
    if not report.same_diagram:
        words += ", " + ("another diagram" if report.same_knot else "ANOTHER KNOT")
    return words if brief else f"{NAMES[result.method]} ({status_word(result)}): {words}"


def _step_at(run: RelaxationRun, share: float) -> int:
    """The step at which nodes have gone a share of their way."""
    gone = np.linalg.norm(run.trajectory - run.trajectory[0], axis=2).sum(axis=1)
    return int(np.searchsorted(np.maximum.accumulate(gone), share * gone[-1]))


def _draw_nodes(axes: Axes, run: RelaxationRun, step: int, *, springs: bool) -> None:
    """The polyline and its nodes at a step, with all springs or with the straightening forces."""
    now = run.trajectory[step]
    axes.plot(*run.trajectory[0].T, color=GRID_COLOUR, linewidth=1, zorder=1)
    axes.plot(*now.T, color="#222222", linewidth=1.6, zorder=3)
    if springs:
        i, j = np.triu_indices(len(now), 1)
        lines = np.stack((now[i], now[j]), axis=1)
        axes.add_collection(
            LineCollection(list(lines), colors=SPRING_COLOUR, linewidths=0.4, alpha=0.5, zorder=2)
        )
    else:
        force = straightening(now, 0.02)
        force[run.fixed] = 0
        axes.quiver(*now.T, *force.T, color=FORCE_COLOUR, scale=12, width=0.008, zorder=4)
    axes.plot(*now[~run.fixed].T, "o", color=BEFORE_COLOUR, markersize=3, zorder=5)
    mark_robots(axes, now[run.fixed], size=6)
    grid_axes(axes)


def _draw_trajectories(axes: Axes, run: RelaxationRun) -> None:
    """The way of every node, from the grid to the end."""
    axes.plot(*run.trajectory[0].T, color=GRID_COLOUR, linewidth=1, zorder=1)
    axes.plot(*run.trajectory[-1].T, color="#222222", linewidth=1.2, zorder=2)
    ways = np.moveaxis(run.trajectory, 0, 1)
    axes.add_collection(
        LineCollection(list(ways[~run.fixed]), colors=FORCE_COLOUR, linewidths=1, zorder=3)
    )
    grid_axes(axes)
