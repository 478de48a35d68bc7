"""The catalogue of the smallest teams that fly, from the stored flights."""

from __future__ import annotations

import json
from collections.abc import Iterable
from pathlib import Path
from typing import Any

from benchmarks.physics import NOISE
from benchmarks.results import Row, load
from knotopt.catalogue.knots import shipped_knots
from knotopt.files import write_atomically
from knotopt.flight.limits import ROOM
from knotopt.reading.knot import read_knot

CATALOGUE = Path(__file__).parents[1] / "knotopt" / "catalogue" / "flown.json"
RESULTS = ("physics_fewest", "physics_safe", "physics", "physics_optimal", "physics_knots")
"""Benchmarks whose flights count; of equally small teams that of the first stands."""
LEAST = 0.75  # of the disturbed flights that a team must tie the knot in


def smallest_teams() -> list[dict[str, Any]]:
    """The smallest team of each knot, in the order of KnotInfo."""
    flown = [team for name in RESULTS for team in _teams(name, load(name)[1])]
    best: dict[str, dict[str, Any]] = {}
    for team in sorted(flown, key=lambda team: (len(team["supports"]), -_rate(team))):
        best.setdefault(team["knot"], team)
    return [best[knot] for knot in shipped_knots() if knot in best]


def write_catalogue() -> Path:
    """Write it, one knot to a line."""
    lines = ",\n".join(json.dumps(team) for team in smallest_teams())
    write_atomically(CATALOGUE, f"[\n{lines}\n]\n")
    return CATALOGUE


def _rate(team: dict[str, Any]) -> float:
    return float(team["tied"] / team["flights"])


def _teams(results: str, rows: Iterable[Row]) -> Iterable[dict[str, Any]]:
    for row in rows:
        if not row["planned"] or not row["tied"] or row["separation"] < 1:
            continue
        named = read_knot(row["row"])
        team = {
            "knot": named.prime_knot.name if named.prime_knot else named.name,
            "grid": row.get("grid", [list(mark) for mark in named.diagram.marks]),
            "cut": row["cut"],
            "supports": row["supports"],
            "step": row.get("step", ROOM.step),
            "tied": row["tied_disturbed"],
            "flights": len(row["disturbed"]),
            "noise": NOISE,
            "results": results,
        }
        if _rate(team) >= LEAST:
            yield team
