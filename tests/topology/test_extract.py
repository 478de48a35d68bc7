"""States of polylines in space: against SnapPy on the same curve, and against moved points."""

from __future__ import annotations

from fractions import Fraction
from itertools import pairwise
from typing import Any

import numpy as np
import pytest
import spherogram
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from snappy.exterior_to_link.exceptions import GeneralPositionError
from snappy.exterior_to_link.link_projection import LinkProjection
from snappy.exterior_to_link.rational_linear_algebra import Matrix, Vector3

from knotopt.arrays import FloatArray, IntArray
from knotopt.cable.alexander import alexander_from_gauss, alexander_polynomial
from knotopt.cable.cable import Cable
from knotopt.cable.notation import gauss_code, pd_code
from knotopt.topology.ambiguity import Reason
from knotopt.topology.closure import brought_together, closed_gauss, closed_pd
from knotopt.topology.extract import PolylineError, extract_state
from knotopt.topology.state import RopeState
from knotopt.verify.crossings import curve_crossings
from tests.helpers.polylines import by_verifier, state_of
from tests.helpers.snappy_invariants import seifert_invariants
from tests.helpers.strategies import cables

Points = FloatArray


def random_points(seed: int) -> IntArray:
    rng = np.random.default_rng(seed)
    return rng.integers(-1000, 1000, size=(rng.integers(8, 21), 3))


def smooth_curve(rng: np.random.Generator, count: int = 64, waves: int = 9) -> Points:
    t = np.linspace(0, 1, count)[:, None]
    return sum(
        rng.normal(size=3) / k * np.cos(np.pi * k * t + rng.uniform(0, 2 * np.pi, 3))
        for k in range(1, waves + 1)
    )


@st.composite
def rope_points(draw: st.DrawFn, size: int = 9) -> Points:
    """Points in general position more often than not; heights far enough apart to matter."""
    corner = st.tuples(st.integers(-50, 50), st.integers(-50, 50), st.integers(-50, 50))
    points = np.array(draw(st.lists(corner, min_size=2, max_size=size)), dtype=float)
    assume((points != points[0]).any())
    return points


@st.composite
def grid_points(draw: st.DrawFn) -> Points:
    """Points on a small grid in plan, so that most degenerate places occur; heights apart."""
    corner = st.tuples(st.integers(0, 5), st.integers(0, 5))
    flat = draw(st.lists(corner, min_size=3, max_size=8))
    flat = [p for k, p in enumerate(flat) if k == 0 or p != flat[k - 1]]
    assume(len(flat) > 1)
    heights = draw(st.permutations(range(len(flat))))
    return np.array([(x, y, 10 * z) for (x, y), z in zip(flat, heights, strict=True)], dtype=float)


# Agreement with SnapPy on the same curve in space


def knot_agreed_with_snappy(seed: int) -> tuple[int, ...] | None:
    """Alexander polynomial, after SnapPy has looked at the closed curve from another direction.

    None where the points are not in general position seen from above.
    """
    points = random_points(seed)
    found = extract_state(points)
    if found.state is None:
        return None
    lifted = [[*points[end, :2].tolist(), height] for end, height in ((-1, 10**5), (0, 107_777))]
    expected = invariants_of(seen_by_snappy([*points.tolist(), *lifted]))
    assert alexander_from_gauss(*closed_gauss(found.state)) == expected[0]
    code = closed_pd(found.state)
    own = spherogram.Link([list(crossing) for crossing in code]) if code else spherogram.Link([])
    assert invariants_of(own) == expected
    return expected[0]


def seen_by_snappy(closed: list[list[int]]) -> spherogram.Link:
    """A link diagram of a closed polyline from a direction that is not from above."""
    component = [Vector3(point) for point in closed]
    for shear in range(1, 20):
        view = Matrix([[0, -2, -1], [1, 2 + shear, 2], [-1, 1 - shear, 0]])
        try:
            return LinkProjection([component], view).link()
        except GeneralPositionError:
            continue
    raise AssertionError("no view in general position")


def invariants_of(link: spherogram.Link) -> tuple[tuple[int, ...], int]:
    """Alexander polynomial and signature. Simplifies the link given."""
    link.simplify("basic")
    return seifert_invariants(link) if link.crossings else ((1,), 0)


def test_closed_curves_are_snappys_knots() -> None:
    found = [knot_agreed_with_snappy(seed) for seed in range(100)]
    assert found.count(None) < 4
    assert sum(knot not in {None, (1,)} for knot in found) > 13


@pytest.mark.slow
def test_2000_closed_curves_are_snappys_knots() -> None:
    found = [knot_agreed_with_snappy(seed) for seed in range(10_000, 12_020)]
    assert len(found) - found.count(None) >= 2000
    assert sum(knot not in {None, (1,)} for knot in found) > 300


