"""What is said of a set that was flown, by flights that are made up."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from knotopt.flight.record import Disturbance
from knotopt.rehearsal.flight_tests import FlightTests
from knotopt.sim.judge import Outcome, Verdict
from tests.helpers.small_flight import flown_set

TIED = Verdict(Outcome.TIED, "3_1", True, True, "1 - t + t^2")
STUCK = Verdict(Outcome.STUCK, "unknot", False, True, "1")


def test_a_set_ties_if_all_its_flights_do() -> None:
    one, three = flown_set(TIED), flown_set(TIED, TIED, STUCK)
    assert one.is_tied and one.lost is None and one.against == ""
    assert not three.is_tied and three.lost is three.disturbed[1]
    assert three.against == "stuck: unknot"
    assert replace(one, separation=0.953).against == "robots come within 0.95 of their separation"


def test_the_better_of_two_sets() -> None:
    tied, lost = flown_set(TIED), flown_set(STUCK)
    worse = [
        replace(tied, robust=3, given_up=("span 2 over span 1",)),
        replace(tied, robust=2),
        replace(tied, robust=3, separation=0.9),
        replace(lost, robust=3),
    ]
    ranks = [each.rank for each in (replace(tied, robust=3), *worse)]
    assert ranks == sorted(ranks, reverse=True) and len(set(ranks)) == len(ranks)


def test_notes_are_of_the_plan_and_nothing_else_changes() -> None:
    flown = flown_set(TIED)
    noted = flown.noted("passed over", "late")
    assert noted.plan.notes == (*flown.plan.notes, "passed over", "late")
    assert noted.undisturbed.record is flown.undisturbed.record and flown.plan.notes == ()


def test_a_flight_that_broke_down_says_so() -> None:
    flight = flown_set(STUCK).undisturbed
    broken = replace(flight.record, cable=np.full_like(flight.record.cable, np.nan))
    down = replace(flight, record=broken)
    assert down.examination is None and down.amiss == "the simulation broke down"
    assert down.came_of == down.why == "stuck: unknot; the simulation broke down"
    held = replace(flight, record=replace(flight.record, finished=False))
    assert held.came_of == "stuck: unknot, held back at 11.0 s of the plan"
    assert held.why == f"{held.came_of}; {held.amiss}" and held.amiss.startswith("span 4 over span")


def test_how_many_sets_are_flown() -> None:
    assert FlightTests().most_cut == FlightTests.MAX_CUT == 20
    assert FlightTests(max_cut=3, seconds=9.0).most_cut == 3
    assert FlightTests(seconds=9.0).most_cut == math.inf
    assert FlightTests(0.02, trials=2).disturbances == [
        Disturbance(0.02, seed=1),
        Disturbance(0.02, seed=2),
    ]
