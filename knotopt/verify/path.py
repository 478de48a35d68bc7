"""Any path of a cable examined: is it the knot, and how far apart, bent and high are its strands?

Only the path's points in space, the grid path and the robots' places go in. Nothing here is shared
with the programs that make paths: the path is sampled anew, all crossings of the samples are found,
and every distance is measured. What is smaller than two samples, 0.04 grid steps, is not seen.
"""

from __future__ import annotations

from bisect import bisect
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from scipy.sparse.csgraph import csgraph_from_dense, dijkstra
from scipy.spatial import cKDTree

from knotopt.arrays import FloatArray, IntArray
from knotopt.verify.alexander import alexander_values
from knotopt.verify.crossings import CurveCrossings, Visit, curve_crossings, grid_code
from knotopt.verify.regions import Cell, define_regions, lay

STEP = 0.02  # between samples of a path [grid steps]
STRETCH = 0.1  # over which slopes are measured [grid steps]
HELD = 1.0  # length of the path on either side of a robot that counts as held by it [grid steps]
OFFSET = 0.618  # of the first sample, in steps: samples fall on no crossing that is a vertex
FAR = 10.0  # how far above the path its ends are joined [grid steps]
TILT = (0.31, 0.17)  # of the direction that the closed curve is seen along, against the vertical
NEAREST = 4.0  # strands farther apart than this are not looked for [grid steps]


@dataclass(frozen=True, eq=False)
class PathReport:
    """What a path is like; lengths in grid steps.

    Attributes
    ----------
    samples : float array, shape (k, 3)
    crossings : CurveCrossings
        Of the samples, seen from above.
    same_diagram : bool
        Whether the Gauss code, over and under, and signs are those of the grid.
    same_knot : bool
        Whether the closed curve, seen along another direction, has the Alexander polynomial of the
        grid's knot.
    length, plan_length : float
        In space and in plan.
    clearance : float
        Smallest distance in plan between points of the path that are apart: the way between them
        along the path, changing strands at crossings, is at least `neighbourhood`; inf if none are
        nearer than 4, or than the neighbourhood.
    closest : pair of floats
        Where on the path that is: lengths in plan from its start.
    gap : float
        Smallest vertical distance at a crossing, the strand that is upper on the grid minus the
        other; inf without crossings, nan for another diagram.
    tightest : int
        The crossing with that gap, in the order first met; -1 if there is none.
    opening : float
        The least room of a strand where it threads an active region: the largest distance of a
        point of it, inside, from the region's boundary; inf if nothing threads, nan for another
        diagram.
    narrowest : str
        Name of that region, or "".
    smallest_radius : float
        Of a circle through three consecutive samples.
    steepest : float
        Largest rise or fall over length in plan, on stretches of 0.1.
    lowest, highest : float
        Heights.
    robots_off : float
        Largest distance of a robot's place from the path, in space.
    nearest_to_a_robot : float
        Smallest distance in space of a robot's place from the path but for the stretch of 1 grid
        step before and behind it, so 1 where nothing else is near; inf without any.
    """

    samples: FloatArray
    crossings: CurveCrossings
    same_diagram: bool
    same_knot: bool
    length: float
    plan_length: float
    clearance: float
    closest: tuple[float, float]
    gap: float
    tightest: int
    opening: float
    narrowest: str
    smallest_radius: float
    steepest: float
    lowest: float
    highest: float
    robots_off: float
    nearest_to_a_robot: float


