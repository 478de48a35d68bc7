"""Crossing-height arcs on a path of given plan, whatever its crossings are."""

from __future__ import annotations

import numpy as np

from knotopt.arrays import FloatArray
from knotopt.cable.cable import Cable
from knotopt.path.curve import Curve, length_along
from knotopt.path.heights import height_arcs
from knotopt.path.mesh import between, robot_times
from knotopt.verify.crossings import CurveCrossings, curve_crossings

SPACING = 0.5  # of the points that the curve goes through, at most [grid steps]
JITTER = 1e-6  # that separates strands which touch in a vertex [grid steps]


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
    try:
        crossings = curve_crossings(np.column_stack((plan, np.zeros(len(plan)))))
    except ValueError:
        plan = plan + JITTER * np.random.default_rng(0).standard_normal(plan.shape)
        crossings = curve_crossings(np.column_stack((plan, np.zeros(len(plan)))))
    at = np.concatenate((crossings.first, crossings.second))
    places = np.arange(len(plan), dtype=np.float64)
    where = np.concatenate((places, at))
    order = np.argsort(where, kind="stable")
    points = np.concatenate((plan, crossings.point, crossings.point))[order]
    every = np.interp(where[order], places, times)
    rank = np.empty(len(where), dtype=np.int64)
    rank[order] = np.arange(len(where))
    first, second = rank[len(plan) :].reshape(2, -1)
    first_over = _first_over(cable, crossings, places, times)
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


def _denser(plan: FloatArray, times: FloatArray) -> tuple[FloatArray, FloatArray]:
    """The same polyline with points between, so that a spline through them stays beside it."""
    steps = np.linalg.norm(np.diff(plan, axis=0), axis=1)
    count = np.maximum(1, np.ceil(steps / SPACING)).astype(np.int64)
    places = np.concatenate([k + np.arange(n) / n for k, n in enumerate(count)] + [[len(steps)]])
    return between(plan, places), np.interp(places, np.arange(len(plan)), times)


def _first_over(
    cable: Cable, crossings: CurveCrossings, places: FloatArray, times: FloatArray
) -> np.ndarray[tuple[int], np.dtype[np.bool_]]:
    """Whether the earlier strand passes over at each crossing."""
    columns = []
    for at in (crossings.first, crossings.second):
        segment = np.searchsorted(cable.times, np.interp(at, places, times), side="right") - 1
        segment = np.clip(segment, 0, len(cable.path) - 2)
        columns.append(cable.points[segment, 0] == cable.points[segment + 1, 0])
    over: np.ndarray[tuple[int], np.dtype[np.bool_]] = columns[0] & ~columns[1]
    return over


def _same_crossings(curve: Curve, crossings: CurveCrossings) -> bool:
    """Whether a curve meets itself as often, and in the same order, as its polyline does."""
    samples = curve.sample(0.02)
    try:
        # Where the curve passes through a crossing of its own points, samples would touch.
        found = curve_crossings((samples[:-1] + samples[1:]) / 2)
    except ValueError:
        return False
    return [k for k, _ in found.code[0]] == [k for k, _ in crossings.code[0]]
