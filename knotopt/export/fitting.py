"""Polynomials fitted to a flight plan: hovers, and septic splines between them.

Breakpoints are spread so that a polynomial of its own would be equally wrong on every piece, as
accurate as the number of pieces allows; what follows is each stretch's own (see `stretch`).
"""

from __future__ import annotations

from functools import lru_cache
from itertools import pairwise

import numpy as np

from knotopt.arrays import FloatArray
from knotopt.export.polynomials import DEGREE, MOST_PIECES, Polynomials, Trajectory
from knotopt.export.stretch import SHORTEST, TOLERANCE, Stretch
from knotopt.export.waypoints import YAW
from knotopt.flight.limits import FlightLimits
from knotopt.flight.plan import FlightPlan

AIM = 2e-4  # error of a polynomial fitted to one piece alone, which mostly makes for `GOAL` [m]
LARGEST = 100.0  # error, for which one piece is enough [m]
FINE = 0.01  # at most between the times at which the fit is made [s]
STILL = 1e-3  # slower is hovering [m/s], if it stays within STAY
STAY = 1e-3  # [m]
HOVER = 1.0  # a shorter hover is no piece of its own [s]
MARGIN = 0.4  # of hovering that a moving piece may use to set off smoothly [s]
REST = 0.5  # of all robots, in which a part can end [s]


def fit_trajectories(plan: FlightPlan) -> tuple[Trajectory, ...]:
    """Fit at most 31 polynomials to every robot's positions.

    Where that many do not come within 1 cm of the plan for all robots, and all of them rest at some
    time in between, the flight is cut there into as few consecutive parts as do. Where they never
    rest, what comes closest is returned: `recheck` says how close.

    Parameters
    ----------
    plan : FlightPlan

    Returns
    -------
    tuple of Trajectory
        Part by part, robot by robot.
    """
    cuts = [0, *_rests(plan), len(plan.times) - 1]
    parts: list[tuple[int, list[Polynomials]]] = []
    start = 0
    while start < len(cuts) - 1:
        for end in range(len(cuts) - 1, start, -1):
            fits = _fit_all(plan, cuts[start], cuts[end])
            if end == start + 1 or max(deviation for _, deviation in fits) <= TOLERANCE:
                break
        parts.append((cuts[start], [polynomials for polynomials, _ in fits]))
        start = end
    return tuple(
        Trajectory(robot, part, float(plan.times[first]), fit)
        for part, (first, fits) in enumerate(parts, 1)
        for robot, fit in enumerate(fits, 1)
    )


def _rests(plan: FlightPlan) -> list[int]:
    """Samples amid each rest of all robots, those at the flight's beginning and end left out."""
    track = plan.positions.reshape(len(plan.times), -1)
    last = len(track) - 1
    return [
        (first + end) // 2
        for first, end in _still(plan.times, track)
        if first > 0 and end < last and plan.times[end] - plan.times[first] >= REST
    ]


def _still(times: FloatArray, track: FloatArray) -> list[tuple[int, int]]:
    """First and last samples of the hovers of a track, shape (T, any)."""
    slow = np.abs(np.diff(track, axis=0)).max(axis=1) < STILL * np.diff(times)
    edges = np.flatnonzero(np.diff(np.concatenate(([False], slow, [False])))).reshape(-1, 2)
    return [
        (first, last)
        for first, last in edges.tolist()
        if np.ptp(track[first : last + 1], axis=0).max() < STAY
    ]


def _fit_all(plan: FlightPlan, first: int, last: int) -> list[tuple[Polynomials, float]]:
    """The polynomials of every robot between two samples, and its deviation."""
    times = plan.times[first : last + 1] - plan.times[first]
    tracks = plan.positions[first : last + 1].swapaxes(0, 1)
    return [_fit_robot(times, track, plan.limits) for track in tracks]


