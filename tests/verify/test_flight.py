"""The leader's crossings: against dense sampling, and grid knots drawn out."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from knotopt import Cable, shipped_knots
from knotopt.arrays import FloatArray
from knotopt.verify.flight import _crossings, leader_events, nearest_approaches
from knotopt.verify.flight_word import (
    reduced_word,
)
from tests.helpers.strategies import cables


def moving(seed: int, samples: int = 4, vertices: int = 6) -> FloatArray:
    return np.random.default_rng(seed).normal(size=(samples, vertices, 3))


def brute_force(cable: FloatArray, steps: int = 3000) -> list[tuple[float, int, int, bool]]:
    """Time, edge, sense, over: where the leader changes sides between dense samples."""
    fine = np.linspace(0, len(cable) - 1, (len(cable) - 1) * steps + 1)
    k = np.minimum(fine.astype(int), len(cable) - 2)
    dense = cable[k] + (fine - k)[:, None, None] * (cable[k + 1] - cable[k])
    found = []
    for edge in range(cable.shape[1] - 2):
        a, b, p = dense[:, edge], dense[:, edge + 1], dense[:, -1]
        d, off = b - a, p - a
        side = np.sign(d[:, 0] * off[:, 1] - d[:, 1] * off[:, 0])
        share = (d[:, :2] * off[:, :2]).sum(axis=1) / (d[:, :2] ** 2).sum(axis=1)
        for i in np.flatnonzero(side[1:] != side[:-1]):
            if 0 < share[i] < 1:
                over = off[i, 2] > share[i] * d[i, 2]
                found.append((float(fine[i]), edge, int(side[i + 1]), bool(over)))
    return sorted(found)


@settings(max_examples=150)
@given(st.integers(0, 2**32))
def test_random_motion_against_dense_sampling(seed: int) -> None:
    cable = moving(seed)
    events = leader_events(np.arange(4.0), cable, [0, 2, 5], [0.0, 2.0])
    times = np.array([event.time for event in events])
    assume((np.diff(times) > 2e-3).all())  # else dense sampling mixes them up
    assume(all(0.01 < event.share < 0.99 for event in events))
    assume(all(abs(event.gap) > 0.02 for event in events))
    expected = brute_force(cable)
    assert [(e.edge, e.sense, e.over) for e in events] == [row[1:] for row in expected]
    assert np.allclose(times, [row[0] for row in expected], atol=2e-3)
    for event in events:
        assert event.older == (1 if event.edge < 2 else 2)
        assert event.span == (1 if event.time < 2 else 2)


@settings(max_examples=300)
@given(st.lists(st.integers(-1, 1), min_size=5 * 5 * 2, max_size=5 * 5 * 2))
def test_touching_at_vertices_and_samples_counts_as_if_the_leader_were_moved_a_little(
    coordinates: list[int],
) -> None:
    """On a 3 by 3 lattice nearly everything touches; a small shift of the leader decides all."""
    cable = np.ones((5, 7, 3))
    cable[:, :4, :2] = np.reshape(coordinates, (5, 5, 2))[:, :4]
    cable[:, 4:6, :2] = [[40, 30], [50, 40]]
    cable[:, 6, :2] = np.reshape(coordinates, (5, 5, 2))[:, 4]
    shifted = cable.copy()
    shifted[:, 6, :2] += [1e-4, 1e-9]
    assert net_crossings(cable) == net_crossings(shifted)


def net_crossings(cable: FloatArray) -> dict[tuple[int, int], int]:
    """Sum of senses for each interval and edge."""
    sums: dict[tuple[int, int], int] = {}
    interval, edge, sense, when, share = _crossings(cable[:, :, :2])
    assert ((when >= 0) & (when <= 1) & (share >= 0) & (share <= 1)).all()
    for k, e, each in zip(interval.tolist(), edge.tolist(), sense.tolist(), strict=True):
        sums[k, e] = sums.get((k, e), 0) + each
    return {where: total for where, total in sums.items() if total}


def drawn_out(cable: Cable, shift: float, step: float) -> tuple[FloatArray, FloatArray]:
    """A grid path being laid: vertices on it up to the leader's time, the others at the leader."""
    visited, _, over = cable.visits
    rest = np.unique(np.concatenate((np.arange(0, cable.length, 0.5), cable.times)))
    leader = np.append(np.arange(shift, cable.length, step), cable.length).astype(float)
    at = np.minimum(rest[None], leader[:, None])
    whole = np.arange(cable.length + 1)
    x, y = (np.interp(at, whole, axis) for axis in cable.cells.T)
    z = np.interp(at, visited, np.where(over, 0.3, -0.3)) if len(visited) else 0 * at
    return leader, np.stack((x, y, z), axis=2)


