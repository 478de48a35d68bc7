"""A flight plan as files for Crazyswarm2: robots, polynomials, and a script that flies them.

Crazyswarm2 1.0 (https://imrclab.github.io/crazyswarm2/) starts a trajectory where the robot is
unless told `relative=False`. Robots evaluate an uploaded trajectory in place, even when it has
ended: before another is uploaded over it they are sent to where they are by `goTo`, which is kept
elsewhere (crazyflie-firmware, src/modules/src/planner.c).
"""

from __future__ import annotations

import json
import math
from collections.abc import Sequence

import numpy as np

from knotopt.errors import RequirementError
from knotopt.export.fitting import fit_trajectories
from knotopt.export.polynomials import Trajectory
from knotopt.export.recheck import FitReport, recheck
from knotopt.export.waypoints import YAW, waypoints_csv
from knotopt.flight.plan import FlightPlan
from knotopt.flight.plan_file import check_plan

PEAK = 2.2  # largest over mean speed of the polynomial from rest to rest that robots take off by
SHORTEST = 2.0  # time to take off or to land [s]
BRIEFEST = 1.0  # flight that polynomials can be fitted to [s]


def export_files(plan: FlightPlan) -> tuple[dict[str, str], FitReport]:
    """Everything that a Crazyflie swarm takes, by file name.

    `waypoints.csv`, `crazyflies.yaml`, `fly.py` and a file of polynomials for each robot, or for
    each of its parts: `robot_01.csv` or `robot_01_part1.csv`.

    Parameters
    ----------
    plan : FlightPlan

    Returns
    -------
    files : dict of str to str
        Texts; nothing is written.
    report : FitReport
        What robots do that fly the polynomials. Where it has something broken, the files are there
        all the same, but the script flies only if told to.

    Raises
    ------
    RequirementError
        A plan that no robots could fly, one of less than 1 s, or one whose robots start or end so
        much on top of each other that they cannot take off or land.
    """
    check_plan(plan)
    if plan.duration < BRIEFEST:
        raise RequirementError(f"a flight of {plan.duration:g} s is too short to be exported")
    _check_columns(plan)
    trajectories = fit_trajectories(plan)
    report = recheck(plan, trajectories)
    files = {
        "waypoints.csv": waypoints_csv(plan),
        "crazyflies.yaml": crazyflies_yaml(plan),
        "fly.py": flight_script(plan, trajectories, report.broken),
    }
    polynomials = (each.polynomials.csv() for each in trajectories)
    return files | dict(zip(_file_names(trajectories), polynomials, strict=True)), report


def crazyflies_yaml(plan: FlightPlan) -> str:
    """The robots of a plan as they go into Crazyswarm2's `crazyflies.yaml`.

    Robot j is cf<j>, at the address that Crazyswarm2 has for it by convention, on the ground under
    its first waypoint [m].
    """
    lines = [
        f"# {plan.name}: these robots replace those in Crazyswarm2's crazyflies.yaml;",
        "# uri and type are yours to adapt, robots stand at initial_position (x, y, z in m).",
        "robots:",
    ]
    for robot, (x, y, _) in enumerate(plan.positions[0].tolist(), 1):
        lines += [
            f"  {_robot_name(robot)}:",
            "    enabled: true",
            f"    uri: radio://0/80/2M/E7E7E7E7{robot:02X}",
            f"    initial_position: [{x:.4f}, {y:.4f}, 0.0]",
            "    type: cf21  # see robot_types",
        ]
    return "\n".join([*lines, ""])


