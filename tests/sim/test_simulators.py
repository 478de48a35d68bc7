"""Flights on a simulator that is made up: what flies knows of the protocol alone."""

from __future__ import annotations

import sys

import numpy as np
import pytest

from knotopt import Cable, read
from knotopt.errors import MissingExtraError
from knotopt.flight.planner import plan_flight
from knotopt.flight.record import Disturbance
from knotopt.flight.request import FlightRequest
from knotopt.mission.fly import fly_disturbed, rehearse_mission
from knotopt.rehearsal.cut_off import fly_set
from knotopt.rehearsal.flight_tests import FlightTests
from knotopt.rehearsal.rehearse import rehearse_flight
from knotopt.sim.judge import Outcome
from knotopt.sim.simulators import SIMULATORS, Simulator
from knotopt.sim.trials import fly_trial, fly_trials
from knotopt.supports.selection import GivenSupports
from tests.helpers.trailing_cable import TRAILING, TrailingCable

CABLE = Cable(read("3").diagram, "L+")
SMALLEST = GivenSupports(CABLE, (4, 5, 7))


@pytest.fixture(autouse=True)
def _without_mujoco(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "mujoco", None)


@pytest.mark.parametrize("knot", ["3_1", "4_1"])
def test_trials(knot: str) -> None:
    cable = Cable(read(knot).diagram, "L+")
    plan = plan_flight(knot, cable, tuple(range(2, len(cable.path))), schedule="fixed")
    flight = fly_trial(plan, simulator=TRAILING)
    assert flight.is_tied and flight.verdict.knot == knot and flight.amiss == ""
    assert flight.record.robots[-1] == pytest.approx(plan.anchors)
    bare = fly_trial(plan_flight(knot, cable, ()), simulator=TRAILING)
    assert bare.verdict.outcome is Outcome.WRONG_KNOT and bare.verdict.knot == "unknot"
    seeds = [Disturbance(noise=0.01, seed=seed) for seed in (4, 9)]
    flights = fly_trials(plan, seeds, TRAILING)
    assert [each.record.disturbance for each in flights] == seeds


def test_a_rehearsal() -> None:
    before = TrailingCable.started
    found = rehearse_flight(CABLE, SMALLEST.supports, FlightRequest("3_1", "milp"), 1, TRAILING)
    assert found.is_tied and found.robust == 3 and found.given_up == () and found.against == ""
    assert found.rehearsals == 1 and found.ways >= len(found.plan.crossings)
    assert TrailingCable.started - before == 1 + 1 + 3  # rehearsed, flown, flown disturbed
    assert np.array_equal(found.undisturbed.record.robots[0], found.plan.positions[0])


def test_a_set_that_is_tested() -> None:
    flown = fly_set("3_1", SMALLEST, FlightTests(noise=0.02, trials=2), TRAILING)
    assert [flight.record.disturbance for flight in flown.flights] == [
        Disturbance(),
        Disturbance(0.02, seed=1),
        Disturbance(0.02, seed=2),
    ]
    assert flown.is_tied and flown.lost is None


def test_a_mission() -> None:
    """Rehearsed, pulled tight, flown undisturbed and disturbed."""
    request = FlightRequest("3_1", "milp")
    mission = rehearse_mission([SMALLEST], request, tighten=2.0, simulator=TRAILING)
    mission = fly_disturbed(mission, [Disturbance(0.01, seed=7)], TRAILING)
    assert mission.plan.ends_apart[1] == pytest.approx(2.0, abs=0.05)
    assert [name for name, _ in mission.flights] == ["undisturbed"]
    assert [(each["flight"], each["outcome"]) for each in mission.disturbed] == [("seed 7", "tied")]


def test_the_registry() -> None:
    assert [(each.name, each.package, each.extra) for each in SIMULATORS.values()] == [
        ("mujoco", "mujoco", "sim")
    ]
    unheard = Simulator("unheard", "no_such_package", "sim", TrailingCable)
    start, lengths = np.array([[0.0, 0, 2], [1, 0, 2]]), np.array([1.5])
    for simulator in (*SIMULATORS.values(), unheard):
        with pytest.raises(MissingExtraError, match=f"a flight needs {simulator.package}, which"):
            simulator.start(start, lengths, step=0.5, speed=0.6)
    assert TRAILING.start(start, lengths, step=0.5, speed=0.6).record().finished
