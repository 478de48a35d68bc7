"""The independent check of paths: against SnapPy, made-up curves, and paths spoiled on purpose."""

from __future__ import annotations

import numpy as np
import pytest
import snappy
from hypothesis import given, settings
from hypothesis import strategies as st

from knotopt import Cable, Curve, best_cut, check_path, optimise_path, read, shipped_knots
from knotopt.cable.alexander import alexander_from_gauss, alexander_polynomial
from knotopt.path.result import FINE, robot_points
from knotopt.verify.alexander import POINTS, PRIME, alexander_values
from knotopt.verify.crossings import curve_crossings, grid_code
from knotopt.verify.path import alexander_of, closed_code, resample
from tests.helpers.snappy_invariants import seifert_invariants
from tests.helpers.strategies import cables


def value(polynomial: tuple[int, ...], t: int) -> int:
    inverse = pow(t, -1, PRIME)
    at = [sum(c * pow(x, k, PRIME) for k, c in enumerate(polynomial)) for x in (t, inverse)]
    return at[0] * at[1] % PRIME


@given(cables(3, 9))
def test_values_of_the_alexander_polynomial(cable: Cable) -> None:
    visits, signs = grid_code(cable.path)
    found = alexander_values([k for k, _ in visits], [over for _, over in visits], signs)
    assert found == tuple(value(alexander_polynomial(cable), t) for t in POINTS)


@given(cables(2, 10))
def test_gauss_code_of_the_grid(cable: Cable) -> None:
    visits, signs = grid_code(cable.path)
    _, which, over = cable.visits
    assert [k for k, _ in visits] == which.tolist()
    assert [o for _, o in visits] == over.tolist()
    assert signs == cable.crossings.sign.tolist()


def test_different_knots_have_different_values() -> None:
    by_values: dict[tuple[int, ...], set[tuple[int, ...]]] = {}
    for knot in shipped_knots().values():
        cable = Cable(knot.diagram, "L+")
        by_values.setdefault(alexander_of(grid_code(cable.path)), set()).add(
            alexander_polynomial(cable)
        )
    assert len(by_values) > 180 and all(len(each) == 1 for each in by_values.values())


@given(st.integers(0, 2**32), st.integers(4, 14))
@settings(max_examples=60)
def test_random_polygons_against_snappy(seed: int, count: int) -> None:
    """Crossings found on a random closed polygon make a planar diagram, of the knot that we say."""
    points = np.random.default_rng(seed).random((count, 3))
    closed = np.concatenate((points, points[:1] + 1e-9))
    visits, signs = curve_crossings(closed).code
    ours = alexander_from_gauss([k for k, _ in visits], [over for _, over in visits], signs)
    link = link_of_code(visits, signs)
    assert ours == (seifert_invariants(link)[0] if link is not None else (1,))


def link_of_code(visits: list[tuple[int, bool]], signs: list[int]) -> snappy.Link | None:
    """SnapPy's link of a Gauss code, through its PD code."""
    if not signs:
        return None
    arcs: dict[int, dict[str, int]] = {k: {} for k in range(len(signs))}
    for label, (crossing, over) in enumerate(visits):
        arcs[crossing]["over" if over else "under"] = label
    total = len(visits)
    code = []
    for crossing, sign in enumerate(signs):
        under, over = arcs[crossing]["under"], arcs[crossing]["over"]
        after_under, after_over = (under + 1) % total, (over + 1) % total
        if sign > 0:
            code.append([under, over, after_under, after_over])
        else:
            code.append([under, after_over, after_under, over])
    return snappy.Link(code)


def path_of_5_1() -> tuple[Cable, tuple[int, ...], np.ndarray]:
    chosen = best_cut(read("5").diagram)
    result = optimise_path(chosen.cable, chosen.supports)
    return chosen.cable, chosen.supports, result.curve.sample(FINE)


def test_a_changed_crossing_is_another_knot() -> None:
    cable, supports, points = path_of_5_1()
    robots = robot_points(cable, supports)
    good = check_path(points, cable.path, robots, 0.6)
    assert good.same_diagram and good.same_knot
    worst = good.crossings.first[2]
    at = resample(points, 0.02)[int(worst)]
    swapped = points.copy()
    near = np.linalg.norm(points[:, :2] - at[:2], axis=1) < 0.25
    swapped[near, 2] *= -1
    bad = check_path(swapped, cable.path, robots, 0.6)
    assert not bad.same_diagram and not bad.same_knot


