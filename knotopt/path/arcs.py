"""Crossing-height arcs on a path of given plan, whatever its crossings are."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from knotopt.arrays import BoolArray, FloatArray, IndexArray, IntArray
from knotopt.cable.cable import Cable
from knotopt.path.curve import Curve, length_along
from knotopt.path.heights import height_arcs
from knotopt.path.mesh import between, robot_times
from knotopt.path.plane import cross
from knotopt.topology.crossings import crossings_and_contacts, projection

SPACING = 0.5  # of the points that the curve goes through, at most [grid steps]
JITTER = 1e-6  # that separates strands which touch in a vertex [grid steps]


@dataclass(frozen=True, eq=False)
class _PlanCrossings:
    """Crossings of a plan path, in the order first met.

    first, second: where along it, k + u is in segment k at share u; point: shape (C, 2).
    """

    first: FloatArray
    second: FloatArray
    point: FloatArray

    @property
    def visited(self) -> IntArray:
        """Which crossing each visit is to, in the order of the visits, shape (2C,)."""
        order = np.argsort(np.concatenate((self.first, self.second)))
        return np.tile(np.arange(len(self.first)), 2)[order]


def with_arcs(
    cable: Cable, supports: tuple[int, ...], plan: FloatArray, times: FloatArray, gap: float
) -> tuple[Curve, FloatArray]:
    """A plan path lifted over its crossings, smooth if that keeps them.

    At a crossing of a column with a row of the grid the column passes over, as on the grid; at any
    other one, which the grid does not have, the later strand does.

    Parameters
    ----------
    cable : Cable
    supports : tuple of int
    plan : float array, shape (m, 2) [grid steps]
    times : float array, shape (m,), increasing
        Time on the grid of each point; robots' times are among them.
    gap : float
        Vertical distance at crossings [grid steps].

    Returns
    -------
    Curve, float array
        The curve and the time of each of its points, crossings among them.
    """
    plan, times = _denser(plan, times)
    crossings = _crossings(plan)
    if crossings is None:
        plan = plan + JITTER * np.random.default_rng(0).standard_normal(plan.shape)
        crossings = _crossings(plan)
        assert crossings is not None
    at = np.concatenate((crossings.first, crossings.second))
    places = np.arange(len(plan), dtype=np.float64)
    where = np.concatenate((places, at))
    order = np.argsort(where, kind="stable")
    points = np.concatenate((plan, crossings.point, crossings.point))[order]
    every = np.interp(where[order], places, times)
    rank = np.argsort(order)
    first, second = rank[len(plan) :].reshape(2, -1)
    first_over = _first_over(cable, np.interp(at, places, times).reshape(2, -1))
    robots = np.searchsorted(times, robot_times(cable, supports))
    along = length_along(points)
    heights = height_arcs(
        along + 1e-9 * np.arange(len(along)),
        rank[robots],
        np.where(first_over, first, second),
        np.where(first_over, second, first),
        gap,
    )
    points = np.column_stack((points, heights))
    distinct = np.concatenate(([True], np.diff(along) > 1e-9))
    points, every = points[distinct], every[distinct]
    smooth = Curve(points, is_smooth=True)
    return (smooth if _same_crossings(smooth, crossings) else Curve(points, False)), every


def _crossings(plan: FloatArray) -> _PlanCrossings | None:
    """The crossings of a plan path; None where it touches itself.

    Which segments cross, or touch, is exact; where they cross is in floating point.
    """
    seen = projection(np.column_stack((plan, np.zeros(len(plan)))))
    found, contacts = crossings_and_contacts(seen, 0.0, 0.0)
    if contacts or len(seen.flat) < len(plan):
        return None
    i, j = found.i, found.j
    u, v = _share(plan, i, j), _share(plan, j, i)
    order = np.argsort(i + u)
    point = plan[i] + u[:, None] * (plan[i + 1] - plan[i])
    return _PlanCrossings((i + u)[order], (j + v)[order], point[order])


def _share(plan: FloatArray, i: IndexArray, j: IndexArray) -> FloatArray:
    """Where segments i meet the lines of segments j."""
    step = plan[j + 1] - plan[j]
    before, after = cross(step, plan[i] - plan[j]), cross(step, plan[i + 1] - plan[j])
    return before / (before - after)


def _denser(plan: FloatArray, times: FloatArray) -> tuple[FloatArray, FloatArray]:
    """The same polyline with points between, so that a spline through them stays beside it."""
    steps = np.linalg.norm(np.diff(plan, axis=0), axis=1)
    count = np.maximum(1, np.ceil(steps / SPACING)).astype(np.int64)
    places = np.concatenate([k + np.arange(n) / n for k, n in enumerate(count)] + [[len(steps)]])
    return between(plan, places), np.interp(places, np.arange(len(plan)), times)


def _first_over(cable: Cable, visits: FloatArray) -> BoolArray:
    """Whether the earlier strand passes over at each crossing, visits shape (2, C) in time."""
    segment = np.searchsorted(cable.times, visits, side="right") - 1
    segment = np.clip(segment, 0, len(cable.path) - 2)
    first, second = cable.points[segment, 0] == cable.points[segment + 1, 0]  # in a column
    over: BoolArray = first & ~second
    return over


def _same_crossings(curve: Curve, crossings: _PlanCrossings) -> bool:
    """Whether a curve meets itself as often, and in the same order, as its polyline does."""
    samples = curve.sample(0.02)
    # Where the curve passes through a crossing of its own points, samples would touch.
    found = _crossings(((samples[:-1] + samples[1:]) / 2)[:, :2])
    return found is not None and np.array_equal(found.visited, crossings.visited)
