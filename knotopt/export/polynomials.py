"""Piecewise polynomials of degree 7, and Crazyswarm2's file of them: 33 columns, a piece a line.

The columns are the piece's duration and the coefficients of x, y, z and yaw, the constant term
first, in the time since the piece's beginning. Format: `Duration,x^0,...,yaw^7` in the examples of
Crazyswarm2 (https://github.com/IMRCLab/crazyswarm2), whose `uav_trajectory.py` reads it; the
firmware keeps 132 bytes a piece in 4096 bytes
(https://github.com/bitcraze/crazyflie-firmware, docs/functional-areas/trajectory_formats.md).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from math import factorial
from pathlib import Path

import numpy as np
from scipy.interpolate import BSpline, PPoly

from knotopt.arrays import FloatArray
from knotopt.errors import FileFormatError

DEGREE = 7
MOST_PIECES = 31
AXES = ("x", "y", "z", "yaw")
HEADER = ",".join(["Duration", *(f"{axis}^{k}" for axis in AXES for k in range(DEGREE + 1))])


@dataclass(frozen=True, eq=False)
class Polynomials:
    """What one robot flies in one go.

    Attributes
    ----------
    durations : float array, shape (n,)
        Of the pieces [s].
    coefficients : float array, shape (n, 4, 8)
        Of x, y, z [m; the world's frame] and yaw [rad] in ascending powers of the time since the
        piece's beginning [s].
    """

    durations: FloatArray
    coefficients: FloatArray

    @classmethod
    def from_splines(cls, splines: Sequence[tuple[BSpline, FloatArray]], yaw: float) -> Polynomials:
        """Consecutive splines of x, y and z, each with its breakpoints, at one yaw [rad]."""
        durations, coefficients = [], []
        for spline, breaks in splines:
            pieces = np.zeros((len(breaks) - 1, len(AXES), DEGREE + 1))
            pieces[:, -1, 0] = yaw
            for k in range(DEGREE + 1):
                pieces[:, :-1, k] = spline(breaks[:-1], nu=k) / factorial(k)
            durations.append(np.diff(breaks))
            coefficients.append(pieces)
        return cls(np.concatenate(durations), np.concatenate(coefficients))

    @property
    def duration(self) -> float:
        """Of all pieces [s]."""
        return float(self.breaks[-1])

    @cached_property
    def breaks(self) -> FloatArray:
        """Where the pieces begin and the last one ends, shape (n + 1,) [s]."""
        return np.concatenate(([0.0], np.cumsum(self.durations)))

    def at(self, times: FloatArray, derivative: int = 0) -> FloatArray:
        """x, y, z, yaw or a derivative of them, shape (T, 4).

        Before its beginning and after its end a robot hovers where it begins and ends.
        """
        pieces = PPoly(self.coefficients.transpose(2, 0, 1)[::-1], self.breaks)
        values: FloatArray = pieces(np.clip(times, 0, self.duration), nu=derivative)
        if derivative:
            values[(times < 0) | (times > self.duration)] = 0
        return values

    def jumps(self, derivative: int) -> FloatArray:
        """By how much a derivative jumps at each of `breaks`, shape (n + 1,).

        Hovering before and after counts: only at rest is there no jump at the ends. The values
        there are no jumps.
        """
        powers = np.arange(DEGREE + 1)
        factors = np.prod([powers - k for k in range(derivative)], axis=0, dtype=np.float64)
        exponents = np.maximum(powers - derivative, 0)
        first = (self.coefficients * factors)[..., derivative]
        last = np.einsum(
            "nak,nk->na", self.coefficients * factors, self.durations[:, None] ** exponents
        )
        rest = np.zeros((1, len(AXES)))
        before, after = np.vstack((rest, last)), np.vstack((first, rest))
        if not derivative:
            before[0], after[-1] = after[0], before[-1]
        return np.asarray(np.linalg.norm(after - before, axis=1))

    def csv(self) -> str:
        """The file for Crazyswarm2, with every digit of the coefficients.

        Robots hold them in single precision, which moves them by some 5e-6 m.
        """
        table = np.column_stack(
            (self.durations, self.coefficients.reshape(len(self.durations), -1))
        )
        lines = [",".join(map(repr, row)) for row in table.tolist()]
        return "\n".join([HEADER, *lines, ""])


@dataclass(frozen=True, eq=False)
class Trajectory:
    """What one robot flies from one instant of a plan at which all robots rest to another.

    Attributes
    ----------
    robot, part : int
        1-based.
    start : float
        Time of the plan at its beginning [s].
    polynomials : Polynomials
    """

    robot: int
    part: int
    start: float
    polynomials: Polynomials


def read_polynomials(path: Path | str) -> Polynomials:
    """Polynomials from a file of 33 columns.

    Raises
    ------
    FileFormatError
        The file cannot be read, a line is not 33 numbers, a duration is not positive, or there are
        more pieces than a robot can keep; the message names the line.
    """
    path = Path(path)
    try:
        lines = path.read_text(encoding="utf-8").splitlines()
    except OSError as error:
        raise FileFormatError(f"cannot read {path}: {error.strerror}") from error
    except UnicodeDecodeError as error:
        raise FileFormatError(f"{path} is not UTF-8 text (byte {error.start})") from error
    if not lines or lines[0].strip().lower() != HEADER.lower():
        raise FileFormatError(f"{path}, line 1: expected {HEADER[:20]}...,yaw^7")
    rows = []
    for number, line in enumerate(lines[1:], 2):
        try:
            row = [float(entry) for entry in line.split(",")]
        except ValueError as error:
            raise FileFormatError(f"{path}, line {number}: {error}") from error
        if len(row) != 33 or not np.isfinite(row).all():
            raise FileFormatError(f"{path}, line {number}: {len(row)} entries, not 33 numbers")
        if not row[0] > 0:
            raise FileFormatError(f"{path}, line {number}: a duration of {row[0]:g} s")
        rows.append(row)
    if not 1 <= len(rows) <= MOST_PIECES:
        raise FileFormatError(f"{path} has {len(rows)} pieces; a robot keeps 1 to {MOST_PIECES}")
    table = np.array(rows)
    return Polynomials(table[:, 0], table[:, 1:].reshape(-1, len(AXES), DEGREE + 1))
