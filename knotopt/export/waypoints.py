"""Flight plans as waypoints: CSV `t,robot,x,y,z,yaw`, one line a robot and instant."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from knotopt.arrays import FloatArray
from knotopt.errors import FileFormatError
from knotopt.flight.plan import FlightPlan

HEADER = "t,robot,x,y,z,yaw"
YAW = 0.0  # the heading of every robot at every time [rad]: a cable hangs from it all the same


@dataclass(frozen=True, eq=False)
class Waypoints:
    """Where robots are at given times.

    Attributes
    ----------
    times : float array, shape (T,)
        [s]
    positions : float array, shape (T, R, 3)
        [m; the world's frame, z up from the ground]
    yaw : float array, shape (T, R)
        [rad]
    """

    times: FloatArray
    positions: FloatArray
    yaw: FloatArray


def waypoints_csv(plan: FlightPlan) -> str:
    """A plan as CSV: for each time [s] all robots (1-based), x, y, z [m] and yaw [rad]."""
    lines = [HEADER]
    for time, places in zip(plan.times.tolist(), plan.positions.tolist(), strict=True):
        lines += [
            f"{time:.6f},{robot},{x:.5f},{y:.5f},{z:.5f},{YAW:.5f}"
            for robot, (x, y, z) in enumerate(places, 1)
        ]
    return "\n".join([*lines, ""])


def read_waypoints(path: Path | str) -> Waypoints:
    """Waypoints from a file that `waypoints_csv` wrote.

    Raises
    ------
    FileFormatError
        The file cannot be read, or a line is not what the others make expect; the message names it.
    """
    path = Path(path)
    try:
        lines = path.read_text(encoding="utf-8").splitlines()
    except OSError as error:
        raise FileFormatError(f"cannot read {path}: {error.strerror}") from error
    except UnicodeDecodeError as error:
        raise FileFormatError(f"{path} is not UTF-8 text (byte {error.start})") from error
    if not lines or lines[0].strip() != HEADER:
        raise FileFormatError(f"{path}, line 1: expected {HEADER!r}")
    rows: list[list[float]] = []
    for number, line in enumerate(lines[1:], 2):
        try:
            rows.append([float(entry) for entry in line.split(",")])
        except ValueError as error:
            raise FileFormatError(f"{path}, line {number} is {line!r}, not six numbers") from error
        if len(rows[-1]) != 6 or not np.isfinite(rows[-1]).all():
            raise FileFormatError(f"{path}, line {number} is {line!r}, not six numbers")
    if not rows:
        raise FileFormatError(f"{path} has no waypoints")
    robots = sum(row[0] == rows[0][0] for row in rows)
    for place, row in enumerate(rows):
        first = rows[place - place % robots]
        if row[1] != place % robots + 1 or row[0] != first[0]:
            raise FileFormatError(
                f"{path}, line {place + 2}: expected robot {place % robots + 1} "
                f"at t = {first[0]:g}, since every time has robots 1 to {robots}"
            )
        if row is first and place and not row[0] > rows[place - 1][0]:
            raise FileFormatError(f"{path}, line {place + 2}: t = {row[0]:g} does not increase")
    if len(rows) % robots:
        raise FileFormatError(f"{path} ends before the last robot, {robots}")
    table = np.array(rows).reshape(-1, robots, 6)
    return Waypoints(table[:, 0, 0], table[:, :, 2:5], table[:, :, 5])
