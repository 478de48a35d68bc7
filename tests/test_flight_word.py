"""The leader's crossings: against dense sampling, grid knots drawn out, and words made up."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray
from strategies import cables

from knotopt import Cable, shipped_knots
from knotopt.verify.flight import _crossings, leader_events, nearest_approaches
from knotopt.verify.flight_word import (
    RouteCrossing,
    catenary_height,
    compare_words,
    plan_word,
    reduced_word,
)

FloatArray = NDArray[np.float64]


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


@dataclass(frozen=True)
class Planned:
    """A planned letter."""

    span: int
    older: int
    over: bool
    sense: int


def executed(planned: Planned, route: float, gap: float | None = None) -> RouteCrossing:
    height = (0.2 if planned.over else -0.2) if gap is None else gap
    return RouteCrossing(
        planned.span, planned.older, height > 0, planned.sense, (0, 0), height, 0.0, route
    )


WORD = [Planned(4, 1, True, 1), Planned(4, 1, False, -1), Planned(4, 2, True, 1)]


def test_a_word_flown_as_planned() -> None:
    rows = compare_words(WORD, [executed(letter, k) for k, letter in enumerate(WORD)])
    assert [row.kind for row in rows] == ["as planned"] * 3
    expected = "span 4 under span 1: 1.00 m along the route, 0.20 m below the strand"
    assert rows[1].sentence == expected


def test_a_dip_that_was_too_shallow() -> None:
    """Under becomes over; then over and back over span 1 undo each other."""
    found = [executed(WORD[0], 1), executed(WORD[1], 2, 0.12), executed(WORD[2], 3)]
    rows = compare_words(WORD, found, [(0.0, 1.0), (0.03, 2.0), (0.0, 3.0)])
    assert [row.kind for row in rows] == ["missing", "wrong height", "as planned"]
    assert rows[0].sentence == (
        "span 4 over span 1: missing: crossed 1.00 m along the route and undone "
        "2.00 m along the route"
    )
    assert rows[1].sentence == (
        "span 4 under span 1: executed as over 2.00 m along the route: "
        "the leader was 0.12 m above the strand"
    )


def test_there_and_back_over_a_span_of_which_one_fails() -> None:
    """Planned over span 2 and back over it; the way back came out below, or not at all."""
    plan = [Planned(5, 2, True, -1), Planned(7, 2, True, 1), Planned(8, 3, True, 1)]
    way = executed(plan[0], 1), executed(plan[1], 2, -0.02), executed(plan[2], 3)
    assert [row.kind for row in compare_words(plan, way)] == [
        "as planned",
        "wrong height",
        "as planned",
    ]
    rows = compare_words(plan, [way[0], way[2]])
    assert [row.kind for row in rows] == ["as planned", "missing", "as planned"]
    assert [row.kind for row in compare_words(plan, way[2:])] == ["as planned"]


def test_a_letter_that_was_never_crossed() -> None:
    rows = compare_words(WORD[2:], [], [(0.3, 31.2)])
    assert [row.sentence for row in rows] == [
        "span 4 over span 2: missing: never crossed; nearest approach 0.30 m at 31.20 s of the plan"
    ]
    assert compare_words(WORD[2:], [])[0].sentence.endswith("missing: never crossed")


def test_a_single_letter_at_the_wrong_height_or_from_the_wrong_side() -> None:
    found = [executed(WORD[0], 1, -0.12), executed(replace(WORD[2], sense=-1), 3)]
    rows = compare_words([WORD[0], WORD[2]], found)
    assert [row.kind for row in rows] == ["wrong height", "wrong way"]
    assert rows[0].sentence == (
        "span 4 over span 1: executed as under 1.00 m along the route: "
        "the leader was 0.12 m below the strand"
    )
    assert rows[1].sentence.startswith("span 4 over span 2: crossed the other way, from left to r")


def test_missing_and_extra_letters() -> None:
    other, own = Planned(4, 3, False, 1), Planned(4, 5, True, 1)
    found = [executed(letter, k) for k, letter in enumerate([WORD[0], other, WORD[1], own])]
    rows = compare_words(WORD, found, [(0.0, 1.0), (0.0, 2.0), (math.inf, math.nan)])
    kinds = [row.kind for row in rows]
    assert kinds[:3] == ["as planned", "extra", "as planned"]
    assert sorted(kinds[3:]) == ["extra", "missing"]
    sentences = [row.sentence for row in rows]
    assert "extra: span 4 under span 3 1.00 m along the route" in sentences
    assert (
        "extra: on span 4 the leader crossed over its own tether 3.00 m along the route"
        in sentences
    )
    assert "span 4 over span 2: missing: the flight did not get that far" in sentences


@given(
    st.lists(
        st.builds(Planned, st.just(5), st.integers(1, 2), st.booleans(), st.sampled_from([1, -1])),
        max_size=12,
    )
)
def test_reduced_words(letters: list[Planned]) -> None:
    """Nothing is left to take out, and inserting a pair that undoes itself changes nothing."""
    word = reduced_word(letters)
    assert all(
        (a.older, a.over) != (b.older, b.over) or a.sense == b.sense for a, b in pairwise(word)
    )
    pair = [Planned(5, 1, True, 1), Planned(5, 1, True, -1)]
    for place in range(len(letters) + 1):
        assert reduced_word(letters[:place] + pair + letters[place:]) == word
    assert reduced_word([*letters, *(replace(x, sense=-x.sense) for x in letters[::-1])]) == ()
    rows = compare_words(letters, [executed(letter, k) for k, letter in enumerate(letters)])
    assert [row.kind for row in rows] == ["as planned"] * len(word)


def test_nearest_approach() -> None:
    """The leader passes span 1 at 0.3 m, half-way between its vertices; the flight stops early."""
    cable = np.zeros((3, 4, 3))
    cable[:, :3] = [[0, 0, 0], [2, 0, 0], [4, 0, 0]]
    cable[:, 3, :2] = [[1, 1], [1, 0.3], [1, 0.8]]
    held, passes, clock = [0, 1, 2, 3], [-1.0, 0.0, 1.5], [0.0, 1.0, 1.0]
    first, never = nearest_approaches(cable, held, passes, clock, [(2, 1), (3, 1)])
    assert first == pytest.approx((0.3, 1.0))
    assert never[0] == math.inf


@given(cables(2, 8))
@settings(max_examples=40)
def test_the_word_of_a_grid_path_flown_round_all_corners(cable: Cable) -> None:
    """Every corner an anchor, the route 0.6 above or below the grid at second visits."""
    crossings = sorted(cable.crossings, key=lambda crossing: crossing.second)
    along = np.arange(0, cable.length + 1e-9, 0.25)
    x, y = (np.interp(along, np.arange(cable.length + 1), axis) for axis in cable.cells.T)
    z = np.zeros_like(along)
    for crossing in crossings:
        z[np.abs(along - crossing.second) < 0.3] = -0.6 if crossing.first_over else 0.6
    route = np.stack((x, y, z), axis=1)
    way = np.concatenate(([0], np.cumsum(np.linalg.norm(np.diff(route, axis=0), axis=1))))
    anchors = np.column_stack((cable.points, np.zeros(len(cable.points))))
    lengths = np.diff(cable.times) * 1.001
    word = plan_word(route, np.interp(cable.times[:-1], along, way), anchors, lengths)
    assert len(word) == len(crossings)
    planned = []
    for found, crossing in zip(word, crossings, strict=True):
        assert found.place == pytest.approx((crossing.column, crossing.row), abs=1e-9)
        assert -0.4 < found.cable_height < 0
        older = int(np.searchsorted(cable.times, crossing.first))
        span = int(np.searchsorted(cable.times, crossing.second))
        sense = crossing.sign if crossing.first_over else -crossing.sign
        planned.append(Planned(span, older, not crossing.first_over, sense))
    assert [(f.span, f.older, f.over, f.sense) for f in word] == [
        (p.span, p.older, p.over, p.sense) for p in planned
    ]
    assert all(row.kind == "as planned" for row in compare_words(planned, word))


def test_a_route_above_the_anchors_but_below_a_taut_cable() -> None:
    """Over or under is decided by the catenary, not by the anchors' height."""
    anchors = [[0, 0, 2], [2, 0, 2], [1, 1, 2], [1, -1, 2]]
    route = [[0, 0, 2], [2, 0, 2], [1, 1, 2], [1, 0.2, 1.5], [1, -1, 1.5]]
    passes = np.concatenate(([0], np.cumsum(np.linalg.norm(np.diff(route, axis=0), axis=1))))[:3]
    for length, over in ((2.01, False), (3.0, True)):
        (found,) = plan_word(route, passes, anchors, [length, 2, 3])
        assert (found.span, found.older, found.over, found.sense) == (3, 1, over, -1)
        assert found.when == f"{found.route:.2f} m along the route"


