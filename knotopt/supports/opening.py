"""Formulation `opening`, compiled from a cable: which chords of opening polygons close on what.

The opening polygon of a region runs through its apexes and the selected turning points on its
boundary. The chord from node u to node w closes on a threading point q if it passes q at less than
the openness r, or if the boundary from u to w and back along the chord winds round q.

A boundary runs along the path, so what a chord u-w closes on does not depend on the region: it is
found once for all regions, as arrays over pairs of nodes and threading points.
"""

from __future__ import annotations

from functools import lru_cache

import numpy as np

from formulations.opening import OpeningProgram
from formulations.team import Team
from knotopt.arrays import FloatArray, IntArray
from knotopt.cable.cable import Cable
from knotopt.supports.formulation import Formulation
from knotopt.supports.proofs import by_counting, by_refutation
from knotopt.supports.regions import Regions
from knotopt.supports.threading import Threading
from knotopt.supports.threading_points import threading_points

_ENTRIES_AT_ONCE = 1 << 20


def compile_opening(
    regions: Regions,
    mode: Threading = Threading.TURNING_POINT,
    team: Team | None = None,
    start: tuple[int, ...] | None = None,
) -> OpeningProgram:
    """The program `opening` of a cable.

    Parameters
    ----------
    regions : Regions
    mode : Threading
    team : Team, optional
        What the team asks beyond openness.
    start : tuple of int, optional
        Turning points (1-based) of a first guess.

    Notes
    -----
    O(R n^2 K) time for R active regions of up to n turning points, K threading points each.

    Examples
    --------
    >>> from knotopt.diagram.families import torus_knot
    >>> program = compile_opening(Regions(Cable(torus_knot(2, 3), "L+")))
    >>> opening = [row for row in program.instance(0.25).rows if row.family == "opening"]
    >>> len(opening), opening[0].literals, opening[0].origin
    (12, (-4, 3), 'loop c1, threaded at p9')
    """
    cable = regions.cable
    threading = threading_points(regions, mode)
    active, where = np.unique(threading.region, return_index=True)
    bounds = np.append(where, len(threading))
    stretches, starts_at, ends_at, region_of = _stretches(regions, active)
    margins = np.full(len(stretches), np.inf)
    cause = np.zeros(len(stretches), dtype=np.int64)
    slot = np.searchsorted(active, region_of)
    counts = np.diff(bounds)[slot]
    total = np.cumsum(counts)
    begin = 0
    while begin < len(counts):  # pairs of a stretch and a threading point of its region
        done = int(total[begin - 1]) if begin else 0
        end = max(begin + 1, int(np.searchsorted(total, done + _ENTRIES_AT_ONCE, side="right")))
        part = np.arange(begin, end)
        pair = np.repeat(part, counts[part])
        offset = np.arange(len(pair)) - np.repeat(total[part] - counts[part] - done, counts[part])
        q = threading.point[bounds[slot[pair]] + offset]
        found = stretch_margins(cable, starts_at[pair], ends_at[pair], q)
        starts = total[part] - counts[part] - done
        margins[part] = np.minimum.reduceat(found, starts)
        # Which threading point it is, for the row's origin.
        nearest = np.flatnonzero(found == np.repeat(margins[part], counts[part]))
        stretch, index = np.unique(pair[nearest], return_index=True)
        cause[stretch] = q[nearest[index]]
        begin = end
    # The same stretch bounds several regions: keep the row that counts first.
    order = np.lexsort((margins, *stretches.T))
    fresh = np.ones(len(order), dtype=bool)
    fresh[1:] = (stretches[order[1:]] != stretches[order[:-1]]).any(axis=1)
    kept = np.sort(order[fresh])
    kept = kept[margins[kept] < 1.0]  # beyond openness 1 not even the grid's own path is open

    def origin(index: int) -> str:
        number = kept[index]
        return f"{regions.name(int(region_of[number]))}, threaded at p{cause[number] + 1}"

    return OpeningProgram(
        name=f"opening, {mode}, cut {cable.cut}",
        points=len(cable.path),
        stretches=stretches[kept],
        margins=margins[kept],
        origin=origin,
        at_least=tuple(_area(regions, active)),
        team=team or Team(),
        start=start,
    )


def _area(regions: Regions, active: IntArray) -> list[tuple[tuple[int, ...], int, str]]:
    rows: dict[tuple[tuple[int, ...], int], int] = {}
    for index, mask in zip(active.tolist(), regions.on_boundary(active), strict=True):
        points = tuple((np.flatnonzero(mask) + 1).tolist())
        rows.setdefault((points, 1 if regions.boundaries.is_pocket[index] else 2), index)
    return [(points, count, regions.name(index)) for (points, count), index in rows.items()]


