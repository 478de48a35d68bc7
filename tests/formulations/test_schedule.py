"""Schedules along a path: against finite differences, closed forms and another solver."""

from __future__ import annotations

import itertools
import math

import cvxpy as cp
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from formulations import schedule as program
from formulations.schedule import Schedule, fastest_schedule, greedy_schedule, steady_schedule
from knotopt.arrays import FloatArray

Derivatives = tuple[FloatArray, FloatArray]

SPEED, ACCELERATION = 0.6, 1.5


class Waves:
    """Bodies on smooth random curves: sums of sines, drifting at one speed."""

    def __init__(self, seed: int, bodies: int, length: float = 4.0) -> None:
        random = np.random.default_rng(seed)
        self.length = length
        self.drift = random.normal(size=(bodies, 3))
        self.drift /= np.linalg.norm(self.drift, axis=1)[:, None]
        self.size = random.normal(size=(4, bodies, 3)) * 0.12
        self.rate = random.uniform(1.0, 4.0, size=(4, 1, 1))
        self.phase = random.uniform(0, 6.3, size=(4, bodies, 3))

    def __call__(self, s: FloatArray) -> FloatArray:
        waves = self.size * np.sin(self.rate * s[:, None, None, None] + self.phase)
        found: FloatArray = self.drift * s[:, None, None] + waves.sum(axis=1)
        return found

    def derivatives(self, s: FloatArray) -> Derivatives:
        angle = self.rate * s[:, None, None, None] + self.phase
        first = self.drift + (self.size * self.rate * np.cos(angle)).sum(axis=1)
        return first, -(self.size * self.rate**2 * np.sin(angle)).sum(axis=1)

    def nodes(self, count: int) -> FloatArray:
        return np.linspace(0, self.length, count)


class Line:
    """Several bodies on one straight line, some slower."""

    def __init__(self, shares: tuple[float, ...] = (1.0, 0.4)) -> None:
        self.shares = np.array(shares)

    def derivatives(self, s: FloatArray) -> Derivatives:
        first = np.zeros((len(s), len(self.shares), 3))
        first[:, :, 1] = self.shares
        return first, np.zeros_like(first)


class Stopping:
    """A file on a straight line, each body braking at its own place, as robots in flight do."""

    def __init__(self, stops: tuple[float, ...], braking: float) -> None:
        self.stops, self.braking = np.array(stops), braking

    def _left(self, s: FloatArray) -> FloatArray:
        left: FloatArray = np.clip(self.stops + self.braking - s[:, None], 0, 2 * self.braking)
        return left

    def __call__(self, s: FloatArray) -> FloatArray:
        b, left = self.braking, self._left(s)
        along = np.where(left < 2 * b, self.stops - left**2 / (4 * b), s[:, None])
        return np.stack((along, 0 * along, 0 * along), axis=2)

    def derivatives(self, s: FloatArray) -> Derivatives:
        b, left = self.braking, self._left(s)
        first, second = np.zeros((2, len(s), len(self.stops), 3))
        first[:, :, 0] = left / (2 * b)
        second[:, :, 0] = np.where((left > 0) & (left < 2 * b), -1 / (2 * b), 0.0)
        return first, second


def measured(
    path: Waves | Stopping, schedule: Schedule, interval: float = 0.002
) -> tuple[float, float]:
    """Largest speed and acceleration of any body, by differences of a finely sampled motion."""
    times = np.arange(0, schedule.duration, interval)
    positions = path(schedule.at(times))
    speeds = np.linalg.norm(np.diff(positions, axis=0), axis=2) / interval
    second = positions[2:] - 2 * positions[1:-1] + positions[:-2]
    return float(speeds.max()), float(np.linalg.norm(second, axis=2).max()) / interval**2


@settings(max_examples=8)
@given(st.integers(0, 2**32), st.integers(1, 5))
def test_the_fastest_keeps_limits_and_beats_the_others(seed: int, bodies: int) -> None:
    path = Waves(seed, bodies)
    nodes = path.nodes(150)
    arguments = (nodes, *path.derivatives(nodes), SPEED, ACCELERATION)
    fastest = fastest_schedule(*arguments)
    assert fastest.is_optimal
    speed, acceleration = measured(path, fastest)
    assert speed < 1.005 * SPEED
    assert acceleration < 1.03 * ACCELERATION
    # It uses what it may: some limit is met.
    assert speed > 0.97 * SPEED or acceleration > 0.97 * ACCELERATION
    for other in (greedy_schedule, steady_schedule):
        slower = other(*arguments)
        speed, acceleration = measured(path, slower)
        if acceleration < 1.0 * ACCELERATION and speed < 1.001 * SPEED:
            assert fastest.duration <= 1.002 * slower.duration