def flight_script(
    plan: FlightPlan, trajectories: Sequence[Trajectory], broken: Sequence[str] = ()
) -> str:
    """A Python script that flies the trajectories beside it; it needs `crazyflie_py` alone.

    Parameters
    ----------
    plan : FlightPlan
    trajectories : sequence of Trajectory
        Of all robots and parts.
    broken : sequence of str
        What they do not keep, see `FitReport`: the script then needs the argument `--anyway`.
    """
    parts: list[dict[str, str]] = [{} for _ in range(max(each.part for each in trajectories))]
    rests: list[dict[str, list[float]]] = [{} for _ in parts]
    for each, name in zip(trajectories, _file_names(trajectories), strict=True):
        start = each.polynomials.at(np.zeros(1))[0, :3].round(6)
        parts[each.part - 1][_robot_name(each.robot)] = name
        rests[each.part - 1][_robot_name(each.robot)] = start.tolist()
    heights = {name: place[2] for name, place in rests[0].items()}
    climb = max(SHORTEST, PEAK * max(heights.values()) / plan.limits.speed)
    values = {
        "TITLE": f"Flies {plan.name}: {plan.robots} robots, {plan.duration:.1f} s.",
        "BROKEN": list(broken),
        "PARTS": parts,
        "STARTS": rests,
        "YAW": YAW,
        "CLIMB": math.ceil(10 * climb) / 10,
    }
    script = SCRIPT
    for name, value in values.items():
        script = script.replace(f"<{name}>", json.dumps(value, indent=4))
    return script


def _check_columns(plan: FlightPlan) -> None:
    """Robots take off and land straight up and down, all at once."""
    least = plan.limits.separation * (1 - 1e-4)
    for verb, places in (("start", plan.positions[0]), ("end", plan.positions[-1])):
        for i, j in zip(*np.triu_indices(plan.robots, 1), strict=True):
            apart = math.dist(places[i, :2], places[j, :2])
            if apart < least:
                raise RequirementError(
                    f"robots {i + 1} and {j + 1} {verb} {apart:.3f} m apart in plan: one would be "
                    f"in the other's way when they take off and land; "
                    f"the separation is {plan.limits.separation:g} m"
                )


def _robot_name(robot: int) -> str:
    return f"cf{robot}"


def _file_names(trajectories: Sequence[Trajectory]) -> list[str]:
    several = any(each.part > 1 for each in trajectories)
    return [
        f"robot_{each.robot:02d}" + (f"_part{each.part}" if several else "") + ".csv"
        for each in trajectories
    ]


SCRIPT = '''#!/usr/bin/env python3
"""Run this with Crazyswarm2's server up: ros2 launch crazyflie launch.py (see crazyflies.yaml)."""

import sys
from pathlib import Path

from crazyflie_py import Crazyswarm
from crazyflie_py.uav_trajectory import Trajectory

TITLE = <TITLE>
# What the polynomials do not keep.
BROKEN = <BROKEN>
# Files of each robot, part by part; all robots rest between two parts.
PARTS = <PARTS>
# Where each robot is when a part starts [m].
STARTS = <STARTS>
YAW = <YAW>  # [rad]
CLIMB = <CLIMB>  # [s]
GO = 2.0  # [s]
SETTLE = 1.0  # [s]
GROUND = 0.04  # [m]


def load(name):
    trajectory = Trajectory()
    trajectory.loadcsv(Path(__file__).resolve().parent / name)
    return trajectory


def main():
    print(TITLE)
    for line in BROKEN:
        print("Not kept:", line)
    if BROKEN and "--anyway" not in sys.argv[1:]:
        sys.exit("Nothing flies; with --anyway it does.")
    parts = [{name: load(file) for name, file in part.items()} for part in PARTS]

    swarm = Crazyswarm()
    clock, everyone = swarm.timeHelper, swarm.allcfs
    robots = everyone.crazyfliesByName
    if set(robots) != set(PARTS[0]):
        sys.exit(f"The server has {sorted(robots)}, this flight is for {sorted(PARTS[0])}.")

    def upload(part):
        for name, trajectory in part.items():
            robots[name].uploadTrajectory(0, 0, trajectory)

    upload(parts[0])
    for name, place in STARTS[0].items():
        robots[name].takeoff(targetHeight=place[2], duration=CLIMB)
    clock.sleep(CLIMB + SETTLE)
    for number, (part, start) in enumerate(zip(parts, STARTS)):
        for name, place in start.items():
            robots[name].goTo(place, YAW, GO, relative=False)
        clock.sleep(GO + SETTLE)
        if number:  # robots are held by goTo, so what they flew last can be overwritten
            upload(part)
        everyone.startTrajectory(0, timescale=1.0, reverse=False, relative=False)
        clock.sleep(max(trajectory.duration for trajectory in part.values()) + SETTLE)
    everyone.land(targetHeight=GROUND, duration=CLIMB)
    clock.sleep(CLIMB + SETTLE)


if __name__ == "__main__":
    main()
'''
