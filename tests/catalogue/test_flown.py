"""The teams known to fly: what the catalogue says of them, and the stored flights."""

from __future__ import annotations

import json

import pytest

from benchmarks.flown import CATALOGUE, LEAST, smallest_teams
from knotopt.cable.cable import Cable
from knotopt.catalogue.flown import FlownTeam, flown_teams
from knotopt.catalogue.knots import shipped_knots
from knotopt.flight.limits import ROOM
from knotopt.identify.identify import identify


def test_the_file_is_what_the_flights_give() -> None:
    assert json.loads(CATALOGUE.read_text(encoding="utf-8")) == smallest_teams()


@pytest.mark.parametrize("team", flown_teams().values(), ids=lambda team: team.knot)
def test_a_team(team: FlownTeam) -> None:
    assert identify(team.diagram).name in (team.knot, f"m{team.knot}")
    assert {*team.supports} <= {*range(2, len(Cable(team.diagram, team.cut).path))}
    assert LEAST * team.flights <= team.tied <= team.flights
    assert team.robots >= 3 and team.step >= ROOM.step


def test_known_teams() -> None:
    teams = flown_teams()
    assert [teams[knot].robots for knot in ("3_1", "4_1", "5_1")] == [3, 4, 3]
    assert list(teams) == [knot for knot in shipped_knots() if knot in teams]
