"""Whether robots' trajectories keep their limits, from samples of their positions alone.

What is measured, and how far from the truth it can be (limits A on acceleration, J on jerk):

- Speed is the mean velocity over a window h, acceleration the second difference with step h, a mean
  over 2h. Neither exceeds the largest true value, and they fall short of it by at most A h / 4 and
  J h / 3. An error e of every sample adds at most 2 e / h and 4 e / h^2.
- Distances between samples are those of robots that move straight from sample to sample; real
  ones, within A, are nearer by at most A dt^2 / 4 in space.
"""

from __future__ import annotations

from dataclasses import dataclass, fields
from itertools import combinations

import numpy as np
from numpy.typing import ArrayLike

from knotopt.arrays import FloatArray

STILL = 1e-3  # a robot that stays within this hovers [m]


@dataclass(frozen=True)
class Worst:
    """The worst value of something, where and when.

    Attributes
    ----------
    value : float
    limit : float
        nan if none was given.
    robots : tuple of int
        Whose it is, 1-based.
    time : float
        [s]
    broken : str
        What is wrong, in a sentence; "" if nothing is.
    """

    value: float
    limit: float
    robots: tuple[int, ...]
    time: float
    broken: str = ""


@dataclass(frozen=True)
class LimitsReport:
    """What trajectories are like, beside their limits.

    Attributes
    ----------
    speed, acceleration : Worst
        Largest [m/s, m/s^2].
    separation : Worst
        Smallest distance of two robots, between samples too, in the ellipsoid's measure: 1 on it.
    cable : Worst
        Largest distance of consecutive robots over the cable between them.
    lowest, highest : Worst
        Heights of robots [m].
    start_speed, end_speed : Worst
        Largest mean speed over the first and the last window [m/s].
    hover_before, hover_after : Worst
        Time until the first robot leaves its place and since the last arrived [s].
    spacing : Worst
        Smallest distance of consecutive robots at the start [m].
    """

    speed: Worst
    acceleration: Worst
    separation: Worst
    cable: Worst
    lowest: Worst
    highest: Worst
    start_speed: Worst
    end_speed: Worst
    hover_before: Worst
    hover_after: Worst
    spacing: Worst

    @property
    def broken(self) -> tuple[str, ...]:
        """A sentence for each limit that is broken."""
        worst = (getattr(self, field.name) for field in fields(self))
        return tuple(each.broken for each in worst if each.broken)

    @property
    def ok(self) -> bool:
        """Whether every limit is kept."""
        return not self.broken


def check_limits(
    times: ArrayLike,
    positions: ArrayLike,
    lengths: ArrayLike,
    *,
    speed: float,
    acceleration: float,
    separation: float,
    downwash: float,
    floor: float,
    ceiling: float,
    spacing: float | None = None,
    hover_before: float = 0.0,
    hover_after: float = 0.0,
    window: float = 0.1,
    tolerance: float = 1e-3,
) -> LimitsReport:
    """Measure trajectories against limits.

    Parameters
    ----------
    times : float array, shape (T,)
        Evenly spaced [s].
    positions : float array, shape (T, R, 3)
        Of the robots [m].
    lengths : float array, shape (R - 1,)
        Of cable between consecutive robots [m].
    speed, acceleration : float
        Largest allowed [m/s, m/s^2].
    separation, downwash : float
        Semi-axes of the ellipsoid that a robot keeps free of others, level and vertical [m].
    floor, ceiling : float
        Lowest and highest allowed height [m].
    spacing : float, optional
        Least distance of consecutive robots at the start [m].
    hover_before, hover_after : float
        How long all robots keep still before and after [s].
    window : float
        Over which velocities are taken [s], made a whole number of samples.
    tolerance : float
        Share of a limit by which it may be missed.

    Raises
    ------
    ValueError
        Arrays of shapes that do not fit, a number that is not finite, times that are not evenly
        spaced, or too few for the window.

    Examples
    --------
    >>> times = np.linspace(0, 2, 41)
    >>> still = np.broadcast_to([[0, 0, 1.0], [1, 0, 1], [1, 0.1, 1]], (41, 3, 3))
    >>> report = check_limits(times, still, [1.1, 1.1], speed=0.6, acceleration=1.5,
    ...     separation=0.2, downwash=0.33, floor=0.3, ceiling=3.0)
    >>> report.broken
    ('robots 2 and 3 come within 0.50 of their separation at 0.00 s',)
    """
    times, positions, lengths = _checked(times, positions, lengths)
    interval = float(times[-1] - times[0]) / (len(times) - 1)
    steps = max(1, round(window / interval))
    if len(times) < 2 * steps + 1:
        raise ValueError(f"{len(times)} samples are too few for a window of {window:g} s")
    track = _Track(times, positions, lengths, steps, steps * interval, tolerance)
    at_rest = acceleration * track.window / 2
    return LimitsReport(
        speed=track.speed(speed),
        acceleration=track.acceleration(acceleration),
        separation=track.separation(separation, downwash),
        cable=track.cable(),
        lowest=track.height(floor, lowest=True),
        highest=track.height(ceiling, lowest=False),
        start_speed=track.rest(at_rest, start=True),
        end_speed=track.rest(at_rest, start=False),
        hover_before=track.hover(hover_before, before=True),
        hover_after=track.hover(hover_after, before=False),
        spacing=track.spacing(spacing),
    )


