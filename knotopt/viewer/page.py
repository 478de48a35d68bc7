"""A flight as one page that needs nothing else: `viewer.html`.

The scene is drawn by a few hundred lines on a canvas, with the page's own perspective: lines and
dots sorted by depth are all there is to show, and a 3-D library would be most of the file.
"""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from html import escape
from typing import Any

import numpy as np

from knotopt.document.pages import filled, page, part
from knotopt.flight.plan import FlightPlan
from knotopt.flight.record import FlightRecord
from knotopt.supports.regions import Regions
from knotopt.viewer.colours import ramp
from knotopt.viewer.packing import frame_count, packed_motion, packed_text, resampled
from knotopt.viewer.squares import active_layers

SCRIPTS = ("unpack", "catenary", "canvas", "flight", "scene", "above", "heights", "player")
ROUTE_POINTS = 1500  # of the leader's route that are drawn, at most
VERTICES = 400  # of a simulated cable that are drawn, at most
NUMBERS = 900_000  # in all simulated cables together, at most: about 1 MB


def flight_page(
    plan: FlightPlan,
    records: Sequence[tuple[str, FlightRecord]] = (),
    measures: Sequence[tuple[str, str]] = (),
    events: Sequence[Mapping[str, str]] = (),
    downloads: Mapping[str, str] | None = None,
) -> str:
    """The page of a flight, to be written as UTF-8.

    Parameters
    ----------
    plan : FlightPlan
    records : sequence of (name, FlightRecord)
        Flights of this plan to choose from; the first one is shown.
    measures : sequence of (name, value)
    events : sequence of mapping
        Rows of the table of crossings as executed: column to text. Columns are in the order in
        which they first occur.
    downloads : mapping, optional
        Texts to download: name of the file to content.

    Returns
    -------
    str
        HTML. Whatever the names and texts are, they are shown as text. The page loads nothing, and
        its content security policy lets nothing but its own script run.

    Raises
    ------
    RequirementError
        A plan or a record has positions that are not finite numbers.
    """
    scripts = (part(__package__, f"{name}.js") for name in SCRIPTS)
    script = '(() => {\n"use strict";\n' + "\n".join(scripts) + "\n})();"
    title = f"Flight of {plan.name}"
    parts = {
        "title": escape(title),
        "facts": _facts(plan),
        "notes": "".join(f"<li>{escape(note)}</li>" for note in plan.notes),
        "measures": _measures(measures),
        "planned": _planned(plan),
        "events": _events(events),
        "script": script,
        # No "<" is left that could end the element early.
        "data": json.dumps(_data(plan, records, downloads or {})).replace("<", "\\u003c"),
    }
    body = filled(part(__package__, "flight.html"), parts)
    return page(title, body, part(__package__, "flight.css"), script)


def _data(
    plan: FlightPlan, records: Sequence[tuple[str, FlightRecord]], downloads: Mapping[str, str]
) -> dict[str, Any]:
    every = np.linspace(0, len(plan.route) - 1, min(len(plan.route), ROUTE_POINTS)).astype(int)
    positions = resampled(plan.times, plan.positions, frame_count(plan.times))
    return {
        "name": plan.name,
        "colours": ramp(plan.robots),
        "duration": plan.duration,
        "lengths": plan.lengths.round(4).tolist(),
        "positions": packed_motion(positions, "the plan"),
        "route": packed_motion(plan.route[every][:, None], "the leader's route"),
        "step": plan.world.step,
        "altitude": plan.world.altitude,
        "size": plan.cable.diagram.size,
        "layers": active_layers(Regions(plan.cable)).tolist(),
        "crossings": [
            {
                "name": crossing.name,
                "span": crossing.span,
                "older": crossing.older,
                "over": bool(crossing.over),
                "place": [round(float(value), 4) for value in crossing.place],
                "height": round(float(crossing.height), 4),
                "cable": round(float(crossing.cable_height), 4),
                "time": round(float(crossing.time), 4),
            }
            for crossing in plan.crossings
        ],
        "records": [_record(name, record, len(records)) for name, record in records],
        "downloads": [[name, packed_text(text)] for name, text in downloads.items()],
    }


