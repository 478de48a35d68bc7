"""What the leader crosses: simple flights, and against the checker, which works otherwise."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from knotopt.arrays import FloatArray
from knotopt.flight.layout import Letter
from knotopt.flight.leader_crossings import happened_word, leader_crossings
from knotopt.flight.record import Disturbance, FlightRecord
from knotopt.verify.flight import leader_events

LAID = [[0.0, 0.0, 1.0], [2.0, 0.0, 1.0]]
"""One span along x; the robots that hold it hover at both its ends."""


def record(cable: FloatArray, held: list[int]) -> FlightRecord:
    """A flight whose samples are a second apart."""
    times = np.arange(len(cable), dtype=float)
    return FlightRecord(times, times, cable, np.array(held), True, 0.1, 0.0, Disturbance(), 0.0)


def leader_along(track: list[list[float]], tether: list[list[float]]) -> FlightRecord:
    """The leader flies a track on span 2, its tether held at (2, 0) and through given points."""
    cable = np.array([[*LAID, *tether, place] for place in track])
    return record(cable, [0, 1, cable.shape[1] - 1])


def test_a_strand_is_crossed_over_and_back_under() -> None:
    flight = leader_along(
        [[0.5, 1.0, 1.4], [0.5, -1.0, 1.4], [1.5, -1.0, 0.3], [1.5, 1.0, 0.3]], [[3.0, 0.0, 1.0]]
    )
    over, under = leader_crossings(flight, 2, 0.0)
    assert over.letter == Letter(1, True, -1, None) and over.gap == pytest.approx(0.4)
    assert under.letter == Letter(1, False, 1, None) and under.gap == pytest.approx(-0.7)
    assert not (over.is_own or under.is_own or over.is_curl or under.is_curl)
    assert happened_word((over, under)) == (over.letter, under.letter)
    assert leader_crossings(flight, 2, 1.0) == (under,)  # nothing that was before


def test_there_and_back_over_a_strand_is_nothing() -> None:
    flight = leader_along([[0.5, y, 1.4] for y in (1.0, -1.0, 1.0)], [[3.0, 0.0, 1.0]])
    found = leader_crossings(flight, 2, 0.0)
    assert [crossing.letter.sense for crossing in found] == [-1, 1]
    assert happened_word(found) == ()


def test_a_curl_of_the_tether_is_nothing_and_one_about_a_strand_is() -> None:
    """The leader crosses its own tether, without and with the laid span in the loop between."""
    tether = [[2.5, 0.0, 0.5], [2.5, 1.0, 0.5], [1.5, 1.0, 0.5]]
    free = leader_along([[2.2, 0.5, 2.0], [3.0, 0.5, 2.0]], tether)
    (curl,) = leader_crossings(free, 2, 0.0)
    assert curl.is_own and curl.is_curl and happened_word((curl,)) == ()
    assert curl.letter == Letter(2, True, -1, None)
    under_it = [[2.5, 0.0, 0.5], [2.5, 1.0, 0.5], [1.5, 1.0, 0.5], [1.5, -1.0, 0.5]]
    caught = leader_along([[2.2, 0.3, 2.0], [3.0, 0.3, 2.0]], under_it)
    (own,) = leader_crossings(caught, 2, 0.0)
    assert own.is_own and not own.is_curl
    assert happened_word((own,)) == (own.letter,)


@pytest.mark.parametrize("place", [0.5, 1.0])
@pytest.mark.parametrize("sample", [0.0, 0.3])
def test_a_crossing_at_a_vertex_or_at_a_sample_is_one(place: float, sample: float) -> None:
    laid = [[0.0, 0.0, 1.0], [1.0, 0.0, 1.0], [2.0, 0.0, 1.0]]
    track = [[place, y, 1.4] for y in (1.0, sample, -1.0)]
    cable = np.array([[*laid, [3.0, 0.0, 1.0], place] for place in track])
    found = leader_crossings(record(cable, [0, 2, 4]), 2, 0.0)
    assert [crossing.letter for crossing in found] == [Letter(1, True, -1, None)]


def moving_cable(seed: int) -> FlightRecord:
    """A cable of three spans at random, the leader flying smoothly about over and under it."""
    random = np.random.default_rng(seed)
    share = np.linspace(0, 1, 120)[:, None, None]
    start, drift = random.uniform(-2, 2, (13, 3)), random.normal(0, 0.3, (13, 3))
    cable = start + share * drift
    waves, phases = random.uniform(-1, 1, (2, 4, 3))
    angles = 2 * np.pi * (share * np.arange(1, 5)[:, None] + phases)
    cable[:, -1] = 2 * (waves * np.sin(angles)).sum(axis=1)
    return record(cable, [0, 4, 8, 12])


@settings(max_examples=60)
@given(st.integers(0, 2**32))
def test_the_checker_finds_the_same_crossings(seed: int) -> None:
    flight = moving_cable(seed)
    passes = np.array([0.0, 0.0, 0.0])
    events = leader_events(flight.times, flight.cable, flight.held, passes)
    found = leader_crossings(flight, 3, 0.0)
    by_the_checker = [(x.older, x.over, x.sense, x.own, x.curl) for x in events]
    by_the_maker = [
        (x.letter.older, x.letter.over, x.letter.sense, x.is_own, x.is_curl) for x in found
    ]
    # Two that come in one interval may be found in either order.
    assert sorted(by_the_maker) == sorted(by_the_checker)
    gaps = sorted(x.gap for x in found), sorted(x.gap for x in events)
    assert gaps[0] == pytest.approx(gaps[1], abs=0.1)