def test_states_and_places_are_the_verifiers() -> None:
    for seed in range(60):
        points = smooth_curve(np.random.default_rng(seed))
        found = extract_state(points, plan_tolerance=0, height_tolerance=0)
        expected = curve_crossings(points)
        assert found.state == by_verifier(points) and found.state.is_planar
        where, which = expected.visits
        assert np.allclose(found.visits.parameter, where)
        assert np.allclose(found.visits.point, expected.point[which])
        assert np.allclose(np.abs(found.visits.gap), np.abs(expected.gap[which]))
        over = [entry & 2 > 0 for entry in found.state.code]
        assert (found.visits.gap > 0).tolist() == over


def test_ranges_lie_between_the_visits() -> None:
    points = smooth_curve(np.random.default_rng(3))
    found = extract_state(points)
    assert found.state is not None and found.state.crossings > 0
    assert found.ranges.shape == (2 * found.state.crossings + 1, 2)
    assert found.ranges[0, 0] == 0 and found.ranges[-1, 1] == len(points) - 1
    assert (found.ranges[:-1, 1] == found.ranges[1:, 0]).all()
    assert (found.ranges[:, 0] < found.ranges[:, 1]).all()
    place = [np.interp(found.ranges[1:, 0], range(64), column) for column in points.T]
    partner = np.array(found.state.code) >> 2
    assert np.allclose(place[0], place[0][partner]) and np.allclose(place[1], place[1][partner])
    assert np.allclose(found.visits.gap, place[2] - place[2][partner])


@given(rope_points())
def test_reflections_and_reversal(points: Points) -> None:
    found = extract_state(points)
    mirrored = extract_state(points * [1, -1, 1])
    backward = extract_state(points[::-1])
    below = extract_state(points * [1, 1, -1])
    if found.state is None:
        assert mirrored.state is backward.state is below.state is None
        return
    assert mirrored.state == found.state.mirror()
    assert backward.state == found.state.reverse()
    # Seen upside down every strand that was over is under, and the sign changes with it.
    assert below.state == RopeState(tuple(entry ^ 3 for entry in found.state.code))


@given(rope_points(), st.floats(0, 7), st.floats(-100, 100), st.floats(0.01, 100))
def test_motions_of_the_plane(points: Points, angle: float, shift: float, scale: float) -> None:
    found = extract_state(points)
    assume(found.state is not None)
    c, s = np.cos(angle), np.sin(angle)
    turned = scale * (points @ np.array([[c, s, 0], [-s, c, 0], [0, 0, 1]])) + shift
    tolerances = {"plan_tolerance": 1e-9, "height_tolerance": 1e-9}
    assert state_of(turned, **tolerances) == found.state


@given(rope_points(), st.lists(st.tuples(st.integers(0, 7), st.floats(0.1, 0.9)), max_size=8))
def test_points_added_on_the_segments(points: Points, added: list[tuple[int, float]]) -> None:
    found = extract_state(points)
    assume(found.state is not None)
    for segment, share in added:
        k = segment % (len(points) - 1)
        point = points[k] + share * (points[k + 1] - points[k])
        points = np.insert(points, k + 1, point, axis=0)
    again = extract_state(points)
    if again.state is None:  # an added point may come within tolerance of another strand's corner
        assert {ambiguity.reason for ambiguity in again.ambiguous} <= {Reason.FOLD, Reason.OVERLAP}
    else:
        assert again.state == found.state


@settings(max_examples=400)
@given(grid_points(), st.integers(0, 2**32))
def test_a_state_survives_every_motion_within_tolerance(points: Points, seed: int) -> None:
    """What is not called ambiguous is the state of all polylines nearby, by another program."""
    tolerance = 1e-3
    found = extract_state(points, plan_tolerance=tolerance)
    assume(found.state is not None and (np.abs(found.visits.gap) > 0.5).all())
    rng = np.random.default_rng(seed)
    for _ in range(8):
        angle, size = rng.uniform(0, 2 * np.pi, len(points)), rng.choice([0.1, 0.4, 0.499])
        moved = points.copy()
        moved[:, 0] += tolerance * size * np.cos(angle)
        moved[:, 1] += tolerance * size * np.sin(angle)
        assert by_verifier(moved) == found.state


@pytest.mark.parametrize("tolerance", [0.002, 0.01])
def test_points_closer_together_than_the_tolerance(tolerance: float) -> None:
    """Smooth motions by less than half the tolerance keep a state, however fine the points."""
    states = 0
    for seed in range(25):
        rng = np.random.default_rng(seed)
        points = smooth_curve(rng, count=400, waves=4)
        found = extract_state(points, plan_tolerance=tolerance, height_tolerance=0)
        if found.state is None or (np.abs(found.visits.gap) < 10 * tolerance).any():
            continue
        states += 1
        for waves in (3, 8, 20):
            motion = smooth_curve(rng, count=400, waves=waves) * [1, 1, 0]
            motion *= 0.4999 * tolerance / np.hypot(motion[:, 0], motion[:, 1]).max()
            assert by_verifier(points + motion) == found.state
    assert states >= 10


