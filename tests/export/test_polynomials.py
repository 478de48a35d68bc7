"""What a Crazyflie swarm takes, read by what knows the formats alone."""

from __future__ import annotations

import csv
from dataclasses import replace
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import yaml
from hypothesis import given, settings
from hypothesis import strategies as st

from knotopt.errors import FileFormatError, RequirementError
from knotopt.export.crazyswarm import export_files
from knotopt.export.fitting import fit_trajectories
from knotopt.export.polynomials import Polynomials, read_polynomials
from knotopt.export.recheck import recheck
from knotopt.export.stretch import TOLERANCE
from knotopt.export.waypoints import read_waypoints, waypoints_csv
from knotopt.flight.limits import ROOM, FlightLimits
from knotopt.flight.plan import FlightPlan
from tests.helpers.smooth_flight import AMPLE, flight


class Reader:
    """A file of 33 columns, from the description alone: Horner's rule on each piece in turn."""

    def __init__(self, text: str) -> None:
        header, *lines = csv.reader(text.splitlines())
        assert header[0].lower() == "duration"
        assert header[1:] == [f"{axis}^{k}" for axis in ("x", "y", "z", "yaw") for k in range(8)]
        assert 1 <= len(lines) <= 31
        assert all(len(line) == 33 for line in lines)
        self.pieces = [
            (float(line[0]), [[float(e) for e in line[1 + 8 * a : 9 + 8 * a]] for a in range(4)])
            for line in lines
        ]
        self.duration = sum(duration for duration, _ in self.pieces)

    def at(self, time: float) -> list[float]:
        for duration, axes in self.pieces:
            if time <= duration:
                return [self._value(axis, time) for axis in axes]
            time -= duration
        duration, axes = self.pieces[-1]
        return [self._value(axis, duration) for axis in axes]

    def jumps(self) -> list[float]:
        """Largest jump of each derivative up to the third, being at rest outside included."""
        worst = [0.0] * 4
        for order in range(4):
            for axis in range(4):
                ends = [
                    tuple(self._value(self._derivative(axes[axis], order), t) for t in (0, end))
                    for end, axes in self.pieces
                ]
                pairs = [(a[1], b[0]) for a, b in pairwise(ends)]
                if order:
                    pairs += [(0.0, ends[0][0]), (ends[-1][1], 0.0)]
                worst[order] = max([worst[order], *(abs(a - b) for a, b in pairs)])
        return worst

    @staticmethod
    def _value(coefficients: list[float], time: float) -> float:
        value = 0.0
        for coefficient in reversed(coefficients):
            value = value * time + coefficient
        return value

    @staticmethod
    def _derivative(coefficients: list[float], order: int) -> list[float]:
        for _ in range(order):
            coefficients = [k * c for k, c in enumerate(coefficients)][1:]
        return coefficients


def farthest(plan: FlightPlan, robot: int, reader: Reader, start: float = 0.0) -> float:
    """How far from the plan a file gets, between samples too, within its own time."""
    times = np.linspace(start, start + reader.duration, 1500)
    flown = np.array([reader.at(time) for time in times - start])[:, :3]
    planned = [np.interp(times, plan.times, plan.positions[:, robot, axis]) for axis in range(3)]
    return float(np.linalg.norm(flown - np.column_stack(planned), axis=1).max())


@settings(max_examples=15)
@given(
    bends=st.integers(0, 3),
    depth=st.floats(0, 0.8),
    seconds=st.floats(20, 40),
    interval=st.sampled_from((0.02, 0.05, 0.1)),
)
def test_files_follow_the_plan(bends: int, depth: float, seconds: float, interval: float) -> None:
    plan = flight(legs=(bends,), depth=depth, seconds=seconds, interval=interval)
    files, report = export_files(plan)
    assert report.reached, report.broken
    assert report.parts == 1
    for robot in range(plan.robots):
        reader = Reader(files[f"robot_{robot + 1:02d}.csv"])
        assert reader.duration == pytest.approx(plan.duration, abs=1e-4)
        assert farthest(plan, robot, reader) <= report.deviation.value + 1e-4
        position, velocity, acceleration, jerk = reader.jumps()
        assert max(position, velocity) < 1e-9 and max(acceleration, jerk) < 1e-7


@pytest.mark.parametrize("interval", [0.05, 0.1])
def test_sudden_starts_and_stops_are_smoothed_within_a_centimetre(interval: float) -> None:
    plan = flight(interval=interval)
    share = np.clip((plan.times - 3) / 15, 0, 1)[:, None, None]
    sudden = plan.positions[0] + share * (plan.anchors - plan.positions[0])
    files, report = export_files(replace(plan, positions=sudden, crossings=()))
    assert report.deviation.value <= TOLERANCE
    for robot in range(plan.robots):
        assert max(Reader(files[f"robot_{robot + 1:02d}.csv"]).jumps()) < 1e-7


