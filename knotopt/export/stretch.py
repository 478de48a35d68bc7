"""The septic spline of a robot between two rests: close to its plan, and within its limits.

In the B-spline basis of degree 7 with inner knots of multiplicity 4 a spline is continuous to the
third derivative whatever its coefficients, and at rest at both ends if the first and the last four
are equal (de Boor, "A Practical Guide to Splines", 2001, chapter IX). Its other coefficients are
those of weighted least squares.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.interpolate import BSpline
from scipy.sparse import csc_array
from scipy.sparse.linalg import spsolve

from knotopt.arrays import FloatArray
from knotopt.export.polynomials import DEGREE
from knotopt.flight.limits import FlightLimits

TOLERANCE = 0.01
"""How far from the plan a robot may fly [m]."""

SHORTEST = 0.1
"""Shortest piece [s]: its four unknowns need more samples than that."""

GOAL = 1e-3  # error that is small enough [m]
KEPT = 0.99  # share of the largest speed and acceleration to which splines are pulled back
PULL = {1: 100.0, 2: 0.3}  # how hard that is, by the derivative
SPENT = 12  # pieces at most on keeping them
ROUNDS = 24  # of moving breakpoints, of weighing, and of pulling


class Stretch:
    """What a robot does between two rests, and the best spline found for it.

    Attributes
    ----------
    breaks : float array, shape (n + 1,)
        [s]
    spline : BSpline
        Of x, y and z [m].
    error : float
        Its largest distance to the track [m].
    """

    breaks: FloatArray
    spline: BSpline
    error: float

    def __init__(
        self, times: FloatArray, track: FloatArray, ends: FloatArray, breaks: FloatArray
    ) -> None:
        self._times, self._track, self._ends = times, track, ends
        self.error = np.inf
        self.fit(breaks, np.ones(len(times)))

    @property
    def pieces(self) -> int:
        """Number of polynomials."""
        return len(self.breaks) - 1

    def fit(self, breaks: FloatArray, weights: FloatArray) -> FloatArray:
        """Fit to given breakpoints, keep it if it is the best; return distances to the track."""
        breaks = np.round(breaks, 6)
        spline = self._spline(breaks, weights)
        off = self._off(spline)
        if off.max() < self.error:
            self.breaks, self.spline, self.error = breaks, spline, float(off.max())
            self._weights = weights.copy()
        return off

    def improve(self, spare: int) -> None:
        """Spend spare pieces where the error is, move breakpoints there, then weigh by it.

        The last is Lawson's algorithm, which turns least squares into the least maximum.
        """
        weights = np.ones(len(self._times))
        breaks, off = self.breaks, self._off(self.spline)
        for _ in range(spare):
            more = _halved(breaks, self._times[off.argmax()])
            if self.error <= GOAL or len(more) == len(breaks):
                break
            breaks = more
            off = self.fit(breaks, weights)
        breaks, off = self.breaks, self._off(self.spline)
        for _ in range(ROUNDS):
            if self.error <= GOAL:
                return
            first = np.minimum(np.searchsorted(self._times, breaks[:-1]), len(off) - 1)
            errors = np.maximum.reduceat(off, first)
            share = np.cumsum((errors / errors.max() + 0.02) ** (1 / (DEGREE + 1)))
            share = np.concatenate(([0], share)) / share[-1]
            breaks = np.interp(np.linspace(0, 1, len(breaks)), share, breaks)
            if np.diff(breaks).min() < SHORTEST:
                break
            off = self.fit(breaks, weights)
        breaks = self.breaks
        for _ in range(ROUNDS):
            off = self.fit(breaks, weights)
            weights *= 0.3 + off / off.max()
            weights /= weights.mean()

    def restrain(self, limits: FlightLimits, spare: int) -> None:
        """Give up some accuracy where a spline overshoots the largest speed and acceleration.

        Where that is not enough, spare pieces are spent there.
        """
        allowed = max(self.error, 0.95 * TOLERANCE)
        excess, place = self._pull_back(limits, allowed)
        kept = excess, self.spline, self.error, self.breaks
        for _ in range(min(spare, SPENT)):
            more = _halved(self.breaks, place)
            if kept[0] <= 1 or len(more) == len(self.breaks):
                break
            self.error = np.inf
            self.fit(more, np.ones(len(self._times)))
            excess, place = self._pull_back(limits, allowed)
            if excess < kept[0] and self.error <= allowed:
                kept = excess, self.spline, self.error, self.breaks
        _, self.spline, self.error, self.breaks = kept

    def _pull_back(self, limits: FlightLimits, allowed: float) -> tuple[float, float]:
        """Pull derivatives back to the limits, the harder the longer they exceed them.

        Returns the largest share of a limit, and when that is; the error may grow as allowed.
        """
        most = {1: limits.speed, 2: limits.acceleration}
        force = {order: np.zeros(len(self._times)) for order in most}
        weights = np.maximum(self._weights, 0.1)
        spline, least, place = self.spline, np.inf, 0.0
        for _ in range(ROUNDS):
            pulls, shares = [], np.zeros(len(self._times))
            for order, limit in most.items():
                value = spline(self._times, nu=order)
                share = np.linalg.norm(value, axis=1) / limit
                size = np.maximum(share / KEPT, 1)
                force[order] += PULL[order] * (size - 1)
                pulls.append(_Pull(order, force[order], value / size[:, None]))
                shares = np.maximum(shares, share)
            off = self._off(spline)
            weights *= 1 + np.maximum(off / allowed - 0.5, 0)
            error = float(off.max())
            if shares.max() < least and error <= max(allowed, self.error):
                self.spline, self.error = spline, error
                least, place = float(shares.max()), float(self._times[shares.argmax()])
            if least <= 1:
                break
            spline = self._spline(self.breaks, weights, pulls)
        return least, place

    def _off(self, spline: BSpline) -> FloatArray:
        return np.asarray(np.linalg.norm(spline(self._times) - self._track, axis=1))

    def _spline(
        self, breaks: FloatArray, weights: FloatArray, pulls: Sequence[_Pull] = ()
    ) -> BSpline:
        """The spline nearest to the track in the sense of weighted squares."""
        half = (DEGREE + 1) // 2
        inner = np.repeat(breaks[1:-1], half)
        knots = np.concatenate(([breaks[0]] * 2 * half, inner, [breaks[-1]] * 2 * half))
        times = np.clip(self._times, breaks[0], breaks[-1])
        design = BSpline.design_matrix(times, knots, DEGREE)
        values = np.zeros((design.shape[1], 3))
        values[:half], values[-half:] = self._ends
        if len(inner):
            free = slice(half, -half)
            weighted = design[:, free].multiply(weights[:, None]).tocsr()
            matrix = weighted.T @ design[:, free]
            right = weighted.T @ (self._track - design @ values)
            for pull in pulls:
                strong = pull.weights > 0
                rows = BSpline(knots, np.eye(len(values)), DEGREE)(times[strong], nu=pull.order)
                heavy = rows[:, free].T * pull.weights[strong]
                matrix = matrix + csc_array(heavy @ rows[:, free])
                right = right + heavy @ (pull.target[strong] - rows @ values)
            values[free] = spsolve(matrix.tocsc(), right)
        return BSpline(knots, values, DEGREE)


@dataclass(frozen=True, eq=False)
class _Pull:
    """What a derivative of a spline ought to be, and how much that weighs, over time."""

    order: int
    weights: FloatArray  # (T,)
    target: FloatArray  # (T, 3)


def _halved(breaks: FloatArray, time: float) -> FloatArray:
    """Breakpoints and one more: in the longest of the piece at a time and those beside it.

    Beside a long piece, even a bad one, a short one has no freedom. None is added where all are
    too short.
    """
    lengths = np.diff(breaks)
    here = int(np.searchsorted(breaks[1:-1], time))
    first = max(here - 1, 0)
    longest = first + int(lengths[first : here + 2].argmax())
    if lengths[longest] < 2 * SHORTEST:
        return breaks
    return np.insert(breaks, longest + 1, breaks[longest : longest + 2].mean())