@given(
    st.floats(0.05, 3),
    st.floats(-2, 2),
    st.floats(1e-6, 4),
    st.floats(0, 1),
)
def test_a_catenary_has_its_length_and_hangs(
    across: float, rise: float, slack: float, share: float
) -> None:
    length = math.hypot(across, rise) * (1 + slack)
    ends = np.array([[1.0, 2.0, 0.5], [1 + 0.6 * across, 2 + 0.8 * across, 0.5 + rise]])
    shares = np.linspace(0, 1, 401)
    z = np.array([catenary_height(*ends, length, float(u)) for u in shares])
    assert z[0] == pytest.approx(0.5) and z[-1] == pytest.approx(0.5 + rise)
    assert (np.diff(z, 2) > -1e-9).all()
    measured = np.hypot(np.diff(z), across * np.diff(shares)).sum()
    assert measured == pytest.approx(length, rel=2e-3)
    turned = catenary_height(ends[1], ends[0], length, 1 - share)
    assert catenary_height(*ends, length, share) == pytest.approx(turned, abs=1e-6)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"route": [[0, 0, 0]]}, "route: at least two points"),
        ({"passes": [0.0]}, "3 robots need one pass and one length less"),
        ({"lengths": [1.0, np.nan]}, "not finite"),
        ({"passes": [1.0, 0.5]}, "out of order"),
    ],
)
def test_wrong_plans(change: dict[str, object], message: str) -> None:
    plan: dict[str, object] = {
        "route": [[0, 0, 0], [2, 0, 0]],
        "passes": [0.0, 1.0],
        "anchors": [[0, 0, 0], [1, 0, 0], [2, 0, 0]],
        "lengths": [1.0, 1.0],
    }
    with pytest.raises(ValueError, match=message):
        plan_word(**(plan | change))  # type: ignore[arg-type]