# Places that are ambiguous, one by one, each with two ways to move points that give other states


@given(cables(max_size=7))
def test_a_cable_laid_on_its_grid(cable: Cable) -> None:
    """Columns at height 1, rows at height 0, so that every corner is a vertical piece."""
    rows: list[tuple[int, int, int]] = []
    for (x, y), (a, b) in pairwise(cable.path):
        height = int(x == a)
        rows += [(x, y, height), (a, b, height)]
    state = state_of(rows)
    signs = cable.crossings.sign.tolist()
    assert state == RopeState.from_gauss(gauss_code(cable), signs)
    assert sorted(closed_pd(state)) == sorted(pd_code(cable))
    assert alexander_from_gauss(*closed_gauss(state)) == alexander_polynomial(cable)


def test_strands_nearly_parallel_are_placed_exactly() -> None:
    """Where floating point would lose the place, it is that of the rational numbers."""
    a, along, left = np.array([0.1, 0.2]), np.array([1000.2, 700.7]), np.array([-0.57, 0.82])
    c, d = a + 0.3 * along + 1e-9 * left, a + 0.71 * along - 2e-9 * left
    flat = [a, a + along, [0, 3000], c, d]
    points = [[*place, z] for place, z in zip(flat, (0, 0, 1, 1, 2), strict=True)]
    found = extract_state(points, plan_tolerance=0)
    assert found.state is not None and found.visits.segment.tolist() == [0, 3]
    (ax, ay), (bx, by), _, (cx, cy), (dx, dy) = (
        (Fraction(float(x)), Fraction(float(y))) for x, y in flat
    )
    turn = (bx - ax) * (dy - cy) - (by - ay) * (dx - cx)
    u = ((cx - ax) * (dy - cy) - (cy - ay) * (dx - cx)) / turn
    v = ((cx - ax) * (by - ay) - (cy - ay) * (bx - ax)) / turn
    assert found.visits.fraction.tolist() == [float(u), float(v)]
    assert found.visits.gap.tolist() == [-float(1 + v), float(1 + v)]


def test_many_points_go_through_in_blocks() -> None:
    points = smooth_curve(np.random.default_rng(8), count=2600, waves=6)
    found = extract_state(points, plan_tolerance=0, height_tolerance=0)
    assert found.state == by_verifier(points)


# Closing the rope


def test_the_closing_arc_takes_the_shortest_way() -> None:
    for seed in range(40):
        state = state_of(smooth_curve(np.random.default_rng(seed)))
        joined = brought_together(state)
        assert joined.is_planar
        assert brought_together(joined) == joined
        assert any({0, len(joined.code) * 2} <= set(face) for face in joined.faces)
        added = joined.crossings - state.crossings
        assert all(entry & 2 for entry in joined.code[len(joined.code) - added :])


def test_a_rope_without_crossings_closes_to_nothing() -> None:
    assert closed_pd(RopeState(())) == ()
    assert closed_gauss(RopeState(())) == ([], [], [])


# Wrong input


@pytest.mark.parametrize(
    ("points", "message"),
    [
        ([[0, 0], [1, 1]], r"shape \(2, 2\); expected \(m, 3\)"),
        ([0, 0, 0], r"shape \(3,\)"),
        ([[0, 0, 0]], "at least two points, not 1"),
        (np.zeros((0, 3)), "at least two points, not 0"),
        ([[0, 0, 0], [1, 0]], "not rows of three numbers"),
        ([[0, 0, 0], ["x", 0, 0]], "not rows of three numbers"),
        ([[0, 0, 0], [1, 0, 0], [1, float("nan"), 0]], r"row 2 is not finite: \[1.0, nan, 0.0\]"),
        ([[0, 0, 0], [float("inf"), 0, 0]], "row 1 is not finite"),
        ([[0, 0, 0], [-1e200, 0, 0]], "row 1 has coordinates beyond"),
        ([[1, 2, 3]] * 4, r"all 4 rows are the same point: \[1.0, 2.0, 3.0\]"),
    ],
)
def test_wrong_points_are_refused(points: Any, message: str) -> None:
    with pytest.raises(PolylineError, match=message):
        extract_state(points)


def test_wrong_tolerances_are_refused() -> None:
    points = [[0, 0, 0], [1, 0, 0]]
    with pytest.raises(PolylineError, match="the plan tolerance is -1; expected a length"):
        extract_state(points, plan_tolerance=-1)
    with pytest.raises(PolylineError, match="the height tolerance is nan"):
        extract_state(points, height_tolerance=float("nan"))
