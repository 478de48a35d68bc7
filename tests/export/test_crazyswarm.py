"""The exported script, flown by a stand-in for Crazyswarm2."""

from __future__ import annotations

import runpy
import sys
from dataclasses import replace
from pathlib import Path
from types import ModuleType, SimpleNamespace
from typing import Any

import numpy as np
import pytest

from knotopt.export.crazyswarm import export_files, flight_script
from knotopt.export.fitting import fit_trajectories
from knotopt.flight.limits import ROOM
from tests.helpers.smooth_flight import flight


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
