"""Pictures of flights: what is planned, and instants of a flight as it happened (matplotlib)."""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from knotopt.arrays import FloatArray
from knotopt.flight.plan import FlightPlan
from knotopt.flight.record import FlightRecord
from knotopt.path.curve import length_along
from knotopt.plot.cable import CABLE_COLOUR, LIFTING_COLOUR, SUPPORT_COLOUR
from knotopt.plot.figures import PANEL, measured_axes, titled
from knotopt.plot.labels import HALO
from knotopt.plot.path import OVER_COLOUR, UNDER_COLOUR
from knotopt.viewer.colours import ramp

ROUTE_COLOUR = "#999999"
ELEVATION, TURN = 60.0, -15.0  # of the eye in a strip [degrees]
CABLE_WIDTH, CLEARED_WIDTH = 1.8, 4.2  # of a strand, and of what it clears below it [points]
_STROKES = ([0.0, 1.0], [-0.1, 1.1])  # what an edge clears and its own line, as shares of it
MARGIN = 0.25  # about the knot in a strip [m]


def flight_figure(plan: FlightPlan, title: str = "") -> Figure:
    """The planned flight: route over the laid cable, heights along the route, speeds over time.

    Parameters
    ----------
    plan : FlightPlan
    title : str
        By default the knot, the robots and the time of flight.
    """
    figure = Figure(figsize=(2.4 * PANEL, 1.45 * PANEL), layout="constrained")
    grid = figure.add_gridspec(2, 2, width_ratios=[1.0, 1.25])
    handles = draw_route(figure.add_subplot(grid[:, 0]), plan)
    draw_route_heights(figure.add_subplot(grid[0, 1]), plan)
    handles += draw_speeds(figure.add_subplot(grid[1, 1]), plan)
    words = f"{plan.name}: {plan.robots} robots, {plan.schedule} schedule, {plan.duration:.1f} s"
    return titled(figure, title or words, handles, 4)


def draw_route(axes: Axes, plan: FlightPlan) -> list[Line2D]:
    """The leader's route in plan over the laid cable, crossings marked; handles for a legend."""
    anchors = plan.anchors
    handles = axes.plot(*anchors[:, :2].T, color=CABLE_COLOUR, linewidth=2, label="laid cable")
    handles += axes.plot(
        *plan.route[:, :2].T, color=ROUTE_COLOUR, linewidth=1, label="leader's route", zorder=3
    )
    places = np.array([crossing.place for crossing in plan.crossings]).reshape(-1, 2)
    for over, (marker, colour, word) in _KINDS.items():
        chosen = [k for k, crossing in enumerate(plan.crossings) if crossing.over == over]
        label = f"passes {word}, and which span"
        handles += axes.plot(
            *places[chosen].T, marker, color=colour, markersize=6, label=label, zorder=4
        )
    for crossing in plan.crossings:
        axes.annotate(
            str(crossing.older),
            crossing.place,
            (7, -7),
            color=_KINDS[crossing.over][1],
            **_NUMBER,
        )
    handles += _draw_numbered(axes, anchors[:, :2])
    near = np.vstack((anchors[:, :2], places, plan.positions[0, -1:, :2]))
    low, high = near.min(axis=0) - plan.world.step, near.max(axis=0) + plan.world.step
    axes.set(xlim=(low[0], high[0]), ylim=(low[1], high[1]), aspect="equal")
    measured_axes(axes, "x [m]", "y [m]")
    axes.set_axisbelow(True)
    return handles


def draw_route_heights(axes: Axes, plan: FlightPlan) -> None:
    """Height along the leader's route, and the older cable's where it is crossed."""
    along = length_along(plan.route)
    axes.plot(along, plan.route[:, 2], color=ROUTE_COLOUR, linewidth=1.2)
    for crossing in plan.crossings:
        marker, colour, _ = _KINDS[crossing.over]
        at, heights = [crossing.route] * 2, [crossing.height, crossing.cable_height]
        axes.plot(at, heights, color=colour, linewidth=1)
        axes.plot(at[:1], heights[:1], marker, color=colour, markersize=5)
        axes.plot(at[1:], heights[1:], "_", color=CABLE_COLOUR, markersize=8, markeredgewidth=2)
        outside = 8 if crossing.over else -8
        axes.annotate(str(crossing.older), (at[0], heights[0]), (0, outside), **_NUMBER)
    axes.set_title("dashes: the older cable, with its span's number", fontsize=7)
    measured_axes(axes, "along the leader's route [m]", "height [m]")
    axes.margins(y=0.2)


def draw_speeds(axes: Axes, plan: FlightPlan) -> list[Line2D]:
    """Speed of every robot over time and the limit; a handle for a legend."""
    speeds = np.linalg.norm(np.diff(plan.positions, axis=0), axis=2) / plan.interval
    middle = (plan.times[1:] + plan.times[:-1]) / 2
    for speed, colour in zip(speeds.T[:-1], ramp(plan.robots)[:-1], strict=True):
        axes.plot(middle, speed, color=colour, linewidth=0.7)
    axes.plot(middle, speeds[:, -1], color=CABLE_COLOUR, linewidth=1)
    axes.set_title("black: the leader; colours: the robots behind it", fontsize=7)
    measured_axes(axes, "time [s]", "speed [m/s]")
    return [
        axes.axhline(
            plan.limits.speed, color=LIFTING_COLOUR, linestyle="--", linewidth=1, label="limit"
        )
    ]


