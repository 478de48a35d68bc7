"""Robots in single file along the leader's route, each stopping at its own place, rear ones first.

Everything is a function of one path coordinate s [m], which the leader's coordinate on its route
follows (`knotopt.flight.route.Route`).
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from scipy.interpolate import CubicSpline

from knotopt.arrays import FloatArray
from knotopt.flight.limits import FlightLimits
from knotopt.flight.route import Route
from knotopt.path.curve import length_along
from knotopt.path.world import World

NODES = 0.03  # between nodes of the path coordinate [m]
FINE = 0.005  # between points to measure its length by [m]
DRAWN = 0.05  # between points of the route in a plan [m]


@dataclass(frozen=True, eq=False)
class Formation:
    """The file of robots on a route.

    Parameters
    ----------
    route : Route
    world : World
    limits : FlightLimits
    spacing : float
        Between robots, by the route's coordinate [m].
    """

    route: Route
    world: World
    limits: FlightLimits
    spacing: float

    @cached_property
    def _curve(self) -> CubicSpline:
        points = self.route.points * self.world.step
        points[:, 2] += self.world.altitude
        return CubicSpline(self.route.along * self.world.step, points)

    @property
    def stops(self) -> FloatArray:
        """Coordinate of every robot's own place on the route, shape (R,) [m]."""
        return self.route.stops * self.world.step

    @property
    def braking(self) -> float:
        """Path coordinate over which a robot comes to rest, halved [m]."""
        return self.limits.speed**2 / (2 * self.limits.acceleration)

    @property
    def begin(self) -> float:
        """Path coordinate at which the flight begins: the leader is where robot 1 will stop."""
        return (len(self.stops) - 1) * self.spacing

    @property
    def end(self) -> float:
        """Path coordinate at which the leader is at its place [m]."""
        return float(self.stops[-1]) + self.braking

    @property
    def nodes(self) -> FloatArray:
        """Path coordinates at even distances, shape (K,)."""
        count = int(np.ceil((self.end - self.begin) / NODES)) + 1
        return np.linspace(self.begin, self.end, count)

    def _along(self, s: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Coordinate of each robot, with derivatives by the path coordinate, shapes (K, R)."""
        behind = np.arange(len(self.stops) - 1, -1, -1) * self.spacing
        free = s[:, None] - behind
        b = self.braking
        left = np.clip(self.stops + b - free, 0, 2 * b)  # until at rest
        flying = free < self.stops - b
        along = np.where(flying, free, self.stops - left**2 / (4 * b))
        rate = np.where(flying, 1.0, left / (2 * b))
        change = np.where(flying | (left == 0), 0.0, -1 / (2 * b))
        return along, rate, change

    def point(self, along: float) -> FloatArray:
        """The route at a coordinate, shape (3,) [m]."""
        return np.asarray(self._curve(along))

    def positions(self, s: FloatArray) -> FloatArray:
        """Positions of the robots at path coordinates, shape (K, R, 3) [m]."""
        along, _, _ = self._along(s)
        return np.asarray(self._curve(along))

    def derivatives(self, s: FloatArray) -> tuple[FloatArray, FloatArray]:
        """First and second derivative of the positions by the path coordinate, (K, R, 3)."""
        along, rate, change = self._along(s)
        tangent, curvature = self._curve(along, 1), self._curve(along, 2)
        first = tangent * rate[..., None]
        return first, curvature * rate[..., None] ** 2 + tangent * change[..., None]

    @cached_property
    def _fine(self) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Coordinates, points and arc lengths of the route at small steps."""
        end = float(self.route.along[-1]) * self.world.step
        along = np.linspace(0, end, int(np.ceil(end / FINE)) + 1)
        points = self._curve(along)
        return along, points, length_along(points)

    def arc_length(self, along: float) -> float:
        """Arc length of the route up to a coordinate [m]."""
        coordinates, _, lengths = self._fine
        return float(np.interp(along, coordinates, lengths))

    def drawn(self) -> FloatArray:
        """The route at even distances, shape (m, 3) [m]."""
        _, points, lengths = self._fine
        even = np.linspace(0, lengths[-1], int(np.ceil(lengths[-1] / DRAWN)) + 1)
        return np.column_stack([np.interp(even, lengths, points[:, k]) for k in range(3)])

    @property
    def separation(self) -> float:
        """Least distance of two robots at nodes, 1 on the ellipsoid of the limits."""
        positions = self.positions(self.nodes)
        least = np.inf
        for first in range(positions.shape[1] - 1):
            apart = positions[:, first + 1 :] - positions[:, first : first + 1]
            flat = (apart[..., :2] ** 2).sum(axis=2) / self.limits.separation**2
            least = min(least, float((flat + (apart[..., 2] / self.limits.downwash) ** 2).min()))
        return float(np.sqrt(least))

    @property
    def farthest(self) -> FloatArray:
        """The farthest that consecutive robots get apart, shape (R - 1,) [m]."""
        positions = self.positions(self.nodes)
        return np.asarray(np.linalg.norm(np.diff(positions, axis=1), axis=2).max(axis=0))
