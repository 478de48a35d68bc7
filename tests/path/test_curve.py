"""Curves by arc length, heights over crossings, and the scale of the world."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.integrate import quad

from knotopt import Curve, PathRequirements, World, best_cut, optimise_path, read
from knotopt.errors import RequirementError
from knotopt.path.heights import height_arcs


@settings(max_examples=40)
@given(st.integers(0, 2**32), st.integers(3, 12), st.booleans())
def test_arc_length_is_arc_length(seed: int, count: int, smooth: bool) -> None:
    random = np.random.default_rng(seed)
    curve = Curve(np.cumsum(random.uniform(0.2, 1, (count, 3)), axis=0), smooth)
    s = np.linspace(0, curve.length, 4001)
    steps = np.linalg.norm(np.diff(curve.position(s), axis=0), axis=1)
    assert steps.sum() == pytest.approx(curve.length, rel=1e-3)
    if smooth:
        assert steps == pytest.approx(np.full(4000, curve.length / 4000), rel=1e-2)
        tangent = curve.tangent(s[1:-1])
        secant = (curve.position(s[2:]) - curve.position(s[:-2])) / (s[2] - s[0])
        assert np.abs(tangent - secant).max() < 0.02
        assert np.linalg.norm(tangent, axis=1) == pytest.approx(np.ones(3999))
    assert curve.position(curve.marks) == pytest.approx(curve.points, abs=1e-6)


def test_curvature_of_a_circle_and_its_length() -> None:
    angle = np.linspace(0, np.pi, 60)
    curve = Curve(np.column_stack((3 * np.cos(angle), 3 * np.sin(angle), 0 * angle)), True)
    assert curve.length == pytest.approx(3 * np.pi, rel=1e-5)
    middle = np.linspace(1, curve.length - 1, 50)
    assert curve.curvature(middle) == pytest.approx(np.full(50, 1 / 3), rel=1e-2)


def test_second_derivatives_are_continuous() -> None:
    random = np.random.default_rng(0)
    curve = Curve(np.cumsum(random.uniform(0.2, 1, (9, 3)), axis=0), True)
    inside = curve.marks[1:-1]
    before, after = curve.curvature(inside - 1e-6), curve.curvature(inside + 1e-6)
    assert before == pytest.approx(after, abs=1e-3)
    polyline = replace(curve, is_smooth=False)
    assert polyline.curvature(inside + 1e-6) == pytest.approx(np.zeros(len(inside)))


def test_metres() -> None:
    chosen = best_cut(read("3").diagram)
    world = World(step=0.5, altitude=2.0, floor=1.0, ceiling=3.0, downwash=0.2)
    asked = world.requirements(PathRequirements())
    assert (asked.gap, asked.floor, asked.ceiling) == (0.46, -2.0, 2.0)
    result = optimise_path(chosen.cable, chosen.supports, asked)
    metres, curve = world.measures(result), world.curve(result)
    assert metres["cable_length"] == pytest.approx(curve.length)
    assert metres["vertical_gap"] >= metres["vertical_gap_needed"] - 1e-3
    heights = curve.sample(0.01)[:, 2]
    assert metres["lowest"] == pytest.approx(heights.min(), abs=1e-2)
    assert metres["below_ceiling"] == pytest.approx(3.0 - heights.max(), abs=1e-2)
    length, _ = quad(lambda s: np.linalg.norm(curve.tangent(s)), 0, curve.length, limit=200)
    assert length == pytest.approx(result.curve.length * 0.5)


@pytest.mark.parametrize(
    ("wrong", "words"),
    [
        ({"step": 0.0}, "a grid step is a positive length in metres"),
        ({"step": -1.0}, "step is a length in metres"),
        ({"step": 0.5, "altitude": 3.0}, "the altitude 3 m is not between the floor 0.5 m"),
        ({"step": 0.5, "downwash": float("nan")}, "downwash is a length in metres"),
    ],
)
def test_worlds_that_make_no_sense(wrong: dict[str, float], words: str) -> None:
    with pytest.raises(RequirementError, match=words):
        World(**wrong)


def test_a_room_too_low_for_the_gap() -> None:
    with pytest.raises(RequirementError, match=r"no room for a gap of 0.33 m"):
        World(step=0.5, floor=1.4, ceiling=1.6)
    with pytest.raises(RequirementError, match="need some height"):
        World(step=0.5, drone_height=0, downwash=0)


@pytest.mark.parametrize(
    ("points", "words"),
    [
        ([[0.0, 0, 0], [np.nan, 0, 0]], "point 1 of the curve is not finite"),
        ([[0.0, 0, 0], [1, 0, 0], [1, 0, 0]], "points 1 and 2 of the curve coincide"),
        ([[0.0, 0, 0]], "a curve needs two points"),
        ([[0.0, 0], [1, 1]], "a curve needs two points"),
    ],
)
def test_points_that_are_no_curve(points: list[list[float]], words: str) -> None:
    with pytest.raises(RequirementError, match=words):
        Curve(np.array(points), True)


def test_arcs_are_flat_at_crossings_and_at_rest_at_robots() -> None:
    along = np.linspace(0, 10, 1001)
    heights = height_arcs(
        along, np.array([0, 500, 1000]), np.array([200]), np.array([300, 800]), 0.6
    )
    assert heights[[0, 200, 300, 500, 800, 1000]] == pytest.approx([0, 0.3, -0.3, 0, -0.3, 0])
    assert np.abs(heights).max() == pytest.approx(0.3)
    assert np.abs(np.diff(heights)[[199, 200, 299, 300]]).max() < 1e-3