def check_path(
    points: FloatArray,
    path: Sequence[Cell],
    robots: FloatArray,
    neighbourhood: float,
) -> PathReport:
    """Examine a path.

    Parameters
    ----------
    points : float array, shape (n, 3) [grid steps]
        The path as a polyline from p_1 to p_n.
    path : sequence of (column, row)
        The cable's turning points on the grid.
    robots : float array, shape (R, 3)
        Where the robots hold it.
    neighbourhood : float
        From which way along the path on two points count as apart [grid steps].

    Raises
    ------
    ValueError
        A point that is not finite, fewer than two points, a path that touches itself, or a
        neighbourhood that is not positive.
    """
    if not neighbourhood > 0:
        raise ValueError(f"the neighbourhood is a positive length, not {neighbourhood}")
    points = np.asarray(points, dtype=np.float64)
    if points.ndim != 2 or points.shape[1] != 3 or len(points) < 2:
        raise ValueError(f"a path is at least two points [x, y, z], not {points.shape}")
    if not np.isfinite(points).all():
        bad = int(np.flatnonzero(~np.isfinite(points).all(axis=1))[0])
        raise ValueError(f"point {bad} of the path is not finite: {points[bad].tolist()}")
    samples = resample(points, STEP)
    crossings = curve_crossings(samples)
    measured = _Measured(samples, crossings)
    expected = grid_code(path)
    same = crossings.code == expected
    clearance, closest = measured.clearance(neighbourhood)
    opening, narrowest = measured.opening(path) if same else (np.nan, "")
    gaps = _gaps(crossings, expected[0]) if same else np.array([np.nan])
    return PathReport(
        samples=samples,
        crossings=crossings,
        same_diagram=same,
        same_knot=alexander_of(closed_code(samples)) == alexander_of(expected),
        length=float(np.linalg.norm(np.diff(points, axis=0), axis=1).sum()),
        plan_length=float(np.linalg.norm(np.diff(points[:, :2], axis=0), axis=1).sum()),
        clearance=clearance,
        closest=closest,
        gap=float(gaps.min(initial=np.inf)),
        tightest=int(gaps.argmin()) if len(gaps) else -1,
        opening=opening,
        narrowest=narrowest,
        smallest_radius=float(radii(samples).min(initial=np.inf)),
        steepest=measured.steepest,
        lowest=float(points[:, 2].min()),
        highest=float(points[:, 2].max()),
        robots_off=float(cKDTree(resample(points, STEP / 4)).query(robots)[0].max(initial=0)),
        nearest_to_a_robot=measured.nearest_to(robots),
    )


def resample(points: FloatArray, step: float) -> FloatArray:
    """Points on a polyline a step apart in space, none of them (but its ends) a vertex of it."""
    along = np.concatenate(([0], np.cumsum(np.linalg.norm(np.diff(points, axis=0), axis=1))))
    count = max(2, int(along[-1] / step))
    wanted = (np.arange(count) + OFFSET) * (along[-1] / count)
    inner = np.column_stack([np.interp(wanted, along, axis) for axis in points.T])
    return np.concatenate((points[:1], inner, points[-1:]))


def radii(points: FloatArray) -> FloatArray:
    """Radius of the circle through each three consecutive points, inf where they are in line."""
    a, b = np.diff(points, axis=0)[:-1], np.diff(points, axis=0)[1:]
    across = np.linalg.norm(a + b, axis=1)
    area = np.linalg.norm(np.cross(a, b), axis=1)
    sides = np.linalg.norm(a, axis=1) * np.linalg.norm(b, axis=1) * across
    with np.errstate(divide="ignore"):
        found: FloatArray = sides / (2 * area)
    return found


def closed_code(points: FloatArray) -> tuple[list[Visit], list[int]]:
    """Gauss code of a path in space closed far above, seen along a tilted direction."""
    ends = points[[-1, 0]]
    ends[:, 2] = points[:, 2].max() + FAR
    # The closing lines must not end where the path begins: seen along the tilt, they would touch.
    closed = np.concatenate((points, ends, points[:1] + 1e-6))
    closed[:, :2] -= closed[:, 2:] * TILT
    return curve_crossings(closed).code


def alexander_of(code: tuple[list[Visit], list[int]]) -> tuple[int, ...]:
    """What tells the Alexander polynomial of a Gauss code from others."""
    visits, signs = code
    return alexander_values([k for k, _ in visits], [over for _, over in visits], signs)


def _gaps(crossings: CurveCrossings, visits: list[Visit]) -> FloatArray:
    """Height of each crossing's upper strand on the grid above the other."""
    first_over = dict(reversed(visits))
    upper = np.array([first_over[k] for k in range(len(crossings))], dtype=bool)
    gaps: FloatArray = np.where(upper, crossings.gap, -crossings.gap)
    return gaps


