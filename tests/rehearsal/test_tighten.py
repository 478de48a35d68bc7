"""Pulling a knot tight: the ends fly apart, the supports give way, the knot stays."""

from __future__ import annotations

from dataclasses import replace
from functools import cache
from types import SimpleNamespace

import numpy as np
import pytest

pytest.importorskip("mujoco")

from knotopt import Cable, shipped_knots
from knotopt.errors import RequirementError
from knotopt.export.crazyswarm import export_files
from knotopt.flight.examine import examine_flight, examine_plan
from knotopt.flight.limits import ROOM
from knotopt.flight.plan import FlightPlan
from knotopt.flight.planner import plan_flight
from knotopt.rehearsal import tighten
from knotopt.rehearsal.flown_set import FlownSet
from knotopt.rehearsal.tighten import check_tightening, tighten_flight
from knotopt.sim.judge import Outcome
from knotopt.sim.simulation import Simulation
from knotopt.sim.simulators import MUJOCO
from knotopt.sim.trials import Flight, fly_trial

DIAGRAM = shipped_knots()["3_1"].diagram
CABLE = Cable(DIAGRAM, "L+")


@cache
def laid() -> FlownSet:
    """The trefoil with a robot at every turning point, flown as modelled."""
    plan = plan_flight("3_1", CABLE, tuple(range(2, len(CABLE.path))))
    return FlownSet(fly_trial(plan), robust=3, steady=plan.duration)


@cache
def tight() -> FlownSet:
    return tighten_flight(laid(), 30.0)


def test_the_knot_is_smaller_and_still_the_knot() -> None:
    before, after = laid().plan, tight().plan
    assert after.tightening > after.limits.hover_after
    assert after.duration == pytest.approx(before.duration + after.tightening)
    assert after.laid == pytest.approx(before.duration)
    assert np.array_equal(after.positions[: after.laying], before.positions)
    assert np.array_equal(after.anchors, before.anchors)
    ends, supports = after.ends_apart, after.supports_within
    assert ends[0] == before.ends_apart[1] and supports[0] == before.supports_within[0]
    assert ends[1] > 1.5 * ends[0]
    assert (
        tight().undisturbed.verdict.outcome is Outcome.TIED
        and tight().undisturbed.verdict.closures_agree
    )
    assert tight().robust == 3
    assert len(after.notes) == len(before.notes) + 1
    assert f"pulled {ends[1]:.2f} m apart, not 30 m: " in after.notes[-1]


def test_limits_are_kept_and_crossings_are_those_of_laying() -> None:
    before, after = examine_plan(laid().plan), examine_plan(tight().plan)
    assert after.limits.broken == () and before.limits.broken == ()
    assert after.crossings == before.crossings and after.states == before.states
    flown = examine_flight(tight().plan, tight().undisturbed.record)
    assert flown.crossings == examine_flight(laid().plan, laid().undisturbed.record).crossings
    assert tight().undisturbed.record.finished
    _, fit = export_files(tight().plan)
    assert fit.broken == ()


def test_robots_pull_level_and_come_to_rest() -> None:
    plan = tight().plan
    pulled = plan.positions[plan.laying :]
    assert pulled[:, :, 2] == pytest.approx(ROOM.altitude)
    assert (
        np.abs(np.diff(pulled[-round(plan.limits.hover_after / plan.interval) :], axis=0)).max()
        == 0
    )
    assert np.linalg.norm(pulled[0] - plan.anchors, axis=1).max() < 1e-3


def test_ends_stop_where_they_are_to(monkeypatch: pytest.MonkeyPatch) -> None:
    tied = laid().undisturbed
    monkeypatch.setattr(tighten, "fly_trial", lambda plan, **_: replace(tied, plan=plan))
    monkeypatch.setattr(tighten, "fly_trials", lambda *_: [tied] * 3)
    ends = laid().plan.ends_apart[1]
    found = tighten_flight(laid(), ends + 0.5).plan
    assert found.ends_apart[1] == pytest.approx(ends + 0.5, abs=0.05)
    assert found.notes == laid().plan.notes