def assert_events_are_the_crossings(cable: Cable, shift: float, step: float) -> None:
    leader, laid = drawn_out(cable, shift, step)
    rest = laid[-1]
    corners = [int(np.flatnonzero((rest[:, :2] == point).all(axis=1))[0]) for point in cable.points]
    events = leader_events(leader, laid, corners, cable.times[:-1])
    crossings = sorted(cable.crossings, key=lambda crossing: crossing.second)
    assert len(events) == len(crossings)
    for event, crossing in zip(events, crossings, strict=True):
        assert event.time == pytest.approx(crossing.second, abs=1e-9)
        assert event.place == pytest.approx((crossing.column, crossing.row), abs=1e-9)
        assert event.over is not crossing.first_over
        assert event.sense == (crossing.sign if crossing.first_over else -crossing.sign)
        assert event.older == int(np.searchsorted(cable.times, crossing.first))
        assert event.span == int(np.searchsorted(cable.times, crossing.second))
        assert abs(event.gap) == pytest.approx(0.6, abs=0.1)  # sampled
        assert not event.own and not event.curl


@given(cables(2, 8), st.sampled_from([0.0, 0.13]), st.sampled_from([0.1, 0.25]))
@settings(max_examples=60)
def test_a_grid_path_drawn_out_gives_the_gauss_code(
    cable: Cable, shift: float, step: float
) -> None:
    assert_events_are_the_crossings(cable, shift, step)


@pytest.mark.parametrize("name", ["3_1", "4_1", "5_2", "7_6", "8_19", "9_2"])
def test_knots_of_the_catalogue_drawn_out(name: str) -> None:
    assert_events_are_the_crossings(Cable(shipped_knots()[name].diagram, "L+"), 0.0, 0.1)


def test_a_strand_that_moves_under_a_leader_at_rest() -> None:
    """The cable passes below the leader and back: two events that undo each other."""
    cable = np.zeros((5, 4, 3))
    cable[:, :3] = [[-3, -1, 1], [3, -1, 1], [9, 9, 1]]
    cable[:, :2, 1] = np.array([-1, 0.5, 1, 0.5, -1])[:, None]
    cable[:, 3] = [0, 0, 1.5]
    events = leader_events(np.arange(5.0), cable, [0, 1, 3], [-2.0, -1.0], clock=np.arange(5) / 2)
    assert [(e.over, e.sense, e.older, e.span, e.own) for e in events] == [
        (True, -1, 1, 2, False),
        (True, 1, 1, 2, False),
    ]
    assert [e.time for e in events] == pytest.approx([2 / 3, 3 + 1 / 3])
    assert [e.clock for e in events] == pytest.approx([1 / 3, 5 / 3])
    assert events[0].gap == pytest.approx(0.5)
    assert events[0].loop > 10 and reduced_word(events) == ()