def test_a_pulled_strand_changes_the_diagram_but_not_the_knot() -> None:
    """A Reidemeister move: a strand lifted over another one beside it."""
    cable, supports, points = path_of_5_1()
    s = np.linspace(0, 1, len(points))
    bump = np.exp(-(((s - 0.35) / 0.02) ** 2))
    moved = points.copy()
    moved[:, :2] += bump[:, None] * np.array([-2.5, -0.6])
    moved[:, 2] += 4 * np.exp(-(((s - 0.35) / 0.03) ** 2))
    report = check_path(moved, cable.path, robot_points(cable, supports), 0.6)
    assert not report.same_diagram and report.same_knot
    assert np.isnan(report.gap) and np.isnan(report.opening)


def test_distances_on_a_curve_known_by_hand() -> None:
    """A loop on the grid with one crossing: every distance can be read off."""
    path = [(1, 2), (3, 2), (3, 4), (2, 4), (2, 1), (4, 1), (4, 3), (1, 3)]
    height = {1: 0.0, 2: 0.0, 3: 0.0, 4: 0.0, 5: 0.4, 6: 0.4, 7: 0.4, 8: 0.4}
    corners = np.array([[c, r, height[k]] for k, (c, r) in enumerate(path, 1)], dtype=float)
    points = Curve(corners, is_smooth=False).sample(0.01)
    crossings = curve_crossings(resample(points, 0.02))
    assert crossings.point.round(2).tolist() == [[2.0, 2.0], [3.0, 3.0], [2.0, 3.0]]
    assert crossings.gap.round(1).tolist()[0] == -0.3
    report = check_path(points, path, corners[[0, -1]], 1.5)
    assert report.clearance == pytest.approx(1.0, abs=0.08)
    assert report.plan_length == pytest.approx(15.0, abs=1e-9)
    assert report.robots_off < 1e-6 and (report.lowest, report.highest) == (0.0, 0.4)


def test_turning_radius_of_a_circle() -> None:
    angle = np.linspace(0, 1.5 * np.pi, 4000)
    points = np.column_stack((2 * np.cos(angle), 2 * np.sin(angle), 0.1 * angle))
    report = check_path(points, [(1, 1), (2, 1)], points[[0, -1]], 0.6)
    helix = (2**2 + 0.1**2) / 2
    assert report.smallest_radius == pytest.approx(helix, rel=0.01)
    assert report.steepest == pytest.approx(0.05, rel=0.02)
    assert len(report.crossings) == 0 and report.tightest == -1


@pytest.mark.parametrize(
    ("points", "words"),
    [
        (np.array([[0.0, 0, 0], [np.nan, 1, 0], [2, 2, 0]]), "point 1 of the path is not finite"),
        (np.zeros((1, 3)), "at least two points"),
        (np.zeros((5, 2)), "at least two points"),
    ],
)
def test_points_that_are_no_path(points: np.ndarray, words: str) -> None:
    with pytest.raises(ValueError, match=words):
        check_path(points, [(1, 1), (2, 1)], np.zeros((2, 3)), 0.6)


def test_neighbourhoods_large_and_small() -> None:
    there = np.column_stack((np.linspace(0, 30, 601), np.zeros(601), np.zeros(601)))
    points = np.concatenate((there, there[::-1] + np.array([0, 0.3, 0])))
    path = [(1, 1), (31, 1), (31, 5), (1, 5)]
    for neighbourhood in (0.7, 20.0):
        report = check_path(points, path, points[[0, -1]], neighbourhood)
        assert report.clearance == pytest.approx(0.3, abs=1e-3)
    for wrong in (0.0, -1.0, float("nan")):
        with pytest.raises(ValueError, match="the neighbourhood is a positive length"):
            check_path(points, path, points[[0, -1]], wrong)


def test_strands_near_a_robot() -> None:
    points = np.array([[0.0, 0, 0], [4, 0, 0], [4, 0.5, 0.2], [-3, 0.5, 0.2]])
    dense = Curve(points, is_smooth=False).sample(0.01)
    path = [(1, 1), (2, 1)]
    report = check_path(dense, path, points[[0, -1]], 0.6)
    assert report.nearest_to_a_robot == pytest.approx(np.hypot(0.5, 0.2), abs=0.01)


def test_strands_that_touch_are_refused() -> None:
    touching = np.array([[0.0, 0, 0], [2, 0, 0], [2, 2, 0], [1, 2, 0], [1, 0, 0], [0, -1, 0]])
    with pytest.raises(ValueError, match="touch in a vertex, near"):
        curve_crossings(touching)


def test_the_tilted_view_is_another_diagram_of_the_same_knot() -> None:
    cable, _, points = path_of_5_1()
    tilted = closed_code(resample(points, 0.02))
    assert alexander_of(tilted) == alexander_of(grid_code(cable.path))
    mirrored = points * np.array([1.0, 1.0, -1.0])
    assert alexander_of(closed_code(resample(mirrored, 0.02))) == alexander_of(tilted)