def _fit_robot(
    times: FloatArray, track: FloatArray, limits: FlightLimits
) -> tuple[Polynomials, float]:
    """The polynomials of one robot on one part of the plan, which it begins and ends at rest."""
    hovers = _hovers(times, track)
    if 2 * len(hovers) + 1 > MOST_PIECES:
        hovers = []
    held = {end: track[sum(hover) // 2] for hover in hovers for end in hover}
    fine = _finely(times, track)
    stretches = []
    for samples in _spread(track, hovers, max(5, int(np.ceil(SHORTEST / (times[1] - times[0]))))):
        first, last = samples[0], samples[-1]
        ends = np.array([held.get(end, track[end]) for end in (first, last)])
        inside = (fine[0] >= times[first]) & (fine[0] <= times[last])
        stretches.append(Stretch(fine[0][inside], fine[1][inside], ends, times[samples]))
    spare = MOST_PIECES - sum(stretch.pieces for stretch in stretches)
    for stretch in sorted(stretches, key=lambda stretch: -stretch.error):
        spare += stretch.pieces
        stretch.improve(spare - stretch.pieces)
        stretch.restrain(limits, spare - stretch.pieces)
        spare -= stretch.pieces
    splines = [(stretch.spline, stretch.breaks) for stretch in stretches]
    deviation = max(stretch.error for stretch in stretches)
    return Polynomials.from_splines(splines, YAW), deviation


def _hovers(times: FloatArray, track: FloatArray) -> list[tuple[int, int]]:
    """First and last samples of a robot's hovers, less what its moving before and after takes."""
    margin = int(np.ceil(MARGIN / (times[1] - times[0])))
    end = len(times) - 1
    return [
        (first + margin * (first > 0), last - margin * (last < end))
        for first, last in _still(times, track)
        if times[last] - times[first] >= HOVER
    ]


def _spread(track: FloatArray, hovers: list[tuple[int, int]], shortest: int) -> list[list[int]]:
    """Breakpoints, as samples, of each hover and each stretch between hovers.

    All pieces are as wrong as each other, by `AIM` or as little more as there are pieces for.
    """
    ends = sorted({0, len(track) - 1, *(end for hover in hovers for end in hover)})

    def breaks(error: float) -> list[list[int]]:
        return [
            [first, last]
            if (first, last) in hovers
            else _equal(track, first, last, error, shortest)
            for first, last in pairwise(ends)
        ]

    low, high, best = AIM, LARGEST, breaks(AIM)
    if [len(stretch) for stretch in best] == [2]:  # the reader of Crazyswarm2 fails on one line
        return [[0, ends[-1] // 2, ends[-1]]]
    if sum(len(stretch) - 1 for stretch in best) <= MOST_PIECES:
        return best
    best = breaks(high)
    while high > 1.1 * low:
        middle = float(np.sqrt(low * high))
        found = breaks(middle)
        if sum(len(stretch) - 1 for stretch in found) <= MOST_PIECES:
            best, high = found, middle
        else:
            low = middle
    return best


def _equal(track: FloatArray, first: int, last: int, error: float, shortest: int) -> list[int]:
    """Breakpoints such that no piece, fitted by itself, is further off than `error`."""
    breaks = [first]
    while breaks[-1] < last:
        begin = breaks[-1]
        long, step = min(begin + shortest, last), 2 * shortest
        while begin + step < last and _error(track[begin : begin + step + 1]) <= error:
            long, step = begin + step, 2 * step
        short, too_long = long, min(begin + step, last + 1)
        while too_long - short > 1:
            middle = (short + too_long) // 2
            if _error(track[begin : middle + 1]) <= error:
                short = middle
            else:
                too_long = middle
        breaks.append(short if last - short >= shortest else last)
        if short < last == breaks[-1] and short - shortest - begin >= shortest:
            breaks.insert(-1, last - shortest)
    return breaks


def _error(track: FloatArray) -> float:
    """Largest distance from a stretch of a track to the polynomial nearest to it."""
    basis = _basis(len(track))
    residual = track - basis @ (basis.T @ track)
    return float(np.sqrt((residual**2).sum(axis=1).max()))


@lru_cache(maxsize=512)
def _basis(count: int) -> FloatArray:
    """Orthonormal polynomials at evenly spaced places, shape (count, 8)."""
    places = np.linspace(-1, 1, count)
    return np.asarray(np.linalg.qr(np.polynomial.legendre.legvander(places, DEGREE))[0])


def _finely(times: FloatArray, track: FloatArray) -> tuple[FloatArray, FloatArray]:
    """A track at times so close that the spline cannot swing between them."""
    every = int(np.ceil((times[1] - times[0]) / FINE))
    fine = np.interp(np.arange((len(times) - 1) * every + 1) / every, np.arange(len(times)), times)
    return fine, np.column_stack([np.interp(fine, times, track[:, axis]) for axis in range(3)])