def test_a_flight_that_ties_nothing_is_not_pulled() -> None:
    flight = laid().undisturbed
    verdict = replace(flight.verdict, outcome=Outcome.WRONG_KNOT)
    lost = replace(laid(), undisturbed=replace(flight, verdict=verdict))
    found = tighten_flight(lost, 5.0)
    assert found.plan.tightening == 0 and np.array_equal(found.plan.times, lost.plan.times)
    assert found.plan.notes[-1] == "not pulled tight: the flight does not tie the knot"


def test_a_knot_that_a_pull_undoes_is_pulled_less(monkeypatch: pytest.MonkeyPatch) -> None:
    flown: list[float] = []

    def undone(at_most: int) -> None:
        def fly(plan: FlightPlan, **_: object) -> Flight:
            flown.append(plan.tightening)
            outcome = Outcome.TIED if len(flown) > at_most else Outcome.WRONG_KNOT
            flight = laid().undisturbed
            return replace(flight, plan=plan, verdict=replace(flight.verdict, outcome=outcome))

        flown.clear()
        monkeypatch.setattr(tighten, "fly_trial", fly)

    monkeypatch.setattr(
        tighten, "fly_trials", lambda *_: [SimpleNamespace(is_tied=True) for _ in range(3)]
    )
    undone(1)
    found = tighten_flight(laid(), 30.0).plan
    assert flown[0] > flown[1] == found.tightening
    assert found.notes[-1].endswith("apart, not 30 m: farther it is not the knot")
    undone(10)
    found = tighten_flight(laid(), 30.0).plan
    assert flown == sorted(flown, reverse=True) and len(flown) == len(tighten.SHARES)
    assert found.tightening == 0
    assert found.notes[-1] == "not pulled tight: no pull keeps the knot"


@pytest.mark.parametrize(
    ("knot", "cut", "apart", "words"),
    [
        ("8_9", "col9+", 5.0, r"those of cut col9\+ are inside: choose an outer cut"),
        ("3_1", "L+", 1.0, "are 1.00 m apart when it is laid; .* not 1 m"),
        ("3_1", "L+", float("nan"), "not nan m"),
        ("3_1", "L+", float("inf"), "not inf m"),
    ],
)
def test_what_cannot_be_meant(knot: str, cut: str, apart: float, words: str) -> None:
    with pytest.raises(RequirementError, match=words):
        check_tightening(Cable(shipped_knots()[knot].diagram, cut), apart, ROOM)


def row_of(count: int, length: float = 1.0) -> Simulation:
    start = np.column_stack((0.5 * np.arange(count), np.zeros(count), np.full(count, 2.0)))
    return MUJOCO.start(start, np.full(count - 1, length), step=0.5, speed=0.6)


def test_two_robots_pull_until_the_cable_holds_them() -> None:
    simulation = row_of(2)
    velocities = np.array([[-0.2, 0, 0], [0.2, 0, 0]])
    assert not simulation.pull(velocities, lambda _: True)
    record = simulation.record()
    assert not record.finished
    assert np.linalg.norm(np.diff(record.robots[-1], axis=0)) == pytest.approx(1.0, abs=0.03)


def test_a_robot_between_gives_way_at_its_height() -> None:
    simulation = row_of(3)
    velocities = np.array([[0.0, 0, 0], [0, 0, 0], [0.2, 0, 0]])
    middle = simulation.robots[1]
    assert simulation.pull(velocities, lambda robots: bool(robots[2, 0] < 3.0))
    assert simulation.record().finished
    after = simulation.robots
    assert after[2, 0] == pytest.approx(3.0, abs=0.02)
    assert after[1, 0] > middle[0] + 1.0 and after[1, 2] == pytest.approx(2.0, abs=0.05)
    assert simulation.clock == pytest.approx(simulation.record().clock[-1], abs=0.1)