@pytest.mark.parametrize("acceleration", [0.4, 1.0, 1.5])
def test_a_plan_near_its_limits_is_flown_within_them(acceleration: float) -> None:
    """Accelerations that jump, here by all they may less 5 %, are what a mere fit overshoots."""
    limits = FlightLimits(speed=0.5, acceleration=acceleration / 0.95)
    plan = flight(limits=limits, depth=0.0, seconds=6)
    pace = limits.speed / acceleration
    triangle = np.clip(np.minimum(plan.times - 3, 8 - plan.times) / pace, 0, 1)
    along = np.cumsum(triangle) * plan.interval * limits.speed
    positions = np.repeat(plan.positions[:1], len(plan.times), axis=0)
    positions[:, -1, 0] += along
    report = export_files(
        replace(plan, positions=positions, crossings=(), lengths=np.array([9, 12]))
    )[1]
    assert report.reached, report.broken
    assert report.speed.value > 0.49


def test_a_robot_that_never_moves_still_has_two_lines() -> None:
    """`numpy.loadtxt`, by which Crazyswarm2 reads the file, makes no table of one line."""
    plan = flight(robots=2)
    assert (plan.positions[:, 0] == plan.positions[0, 0]).all()
    pieces = Reader(export_files(plan)[0]["robot_01.csv"]).pieces
    assert len(pieces) == 2
    assert all(axes[0] == pytest.approx([1.0] + [0.0] * 7, abs=1e-9) for _, axes in pieces)


def test_a_long_flight_that_rests_is_cut_into_parts() -> None:
    plan = flight(legs=(9, 9, 9), seconds=30, interval=0.1)
    files, report = export_files(plan)
    assert report.reached, report.broken
    assert 1 < report.parts <= 3
    starts = {each.part: each.start for each in fit_trajectories(plan)}
    for part, start in starts.items():
        durations = set()
        for robot in range(plan.robots):
            reader = Reader(files[f"robot_{robot + 1:02d}_part{part}.csv"])
            durations.add(round(reader.duration, 4))
            assert farthest(plan, robot, reader, start) <= TOLERANCE
        assert len(durations) == 1
        assert start + durations.pop() == pytest.approx(starts.get(part + 1, plan.duration))


def test_a_long_flight_that_never_rests_says_how_far_off_it_is() -> None:
    plan = flight(legs=(60,), seconds=100)
    files, report = export_files(plan)
    assert report.parts == 1 and report.pieces <= 31 and not report.reached
    off = max(farthest(plan, j, Reader(files[f"robot_{j + 1:02d}.csv"])) for j in range(3))
    assert report.deviation.value == pytest.approx(off, rel=0.05)
    assert off > TOLERANCE
    assert (
        f"robot 3 at {report.deviation.time:.2f} s: {report.deviation.value:.4f} m off"
        in (report.broken[0])
    )


def test_what_the_fit_breaks_is_reported() -> None:
    plan = flight()
    flown = fit_trajectories(plan)
    assert recheck(plan, flown).reached
    crossing = plan.crossings[0]
    tight = {
        "m/s > 0.05": replace(plan, limits=FlightLimits(speed=0.05, acceleration=9)),
        "m/s^2 > 0.01": replace(plan, limits=FlightLimits(speed=9, acceleration=0.01)),
        "of the separation": replace(
            plan, limits=replace(AMPLE, separation=0.35, spacing=0.4, downwash=0.4)
        ),
        "of the cable between them apart": replace(plan, lengths=np.array([0.7, 3.0])),
        "below the floor 1.9 m": replace(plan, world=replace(ROOM, floor=1.9)),
        "above the ceiling 1.9 m": replace(plan, world=replace(ROOM, altitude=1.5, ceiling=1.9)),
        "span 2 over span 1: the leader passes with a gap of 0.3": replace(
            plan, crossings=(replace(crossing, height=crossing.height + 0.02),)
        ),
        "span 2 under span 1: the leader passes with a gap of -0.3": replace(
            plan, crossings=(replace(crossing, over=False),)
        ),
    }
    for words, changed in tight.items():
        broken = recheck(changed, flown).broken
        assert len(broken) == 1 and words in broken[0], (words, broken)


@pytest.mark.parametrize(
    ("power", "words"),
    [(0, "position jumps"), (1, "velocity jumps"), (2, "acceleration jumps"), (3, "jerk jumps")],
)
def test_a_jump_is_reported_with_its_place(power: int, words: str) -> None:
    plan = flight()
    first, *others = fit_trajectories(plan)
    coefficients = first.polynomials.coefficients.copy()
    coefficients[1, 0, power] += 1e-3
    spoilt = replace(first, polynomials=Polynomials(first.polynomials.durations, coefficients))
    report = recheck(plan, (spoilt, *others))
    places = [f"robot 1 at {time:.2f} s: {words}" for time in first.polynomials.breaks[1:3]]
    assert any(line.startswith(tuple(places)) for line in report.broken)


