"""A path as a curve in space by arc length: a C2 cubic spline, or a polyline."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from scipy.interpolate import CubicSpline, PPoly

from knotopt.arrays import FloatArray
from knotopt.errors import RequirementError

GAUSS_NODES, GAUSS_WEIGHTS = np.polynomial.legendre.leggauss(5)


def length_along(points: FloatArray) -> FloatArray:
    """Length of a polyline up to each of its points, shape (m,)."""
    steps = np.linalg.norm(np.diff(points, axis=0), axis=1)
    return np.concatenate(([0], np.cumsum(steps)))


@dataclass(frozen=True, eq=False)
class Curve:
    """A curve through points in space, called with arc length.

    Parameters
    ----------
    points : float array, shape (m, 3)
        [grid steps, or metres in a `World`]
    is_smooth : bool
        Whether the curve is the natural cubic spline through the points, parametrised by chord
        length, which has a continuous curvature, or the polyline.

    Raises
    ------
    RequirementError
        A point that is not finite, or two neighbours that coincide.

    Examples
    --------
    >>> curve = Curve(np.array([[0.0, 0, 0], [1, 0, 0], [3, 0, 0]]), is_smooth=True)
    >>> round(curve.length, 9), curve.position(1.5).round(9).tolist()
    (3.0, [1.5, 0.0, 0.0])
    >>> curve.tangent(np.array([0.0, 2.0])).round(9).tolist()
    [[1.0, 0.0, 0.0], [1.0, 0.0, 0.0]]
    >>> curve.curvature(1.0).round(9).tolist()
    0.0
    """

    points: FloatArray
    is_smooth: bool

    def __post_init__(self) -> None:
        points = np.asarray(self.points, dtype=np.float64)
        object.__setattr__(self, "points", points)
        if points.ndim != 2 or points.shape[1] != 3 or len(points) < 2:
            raise RequirementError(f"a curve needs two points [x, y, z], not {points.shape}")
        for k in np.flatnonzero(~np.isfinite(points).all(axis=1)).tolist():
            raise RequirementError(f"point {k} of the curve is not finite: {points[k].tolist()}")
        for k in np.flatnonzero(~np.diff(points, axis=0).any(axis=1)).tolist():
            raise RequirementError(f"points {k} and {k + 1} of the curve coincide")

    @cached_property
    def length(self) -> float:
        """Length of the curve."""
        return float(self.marks[-1])

    @cached_property
    def marks(self) -> FloatArray:
        """Arc length at each point, shape (m,)."""
        if not self.is_smooth:
            return self._chords
        start, width = self._chords[:-1, None], np.diff(self._chords)[:, None]
        velocity = self._spline(start + width * (GAUSS_NODES + 1) / 2, 1)
        pieces = (np.linalg.norm(velocity, axis=-1) * GAUSS_WEIGHTS).sum(axis=1) * width[:, 0] / 2
        return np.concatenate(([0], np.cumsum(pieces)))

    def position(self, s: float | FloatArray) -> FloatArray:
        """Position at arc length s, which is clipped to [0, length], shape (..., 3)."""
        return np.asarray(self._spline(self._parameter(s)))

    def tangent(self, s: float | FloatArray) -> FloatArray:
        """Unit tangent at arc length s, shape (..., 3)."""
        velocity = np.asarray(self._spline(self._parameter(s), 1))
        tangent: FloatArray = velocity / np.linalg.norm(velocity, axis=-1, keepdims=True)
        return tangent

    def curvature(self, s: float | FloatArray) -> FloatArray:
        """Curvature at arc length s [1 / length]; that of a polyline is 0 between its points."""
        u = self._parameter(s)
        velocity, acceleration = np.asarray(self._spline(u, 1)), np.asarray(self._spline(u, 2))
        turn = np.linalg.norm(np.cross(velocity, acceleration), axis=-1)
        curvature: FloatArray = turn / np.linalg.norm(velocity, axis=-1) ** 3
        return curvature

    def sample(self, step: float) -> FloatArray:
        """Points about a step apart, the curve's own among them, shape (k, 3)."""
        chords = np.diff(self._chords)
        count = np.maximum(1, np.ceil(chords / step)).astype(np.int64)
        start = np.repeat(np.arange(len(chords)), count)
        share = np.concatenate([np.arange(n) / n for n in count.tolist()])
        u = np.append(self._chords[start] + share * chords[start], self._chords[-1])
        return np.asarray(self._spline(u))

    @cached_property
    def _chords(self) -> FloatArray:
        return length_along(self.points)

    @cached_property
    def _spline(self) -> PPoly:
        if self.is_smooth and len(self.points) > 2:
            return CubicSpline(self._chords, self.points, bc_type="natural")
        slopes = np.diff(self.points, axis=0) / np.diff(self._chords)[:, None]
        return PPoly(np.stack((slopes, self.points[:-1])), self._chords)

    def _parameter(self, s: float | FloatArray) -> FloatArray:
        """Chord-length parameter at arc length s: a first guess and Newton's steps."""
        s = np.clip(s, 0, self.length)
        u = np.interp(s, self.marks, self._chords)
        if not self.is_smooth:
            return np.asarray(u)
        piece = np.clip(np.searchsorted(self.marks, s, side="right") - 1, 0, len(self.marks) - 2)
        low, high = self._chords[piece], self._chords[piece + 1]
        for _ in range(6):
            half = (np.asarray(u) - low)[..., None] / 2
            nodes = low[..., None] + half * (GAUSS_NODES + 1)
            speeds = np.linalg.norm(self._spline(nodes, 1), axis=-1)
            reached = self.marks[piece] + (speeds * GAUSS_WEIGHTS * half).sum(axis=-1)
            speed = np.linalg.norm(self._spline(u, 1), axis=-1)
            u = np.clip(u - (reached - s) / speed, low, high)
        return np.asarray(u)
