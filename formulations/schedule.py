"""The fastest way along a path that several bodies take together: a convex program.

Positions are functions of one path coordinate s. With b(s) = (ds/dt)^2, linear between nodes, time
is the integral of ds / sqrt(b), velocities are q' sqrt(b) and accelerations q'' b + q' b' / 2
(Verscheure et al. 2009, doi:10.1109/TAC.2009.2028959). Limits on the length of both are convex in
b, and so is the time: a local optimum is the global one of this discretisation.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from itertools import pairwise

import casadi as ca
import numpy as np

from formulations.arrays import BoolArray, FloatArray

CRAWL = 1e-4  # least share of the largest path speed, squared; it is zero at both ends only
STILL = 1e-6  # a body with smaller derivatives stands
TOLERANCE = 1e-5  # of the program, relative
INSIDE = 0.5  # share of a schedule within the limits that IPOPT starts from
ROUNDS = 8  # of adding rows


@dataclass(frozen=True)
class Schedule:
    """When a path is where.

    Attributes
    ----------
    nodes, times, pace : float arrays, shape (K,)
        Path coordinate, time from 0 [s] and rate of the path coordinate at each node.
    is_optimal : bool
    raw_status : str
        IPOPT's return status, or what replaced it.
    iterations : int
    """

    nodes: FloatArray
    times: FloatArray
    pace: FloatArray
    is_optimal: bool
    raw_status: str
    iterations: int

    @property
    def duration(self) -> float:
        """From rest to rest [s]."""
        return float(self.times[-1])

    def when(self, coordinate: float) -> float:
        """Time at which the path coordinate is reached."""
        times = np.linspace(0, self.duration, 4 * len(self.nodes))
        return float(np.interp(coordinate, self.at(times), times))

    def at(self, time: FloatArray) -> FloatArray:
        """Path coordinate at times; the rate changes evenly between nodes."""
        time = np.clip(time, 0, self.times[-1])
        k = np.clip(np.searchsorted(self.times, time, side="right") - 1, 0, len(self.nodes) - 2)
        gone = time - self.times[k]
        rate = (self.pace[k + 1] - self.pace[k]) / (self.times[k + 1] - self.times[k])
        found: FloatArray = self.nodes[k] + gone * (self.pace[k] + rate * gone / 2)
        return np.clip(found, self.nodes[0], self.nodes[-1])


def greedy_schedule(
    nodes: FloatArray, first: FloatArray, second: FloatArray, speed: float, acceleration: float
) -> Schedule:
    """A schedule within the limits, by one pass forward and one back; nearly the fastest.

    The path speeds up and slows down by 80 % of what |q'' b + q' r| <= a leaves for r = b' / 2 of
    every body, a quadratic in r.
    """
    size = np.maximum(np.linalg.norm(first, axis=2), STILL)
    bend = np.linalg.norm(second, axis=2)
    mixed = (first * second).sum(axis=2)
    worst = np.maximum(bend.max(axis=1), STILL)
    cap = np.minimum((speed / size.max(axis=1)) ** 2, 0.9 * acceleration / worst)
    b = cap.copy()
    for order, way in ((np.arange(len(nodes)), 1.0), (np.arange(len(nodes))[::-1], -1.0)):
        b[order[0]] = 0.0
        for here, there in pairwise(order.tolist()):
            along = way * mixed[here] * b[here]
            spare = acceleration**2 - (bend[here] * b[here]) ** 2
            root = np.sqrt(np.maximum(along**2 + size[here] ** 2 * spare, 0))
            moving = size[here] > STILL
            rate = float(((root - along) / size[here] ** 2)[moving].min(initial=np.inf))
            gain = 2 * max(rate, 0.0) * abs(nodes[there] - nodes[here])
            b[there] = min(b[there], b[here] + 0.8 * gain)
    pace = np.sqrt(np.maximum(b, CRAWL * np.median(cap)))
    return Schedule(nodes, _times(nodes, pace), pace, False, "greedy", 0)


def fastest_schedule(
    nodes: FloatArray, first: FloatArray, second: FloatArray, speed: float, acceleration: float
) -> Schedule:
    """The fastest schedule from rest to rest.

    Parameters
    ----------
    nodes : float array, shape (K,)
        Increasing path coordinates.
    first, second : float arrays, shape (K, R, 3)
        Derivatives of the bodies' positions by the path coordinate.
    speed, acceleration : float
        Limits of each body.
    """
    count = len(nodes)
    size, bend = np.linalg.norm(first, axis=2), np.linalg.norm(second, axis=2)
    fastest = np.maximum(size.max(axis=1), STILL)
    low = np.full(count, CRAWL * float(np.median((speed / fastest) ** 2)))
    high = np.maximum((speed / fastest) ** 2, low)
    high[[0, -1]] = low[[0, -1]]
    greedy = greedy_schedule(nodes, first, second, speed, acceleration)
    b = np.clip(INSIDE * greedy.pace**2, low, high)
    # Most of what one body asks another asks more of: rows that are broken are added in rounds.
    wanted = np.zeros(size.shape, dtype=bool)
    wanted[np.arange(count), bend.argmax(axis=1)] = True
    wanted[np.arange(count), size.argmax(axis=1)] = True
    iterations = 0
    for _ in range(ROUNDS):
        b, status, taken = _solve(nodes, first, second, wanted, acceleration, low, high, b)
        iterations += taken
        asked = _accelerations(nodes, first, second, b)
        broken = (asked > acceleration * (1 + TOLERANCE)) & ~wanted
        if not broken.any():
            break
        wanted |= asked > 0.8 * acceleration
    # What tolerances leave is taken out by flying slower throughout.
    worst = max(float(asked.max()) / acceleration, 1.0)
    pace = np.sqrt(b / worst)
    times = _times(nodes, pace)
    is_optimal = status == "Solve_Succeeded" and worst < 1 + 1e2 * TOLERANCE
    if not is_optimal and greedy.duration < times[-1]:
        return replace(greedy, raw_status=status, iterations=iterations)
    return Schedule(nodes, times, pace, is_optimal, status, iterations)


def _accelerations(
    nodes: FloatArray, first: FloatArray, second: FloatArray, b: FloatArray
) -> FloatArray:
    """The larger of the accelerations before and after each node, shape (K, R)."""
    rate = np.diff(b) / np.diff(nodes) / 2
    sides = (np.concatenate((rate[:1], rate)), np.concatenate((rate, rate[-1:])))
    both = (
        np.linalg.norm(second * b[:, None, None] + first * side[:, None, None], axis=2)
        for side in sides
    )
    found: FloatArray = np.maximum(*both)
    return found


def _solve(
    nodes: FloatArray,
    first: FloatArray,
    second: FloatArray,
    wanted: BoolArray,
    acceleration: float,
    low: FloatArray,
    high: FloatArray,
    guess: FloatArray,
) -> tuple[FloatArray, str, int]:
    """The program with the acceleration rows of these nodes and bodies."""
    count, step = len(nodes), np.diff(nodes)
    node, body = np.nonzero(wanted)
    b = ca.SX.sym("b", count)
    slope = (b[1:] - b[:-1]) / step
    along, across = ca.DM(first[node, body]), ca.DM(second[node, body])
    rows = []
    for interval in (np.maximum(node - 1, 0), np.minimum(node, count - 2)):
        here, rate = b[node.tolist()], slope[interval.tolist()] / 2
        pull = across * ca.repmat(here, 1, 3) + along * ca.repmat(rate, 1, 3)
        rows.append(ca.sum2(pull**2) / acceleration**2)
    root = ca.sqrt(b)
    time = ca.sum1(2 * ca.DM(step) / (root[1:] + root[:-1]))
    options: dict[str, int | float | str] = {"print_level": 0, "sb": "yes", "max_iter": 200}
    options["tol"] = TOLERANCE
    program = {"x": b, "f": time, "g": ca.vertcat(*rows)}
    solver = ca.nlpsol("schedule", "ipopt", program, {"print_time": False, "ipopt": options})
    answer = solver(x0=guess, lbx=low, ubx=high, lbg=-np.inf, ubg=1.0)
    stats = solver.stats()
    found = np.clip(np.array(answer["x"]).ravel(), low, high)
    return found, str(stats["return_status"]), int(stats["iter_count"])


def steady_schedule(
    nodes: FloatArray, first: FloatArray, second: FloatArray, speed: float, acceleration: float
) -> Schedule:
    """The same at one path speed throughout, the largest that keeps the limits, with ramps."""
    size = np.linalg.norm(first, axis=2).max(axis=1)
    bend = np.linalg.norm(second, axis=2).max(axis=1)
    # While it speeds up a body uses at most 70 % of its acceleration along and 70 % across.
    across = np.sqrt(0.5) * acceleration
    pace = min(speed / size.max(), float(np.sqrt(across / max(bend.max(), STILL))))
    rate = np.sqrt(0.5) * acceleration / size.max()
    length = nodes[-1] - nodes[0]
    pace = min(pace, float(np.sqrt(rate * length)))
    gone = nodes - nodes[0]
    ramp = pace**2 / (2 * rate)
    left = length - gone
    rates = np.sqrt(2 * rate * np.minimum(np.minimum(gone, left), ramp))
    rates = np.maximum(rates, np.sqrt(CRAWL) * pace)
    return Schedule(nodes, _times(nodes, rates), rates, True, "steady", 0)


def _times(nodes: FloatArray, pace: FloatArray) -> FloatArray:
    """When a path is at its nodes, from rates that change evenly between them."""
    return np.concatenate(([0.0], np.cumsum(2 * np.diff(nodes) / (pace[1:] + pace[:-1]))))