def test_a_plan_that_nobody_can_fly_is_refused() -> None:
    plan = flight()
    for change, words in (
        ((7, 1, 2, np.nan), "z of robot 2 at 0.350 s is not a finite number"),
        ((0, 1, 0, 1.05), "robots 1 and 2 start too close"),
        ((-1, 1, slice(None), plan.anchors[0] + [0, 0, 0.5]), "robots 1 and 2 end 0.000 m apart"),
    ):
        positions = plan.positions.copy()
        positions[change[:3]] = change[3]
        with pytest.raises(RequirementError, match=words):
            export_files(replace(plan, positions=positions))
    with pytest.raises(RequirementError, match=r"a flight of 0\.2 s is too short"):
        export_files(replace(plan, times=plan.times[:5], positions=plan.positions[:5]))


@given(st.integers(2, 4), st.sampled_from((0.02, 0.05, 0.1)), st.floats(0, 0.9))
@settings(max_examples=10)
def test_waypoints_are_read_back(robots: int, interval: float, depth: float) -> None:
    plan = flight(robots=robots, interval=interval, depth=depth, seconds=5)
    path = Path("unwritten.csv")
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(Path, "read_text", lambda *_, **__: waypoints_csv(plan))
        found = read_waypoints(path)
    assert np.abs(found.times - plan.times).max() < 1e-6
    assert np.abs(found.positions - plan.positions).max() <= 0.5e-5 + 1e-12
    assert not found.yaw.any()


def test_waypoints_have_the_columns_they_say() -> None:
    rows = list(csv.DictReader(waypoints_csv(flight()).splitlines()))
    assert list(rows[0]) == ["t", "robot", "x", "y", "z", "yaw"]
    assert [row["robot"] for row in rows[:4]] == ["1", "2", "3", "1"]


@pytest.mark.parametrize(
    ("line", "text", "message"),
    [
        (1, "t,x", "line 1: expected 't,robot,x,y,z,yaw'"),
        (3, "0.0,2,1,1", "line 3 is '0.0,2,1,1', not six numbers"),
        (3, "0.0,2,1,b,1,0", "line 3 is"),
        (3, "0.0,2,1,nan,1,0", "line 3 is"),
        (5, "0.05,2,1,1,1,0", r"line 5: expected robot 1 at t = 0.05"),
        (6, "0.07,2,1,1,1,0", r"line 6: expected robot 2 at t = 0.05"),
        (5, "-1,1,1,1,1,0", "line 5: t = -1 does not increase"),
    ],
)
def test_wrong_waypoints_are_named(tmp_path: Path, line: int, text: str, message: str) -> None:
    lines = waypoints_csv(flight()).splitlines()
    lines[line - 1] = text
    path = tmp_path / "waypoints.csv"
    path.write_text("\n".join(lines), encoding="utf-8")
    with pytest.raises(FileFormatError, match=message):
        read_waypoints(path)


@pytest.mark.parametrize("read", [read_waypoints, read_polynomials])
def test_files_that_cannot_be_read(tmp_path: Path, read: Any) -> None:
    with pytest.raises(FileFormatError, match="cannot read"):
        read(tmp_path / "none.csv")
    (tmp_path / "bytes.csv").write_bytes(b"\xff\xfe")
    with pytest.raises(FileFormatError, match="is not UTF-8"):
        read(tmp_path / "bytes.csv")
    (tmp_path / "empty.csv").write_text("")
    with pytest.raises(FileFormatError, match="line 1"):
        read(tmp_path / "empty.csv")


def test_polynomials_are_read_back_to_the_last_digit(tmp_path: Path) -> None:
    written = fit_trajectories(flight())[-1].polynomials
    path = tmp_path / "robot_03.csv"
    path.write_text(written.csv(), encoding="utf-8")
    found = read_polynomials(path)
    assert np.array_equal(found.durations, written.durations)
    assert np.array_equal(found.coefficients, written.coefficients)
    lines = written.csv().splitlines()
    for changed, message in (
        ([*lines[:2], lines[2].replace(",", ";", 1)], "line 3"),
        ([*lines[:2], lines[2] + ",1"], "line 3: 34 entries"),
        ([lines[0], "0" + ",1" * 32], "line 2: a duration of 0 s"),
        ([lines[0], *[lines[1]] * 32], "has 32 pieces; a robot keeps 1 to 31"),
        (lines[:1], "has 0 pieces"),
    ):
        path.write_text("\n".join(changed), encoding="utf-8")
        with pytest.raises(FileFormatError, match=message):
            read_polynomials(path)


def test_robots_stand_under_their_first_waypoints() -> None:
    plan = flight(robots=4)
    robots = yaml.safe_load(export_files(plan)[0]["crazyflies.yaml"])["robots"]
    assert list(robots) == ["cf1", "cf2", "cf3", "cf4"]
    for number, robot in enumerate(robots.values(), 1):
        assert robot["enabled"] is True
        assert robot["uri"] == f"radio://0/80/2M/E7E7E7E70{number}"
        assert robot["type"] == "cf21"
        assert robot["initial_position"] == pytest.approx(
            [*plan.positions[0, number - 1, :2], 0.0], abs=1e-4
        )
        assert all(type(x) is float for x in robot["initial_position"])