@settings(max_examples=40)
@given(st.integers(0, 2**32), st.integers(1, 5))
def test_steady_keeps_the_limits(seed: int, bodies: int) -> None:
    path = Waves(seed, bodies)
    nodes = path.nodes(150)
    speed, acceleration = measured(
        path, steady_schedule(nodes, *path.derivatives(nodes), SPEED, ACCELERATION)
    )
    assert speed < 1.005 * SPEED and acceleration < 1.03 * ACCELERATION


def test_greedy_keeps_the_limits() -> None:
    path = Waves(0, 1)
    nodes = path.nodes(150)
    speed, acceleration = measured(
        path, greedy_schedule(nodes, *path.derivatives(nodes), SPEED, ACCELERATION)
    )
    assert speed < 1.005 * SPEED and acceleration < 1.03 * ACCELERATION


@pytest.mark.parametrize(
    "schedule",
    [fastest_schedule, steady_schedule, greedy_schedule],
)
def test_a_file_that_brakes_keeps_the_limits(schedule: type) -> None:
    """Bodies brake while the path slows down for the last one."""
    braking = SPEED**2 / (2 * ACCELERATION)
    path = Stopping((1.0, 1.5, 1.55), braking)
    nodes = np.linspace(0, 1.55 + braking, 120)
    found = schedule(nodes, *path.derivatives(nodes), SPEED, ACCELERATION)
    speed, acceleration = measured(path, found, 0.01)
    assert speed < 1.005 * SPEED
    assert acceleration < 1.05 * ACCELERATION


@pytest.mark.parametrize("length", [0.1, 0.2, 0.5, 3.0, 12.0])
@pytest.mark.parametrize("shares", [(1.0,), (1.0, 0.4), (0.2, 0.0, 2.0)])
def test_a_straight_line_takes_the_bang_bang_time(length: float, shares: tuple[float, ...]) -> None:
    nodes = np.linspace(1.0, 1.0 + length, 250)
    found = fastest_schedule(nodes, *Line(shares).derivatives(nodes), SPEED, ACCELERATION)
    way = length * max(shares)
    if way > SPEED**2 / ACCELERATION:
        exact = way / SPEED + SPEED / ACCELERATION
    else:
        exact = 2 * math.sqrt(way / ACCELERATION)
    assert found.duration == pytest.approx(exact, rel=0.015)
    assert found.at(np.array([0.0, found.duration])) == pytest.approx([1.0, 1.0 + length])
    assert found.pace.max() * max(shares) <= SPEED * (1 + 1e-6)


def test_a_long_straight_line_of_many_nodes() -> None:
    for length, nodes in ((6.0, np.linspace(0, 6.0, 400)), (1.5, np.linspace(0, 1.5, 400))):
        arguments = (nodes, *Line((0.2, 0.0, 2.0)).derivatives(nodes), SPEED, ACCELERATION)
        found = fastest_schedule(*arguments)
        assert found.duration <= 1.001 * greedy_schedule(*arguments).duration
        exact = 2 * length / SPEED + SPEED / ACCELERATION
        assert found.duration == pytest.approx(exact, rel=0.015)


def test_a_circle_is_flown_at_the_speed_that_its_bend_allows() -> None:
    """Round a circle of radius r the centripetal v^2 / r bounds the speed but for the ends."""
    radius = 0.1
    nodes = np.linspace(0, 60 * radius, 600)
    angle = nodes / radius
    first = np.stack((-np.sin(angle), np.cos(angle), 0 * angle), axis=1)[:, None]
    second = -np.stack((np.cos(angle), np.sin(angle), 0 * angle), axis=1)[:, None] / radius
    found = fastest_schedule(nodes, first, second, SPEED, ACCELERATION)
    cruising = math.sqrt(ACCELERATION * radius)
    assert cruising < SPEED
    assert found.pace[150:450] == pytest.approx(cruising, rel=1e-3)
    # Up to speed: b' = 2 sqrt(a^2 - (b / r)^2), so b = r a sin(2 s / r), reached after pi r / 4.
    assert found.duration == pytest.approx(60 * radius / cruising, rel=0.02)
    assert found.duration > 60 * radius / cruising


