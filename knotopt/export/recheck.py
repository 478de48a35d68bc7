"""Fitted trajectories examined once more: a fit may overshoot what the plan kept."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import combinations
from operator import attrgetter

import numpy as np

from knotopt.arrays import FloatArray
from knotopt.export.polynomials import MOST_PIECES, Trajectory
from knotopt.export.stretch import TOLERANCE
from knotopt.flight.plan import FlightPlan, PlannedCrossing

FINE = 0.01  # at most between the times that are examined [s]
SHARE = 0.01  # of a limit by which it may be missed: a plan may keep it to the last digit
JUMPS = (1e-6, 1e-5, 1e-4, 1e-3)  # that are rounding: of position, velocity, acceleration, jerk
NEAR = 1.0  # to the planned time of a crossing, within which its place is passed [s]
NAMES = ("position", "velocity", "acceleration", "jerk")


@dataclass(frozen=True)
class Extreme:
    """The worst of a quantity: its value, whose, and when in the plan [s]."""

    value: float
    robots: tuple[int, ...]
    time: float

    @property
    def where(self) -> str:
        """In words, such as "robots 1 and 2 at 3.50 s"."""
        names = " and ".join(map(str, self.robots))
        return f"robot{'s' * (len(self.robots) > 1)} {names} at {self.time:.2f} s"


@dataclass(frozen=True)
class FittedCrossing:
    """A planned crossing as the fitted leader flies it.

    `planned` and `gap` are heights of the leader above the older span, below it if it passes under
    [m]; a negative one is on the wrong side. `time` is when it passes the place [s].
    """

    crossing: PlannedCrossing
    planned: float
    gap: float
    time: float


@dataclass(frozen=True)
class FitReport:
    """What robots do that fly the polynomials.

    Attributes
    ----------
    parts, pieces : int
        Consecutive trajectories a robot, and the most pieces in one of them.
    deviation : Extreme
        From the plan [m].
    speed, acceleration : Extreme
        Largest [m/s, m/s^2].
    separation : Extreme
        Least distance of two robots, 1 being on the ellipsoid (see `FlightLimits`).
    cable : Extreme
        Largest distance of consecutive robots over the length of cable between them.
    lowest, highest : Extreme
        Altitude [m].
    jumps : tuple of Extreme
        Largest of position, velocity, acceleration and jerk, at rest before and after included.
    crossings : tuple of FittedCrossing
        Those flown, in order.
    broken : tuple of str
        In words, what is not kept, by more than 1 % of a limit. Speed is a robot's, whatever the
        direction; a crossing keeps its planned gap to 1 cm.
    """

    parts: int
    pieces: int
    deviation: Extreme
    speed: Extreme
    acceleration: Extreme
    separation: Extreme
    cable: Extreme
    lowest: Extreme
    highest: Extreme
    jumps: tuple[Extreme, ...]
    crossings: tuple[FittedCrossing, ...]
    broken: tuple[str, ...]

    @property
    def reached(self) -> bool:
        """Whether the polynomials stay within 1 cm of the plan and within all limits."""
        return not self.broken


def recheck(plan: FlightPlan, trajectories: Sequence[Trajectory]) -> FitReport:
    """Examine trajectories against the plan that they were fitted to.

    Parameters
    ----------
    plan : FlightPlan
    trajectories : sequence of Trajectory
        Of all robots and parts.
    """
    count = int(np.ceil(plan.duration / min(FINE, plan.interval)))
    times = np.linspace(0, plan.duration, count + 1)
    position, velocity, acceleration = (_flown(plan, trajectories, times, k) for k in range(3))
    off = np.linalg.norm(position - _planned(plan, times), axis=2)
    deviation = _largest(off, times)
    speed = _largest(np.linalg.norm(velocity, axis=2), times)
    steepest = _largest(np.linalg.norm(acceleration, axis=2), times)
    separation = _nearest(plan, position, times)
    cable = _largest(np.linalg.norm(np.diff(position, axis=1), axis=2) / plan.lengths, times)
    cable = replace(cable, robots=(cable.robots[0], cable.robots[0] + 1))
    lowest = _largest(-position[:, :, 2], times)
    lowest = replace(lowest, value=-lowest.value)
    highest = _largest(position[:, :, 2], times)
    jumps = tuple(_jump(trajectories, k) for k in range(4))
    fitted = [_crossing(each, times, position[:, -1]) for each in plan.crossings]
    crossings = tuple(each for each in fitted if each is not None)
    pieces = max(len(each.polynomials.durations) for each in trajectories)
    limits, world = plan.limits, plan.world
    found = [
        (deviation.value > TOLERANCE, f"{deviation.value:.4f} m off the plan", deviation),
        (_over(speed, limits.speed), f"{speed.value:.3f} m/s > {limits.speed:g}", speed),
        (
            _over(steepest, limits.acceleration),
            f"{steepest.value:.3f} m/s^2 > {limits.acceleration:g}",
            steepest,
        ),
        (
            separation.value < 1 - SHARE,
            f"{separation.value:.3f} of the separation",
            separation,
        ),
        (_over(cable, 1), f"{cable.value:.3f} of the cable between them apart", cable),
        (
            lowest.value < world.floor * (1 - SHARE),
            f"at {lowest.value:.3f} m, below the floor {world.floor:g} m",
            lowest,
        ),
        (
            _over(highest, world.ceiling),
            f"at {highest.value:.3f} m, above the ceiling {world.ceiling:g} m",
            highest,
        ),
        *(
            (jump.value > most, f"{name} jumps by {jump.value:.2g}", jump)
            for name, jump, most in zip(NAMES, jumps, JUMPS, strict=True)
        ),
    ]
    broken = [f"{extreme.where}: {words}" for wrong, words, extreme in found if wrong]
    broken += [
        f"{each.crossing.name}: the leader passes with a gap of {each.gap:.3f} m "
        f"instead of {each.planned:.3f} m at {each.time:.2f} s"
        for each in crossings
        if each.gap < min(each.planned - TOLERANCE, each.planned * (1 - SHARE)) or each.gap <= 0
    ]
    broken += [
        f"crossing {each.name} is not flown: its time {each.time:.2f} s is not between 0 and "
        f"{plan.duration:.2f} s"
        for each, flown in zip(plan.crossings, fitted, strict=True)
        if flown is None
    ]
    if pieces > MOST_PIECES:
        broken.append(f"{pieces} pieces in one trajectory; a robot keeps {MOST_PIECES}")
    return FitReport(
        parts=max(each.part for each in trajectories),
        pieces=pieces,
        deviation=deviation,
        speed=speed,
        acceleration=steepest,
        separation=separation,
        cable=cable,
        lowest=lowest,
        highest=highest,
        jumps=jumps,
        crossings=crossings,
        broken=tuple(broken),
    )


def _over(extreme: Extreme, limit: float) -> bool:
    return extreme.value > limit * (1 + SHARE)


def _flown(
    plan: FlightPlan, trajectories: Sequence[Trajectory], times: FloatArray, derivative: int
) -> FloatArray:
    """Positions or their derivatives, shape (T, R, 3)."""
    flown = np.zeros((len(times), plan.robots, 3))
    for each in sorted(trajectories, key=lambda each: each.start):
        here = times >= each.start
        values = each.polynomials.at(times[here] - each.start, derivative)
        flown[here, each.robot - 1] = values[:, :3]
    return flown


def _planned(plan: FlightPlan, times: FloatArray) -> FloatArray:
    flat = plan.positions.reshape(len(plan.times), -1)
    columns = [np.interp(times, plan.times, column) for column in flat.T]
    return np.column_stack(columns).reshape(len(times), plan.robots, 3)


def _largest(values: FloatArray, times: FloatArray) -> Extreme:
    sample, robot = np.unravel_index(values.argmax(), values.shape)
    return Extreme(float(values[sample, robot]), (int(robot) + 1,), float(times[sample]))


def _nearest(plan: FlightPlan, position: FloatArray, times: FloatArray) -> Extreme:
    """Least distance of two robots in the metric of the ellipsoid."""
    limits = plan.limits
    scaled = position / [limits.separation, limits.separation, limits.downwash]
    found = []
    for i, j in combinations(range(plan.robots), 2):
        apart = np.linalg.norm(scaled[:, j] - scaled[:, i], axis=1)
        sample = int(apart.argmin())
        found.append(Extreme(float(apart[sample]), (i + 1, j + 1), float(times[sample])))
    return min(found, key=attrgetter("value"))


def _jump(trajectories: Sequence[Trajectory], derivative: int) -> Extreme:
    """The largest jump of a derivative."""
    found = []
    for each in trajectories:
        jumps = each.polynomials.jumps(derivative)
        place = int(jumps.argmax())
        time = each.start + float(each.polynomials.breaks[place])
        found.append(Extreme(float(jumps[place]), (each.robot,), time))
    return max(found, key=attrgetter("value"))


def _crossing(
    crossing: PlannedCrossing, times: FloatArray, leader: FloatArray
) -> FittedCrossing | None:
    """A crossing where the leader comes nearest to its place about the planned time.

    None if it does not fly then.
    """
    near = np.flatnonzero(np.abs(times - crossing.time) <= NEAR)
    if not near.size:
        return None
    away = np.linalg.norm(leader[near, :2] - crossing.place, axis=1)
    sample = int(near[away.argmin()])
    side = 1 if crossing.over else -1
    return FittedCrossing(
        crossing,
        side * (crossing.height - crossing.cable_height),
        float(side * (leader[sample, 2] - crossing.cable_height)),
        float(times[sample]),
    )
