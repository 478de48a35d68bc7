"""What a Crazyflie swarm takes, read by what knows the formats alone, and flown by a stand-in."""

from __future__ import annotations

import csv
import runpy
import sys
from dataclasses import replace
from itertools import pairwise
from pathlib import Path
from types import ModuleType, SimpleNamespace
from typing import Any

import numpy as np
import pytest
import yaml
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

from knotopt.cable.cable import Cable
from knotopt.diagram.families import torus_knot
from knotopt.errors import FileFormatError, RequirementError
from knotopt.export.crazyswarm import export_files, flight_script
from knotopt.export.fitting import fit_trajectories
from knotopt.export.polynomials import Polynomials, read_polynomials
from knotopt.export.recheck import recheck
from knotopt.export.stretch import TOLERANCE
from knotopt.export.waypoints import read_waypoints, waypoints_csv
from knotopt.flight.limits import ROOM, FlightLimits
from knotopt.flight.plan import FlightPlan, PlannedCrossing
from knotopt.path.world import World

FloatArray = NDArray[np.float64]
AMPLE = FlightLimits(speed=9, acceleration=90)


def flight(
    *,
    legs: tuple[int, ...] = (3,),
    depth: float = 0.4,
    seconds: float = 20.0,
    interval: float = 0.05,
    robots: int = 3,
    limits: FlightLimits = AMPLE,
    world: World = ROOM,
) -> FlightPlan:
    """A flight that is smooth: robots glide to their anchors, the leader in bends and dips.

    On each leg, of `seconds`, the leader makes that many bends and dips of that depth; between
    legs all rest for 1 s.
    """
    times = np.arange(round((len(legs) * (seconds + 1) + 4) / interval) + 1) * interval
    share, bends = np.zeros(len(times)), np.zeros(len(times))
    for number, count in enumerate(legs):
        u = np.clip((times - 2 - number * (seconds + 1)) / seconds, 0, 1)
        smooth = u**4 * (35 - 84 * u + 70 * u**2 - 20 * u**3)
        share += smooth / len(legs)
        bends += count * smooth
    start = np.arange(robots)[:, None] * [0.3, 0.0, 0.0] + [1.0, 0.5, 2.0]
    anchors = start + np.arange(robots)[:, None] * [0.5, 1.0, 0.0]
    positions = start + share[:, None, None] * (anchors - start)
    positions[:, -1, 0] += 0.5 * np.sin(2 * np.pi * bends) ** 2
    positions[:, -1, 2] -= depth * np.sin(np.pi * bends) ** 2
    amid = len(times) // 2
    place = positions[amid, -1]
    return FlightPlan(
        name='3_1 "flat"',
        cable=Cable(torus_knot(2, 3), "L+"),
        supports=tuple(range(3, 3 + robots - 2)),
        chosen_by="all",
        schedule="fixed",
        world=world,
        limits=limits,
        times=times,
        positions=positions,
        lengths=np.full(robots - 1, 3.0),
        route=positions[:, -1],
        crossings=(
            PlannedCrossing(
                robots - 1, 1, True, 1, (place[0], place[1]), place[2], place[2] - 0.3, 2.0,
                float(times[amid]),
            ),
        ),
        passes=np.zeros(robots - 1),
    )  # fmt: skip


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
    plan = flight(limits=limits, depth=0.0)
    pace = limits.speed / acceleration
    triangle = np.clip(np.minimum(plan.times - 3, 22 - plan.times) / pace, 0, 1)
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


class Swarm:
    """Stands in for `crazyflie_py`: keeps a log, and what each robot is held by."""

    def __init__(self, names: list[str]) -> None:
        self.log: list[tuple[str, str, Any]] = []
        self.clock = 0.0
        self.until = 0.0
        self.held = dict.fromkeys(names, "ground")
        self.uploaded: dict[str, Any] = {}
        self.allcfs = SimpleNamespace(
            crazyfliesByName={name: self._robot(name) for name in names},
            startTrajectory=self._start,
            land=self._land,
        )
        self.timeHelper = SimpleNamespace(sleep=self._sleep)

    def _robot(self, name: str) -> SimpleNamespace:
        def upload(identifier: int, offset: int, trajectory: Any) -> None:
            assert (identifier, offset) == (0, 0)
            assert self.held[name] in ("ground", "goTo"), "overwrites what the robot hovers by"
            self.uploaded[name] = trajectory
            self.log.append((name, "upload", trajectory.name))

        def take_off(*, targetHeight: float, duration: float) -> None:  # noqa: N803
            assert self.held[name] == "ground"
            self._busy(name, "takeoff", duration, targetHeight)

        def go_to(goal: list[float], yaw: float, duration: float, *, relative: bool) -> None:
            assert not relative and yaw == 0
            assert self.clock >= self.until
            self._busy(name, "goTo", duration, goal)

        return SimpleNamespace(uploadTrajectory=upload, takeoff=take_off, goTo=go_to)

    def _busy(self, name: str, call: str, duration: float, what: Any) -> None:
        self.held[name] = call
        self.log.append((name, call, what))
        self.ends = max(getattr(self, "ends", 0.0), self.clock + duration)

    def _sleep(self, duration: float) -> None:
        self.clock += duration
        self.until = self.ends

    def _start(self, identifier: int, *, timescale: float, reverse: bool, relative: bool) -> None:
        assert (identifier, timescale, reverse, relative) == (0, 1.0, False, False)
        assert self.clock >= self.ends and set(self.held.values()) == {"goTo"}
        for name, trajectory in self.uploaded.items():
            self._busy(name, "trajectory", trajectory.duration, trajectory.name)

    def _land(self, *, targetHeight: float, duration: float) -> None:  # noqa: N803
        assert self.clock >= self.ends
        for name in self.held:
            self._busy(name, "land", duration, targetHeight)


