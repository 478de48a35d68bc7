"""The check of trajectories: on curves whose speed and distances are known, and brute force."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from knotopt.arrays import FloatArray
from knotopt.verify.flight_limits import LimitsReport, check_limits

LIMITS: dict[str, float] = {
    "speed": 0.6,
    "acceleration": 1.5,
    "separation": 0.2,
    "downwash": 0.33,
    "floor": 0.3,
    "ceiling": 3.0,
}


def check(times: FloatArray, positions: FloatArray, **changed: Any) -> LimitsReport:
    lengths = changed.pop("lengths", np.full(positions.shape[1] - 1, 10.0))
    return check_limits(times, positions, lengths, **(LIMITS | changed))


def flight(dt: float = 0.05) -> tuple[FloatArray, FloatArray]:
    """Three robots in file fly 1 m, with ramps of 1.2 m/s² to 0.6 m/s, and hover before and after.

    The last starts after 2 s, each of the others 0.5 s after the one ahead.
    """
    times = np.arange(0, 8 + dt / 2, dt)
    ramp, rate = 0.5, 1.2

    def way(t: FloatArray) -> FloatArray:
        t = np.clip(t, 0, None)
        total = 1 / 0.6 + ramp
        up = np.minimum(t, ramp)
        down = np.clip(t - (total - ramp), 0, ramp)
        return rate * (up**2 / 2 + np.maximum(np.minimum(t, total) - ramp, 0) * ramp - down**2 / 2)

    x = np.stack([way(times - 2 - 0.5 * (2 - j)) + 0.3 * j for j in range(3)], axis=1)
    return times, np.stack((x, np.zeros_like(x), np.full_like(x, 2.0)), axis=2)


def test_a_flight_within_its_limits() -> None:
    times, positions = flight()
    report = check(times, positions, spacing=0.3, hover_before=2, hover_after=2.8, lengths=[1, 1])
    assert report.ok and report.broken == ()
    assert report.speed.value == pytest.approx(0.6)
    assert report.acceleration.value == pytest.approx(1.2)
    assert report.separation.value == pytest.approx(1.5)
    assert report.cable.value == pytest.approx(0.3 + 0.3, abs=1e-9)
    assert report.hover_before.value == pytest.approx(2, abs=0.06)
    assert report.hover_before.robots == (3,) and report.hover_after.robots == (1,)
    assert report.hover_after.value == pytest.approx(8 - 3 - 1 / 0.6 - 0.5, abs=0.1)


@pytest.mark.parametrize(
    ("changed", "sentence"),
    [
        ({"speed": 0.5}, "robot 1 flies at 0.600 m/s at 4.05 s; the limit is 0.5 m/s"),
        ({"acceleration": 1.0}, "robot 2 accelerates by 1.200 m/s² at 4.35 s; the limit is 1 "),
        ({"separation": 0.32}, "robots 2 and 3 come within 0.94 of their separation at 4.70 s"),
        ({"lengths": [1, 0.5]}, "the cable between robots 2 and 3 is stretched to 1.200 of its"),
        ({"floor": 2.1}, "robot 1 is at 2.000 m at 0.00 s, below the floor of 2.1 m"),
        ({"ceiling": 1.9}, "robot 1 is at 2.000 m at 0.00 s, above the ceiling of 1.9 m"),
        ({"hover_before": 2.5}, "robot 3 hovers 2.05 s before the flight, not 2.5 s"),
        ({"hover_after": 4}, "robot 1 hovers 2.90 s after the flight, not 4 s"),
        ({"spacing": 0.4}, "robots 1 and 2 start 0.300 m apart; the spacing is 0.4 m"),
    ],
)
def test_each_broken_limit_has_its_sentence(changed: dict[str, Any], sentence: str) -> None:
    times, positions = flight()
    (found,) = check(times, positions, **changed).broken
    assert found.startswith(sentence), found


def test_a_flight_that_does_not_start_or_end_at_rest() -> None:
    times, positions = flight()
    moving = (times > 3.7) & (times < 4.1)
    broken = check(times[moving], positions[moving]).broken
    assert [sentence[8:] for sentence in broken] == [
        "does not start at rest: 0.600 m/s",
        "does not end at rest: 0.600 m/s",
    ]


@given(st.floats(0.05, 2), st.floats(0.1, 4), st.sampled_from([0.01, 0.02, 0.05]), st.data())
def test_speed_and_acceleration_on_a_circle(
    radius: float, turning: float, dt: float, data: st.DataObject
) -> None:
    """Not above the true values, short of them by A h / 4 and J h / 3 at most; noise as stated."""
    window, noise = 0.1, data.draw(st.sampled_from([0.0, 1e-4, 1e-3]))
    times = np.arange(0, 3, dt)
    angle = turning * times
    circle = radius * np.stack((np.cos(angle), np.sin(angle), 0 * angle), axis=1)
    positions = np.stack((circle, circle + np.array([0, 5, 0])), axis=1)
    error = np.random.default_rng(data.draw(st.integers(0, 99))).normal(size=positions.shape)
    positions = positions + noise * error / np.linalg.norm(error, axis=2, keepdims=True)
    report = check(times, positions, window=window)
    speed, acceleration, jerk = (radius * turning**k for k in (1, 2, 3))
    low, high = 2 * noise / window, 4 * noise / window**2
    short = acceleration * window / 4
    assert speed - short - low <= report.speed.value * (1 + 1e-9)
    assert report.speed.value <= speed + low + 1e-9
    assert acceleration - jerk * window / 3 - high <= report.acceleration.value * (1 + 1e-9)
    assert report.acceleration.value <= acceleration + high + 1e-9


@given(st.integers(0, 2**32), st.integers(2, 4))
def test_separation_between_samples_against_dense_sampling(seed: int, robots: int) -> None:
    rng = np.random.default_rng(seed)
    times = np.arange(6.0)
    positions = rng.random((6, robots, 3))
    fine = np.linspace(0, 5, 5 * 400 + 1)
    dense = np.stack(
        [
            np.stack([np.interp(fine, times, positions[:, j, c]) for c in range(3)], axis=1)
            for j in range(robots)
        ],
        axis=1,
    )
    scaled = dense / [0.2, 0.2, 0.33]
    least = min(
        np.linalg.norm(scaled[:, i] - scaled[:, j], axis=1).min()
        for i in range(robots)
        for j in range(i)
    )
    found = check(times, positions, window=1).separation
    assert least - 0.03 <= found.value <= least + 1e-9  # a robot moves 8 units in 400 samples
    i, j = (robot - 1 for robot in found.robots)
    at = [np.interp(found.time, times, scaled) for scaled in (positions[:, i] - positions[:, j]).T]
    assert np.linalg.norm(np.array(at) / [0.2, 0.2, 0.33]) == pytest.approx(found.value, abs=1e-6)


def test_robots_that_meet_only_between_samples() -> None:
    times = np.linspace(0, 2, 3)
    positions = np.zeros((3, 2, 3))
    positions[:, 0, 0], positions[:, 1, 0] = [0, 1, 1], [1, 0, 0]
    positions[:, :, 2] = 1
    report = check(times, positions, speed=2, acceleration=9, window=1)
    assert report.separation.value == pytest.approx(0)
    assert report.separation.time == pytest.approx(0.5)


def test_one_robot_above_another_needs_the_downwash() -> None:
    positions = np.tile([[0.0, 0.0, 1.0], [0.0, 0.0, 1.3]], (5, 1, 1))
    report = check(np.arange(5) * 0.1, positions)
    assert report.separation.value == pytest.approx(0.3 / 0.33)
    assert report.broken == ("robots 1 and 2 come within 0.91 of their separation at 0.00 s",)


@pytest.mark.parametrize(
    ("spoil", "message"),
    [
        (lambda t, x: (t, x[:, :1]), "at least two robots"),
        (lambda t, x: (t[:-1], x), "need as many times"),
        (lambda t, x: (t, np.where(x == 2.0, np.nan, x)), "robot 1 at sample 0 is not finite"),
        (lambda t, x: (t**2, x), "not evenly spaced"),
        (lambda t, x: (t[:4], x[:4]), "4 samples are too few for a window of 0.1 s"),
    ],
)
def test_wrong_input(spoil: Any, message: str) -> None:
    times, positions = spoil(*flight())
    with pytest.raises(ValueError, match=message):
        check(times, positions)


def test_wrong_lengths() -> None:
    with pytest.raises(ValueError, match="3 robots need 2 lengths"):
        check(*flight(), lengths=[1.0])
    with pytest.raises(ValueError, match="lengths positive"):
        check(*flight(), lengths=[1.0, 0.0])