def _checked(
    times: ArrayLike, positions: ArrayLike, lengths: ArrayLike
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """The arrays, or a plain sentence about what is wrong with them."""
    times, positions = np.asarray(times, dtype=float), np.asarray(positions, dtype=float)
    lengths = np.asarray(lengths, dtype=float)
    if positions.ndim != 3 or positions.shape[2] != 3 or positions.shape[1] < 2:
        raise ValueError(
            f"positions have the shape (T, R, 3) with at least two robots, not {positions.shape}"
        )
    if times.shape != positions.shape[:1] or len(times) < 3:
        raise ValueError(
            f"{len(positions)} samples of positions need as many times, and at least three; "
            f"not {times.shape}"
        )
    if lengths.shape != (positions.shape[1] - 1,):
        raise ValueError(
            f"{positions.shape[1]} robots need {positions.shape[1] - 1} lengths of cable, "
            f"not {lengths.shape}"
        )
    if not np.isfinite(positions).all():
        sample, robot = np.argwhere(~np.isfinite(positions).all(axis=2))[0].tolist()
        raise ValueError(f"the position of robot {robot + 1} at sample {sample} is not finite")
    if not (np.isfinite(times).all() and np.isfinite(lengths).all() and (lengths > 0).all()):
        raise ValueError("times and lengths of cable are finite numbers, and lengths positive")
    gaps = np.diff(times)
    if not (gaps > 0).all() or np.ptp(gaps) > 1e-3 * gaps.mean():
        raise ValueError("times are not evenly spaced")
    return times, positions, lengths


@dataclass(frozen=True, eq=False)
class _Track:
    """Sampled trajectories; `steps` samples make a window."""

    times: FloatArray
    positions: FloatArray
    lengths: FloatArray
    steps: int
    window: float
    tolerance: float

    def speed(self, limit: float) -> Worst:
        moved = self.positions[self.steps :] - self.positions[: -self.steps]
        rate = np.linalg.norm(moved, axis=2) / self.window
        k, robot, value = _extreme(rate)
        time = float(self.times[k] + self.window / 2)
        sentence = f"robot {robot + 1} flies at {value:.3f} m/s at {time:.2f} s; "
        sentence += f"the limit is {limit:g} m/s"
        return self._at_most(value, limit, (robot + 1,), time, sentence)

    def acceleration(self, limit: float) -> Worst:
        h, x = self.steps, self.positions
        rate = np.linalg.norm(x[2 * h :] - 2 * x[h:-h] + x[: -2 * h], axis=2) / self.window**2
        k, robot, value = _extreme(rate)
        time = float(self.times[k + h])
        sentence = f"robot {robot + 1} accelerates by {value:.3f} m/s² at {time:.2f} s; "
        sentence += f"the limit is {limit:g} m/s²"
        return self._at_most(value, limit, (robot + 1,), time, sentence)

    def separation(self, level: float, vertical: float) -> Worst:
        scaled = self.positions / [level, level, vertical]
        worst, where, time = np.inf, (1, 2), float(self.times[0])
        for i, j in combinations(range(scaled.shape[1]), 2):
            apart = scaled[:, j] - scaled[:, i]
            start, moved = apart[:-1], np.diff(apart, axis=0)
            share = -(start * moved).sum(axis=1) / np.maximum((moved * moved).sum(axis=1), 1e-300)
            share = np.clip(share, 0, 1)
            distance = np.linalg.norm(start + share[:, None] * moved, axis=1)
            k = int(distance.argmin())
            if distance[k] < worst:
                worst, where = float(distance[k]), (i + 1, j + 1)
                time = float(self.times[k] + share[k] * (self.times[k + 1] - self.times[k]))
        sentence = f"robots {where[0]} and {where[1]} come within {worst:.2f} of their separation "
        return self._at_least(worst, 1.0, where, time, sentence + f"at {time:.2f} s")

    def cable(self) -> Worst:
        share = np.linalg.norm(np.diff(self.positions, axis=1), axis=2) / self.lengths
        k, span, value = _extreme(share)
        time = float(self.times[k])
        sentence = f"the cable between robots {span + 1} and {span + 2} is stretched to "
        sentence += f"{value:.3f} of its {self.lengths[span]:.3f} m at {time:.2f} s"
        return self._at_most(value, 1.0, (span + 1, span + 2), time, sentence)

    def height(self, limit: float, *, lowest: bool) -> Worst:
        k, robot, value = _extreme(self.positions[:, :, 2], smallest=lowest)
        time = float(self.times[k])
        bound = f"below the floor of {limit:g} m" if lowest else f"above the ceiling of {limit:g} m"
        sentence = f"robot {robot + 1} is at {value:.3f} m at {time:.2f} s, {bound}"
        judge = self._at_least if lowest else self._at_most
        return judge(value, limit, (robot + 1,), time, sentence)

    def rest(self, limit: float, *, start: bool) -> Worst:
        first, last = (0, self.steps) if start else (-1 - self.steps, -1)
        rate = np.linalg.norm(self.positions[last] - self.positions[first], axis=1) / self.window
        robot, time = int(rate.argmax()), float(self.times[0 if start else -1])
        sentence = f"robot {robot + 1} does not {'start' if start else 'end'} at rest: "
        sentence += f"{rate[robot]:.3f} m/s"
        return self._at_most(float(rate[robot]), limit, (robot + 1,), time, sentence)

    def hover(self, limit: float, *, before: bool) -> Worst:
        track = self.positions if before else self.positions[::-1]
        away = np.linalg.norm(track - track[0], axis=2) > STILL
        total = float(self.times[-1] - self.times[0])
        left = np.where(away.any(axis=0), away.argmax(axis=0), len(track) - 1)
        robot = int(left.argmin())
        interval = total / (len(track) - 1)
        value = interval * int(left[robot])
        time = float(self.times[0] + value if before else self.times[-1] - value)
        sentence = f"robot {robot + 1} hovers {value:.2f} s {'before' if before else 'after'} "
        sentence += f"the flight, not {limit:g} s"
        # Where between two samples it left or arrived is not known.
        kept = value + interval >= limit * (1 - self.tolerance)
        return Worst(value, limit, (robot + 1,), time, "" if kept else sentence)

    def spacing(self, limit: float | None) -> Worst:
        apart = np.linalg.norm(np.diff(self.positions[0], axis=0), axis=1)
        k, time = int(apart.argmin()), float(self.times[0])
        value, pair = float(apart[k]), (k + 1, k + 2)
        if limit is None:
            return Worst(value, float("nan"), pair, time)
        sentence = f"robots {k + 1} and {k + 2} start {value:.3f} m apart; the spacing is {limit:g}"
        return self._at_least(value, limit, pair, time, f"{sentence} m")

    def _at_most(
        self, value: float, limit: float, robots: tuple[int, ...], time: float, sentence: str
    ) -> Worst:
        kept = value <= limit * (1 + self.tolerance)
        return Worst(value, limit, robots, time, "" if kept else sentence)

    def _at_least(
        self, value: float, limit: float, robots: tuple[int, ...], time: float, sentence: str
    ) -> Worst:
        kept = value >= limit * (1 - self.tolerance)
        return Worst(value, limit, robots, time, "" if kept else sentence)


def _extreme(values: FloatArray, *, smallest: bool = False) -> tuple[int, int, float]:
    """Row and column of the first largest or smallest value, and the value."""
    found = values.argmin() if smallest else values.argmax()
    row, column = divmod(int(found), values.shape[1])
    return row, column, float(values[row, column])