def conic_duration(path: Waves, nodes: FloatArray, ends: tuple[float, float]) -> float:
    """The same convex program in conic form, all rows at once, by Clarabel."""
    first, second = path.derivatives(nodes)
    step = np.diff(nodes)
    b, root = cp.Variable(len(nodes)), cp.Variable(len(nodes))
    rows = [root <= cp.sqrt(b), b[0] == ends[0], b[-1] == ends[1]]
    for body in range(first.shape[1]):
        along, across = first[:, body], second[:, body]
        rows.append(cp.multiply(np.linalg.norm(along, axis=1) ** 2, b) <= SPEED**2)
        slope = cp.multiply(cp.diff(b), 0.5 / step)
        for at in (slice(0, -1), slice(1, None)):
            pull = [
                cp.multiply(across[at, k], b[at]) + cp.multiply(along[at, k], slope)
                for k in range(3)
            ]
            rows.append(cp.norm(cp.vstack(pull), axis=0) <= ACCELERATION)
    time = cp.sum(cp.multiply(2 * step, cp.inv_pos(root[:-1] + root[1:])))
    problem = cp.Problem(cp.Minimize(time), rows)
    problem.solve(solver=cp.CLARABEL)
    assert problem.status == cp.OPTIMAL
    return float(problem.value)


@pytest.mark.parametrize(("seed", "bodies"), [(1, 1), (2, 5)])
def test_the_optimum_is_the_global_one(seed: int, bodies: int) -> None:
    """Clarabel, which needs no derivatives and no start, finds the same flight time."""
    path = Waves(seed, bodies)
    nodes = path.nodes(120)
    found = fastest_schedule(nodes, *path.derivatives(nodes), SPEED, ACCELERATION)
    exact = conic_duration(path, nodes, (found.pace[0] ** 2, found.pace[-1] ** 2))
    assert found.duration == pytest.approx(exact, rel=2e-3)


@pytest.mark.parametrize("seed", [3, 4])
def test_rows_added_in_rounds_are_all_that_matter(
    seed: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = Waves(seed, 6)
    nodes = path.nodes(80)
    arguments = (nodes, *path.derivatives(nodes), SPEED, ACCELERATION)
    found = fastest_schedule(*arguments)
    solve = program._solve
    asked = []

    def with_all_rows(*given_: object) -> object:
        rows = np.asarray(given_[3])
        asked.append(rows.mean())
        return solve(*given_[:3], np.ones_like(rows), *given_[4:])  # type: ignore[arg-type]

    monkeypatch.setattr(program, "_solve", with_all_rows)
    at_once = fastest_schedule(*arguments)
    assert asked[0] < 0.5  # far fewer rows were begun with
    assert found.duration == pytest.approx(at_once.duration, rel=1e-3)


@settings(max_examples=40)
@given(st.integers(0, 2**32), st.sampled_from([greedy_schedule, steady_schedule]))
def test_a_schedule_never_goes_back_and_when_is_the_inverse_of_at(seed: int, make: type) -> None:
    path = Waves(seed, 2)
    nodes = path.nodes(60)
    found = make(nodes, *path.derivatives(nodes), SPEED, ACCELERATION)
    times = np.linspace(-1, found.duration + 1, 3000)
    at = found.at(times)
    assert (np.diff(at) >= -1e-12).all()
    assert at[0] == nodes[0] and at[-1] == pytest.approx(nodes[-1])
    assert found.at(found.times) == pytest.approx(nodes, abs=1e-9)
    assert np.abs(np.diff(at)).max() < 0.02  # no jumps
    inner = np.linspace(0.05, 0.95, 19) * found.duration
    for time, coordinate in zip(inner.tolist(), found.at(inner).tolist(), strict=True):
        assert found.when(coordinate) == pytest.approx(time, abs=2e-3 * found.duration)
        assert found.at(np.array([found.when(coordinate)])) == pytest.approx(coordinate, abs=0.01)


def test_a_faster_body_cannot_make_the_flight_longer() -> None:
    """The time falls with either limit, and scales as it must."""
    path = Waves(7, 3)
    nodes = path.nodes(100)
    derivatives = path.derivatives(nodes)
    durations = [
        fastest_schedule(nodes, *derivatives, k * SPEED, k**2 * ACCELERATION).duration
        for k in (1.0, 2.0, 3.0)
    ]
    for before, after in itertools.pairwise(durations):
        assert after < before
    assert durations[0] == pytest.approx(2 * durations[1], rel=1e-3)
    loose = fastest_schedule(nodes, *derivatives, SPEED, 2 * ACCELERATION)
    assert loose.duration <= durations[0] * (1 + 1e-4)
