"""A made-up simulator: the cable lies where the leader flew, and robots are where they should be.

It has no physics and needs no package. As the leader passes over and under cable as planned, the
cable it trails is the knot; disturbances are kept on record and disturb nothing.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from knotopt.flight.record import Disturbance, FlightRecord
from knotopt.sim.simulation import FRAME_TIME
from knotopt.sim.simulators import Simulator

EDGES = 40  # of the cable between two robots
NEAR = 1e-3  # of two points of the trail, at least [m]


class TrailingCable:
    """Follows `knotopt.sim.simulation.Simulation`."""

    started = 0

    def __init__(
        self,
        start: np.ndarray,
        lengths: np.ndarray,
        *,
        step: float,
        speed: float,
        disturbance: Disturbance,
    ) -> None:
        TrailingCable.started += 1
        self.disturbance, self.count = disturbance, len(lengths) + 1
        assert step > 0 and speed > 0
        self.trail = [*np.linspace(start[0], start[-1], 20 * self.count)]
        self.at = [20 * j + 10 for j in range(self.count)]  # of the robots on the trail, about
        self.robots = start.copy()
        self.clock = 0.0
        self.held = EDGES * np.arange(self.count)
        self._place(start)
        self.frames = [(0.0, self.cable)]

    def _place(self, robots: np.ndarray) -> None:
        """Robots elsewhere: the leader lengthens the trail, the others go on along it."""
        if np.linalg.norm(robots[-1] - self.trail[-1]) > NEAR:
            self.trail.append(robots[-1].copy())
        trail = np.array(self.trail)
        for j, robot in enumerate(robots[:-1]):
            near = slice(max(0, self.at[j] - 30), self.at[j] + 30)
            away = np.linalg.norm((trail[near] - robot)[:, :2], axis=1)
            self.at[j] = near.start + int(away.argmin())
        self.at[-1] = len(trail) - 1
        spans = []
        for j in range(self.count - 1):
            way = trail[self.at[j] : max(self.at[j + 1], self.at[j] + 1) + 1].copy()
            way[0], way[-1] = robots[j], robots[j + 1]
            even = np.linspace(0, len(way) - 1, EDGES + 1)
            index = np.arange(len(way))
            spans.append(np.column_stack([np.interp(even, index, axis) for axis in way.T])[:-1])
        self.robots = robots.copy()
        self.cable = np.concatenate((*spans, robots[-1:]))

    def follow(self, positions: np.ndarray, interval: float) -> bool:
        for robots in positions[1:]:
            self._place(robots)
            self.clock += interval
            if self.clock - self.frames[-1][0] > FRAME_TIME - 1e-9:
                self.frames.append((self.clock, self.cable))
        return True

    def pull(self, velocities: np.ndarray, goes_on: Callable[[np.ndarray], bool]) -> bool:
        while goes_on(self.robots):
            self.follow(np.stack((self.robots, self.robots + FRAME_TIME * velocities)), FRAME_TIME)
        return True

    def checkpoint(self) -> object:
        return list(self.trail), list(self.at), self.robots, self.cable, self.clock, [*self.frames]

    def restore(self, checkpoint: object) -> None:
        trail, at, self.robots, self.cable, self.clock, frames = checkpoint
        self.trail, self.at, self.frames = list(trail), list(at), list(frames)

    def record(self) -> FlightRecord:
        times = np.array([time for time, _ in self.frames])
        cable = np.array([cable for _, cable in self.frames])
        return FlightRecord(times, times, cable, self.held, True, 0.04, 0.0, self.disturbance, 0.0)


TRAILING = Simulator("trailing", "knotopt", "sim", TrailingCable)
