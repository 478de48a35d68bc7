"""The taut string: shortest, by a certificate that shares nothing with how it was found."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from knotopt import (
    Cable,
    best_cut,
    best_supports,
    optimise_path,
    read,
    taut_length,
    taut_string,
)
from knotopt.errors import RequirementError
from knotopt.path.mesh import robot_times
from tests.helpers.strategies import cables

Word = tuple[tuple[int, int], ...]
Point = tuple[float, float]
TURN = 2 * np.pi
LEAN = 0.05  # of the rays to the right; grids here are so small that they stay in their column


def word(way: list[Point], robots: list[Point], ends: tuple[int, int]) -> Word:
    """Rays that a way crosses, freely reduced, without turns round the robots at its own ends.

    Each robot's ray goes up, leaning so that it passes no other robot nearby.
    """
    letters: list[tuple[int, int]] = []
    for (x0, y0), (x1, y1) in pairwise(way):
        hits = []
        for k, (x, y) in enumerate(robots):
            from_ray = [(px - x) - LEAN * (py - y) for px, py in ((x0, y0), (x1, y1))]
            if from_ray[0] * from_ray[1] < 0:
                share = from_ray[0] / (from_ray[0] - from_ray[1])
                if y0 + share * (y1 - y0) > y:
                    hits.append((share, (k, 1 if from_ray[1] > 0 else -1)))
        letters += [letter for _, letter in sorted(hits)]
    return reduced(letters, ends)


def reduced(letters: list[tuple[int, int]], ends: tuple[int, int]) -> Word:
    kept: list[tuple[int, int]] = []
    for letter in letters:
        if kept and kept[-1] == (letter[0], -letter[1]):
            kept.pop()
        else:
            kept.append(letter)
    while kept and kept[0][0] == ends[0]:
        kept.pop(0)
    while kept and kept[-1][0] == ends[1]:
        kept.pop()
    return tuple(kept)


def pushed_off(span: np.ndarray, robots: list[Point]) -> list[list[Point]]:
    """The span moved off the robots that it touches, round each by half a turn or more, so that a
    string there would be held by the robot: in all ways up to two turns."""
    touched: list[np.ndarray] = [span[0]]
    for a, b in pairwise(span):
        on = []
        for robot in map(np.array, robots):
            along, away = b - a, robot - a
            share = float(along @ away) / float(along @ along)
            if abs(along[0] * away[1] - along[1] * away[0]) < 1e-9 and 1e-9 < share < 1 - 1e-9:
                on.append((share, robot))
        touched += [robot for _, robot in sorted(on, key=lambda each: each[0])]
        touched.append(b)
    choices: list[list[Point]] = [[tuple(touched[0])]]
    for a, b, c in zip(touched, touched[1:], touched[2:], strict=False):
        start, end = (float(np.arctan2(*(x - b)[::-1])) for x in (a, c))
        arcs = [(end - start) % TURN + k * TURN for k in (-2, -1, 0, 1)]
        moved = [
            [b + 0.01 * np.array([np.cos(t), np.sin(t)]) for t in np.linspace(0, arc, 12) + start]
            for arc in arcs
            if abs(arc) > np.pi - 1e-9
        ]
        choices = [[*way, *map(tuple, points)] for way in choices for points in moved]
    return [[*way, tuple(touched[-1])] for way in choices]


@given(cables(2, 8), st.data())
@settings(max_examples=150)
def test_the_string_is_taut_and_passes_the_robots_as_the_cable_does(
    cable: Cable, data: st.DataObject
) -> None:
    """In the plane without the robots a curve that is taut, and homotopic to the cable's span, is
    the shortest of its class: locally shortest curves are unique there."""
    count = len(cable.path)
    supports = tuple(sorted(data.draw(st.sets(st.integers(2, count - 1), max_size=8))))
    times = robot_times(cable, supports)
    robots = [tuple(map(float, cable.cells[t])) for t in times]
    total = 0.0
    for k, span in enumerate(taut_string(cable, supports)):
        assert tuple(span[0]) == robots[k] and tuple(span[-1]) == robots[k + 1]
        assert all(tuple(point) in robots for point in span)
        corners = cable.times[(cable.times > times[k]) & (cable.times < times[k + 1])]
        inner = [tuple(cable.cells[t] + np.array([0.013, 0.007])) for t in corners]
        wanted = word([robots[k], *inner, robots[k + 1]], robots, (k, k + 1))
        ways = pushed_off(span, robots)
        assert wanted in [word(way, robots, (k, k + 1)) for way in ways]
        total += float(np.linalg.norm(np.diff(span, axis=0), axis=1).sum())
    assert taut_length(cable, supports) == pytest.approx(total)
    assert total <= cable.length + 1e-9


def test_all_turning_points_held_leave_the_grid_path() -> None:
    cable = best_cut(read("9").diagram).cable
    every = tuple(range(2, len(cable.path)))
    assert taut_length(cable, every) == pytest.approx(cable.length)
    assert all(len(span) == 2 for span in taut_string(cable, every))


def test_a_string_held_by_a_robot_bends_round_it() -> None:
    chosen = best_cut(read("9").diagram)
    spans = taut_string(chosen.cable, chosen.supports)
    assert max(len(span) for span in spans) > 2
    with pytest.raises(RequirementError, match="no support robot can be at p99"):
        taut_string(chosen.cable, (99,))


@pytest.mark.parametrize("name", ["3_1", "5_2", "7_4", "8_19", "9_20"])
def test_the_programs_path_passes_the_robots_as_the_cable_does(name: str) -> None:
    """So the taut string of the same class is a lower bound of its length."""
    for chosen in (best_cut(read(name).diagram), best_supports(read(name).diagram).best):
        cable, supports = chosen.cable, chosen.supports
        plan = optimise_path(cable, supports).curve.sample(0.01)[:, :2]
        times = robot_times(cable, supports)
        robots = [tuple(map(float, cable.cells[t])) for t in times]
        ends = [int(np.linalg.norm(plan - robot, axis=1).argmin()) for robot in robots]
        for k, (start, end) in enumerate(pairwise(ends)):
            corners = cable.times[(cable.times > times[k]) & (cable.times < times[k + 1])]
            inner = [tuple(cable.cells[t] + np.array([0.013, 0.007])) for t in corners]
            wanted = word([robots[k], *inner, robots[k + 1]], robots, (k, k + 1))
            way = [robots[k], *map(tuple, plan[start + 1 : end]), robots[k + 1]]
            assert word(way, robots, (k, k + 1)) == wanted
