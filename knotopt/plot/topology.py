"""All plans to a goal as one drawing: pictures of the states, and the actions between them."""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import FancyArrowPatch, FancyBboxPatch
from matplotlib.path import Path

from knotopt.arrays import FloatArray
from knotopt.errors import KnotoptError
from knotopt.plot.cable import CABLE_COLOUR
from knotopt.plot.figures import LEGEND
from knotopt.plot.plan_layout import (
    AIR,
    FONT,
    LINE,
    Joined,
    Label,
    joined_states,
    laid_out,
    text_width,
)
from knotopt.plot.rope import draw_rope
from knotopt.topology.actions import R1, R2, Action, C
from knotopt.topology.plan import PlanGraph
from knotopt.topology.state import RopeState

KINDS: dict[type[Action], tuple[str, str, Any]] = {
    R1: ("R1: a new loop", "#0072B2", "solid"),
    C: ("C: an end crosses", "#D55E00", "solid"),
    R2: ("R2: a finger", "#009E73", (0, (4, 1.5))),
}
"""What each kind of action is called, its colour and its line."""

HEAD, FOOT = 0.5, 0.36  # above and below the plans [inch]
NARROWEST = 4.4  # room for the legend [inch]
TITLE_FONT = 9.0  # [points]
SHIFT = 0.06  # between lines of two kinds that join the same states [inch]
FRAME_COLOUR, GOAL_COLOUR = "#CCCCCC", CABLE_COLOUR


def plan_figure(graph: PlanGraph, plans: int | None = None, title: str = "") -> Figure:
    """The states on plans by their numbers of crossings, and the actions between them.

    Each state is drawn as one rope that has it; goals' frames are dark. Actions of one kind with
    the same two states share a line, with all their labels. Where actions join more than 40
    pairs of states, pictures are smaller and labels are left out.

    Parameters
    ----------
    graph : PlanGraph
    plans : int, optional
        Draw only that many plans, the first that `graph.plans` gives; by default all.
    title : str
        By default the numbers of plans and states.

    Raises
    ------
    KnotoptError
        There is no plan to draw.
    """
    if not graph.steps or plans == 0:
        raise KnotoptError("there is no plan to draw")
    joined = joined_states(graph, plans)
    layout = laid_out(graph.start, joined)
    title = title or _summary(graph, plans, len(layout.place))
    low, high = layout.extent
    missing = max(NARROWEST, text_width(title, TITLE_FONT) + AIR) - (high - low)[0]
    aside = max(AIR, missing / 2)
    low, high = low - np.array((aside, FOOT)), high + np.array((aside, HEAD))
    figure = Figure(figsize=(high - low).tolist())
    axes = figure.add_axes((0, 0, 1, 1))
    axes.set(xlim=(low[0], high[0]), ylim=(low[1], high[1]))
    axes.axis("off")
    for pair, actions in joined.items():
        _draw_line(axes, layout.lines[pair], actions)
    for label in layout.labels:
        _draw_label(axes, label)
    for state, place in layout.place.items():
        _draw_state(axes, state, place, layout.side, is_goal=state in graph.goals)
    for number, x in layout.columns.items():
        words = f"{number} crossing" + "s" * (number != 1)
        y = high[1] - HEAD + 0.5 * AIR
        axes.text(x, y, words, fontsize=FONT, color="#888888", ha="center")
    axes.text(
        (low[0] + high[0]) / 2,
        high[1] - 0.5 * AIR,
        title,
        fontsize=TITLE_FONT,
        ha="center",
        va="top",
        parse_math=False,
    )
    figure.legend(handles=_handles(joined), loc="lower center", ncols=4, **LEGEND)
    return figure


def _summary(graph: PlanGraph, plans: int | None, states: int) -> str:
    total = f"{graph.plan_count} plan" + "s" * (graph.plan_count != 1)
    some = f"{plans} of " if plans is not None and plans < graph.plan_count else ""
    return f"{some}{total}, {states} states"


def _draw_state(
    axes: Axes, state: RopeState, place: tuple[float, float], side: float, *, is_goal: bool
) -> None:
    corner = (place[0] - side / 2, place[1] - side / 2)
    axes.add_patch(
        FancyBboxPatch(
            corner,
            side,
            side,
            boxstyle="round,pad=0,rounding_size=0.06",
            facecolor="white",
            edgecolor=GOAL_COLOUR if is_goal else FRAME_COLOUR,
            linewidth=1.0 if is_goal else 0.6,
            zorder=2,
        )
    )
    draw_rope(axes, state, centre=place, size=0.82 * side, width=1.1 if side > 0.6 else 0.9)


def _draw_line(axes: Axes, line: FloatArray, actions: list[Action]) -> None:
    """A line for each kind of action, side by side."""
    kinds = [kind for kind in KINDS if any(isinstance(action, kind) for action in actions)]
    for number, kind in enumerate(kinds):
        _, colour, style = KINDS[kind]
        shift = SHIFT * (number - (len(kinds) - 1) / 2)
        axes.add_patch(
            FancyArrowPatch(
                path=Path(line + np.array((0.0, shift))),
                arrowstyle="-|>,head_length=2.4,head_width=1.2",
                mutation_scale=1.0,
                color=colour,
                linestyle=style,
                linewidth=0.8,
                joinstyle="round",
                zorder=1,
            )
        )


def _draw_label(axes: Axes, label: Label) -> None:
    top = label.y + LINE * (len(label.actions) - 1) / 2
    for number, action in enumerate(label.actions):
        axes.text(
            label.x,
            top - LINE * number,
            str(action),
            fontsize=FONT,
            color=KINDS[type(action)][1],
            ha="center",
            va="center_baseline",
            bbox={"boxstyle": "square,pad=0.08", "facecolor": "white", "edgecolor": "none"},
            zorder=1.5,
        )


def _handles(joined: Joined) -> list[Line2D]:
    """For a legend: the kinds of actions that occur, and the rope's head."""
    found = {type(action) for actions in joined.values() for action in actions}
    handles = [
        Line2D([], [], color=colour, linestyle=style, linewidth=1, label=name)
        for kind, (name, colour, style) in KINDS.items()
        if kind in found
    ]
    head = Line2D(
        [], [], color=CABLE_COLOUR, marker="o", markersize=3, linestyle="", label="head of the rope"
    )
    return [*handles, head]