def run_script(
    folder: Path, names: list[str], monkeypatch: pytest.MonkeyPatch, *arguments: str
) -> Swarm:
    class Trajectory:
        """Reads as Crazyswarm2 1.0 does."""

        def loadcsv(self, path: Path) -> None:
            table = np.loadtxt(path, delimiter=",", skiprows=1, usecols=range(33))
            self.name = path.name
            self.polynomials = [row[1:9] for row in table]
            self.duration = float(np.sum(table[:, 0]))

    swarm = Swarm(names)
    package, module = ModuleType("crazyflie_py"), ModuleType("crazyflie_py.uav_trajectory")
    vars(package)["Crazyswarm"] = lambda: swarm
    vars(module)["Trajectory"] = Trajectory
    monkeypatch.setitem(sys.modules, "crazyflie_py", package)
    monkeypatch.setitem(sys.modules, "crazyflie_py.uav_trajectory", module)
    monkeypatch.setattr(sys, "argv", ["fly.py", *arguments])
    runpy.run_path(str(folder / "fly.py"), run_name="__main__")
    return swarm


def write(files: dict[str, str], folder: Path) -> None:
    for name, text in files.items():
        (folder / name).write_text(text, encoding="utf-8")


def test_the_script_flies_the_files(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    plan = flight()
    files, _ = export_files(plan)
    compile(files["fly.py"], "fly.py", "exec")
    write(files, tmp_path)
    swarm = run_script(tmp_path, ["cf3", "cf1", "cf2"], monkeypatch)
    calls = [call for _, call, _ in swarm.log]
    in_order = ["upload", "takeoff", "goTo", "trajectory", "land"]
    assert calls == [call for call in in_order for _ in range(3)]
    for name, call, what in swarm.log:
        robot = int(name[2:])
        start = plan.positions[0, robot - 1]
        if call in ("upload", "trajectory"):
            assert what == f"robot_{robot:02d}.csv"
        if call == "goTo":
            assert what == pytest.approx(start, abs=1e-3)
        if call == "takeoff":
            assert what == pytest.approx(start[2], abs=1e-3)
    assert swarm.clock > plan.duration


def test_parts_are_uploaded_while_robots_hover(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    files, report = export_files(flight(legs=(9, 9, 9), seconds=30, interval=0.1))
    write(files, tmp_path)
    swarm = run_script(tmp_path, ["cf1", "cf2", "cf3"], monkeypatch)
    flown = [what for name, call, what in swarm.log if name == "cf3" and call == "trajectory"]
    assert flown == [f"robot_03_part{part}.csv" for part in range(1, report.parts + 1)]


def test_the_script_flies_nothing_that_breaks_a_limit(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    files, report = export_files(flight(depth=0.8, world=replace(ROOM, floor=1.5)))
    assert not report.reached
    write(files, tmp_path)
    names = ["cf1", "cf2", "cf3"]
    with pytest.raises(SystemExit, match="Nothing flies"):
        run_script(tmp_path, names, monkeypatch)
    assert run_script(tmp_path, names, monkeypatch, "--anyway").log[-1][1] == "land"


def test_the_script_wants_its_own_robots(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    plan = flight()
    write(export_files(plan)[0], tmp_path)
    with pytest.raises(SystemExit, match=r"The server has \['cf1', 'cf9'\]"):
        run_script(tmp_path, ["cf1", "cf9"], monkeypatch)
    assert '3_1 \\"flat\\"' in flight_script(plan, fit_trajectories(plan))