@dataclass(frozen=True, eq=False)
class _Measured:
    """Distances on and between the strands of a sampled path, in plan."""

    samples: FloatArray
    crossings: CurveCrossings

    @cached_property
    def along(self) -> FloatArray:
        """Length in plan up to each sample."""
        steps = np.linalg.norm(np.diff(self.samples[:, :2], axis=0), axis=1)
        return np.concatenate(([0], np.cumsum(steps)))

    @cached_property
    def visits(self) -> tuple[FloatArray, IntArray]:
        """Length in plan up to each crossing visit, in order, and which crossing it is."""
        where, which = self.crossings.visits
        return np.interp(where, np.arange(len(self.along)), self.along), which

    def clearance(self, neighbourhood: float) -> tuple[float, tuple[float, float]]:
        """Smallest distance of points that are apart, and where they are."""
        tree = cKDTree(self.samples[:, :2])
        radius, farthest = min(neighbourhood / 4, NEAREST), max(neighbourhood, NEAREST)
        while radius <= farthest:
            i, j = tree.query_pairs(radius, output_type="ndarray").T
            apart = self._way(i, j) >= neighbourhood
            if apart.any():
                i, j = i[apart], j[apart]
                distances = np.linalg.norm(self.samples[i, :2] - self.samples[j, :2], axis=1)
                k = int(distances.argmin())
                return float(distances[k]), (float(self.along[i[k]]), float(self.along[j[k]]))
            radius *= 2
        return np.inf, (np.nan, np.nan)

    @cached_property
    def steepest(self) -> float:
        """Largest rise or fall over length in plan."""
        window = min(round(STRETCH / STEP), len(self.samples) - 1)
        rise = np.abs(self.samples[window:, 2] - self.samples[:-window, 2])
        run = self.along[window:] - self.along[:-window]
        return float((rise / np.maximum(run, 1e-12)).max())

    def nearest_to(self, robots: FloatArray) -> float:
        """Smallest distance in space of a robot from strands that it does not hold."""
        nearest = np.inf
        for robot in robots:
            away = np.linalg.norm(self.samples - robot, axis=1)
            others = np.abs(self.along - self.along[away.argmin()]) > HELD
            nearest = min(nearest, float(away[others].min(initial=np.inf)))
        return nearest

    @cached_property
    def between(self) -> FloatArray:
        """Shortest way between crossings along the path, shape (C, C)."""
        at, which = self.visits
        arcs = np.full((len(self.crossings),) * 2, np.inf)
        np.minimum.at(arcs, (which[:-1], which[1:]), np.maximum(np.diff(at), 1e-12))
        ways: FloatArray = dijkstra(csgraph_from_dense(arcs, null_value=np.inf), directed=False)
        return ways

    def _way(self, i: IntArray, j: IntArray) -> FloatArray:
        """Shortest way between samples along the path, changing strands at crossings."""
        at, which = self.visits
        way: FloatArray = np.abs(self.along[i] - self.along[j])
        if not len(at):
            return way
        after_i, after_j = np.searchsorted(at, self.along[i]), np.searchsorted(at, self.along[j])
        for a in (after_i - 1, after_i):
            for b in (after_j - 1, after_j):
                known = (a >= 0) & (a < len(at)) & (b >= 0) & (b < len(at))
                p, q = np.clip(a, 0, len(at) - 1), np.clip(b, 0, len(at) - 1)
                through = np.abs(self.along[i] - at[p]) + self.between[which[p], which[q]]
                through += np.abs(self.along[j] - at[q])
                way = np.where(known, np.minimum(way, through), way)
        return way

    def opening(self, path: Sequence[Cell]) -> tuple[float, str]:
        """The least room of a strand where it threads a region, and which region that is.

        Every second sample is looked at, of a boundary, which makes distances of 0.1 and more at
        most 0.002 too large, and of a strand, which makes its room no larger.
        """
        cells = lay(path)
        time_of = {cell: time for time, cell in enumerate(cells)}
        met = Counter(cells)
        visited = [time for time, cell in enumerate(cells) if met[cell] == 2]
        at = dict(zip(visited, self.visits[0].tolist(), strict=True))
        least, narrowest = np.inf, ""
        for region in define_regions(path, max(map(max, path))):
            if region.threaded_by is None:
                continue
            boundary = {cells[time] for time in region.walk}
            stretches = [(at[low], at[high]) for low, high in _stretches(region.walk)]
            edge = np.concatenate([self._between(*stretch) for stretch in stretches])
            tree = cKDTree(self.samples[edge[::2], :2])
            ends = [t for t in visited if cells[t] in boundary]
            strands = {
                bisect(ends, time_of[point])
                for point in path
                if point in region.interior and time_of[point] > min(region.walk)
            }
            for after in strands:
                end = at[ends[after]] if after < len(ends) else self.along[-1]
                inside = self._between(at[ends[after - 1]], end)
                room = float(tree.query(self.samples[inside[::2], :2])[0].max())
                if room < least:
                    least, narrowest = room, region.name
        return least, narrowest

    def _between(self, start: float, end: float) -> IntArray:
        """The samples from a length in plan to another."""
        low, high = np.searchsorted(self.along, [start, end])
        return np.arange(low, max(high, low + 1))


def _stretches(walk: Sequence[int]) -> list[tuple[int, int]]:
    """The runs of consecutive times in a walk round a boundary."""
    times = np.unique(walk)
    runs = np.split(times, np.flatnonzero(np.diff(times) > 1) + 1)
    return [(int(run[0]), int(run[-1])) for run in runs]