def _record(name: str, record: FlightRecord, count: int) -> dict[str, Any]:
    """A record in as many frames and vertices as fit beside the others."""
    vertices = record.cable.shape[1]
    shown = np.linspace(0, vertices - 1, min(vertices, VERTICES)).round().astype(np.int64)
    shown = np.union1d(shown, record.held)
    room = NUMBERS // (3 * len(shown) * count)
    frames = max(2, min(frame_count(record.times), room))
    cable = resampled(record.times, record.cable[:, shown], frames)
    return {
        "name": name,
        "start": float(record.times[0]),
        "duration": float(record.times[-1] - record.times[0]),
        "clock": resampled(record.times, record.clock, frames).round(3).tolist(),
        "held": np.searchsorted(shown, record.held).tolist(),
        "cable": packed_motion(cable, f"the record {name}"),
    }


def _facts(plan: FlightPlan) -> str:
    facts = [
        ("robots", str(plan.robots)),
        ("supports at turning points", ", ".join(map(str, plan.supports)) or "none"),
        ("chosen by", plan.chosen_by),
        ("cut", str(plan.cable.cut)),
        ("schedule", plan.schedule),
        ("time of flight", f"{plan.laid:.1f} s"),
        *([("pulling tight", f"{plan.tightening:.1f} s")] if plan.tightening else []),
        ("cable between robots, in all", f"{plan.lengths.sum():.2f} m"),
        ("crossings planned", str(len(plan.crossings))),
    ]
    return "".join(f"<div><dt>{name}</dt><dd>{escape(value)}</dd></div>" for name, value in facts)


def _measures(measures: Sequence[tuple[str, str]]) -> str:
    if not measures:
        return ""
    rows = "".join(
        f'<tr><th scope="row">{escape(name)}</th><td>{escape(value)}</td></tr>'
        for name, value in measures
    )
    return _section("measures", "Measures", f"<table><tbody>{rows}</tbody></table>")


def _planned(plan: FlightPlan) -> str:
    if not plan.crossings:
        return _section(
            "planned", "Planned crossings", "<p>The route crosses no cable that is laid.</p>"
        )
    rows: list[tuple[str, ...]] = []
    for index, crossing in enumerate(plan.crossings):
        x, y = crossing.place
        cells = (
            crossing.name,
            f"{x:.2f}, {y:.2f}",
            f"{crossing.height:.2f}",
            f"{crossing.cable_height:.2f}",
            f"{crossing.height - crossing.cable_height:+.2f}".replace("-", "\N{MINUS SIGN}"),
        )
        go = (
            f'<button type="button" class="go" data-crossing="{index}" '
            f'aria-label="Go to {crossing.time:.1f} seconds">{crossing.time:.1f}</button>'
        )
        rows.append((go, *cells))
    heads = ("time [s]", "crossing", "place [m]", "route [m]", "cable [m]", "gap [m]")
    return _section("planned", "Planned crossings", _table(heads, rows))


def _events(events: Sequence[Mapping[str, str]]) -> str:
    if not events:
        return ""
    heads = list(dict.fromkeys(column for row in events for column in row))
    rows = [[escape(row.get(head, "")) for head in heads] for row in events]
    return _section("events", "Crossings as executed", _table(heads, rows))


def _table(heads: Sequence[str], rows: Sequence[Sequence[str]]) -> str:
    """A table of texts over cells of HTML."""
    head = "".join(f'<th scope="col">{escape(text)}</th>' for text in heads)
    body = "".join("<tr>" + "".join(f"<td>{each}</td>" for each in row) + "</tr>" for row in rows)
    return f"<table><thead><tr>{head}</tr></thead><tbody>{body}</tbody></table>"


def _section(name: str, title: str, content: str) -> str:
    return (
        f'<section aria-labelledby="{name}"><h2 id="{name}">{title}</h2>'
        f'<div class="wide" tabindex="0" role="region" aria-labelledby="{name}">{content}</div>'
        "</section>"
    )