def strip_figure(record: FlightRecord, plan: FlightPlan, count: int = 6, title: str = "") -> Figure:
    """Instants of a flight, seen from above at a slant: the cable by spans, upper strands whole.

    Parameters
    ----------
    record : FlightRecord
    plan : FlightPlan
        That was flown; gives the last crossing due at each instant.
    count : int
        Number of instants: evenly spaced while the leader is under way, the end last.
    title : str
    """
    columns = min(count, 3)
    rows = -(-count // columns)
    figure = Figure(figsize=(0.8 * PANEL * columns, 0.84 * PANEL * rows), layout="constrained")
    panels = np.atleast_1d(figure.subplots(rows, columns)).ravel()
    for axes in panels:
        axes.set_axis_off()
    seen = seen_from_above(record.cable)
    laid = seen[int(np.searchsorted(record.clock[:-1], plan.laid)), record.held, :2]
    for axes, frame in zip(panels, instants(record, plan, count), strict=False):
        draw_strands(axes, seen[frame], record)
        _draw_numbered(axes, seen[frame, record.held, :2])
        # Robots that still queue outside are left out of later pictures.
        here = np.concatenate((seen[frame, :, :2], laid))
        middle = (here.min(axis=0) + here.max(axis=0)) / 2
        half = float(np.ptp(here, axis=0).max()) / 2 + MARGIN
        (left, right), (bottom, top) = ((at - half, at + half) for at in middle.tolist())
        axes.set(xlim=(left, right), ylim=(bottom, top), aspect="equal")
        axes.set_title(caption(record, plan, frame), fontsize=7)
    figure.suptitle(title or f"{plan.name}: {plan.robots} robots", fontsize=9, parse_math=False)
    return figure


def caption(record: FlightRecord, plan: FlightPlan, frame: int) -> str:
    """The time of a frame, and what was due last by the plan."""
    clock = record.clock[frame]
    due = [crossing.name for crossing in plan.crossings if crossing.time <= clock]
    if clock > plan.laid + plan.interval:
        due.append("pulled tight")
    return ", ".join((f"{record.times[frame]:.1f} s", *due[-1:]))


def instants(record: FlightRecord, plan: FlightPlan, count: int) -> list[int]:
    """Frames of a strip: the last one, and others evenly from where the leader starts."""
    moves = np.flatnonzero(np.diff(plan.positions[:, -1], axis=0).any(axis=1))
    start = plan.times[moves[0]] if len(moves) else 0.0
    first = min(int(np.searchsorted(record.clock, start)), len(record.times) - 1)
    frames: list[int] = (
        np.linspace(first, len(record.times) - 1, count).round().astype(int).tolist()
    )
    return frames


def seen_from_above(points: FloatArray) -> FloatArray:
    """Points as an eye far away sees them: right, up, and towards the eye [m]."""
    turn, elevation = np.radians(TURN), np.radians(ELEVATION)
    right = points[..., 0] * np.cos(turn) - points[..., 1] * np.sin(turn)
    away = points[..., 0] * np.sin(turn) + points[..., 1] * np.cos(turn)
    up = points[..., 2] * np.cos(elevation) + away * np.sin(elevation)
    towards = points[..., 2] * np.sin(elevation) - away * np.cos(elevation)
    return np.stack((right, up, towards), axis=-1)


def draw_strands(axes: Axes, seen: FloatArray, record: FlightRecord) -> None:
    """The cable's edges from far to near; each clears its surroundings before it is drawn."""
    span = np.searchsorted(record.held, np.arange(len(seen) - 1), side="right") - 1
    colours = np.array(ramp(len(record.held)))[np.clip(span, 0, len(record.held) - 1)]
    start, way = seen[:-1, None], np.diff(seen, axis=0)[:, None]
    order = np.argsort((start + way / 2)[:, 0, 2])
    # One collection draws its lines in order, so both strokes of an edge follow each other. Its own
    # line is longer than what it clears, so that no joint opens.
    cleared, drawn = ((start + way * np.array(ends)[:, None])[order, :, :2] for ends in _STROKES)
    lines = np.stack((cleared, drawn), axis=1).reshape(-1, 2, 2)
    paint = [colour for edge in order for colour in ("white", colours[edge])]
    widths = [CLEARED_WIDTH, CABLE_WIDTH] * len(order)
    axes.add_collection(LineCollection(list(lines), colors=paint, linewidths=widths, zorder=2))


def _draw_numbered(axes: Axes, places: FloatArray) -> list[Line2D]:
    """Robots with their numbers, the leader a diamond; handles for a legend."""
    handles = []
    for at, label, marker, colour, size in (
        (places[:-1], "robots, numbered from the tail", "o", SUPPORT_COLOUR, 5),
        (places[-1:], "leader", "D", LIFTING_COLOUR, 5.5),
    ):
        handles += axes.plot(*at.T, marker, color=colour, markersize=size, label=label, zorder=5)
    for number, place in enumerate(places, 1):
        axes.annotate(str(number), tuple(place), (-6, 6), color="#444444", **_NUMBER)
    return handles


_KINDS = {True: ("^", OVER_COLOUR, "over"), False: ("v", UNDER_COLOUR, "under")}
_NUMBER: dict[str, Any] = {
    "textcoords": "offset points",
    "fontsize": 6.5,
    "ha": "center",
    "va": "center",
    "path_effects": HALO,
    "zorder": 6,
}