def _stretches(regions: Regions, active: IntArray) -> tuple[IntArray, IntArray, IntArray, IntArray]:
    """Every stretch between two nodes of every interval of the given regions' boundaries.

    Returns
    -------
    stretches : (S, 4), u, first, last, w as of `OpeningProgram`
    start, end, region : (S,), times of the two ends, and whose boundary it is
    """
    cable, boundaries = regions.cable, regions.boundaries
    intervals = [
        (index, int(low), int(high))
        for index in active.tolist()
        for low, high in (boundaries.a[index], boundaries.b[index])
        if high >= low
    ]
    parts = []
    for index, low, high in intervals:
        first = int(np.searchsorted(cable.times, low))
        last = int(np.searchsorted(cable.times, high, side="right")) - 1
        # Nodes in path order: apex, turning points first ... last (0-based), apex.
        point = np.concatenate(([0], np.arange(first, last + 1) + 1, [0]))
        time = np.concatenate(([low], cable.times[first : last + 1], [high]))
        i, j = np.triu_indices(len(point), k=2)  # neighbours lie on one segment
        columns = (point[i], i + first + 1, j + first - 1, point[j], time[i], time[j])
        parts.append(np.stack((*columns, np.full(len(i), index))))
    table = np.concatenate((np.zeros((7, 0), dtype=np.int64), *parts), axis=1)
    return table[:4].T, *table[4:]


def stretch_margins(cable: Cable, start: IntArray, end: IntArray, q: IntArray) -> FloatArray:
    """Squared distance of points q from chords between times on the path, 0 if closed by winding.

    Integers throughout and one division that rounds correctly, so that equal distances compare
    equal and comparison with a squared openness in thousandths is exact.

    Parameters
    ----------
    cable : Cable
    start, end : int arrays, shape (S,), times [grid steps from p_1]
    q : int array, shape (S,), indices of turning points (0-based)
    """
    point = cable.points[q]
    here, there = cable.cells[start], cable.cells[end]
    wound = path_turns(cable, start, end, q) + crossings_of_ray(there, here, point)
    return np.where(wound != 0, 0.0, squared_distance(point, here, there))


def path_turns(
    cable: Cable, start: IntArray | int, end: IntArray | int, q: IntArray | int
) -> IntArray:
    """Signed crossings of the path between two times with the ray from turning point q."""
    table = _turns_table(cable)

    def until(time: IntArray | int) -> IntArray:
        segment = np.clip(np.searchsorted(cable.times, time, side="right") - 1, 0, None)
        partial = crossings_of_ray(cable.points[segment], cable.cells[time], cable.points[q])
        whole: IntArray = table[segment, q] + partial
        return whole

    return until(end) - until(start)


@lru_cache(maxsize=4)
def _turns_table(cable: Cable) -> IntArray:
    """Signed crossings of the path up to each turning point with each point's ray, (n, n)."""
    points = cable.points
    each = crossings_of_ray(points[:-1, None], points[1:, None], points[None])
    return np.concatenate((np.zeros((1, len(points)), dtype=np.int64), np.cumsum(each, axis=0)))


def crossings_of_ray(start: IntArray, end: IntArray, q: IntArray) -> IntArray:
    """Signed crossings (+1 upward) of segments with the ray from q to the right.

    Half-open, so that a closed polygon's sum is its winding number about q unless q lies on it.
    All arrays have shape (..., 2) and broadcast.
    """
    below_start, below_end = start[..., 1] <= q[..., 1], end[..., 1] <= q[..., 1]
    side = cross(end - start, q - start)
    up = below_start & ~below_end & (side > 0)
    down = ~below_start & below_end & (side < 0)
    signed: IntArray = up.astype(np.int64) - down
    return signed


def squared_distance(
    q: IntArray, start: IntArray, end: IntArray, d: IntArray | int = 1
) -> FloatArray:
    """Squared distance of points from segments start - end / d, exact up to one rounding."""
    scale = np.expand_dims(d, -1)
    along, offset = end - start * scale, q - start
    beyond = q * scale - end
    length = (along * along).sum(axis=-1)  # times d^2; along, beyond, dot and side times d
    dot = (along * offset).sum(axis=-1)
    side = cross(along, offset)
    found: FloatArray = np.where(
        dot <= 0,
        (offset * offset).sum(axis=-1),
        np.where(
            dot * d >= length,
            (beyond * beyond).sum(axis=-1) / (d * d),
            side * side / np.maximum(length, 1),
        ),
    )
    return found


def cross(a: IntArray, b: IntArray) -> IntArray:
    """z component of the cross product of plane vectors, shape (...)."""
    z: IntArray = a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0]
    return z


OPENING = Formulation(
    name="opening",
    words="polygons through the grid's crossings",
    compile=compile_opening,
    threading=(Threading.TURNING_POINT, Threading.OVER_UNDER),
    proofs={"refutation": by_refutation, "count": by_counting},
)
