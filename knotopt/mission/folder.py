"""The folder of a flight: everything that somebody needs to look at it, check it and fly it."""

from __future__ import annotations

import json
from collections.abc import Mapping
from fnmatch import fnmatch
from pathlib import Path

from knotopt.flight.store import FORMAT, plan_to_json
from knotopt.mission.result import FlightResult
from knotopt.viewer.page import flight_page

MARK = "plan.json"
"""The file that every such folder has."""

NAMES = (
    MARK,
    "check.json",
    "waypoints.csv",
    "robot_*.csv",
    "crazyflies.yaml",
    "fly.py",
    "flight.gif",
    "flight.png",
    "strip.png",
    "report.html",
)


def flight_files(result: FlightResult) -> dict[str, str | bytes]:
    """All files of a flight but the pictures, by name."""
    plan = result.plan
    texts = {
        MARK: plan_to_json(plan),
        **result.exports,
        "check.json": json.dumps(result.content(), indent=1, allow_nan=False) + "\n",
    }
    records = [
        (flight.name, flight.record)
        for flight in (result.flown, result.failed)
        if flight is not None and flight.examination is not None
    ]
    rows: list[Mapping[str, str]] = [
        {
            "flight": name,
            "planned": row.planned or "nothing",
            "result": row.result,
            "what happened": row.happened,
        }
        for name, row in result.events()
    ]
    measures = [*result.measures(), *(("not good", reason) for reason in result.reasons)]
    page = flight_page(plan, records, measures, rows, texts)
    return {**texts, "report.html": page}


def flight_pictures(result: FlightResult) -> dict[str, bytes]:
    """`flight.png`, and `strip.png` of the undisturbed flight in physics.

    `flight.gif` is that flight moving.

    Raises
    ------
    MissingExtraError
        matplotlib is not installed (extra `viz`).
    """
    from knotopt.plot.animation import animate
    from knotopt.plot.figures import figure_bytes
    from knotopt.plot.flight import flight_figure, strip_figure

    plan, flown = result.plan, result.flown
    pictures = {"flight.png": figure_bytes(flight_figure(plan), "png")}
    if flown is not None and flown.examination is not None:
        title = f"{plan.name}: {plan.robots} robots, {flown.name} flight: {flown.verdict}"
        strip = strip_figure(flown.record, plan, title=title)
        pictures["strip.png"] = figure_bytes(strip, "png")
        pictures["flight.gif"] = animate(plan, flown.record, title)
    return pictures


def why_kept(path: Path) -> str:
    """Why a folder that is there already is not one of a flight, to be replaced by a new one.

    A file of the user's own in it would be lost.
    """
    for entry in sorted(path.iterdir()):
        if entry.is_dir() or not any(fnmatch(entry.name, name) for name in NAMES):
            return f"holds {entry.name}, which is no file of a flight: name another folder"
    try:
        with (path / MARK).open(encoding="utf-8") as stream:
            is_flight = FORMAT in stream.read(200)
    except (OSError, UnicodeDecodeError):
        is_flight = False
    return "" if is_flight else f"has no {MARK} of a flight in it: name another folder"
