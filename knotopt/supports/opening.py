"""Formulation `opening`, compiled from a cable: which chords of opening polygons close on what.

The opening polygon of a region runs through its apexes and the selected turning points on its
boundary. The chord from node u to node w closes on a threading point q if it passes q at less than
the openness r, or if the boundary from u to w and back along the chord winds round q.

A boundary runs along the path, so what a chord u-w closes on does not depend on the region: it is
found once for all regions, as arrays over pairs of nodes and threading points.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from formulations.opening import OpeningProgram
from formulations.team import Team
from knotopt.arrays import FloatArray, IntArray
from knotopt.cable.cable import Cable
from knotopt.supports.formulation import Formulation
from knotopt.supports.proofs import by_counting, by_refutation
from knotopt.supports.regions import Regions
from knotopt.supports.threading import Threading, threading_points


@dataclass(frozen=True, eq=False)
class _Stretches:
    """Pieces of boundary that a chord may cut short, from node u to node w along the path.

    u, w: turning points (0-based) or -1 for an apex; first, last: the turning points between;
    start, end: times of the two ends; region: whose boundary.
    """

    u: IntArray
    first: IntArray
    last: IntArray
    w: IntArray
    start: IntArray
    end: IntArray
    region: IntArray


_FIELDS = ("u", "first", "last", "w", "start", "end", "region")
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
    stretches = _stretches(regions, active)
    margins = np.full(len(stretches.u), np.inf)
    cause = np.zeros(len(stretches.u), dtype=np.int64)
    slot = np.searchsorted(active, stretches.region)
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
        found = stretch_margins(cable, stretches.start[pair], stretches.end[pair], q)
        starts = total[part] - counts[part] - done
        margins[part] = np.minimum.reduceat(found, starts)
        # Which threading point it is, for the row's origin.
        nearest = np.flatnonzero(found == np.repeat(margins[part], counts[part]))
        stretch, index = np.unique(pair[nearest], return_index=True)
        cause[stretch] = q[nearest[index]]
        begin = end
    # The same stretch bounds several regions: keep the row that counts first.
    keys = np.stack((stretches.u, stretches.first, stretches.last, stretches.w), axis=1) + 1
    order = np.lexsort((margins, *keys.T))
    fresh = np.ones(len(order), dtype=bool)
    fresh[1:] = (keys[order[1:]] != keys[order[:-1]]).any(axis=1)
    kept = np.sort(order[fresh])
    kept = kept[margins[kept] < 1.0]  # beyond openness 1 not even the grid's own path is open

    def origin(index: int) -> str:
        number = int(kept[index])
        region = regions.name(int(stretches.region[number]))
        return f"{region}, threaded at p{int(cause[number]) + 1}"

    return OpeningProgram(
        name=f"opening, {mode}, cut {cable.cut}",
        points=len(cable.path),
        stretches=keys[kept],
        margins=margins[kept],
        origin=origin,
        at_least=tuple(_area(regions, active)),
        team=team or Team(),
        start=start,
    )


def _area(regions: Regions, active: IntArray) -> list[tuple[tuple[int, ...], int, str]]:
    rows: dict[tuple[tuple[int, ...], int], int] = {}
    on = regions.on_boundary(active)
    for index, mask in zip(active.tolist(), on, strict=True):
        points = tuple((np.flatnonzero(mask) + 1).tolist())
        pocket = bool(regions.boundaries.is_pocket[index])
        rows.setdefault((points, 1 if pocket else 2), index)
    return [(points, count, regions.name(index)) for (points, count), index in rows.items()]


def _stretches(regions: Regions, active: IntArray) -> _Stretches:
    """Every stretch between two nodes of every interval of the given regions' boundaries."""
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
        # Nodes in path order: apex, turning points first ... last, apex.
        point = np.concatenate(([-1], np.arange(first, last + 1), [-1]))
        time = np.concatenate(([low], cable.times[first : last + 1], [high]))
        place = np.arange(first - 1, last + 2)
        i, j = np.triu_indices(len(point), k=2)  # neighbours lie on one segment
        parts.append(
            (
                point[i],
                place[i] + 1,
                place[j] - 1,
                point[j],
                time[i],
                time[j],
                np.full(len(i), index),
            )
        )
    if not parts:
        return _Stretches(*(np.zeros(0, dtype=np.int64) for _ in _FIELDS))
    return _Stretches(*(np.concatenate(column) for column in zip(*parts, strict=True)))


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


def squared_distance(q: IntArray, start: IntArray, end: IntArray) -> FloatArray:
    """Squared distance of points from segments, exact up to one rounding, shape (...)."""
    along, offset = end - start, q - start
    length = (along * along).sum(axis=-1)
    dot = (along * offset).sum(axis=-1)
    side = cross(along, offset)
    beyond = q - end
    found: FloatArray = np.where(
        dot <= 0,
        (offset * offset).sum(axis=-1),
        np.where(
            dot >= length,
            (beyond * beyond).sum(axis=-1),
            (side * side) / np.maximum(length, 1),
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
