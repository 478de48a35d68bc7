"""Ways of the leader through laid cable, on random chains of straight spans."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest
import shapely
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from knotopt.arrays import FloatArray
from knotopt.flight.gates import Gate, RouteShape
from knotopt.flight.laid_cable import hanging_cable
from knotopt.flight.layout import Letter
from knotopt.flight.route import HeightShape, Passage, SpanRoute, build_route
from knotopt.flight.router import Router, Way

SHAPE = RouteShape()


def chain(seed: int, robots: int) -> FloatArray:
    """Places of robots at random, not too close, no three nearly in line."""
    random = np.random.default_rng(seed)
    places: list[FloatArray] = []
    while len(places) < robots:
        place = random.uniform(0, 6, 2)
        if all(np.hypot(*(place - other)) > 1.5 for other in places):
            places.append(place)
    return np.array(places)


def laid_spans(places: FloatArray) -> list[FloatArray]:
    return [np.stack(ends) for ends in pairwise(places)]


def roomy(places: FloatArray) -> bool:
    """Whether every robot is away from every span that is not its own."""
    spans = [shapely.LineString(span) for span in laid_spans(places[:-1])]
    for k, place in enumerate(places):
        point = shapely.Point(place)
        for j, span in enumerate(spans):
            if k not in (j, j + 1) and span.distance(point) < 0.7:
                return False
    return True


def crossings(way: Way, span: FloatArray) -> list[tuple[float, FloatArray, int]]:
    """Arc length, place and sense of each crossing of a way with a straight span."""
    start, ahead = span[0], span[1] - span[0]
    found, gone = [], 0.0
    for a, b in pairwise(way.points):
        piece, line = shapely.LineString([a, b]), shapely.LineString(span)
        met = piece.intersection(line)
        if not met.is_empty:
            place = shapely.get_coordinates(met).mean(axis=0)
            found.append((gone + float(np.hypot(*(place - a))), place))
        gone += float(np.hypot(*(b - a)))
    merged: list[tuple[float, FloatArray, int]] = []
    line = shapely.LineString(way.points)
    for at, place in found:
        if merged and at - merged[-1][0] < 1e-6:
            continue
        sides = [
            ahead[0] * (q.y - start[1]) - ahead[1] * (q.x - start[0])
            for q in (line.interpolate(max(at - 0.01, 0)), line.interpolate(at + 0.01))
        ]
        merged.append((at, place, int(np.sign(sides[1] - sides[0]))))
    return merged


@st.composite
def problems(draw: st.DrawFn) -> tuple[FloatArray, tuple[Letter, ...]]:
    """Places of the robots, the last one the goal, and a word for the way there."""
    spans = draw(st.integers(2, 4))
    places = chain(draw(st.integers(0, 2**32)), spans + 2)
    assume(roomy(places))
    letters = st.builds(
        Letter,
        st.integers(1, spans),
        st.booleans(),
        st.sampled_from([1, -1]),
        st.one_of(st.none(), st.floats(0, 9)),
    )
    word = draw(st.lists(letters, max_size=3))
    return places, tuple(word)


def found_way(
    places: FloatArray, word: tuple[Letter, ...], shape: RouteShape = SHAPE
) -> Way | None:
    router = Router(laid_spans(places[:-1]), places[:-1], places[-2], places[-1], shape)
    return router.find(word, {})


@settings(max_examples=40)
@given(problems())
def test_a_way_crosses_laid_cable_exactly_at_its_gates(
    problem: tuple[FloatArray, tuple[Letter, ...]],
) -> None:
    places, word = problem
    way = found_way(places, word)
    assume(way is not None)
    assert way is not None
    assert way.points[0] == pytest.approx(places[-2]) and way.points[-1] == pytest.approx(
        places[-1]
    )
    assert tuple(gate.letter for gate in way.gates) == word
    happened = []
    for older, span in enumerate(laid_spans(places[:-1]), 1):
        for at, place, sense in crossings(way, span):
            if at > 1e-6:  # the way begins where the last span ends
                happened.append((at, older, sense, place))
    happened.sort(key=lambda each: each[0])
    assert [each[1:3] for each in happened] == [(each.older, each.sense) for each in word]
    for (_, older, _, place), gate in zip(happened, way.gates, strict=True):
        assert place == pytest.approx(gate.place, abs=1e-6)
        start = places[older - 1]
        assert gate.along == pytest.approx(float(np.hypot(*(place - start))), abs=1e-6)
        # At a right angle, the run before and after it straight and free.
        ahead = places[older] - start
        assert abs(float(np.dot(ahead, gate.heading))) < 1e-9
        run = shapely.LineString([gate.entry, gate.exit])
        assert run.hausdorff_distance(run.intersection(shapely.LineString(way.points))) < 1e-6


def nearest_robot(places: FloatArray, word: tuple[Letter, ...]) -> float:
    """How near a way comes to a robot that is neither its start nor its goal."""
    way = found_way(places, word)
    assume(way is not None)
    assert way is not None
    line = shapely.LineString(way.points)
    return min(float(line.distance(shapely.Point(robot))) for robot in places[:-2])


@settings(max_examples=40)
@given(problems())
def test_a_way_keeps_clear_of_hovering_robots(
    problem: tuple[FloatArray, tuple[Letter, ...]],
) -> None:
    assert nearest_robot(*problem) >= SHAPE.clear - 1e-9


def gates_by_time(seed: int, times: list[float]) -> list[float]:
    """Over, under and again over one long span: places along it, as the grid visits them."""
    places = chain(seed, 4)
    places[1] = places[0] + 4.5 * (places[1] - places[0]) / np.hypot(*(places[1] - places[0]))
    assume(roomy(places))
    word = tuple(
        Letter(1, k % 2 == 0, 1 if k % 2 == 0 else -1, time) for k, time in enumerate(times)
    )
    way = found_way(places, word)
    assume(way is not None)
    assert way is not None
    along = [gate.along for gate in way.gates]
    return [place for _, place in sorted(zip(times, along, strict=True))]


@settings(max_examples=20)
@given(st.integers(0, 2**32), st.permutations([1.0, 2.0]))
def test_two_gates_of_one_span_are_apart_and_in_the_order_of_the_grid(
    seed: int, times: list[float]
) -> None:
    first, second = gates_by_time(seed, times)
    assert second - first >= SHAPE.apart - 1e-6


@settings(max_examples=20)
@given(st.integers(0, 2**32), st.permutations([0.0, 1.0, 2.0]))
def test_three_gates_of_one_span_are_apart_and_in_the_order_of_the_grid(
    seed: int, times: list[float]
) -> None:
    places = gates_by_time(seed, times)
    assert all(b - a >= SHAPE.apart - 1e-6 for a, b in pairwise(places))


@settings(max_examples=25)
@given(st.integers(0, 2**32), st.floats(0.5, 4.0), st.booleans())
def test_a_gate_keeps_its_place_among_earlier_crossings(
    seed: int, taken: float, later: bool
) -> None:
    places = chain(seed, 4)
    places[1] = places[0] + 4.5 * (places[1] - places[0]) / np.hypot(*(places[1] - places[0]))
    assume(roomy(places))
    router = Router(laid_spans(places[:-1]), places[:-1], places[-2], places[-1], SHAPE)
    way = router.find([Letter(1, True, 1, 5.0)], {1: [(4.0 if later else 6.0, taken)]})
    assume(way is not None)
    assert way is not None
    assert (way.gates[0].along > taken) is later


def ring(centre: FloatArray, radius: float) -> FloatArray:
    angle = 0.1 + np.arange(24) * np.pi / 12
    circle: FloatArray = centre + radius * np.stack((np.cos(angle), np.sin(angle)), axis=1)
    return np.concatenate((circle, circle[:1]))


@pytest.mark.parametrize("walled", [0, 1])
def test_there_is_no_way_out_of_a_ring_or_into_one(walled: int) -> None:
    ends = np.array([[0.0, 0.0], [4.0, 1.0]])
    free = Router([], ends, *ends, SHAPE).find((), {})
    assert free is not None and len(free.points) == 2
    assert Router([], ends, *ends, SHAPE, [ring(ends[walled], 1.2)]).find((), {}) is None


def test_a_way_leads_round_a_wall() -> None:
    ends = np.array([[0.0, 0.0], [4.0, 0.0]])
    wall = np.array([[2.0, -1.5], [2.0, 1.0]])
    way = Router([], ends, *ends, SHAPE, [wall]).find((), {})
    assert way is not None
    line = shapely.LineString(way.points)
    assert not line.intersects(shapely.LineString(wall))
    assert 2 * np.hypot(2, 1) <= line.length < 1.3 * 2 * np.hypot(2, 1)


def test_hovering_robots_close_a_gap() -> None:
    """Robots 0.7 apart between two walls leave no room, and leave some when fewer."""
    ends = np.array([[0.0, 0.0], [4.0, 0.0]])
    walls = [np.array([[2.0, -30.0], [2.0, -0.7]]), np.array([[2.0, 0.7], [2.0, 30.0]])]
    between = np.array([[2.0, -0.35], [2.0, 0.35]])
    for robots, open_ in ((between, False), (between[:0], True)):
        way = Router([], np.concatenate((ends, robots)), *ends, SHAPE, walls).find((), {})
        assert (way is not None) is open_


def test_a_span_too_short_for_a_gate_has_none() -> None:
    places = np.array([[0.0, 0.0], [0.5, 0.0], [0.5, 2.0], [-2.0, 1.0]])
    assert found_way(places, (Letter(1, True, 1, None),)) is None


@given(
    st.tuples(*[st.floats(-2, 2)] * 6),
    st.floats(1.0, 3.0),
    st.integers(2, 60),
)
def test_a_hanging_cable_has_its_length_and_hangs(
    ends: tuple[float, ...], share: float, count: int
) -> None:
    start, end = np.array(ends[:3]), np.array(ends[3:])
    distance = float(np.linalg.norm(end - start))
    assume(distance > 0.05)
    cable = hanging_cable(start, end, share * distance, count)
    assert cable.shape == (count, 3)
    assert cable[0] == pytest.approx(start, abs=1e-6) and cable[-1] == pytest.approx(end, abs=1e-6)
    fine = hanging_cable(start, end, share * distance, 2001)
    chords = np.linalg.norm(np.diff(fine, axis=0), axis=1)
    assert chords.sum() == pytest.approx(share * distance, rel=2e-3)
    if float(np.hypot(*(end - start)[:2])) > 0.02 * share * distance:
        assert np.ptp(chords) < 0.05 * chords.mean()  # evenly spaced
        across = fine[:, :2] - start[:2]
        chord = (end - start)[:2]
        assert np.abs(across[:, 0] * chord[1] - across[:, 1] * chord[0]).max() < 1e-6
        rate = np.hypot(*np.diff(fine[:, :2], axis=0).T)
        slopes = np.diff(fine[:, 2]) / np.maximum(rate, 1e-12)
        assert (np.diff(slopes) > -1e-4 * (1 + np.abs(slopes[1:]))).all()  # convex


def test_a_route_passes_its_gates_at_their_heights_and_its_robots_at_zero() -> None:
    """A way straight across two spans: over one, under the next."""
    places = np.array([[0.0, 0.0], [4.0, 0.0], [4.0, 3.0], [1.0, 3.0], [2.0, -2.0]])
    router = Router(laid_spans(places[:4]), places[:4], places[3], places[4], SHAPE)
    way = router.find((Letter(1, False, -1, None),), {})
    assert way is not None
    heights = HeightShape()
    passage = Passage(way.gates[0], -0.3, -0.3 - heights.below)
    spans = [SpanRoute(ends, ()) for ends in laid_spans(places[:4])]
    spans.append(SpanRoute(way.points, (passage,)))
    route = build_route(np.array([-3.0, 0.0]), spans)
    at = [int(np.argmin(np.abs(route.along - stop))) for stop in route.stops]
    assert route.points[at, :2] == pytest.approx(places, abs=1e-3)
    assert route.points[at, 2] == pytest.approx(0.0, abs=1e-3)
    (gate,) = route.passed
    here = route.points[int(np.argmin(np.abs(route.along - gate)))]
    assert here[:2] == pytest.approx(way.gates[0].place, abs=0.1)
    assert here[2] == pytest.approx(passage.height, abs=0.1)
    # Smooth: no corner that the ways have is left.
    turns = np.diff(route.points, n=2, axis=0)
    assert np.linalg.norm(turns, axis=1).max() < 0.02
    # Cable from robot 4 to the leader is at least as long as the leader ever is away.
    away = np.linalg.norm(way.points - places[3], axis=1).max()
    assert spans[-1].tether >= away - 1e-9


def test_a_place_that_is_passed_twice_has_two_gates_in_order() -> None:
    """Under the first span and, turning round, back over it at the same place."""
    places = np.array([[0.0, 0.0], [4.0, 0.0], [4.0, 3.0], [1.0, 3.0]])
    there = Gate(Letter(1, False, -1, None), (2.0, 0.0), (0.0, -1.0), 0.6, 2.0)
    back = Gate(Letter(1, True, 1, None), (2.0, 0.0), (0.0, 1.0), 0.6, 2.0)
    way = np.array([[4.0, 3.0], [2.0, 0.6], [2.0, 0.0], [2.0, -0.6], [2.2, -0.9], [2.0, -0.6]])
    way = np.concatenate((way, [[2.0, 0.0], [2.0, 0.6], [1.0, 3.0]]))
    span = SpanRoute(way, (Passage(there, -0.3, -1.5), Passage(back, -0.3, 0.6)))
    route = build_route(
        np.array([-3.0, 0.0]), [*(SpanRoute(ends, ()) for ends in laid_spans(places[:3])), span]
    )
    heights = np.interp(route.passed, route.along, route.points[:, 2])
    assert heights == pytest.approx([-1.5, 0.6], abs=0.1)
    turn = 2 * (0.6 + float(np.hypot(0.2, 0.3)))
    assert route.passed[1] - route.passed[0] == pytest.approx(turn, abs=0.1)
    assert span.up_to(1).points == pytest.approx(way[:4])
    assert span.up_to(2).points == pytest.approx(way[:8])