def test_there_and_back_within_one_interval() -> None:
    """The strand turns so that it passes below the leader twice between two samples."""
    cable = np.zeros((2, 4, 3))
    cable[:, 2], cable[:, 3] = [9, 9, 0], [0, 0, 1]
    cable[:, :2, :2] = [[[-3, -3], [2, 3]], [[1, 3], [2, -4]]]
    first, second = leader_events([0, 1], cable, [0, 3], [0])
    assert (first.edge, second.edge, first.sense + second.sense) == (0, 0, 0)
    assert brute_force(cable) == [
        (pytest.approx(e.time, abs=1e-3), e.edge, e.sense, True) for e in (first, second)
    ]


def test_a_curl_in_the_tether_and_one_that_is_threaded() -> None:
    """A loop over the own tether is a curl unless other cable passes between its two strands."""
    tail = [[-5.0, 3.0, 2.0], [-4.0, 0.5, 1.0], [0.0, 0.0, 1.0], [2.0, 0.0, 1.0], [2.0, 1.0, 2.0]]
    cable = np.array([[*tail, [1.0, y, 2.0]] for y in (1.0, -1.0)])
    (event,) = leader_events([0, 1], cable, [0, 1, 5], [-1, 0])
    assert event.own and event.curl and event.loop == pytest.approx(1 + 2**0.5 + 1.25**0.5 * 0, 1)
    assert reduced_word([event]) == ()
    for height, curl in ((0.5, True), (5.0, False)):
        across = cable.copy()
        across[:, 0], across[:, 1] = [1.5, 3.0, height], [1.5, -3.0, height]
        found = leader_events([0, 1], across, [0, 1, 5], [-1, 0])
        assert [e.curl for e in found if e.edge == 2] == [curl]


def test_the_memory_is_bounded_and_the_parts_fit() -> None:
    """More samples than are looked at together: no event is lost where the parts meet."""
    t = np.linspace(0, 40 * np.pi, 1001)
    cable = np.zeros((len(t), 4, 3))
    cable[:, :3] = [[-9, 0, 0], [0, 0, 0], [0, -9, 0]]
    cable[:, 3] = np.stack((2 * np.cos(t) - 3, 2 * np.sin(t) + 0.1, 0 * t + 1), axis=1)
    events = leader_events(t, cable, [0, 1, 3], [0, 0])
    assert [e.sense for e in events] == [-1, 1] * 20


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"times": [0.0, 0.0]}, "times do not increase"),
        ({"times": [0.0]}, "need as many times"),
        ({"cable": np.zeros((2, 4, 2))}, "shape"),
        ({"cable": np.full((2, 4, 3), np.nan)}, "vertex 0 of the cable is not finite at sample 0"),
        ({"held": [0, 2]}, "robots hold vertices from 0 to 3"),
        ({"held": [0, 2, 2, 3], "span_times": [0, 0, 0]}, "do not increase"),
        ({"span_times": [0.0, 1.0]}, "2 robots need 1 times"),
        ({"clock": [0.0, np.inf]}, "a time is not finite"),
    ],
)
def test_wrong_flights(change: dict[str, object], message: str) -> None:
    given_: dict[str, object] = {
        "times": [0.0, 1.0],
        "cable": np.zeros((2, 4, 3)),
        "held": [0, 3],
        "span_times": [0.0],
    }
    with pytest.raises(ValueError, match=message):
        leader_events(**(given_ | change))  # type: ignore[arg-type]


def test_nearest_approach() -> None:
    """The leader passes span 1 at 0.3 m, half-way between its vertices; the flight stops early."""
    cable = np.zeros((3, 4, 3))
    cable[:, :3] = [[0, 0, 0], [2, 0, 0], [4, 0, 0]]
    cable[:, 3, :2] = [[1, 1], [1, 0.3], [1, 0.8]]
    held, passes, clock = [0, 1, 2, 3], [-1.0, 0.0, 1.5], [0.0, 1.0, 1.0]
    first, never = nearest_approaches(cable, held, passes, clock, [(2, 1), (3, 1)])
    assert first == pytest.approx((0.3, 1.0))
    assert never[0] == math.inf
