"""The folder of a flight: everything that somebody needs to look at it, check it and fly it."""

from __future__ import annotations

import json
from collections.abc import Mapping
from fnmatch import fnmatch
from pathlib import Path

from knotopt.flight.plan_file import FORMAT, plan_to_json
from knotopt.mission.content import mission_content
from knotopt.mission.mission import Mission
from knotopt.viewer.page import flight_page

MARK = "plan.json"
"""The file that every such folder has."""

PAGE = "viewer.html"

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
    PAGE,
)

OLDER = ("report.html",)
"""Names of files that earlier versions wrote."""


def flight_files(mission: Mission) -> dict[str, str | bytes]:
    """All files of a flight but the pictures, by name."""
    texts = {
        MARK: plan_to_json(mission.plan),
        **mission.exports,
        "check.json": json.dumps(mission_content(mission), indent=1, allow_nan=False) + "\n",
    }
    records = [
        (name, flight.record) for name, flight in mission.flights if flight.examination is not None
    ]
    rows: list[Mapping[str, str]] = [
        {
            "flight": name,
            "planned": row.planned or "nothing",
            "result": row.result,
            "what happened": row.happened,
        }
        for name, row in mission.crossings()
    ]
    measures = [*mission.measures(), *(("not good", reason) for reason in mission.reasons)]
    page = flight_page(mission.plan, records, measures, rows, texts)
    return {**texts, PAGE: page}


def flight_pictures(mission: Mission) -> dict[str, bytes]:
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

    plan = mission.plan
    pictures = {"flight.png": figure_bytes(flight_figure(plan), "png")}
    for name, flight in mission.flights[:1]:
        if flight.examination is not None:
            title = f"{plan.name}: {plan.robots} robots, {name} flight: {flight.verdict}"
            strip = strip_figure(flight.record, plan, title=title)
            pictures["strip.png"] = figure_bytes(strip, "png")
            pictures["flight.gif"] = animate(plan, flight.record, title)
    return pictures


def why_kept(path: Path) -> str:
    """Why a folder that is there already is not one of a flight, to be replaced by a new one.

    A file of the user's own in it would be lost.
    """
    for entry in sorted(path.iterdir()):
        if entry.is_dir() or not any(fnmatch(entry.name, name) for name in (*NAMES, *OLDER)):
            return f"holds {entry.name}, which is no file of a flight: name another folder"
    try:
        with (path / MARK).open(encoding="utf-8") as stream:
            is_flight = FORMAT in stream.read(200)
    except (OSError, UnicodeDecodeError):
        is_flight = False
    return "" if is_flight else f"has no {MARK} of a flight in it: name another folder"
