"""The topological state of a polyline in space, seen from above.

Crossings are where strands cross in plan; over and under is by height there. Where a small motion
of the points would change the state the result says so and gives no state. Source of the state:
Yan, Li, Zhu and Bohg, arXiv:2009.02615, section IV.A.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from knotopt.arrays import FloatArray, IntArray
from knotopt.errors import KnotoptError
from knotopt.topology.ambiguity import Ambiguity, Reason, ambiguities
from knotopt.topology.crossings import Crossings, Projection, crossings_and_contacts, projection
from knotopt.topology.state import RopeState

TOLERANCE = 1e-6
FAR = 1e100  # products of such coordinates are still finite
ROUNDING = 64 * float(np.finfo(np.float64).eps)


class PolylineError(KnotoptError):
    """Points that are no polyline in space, or a tolerance that is none: the message names the
    row."""


@dataclass(frozen=True, eq=False)
class Visits:
    """Where a polyline meets its crossings, in order; entry k is the state's visit k (from 0).

    Attributes
    ----------
    segment : int array, shape (2 n,)
        Segment of the polyline, from 0.
    fraction : float array, shape (2 n,)
        Share of that segment before the visit, in [0, 1].
    gap : float array, shape (2 n,)
        Height of this strand above the other one [the polyline's unit]; positive where it is over.
    point : float array, shape (2 n, 2)
        Place in plan.
    """

    segment: IntArray
    fraction: FloatArray
    gap: FloatArray
    point: FloatArray

    def __len__(self) -> int:
        return len(self.segment)

    @property
    def parameter(self) -> FloatArray:
        """Segment + fraction, shape (2 n,): k at point k of the polyline."""
        return self.segment + self.fraction


@dataclass(frozen=True, eq=False)
class Extraction:
    """What a polyline seen from above shows.

    Attributes
    ----------
    state : RopeState or None
        None if the state cannot be told.
    visits : Visits
        Empty without a state.
    ranges : float array, shape (2 n + 1, 2)
        The piece of polyline that each topological segment covers, by parameter from 0 at the first
        point to m - 1 at the last; shape (0, 2) without a state.
    ambiguous : tuple of Ambiguity
        Why there is no state; empty if there is one.
    """

    state: RopeState | None
    visits: Visits
    ranges: FloatArray
    ambiguous: tuple[Ambiguity, ...]


def extract_state(
    points: ArrayLike,
    *,
    plan_tolerance: float = TOLERANCE,
    height_tolerance: float = TOLERANCE,
) -> Extraction:
    """The topological state of a polyline seen from above.

    Parameters
    ----------
    points : float array, shape (m, 3)
        [x, y, height] along the rope, in any one unit of length. Points above one another in a row
        are allowed, and so are repeated points.
    plan_tolerance : float
        Strands that come this close in plan without clearly crossing are ambiguous [the points'
        unit]; a millionth by default, and never less than the rounding of the coordinates.
    height_tolerance : float
        Strands that cross with no more height between them are ambiguous [same unit].

    Raises
    ------
    PolylineError
        Fewer than two points, points that are all equal or not finite (the message names the row),
        or a tolerance that is negative.

    Notes
    -----
    The crossings are exact (see `crossings`). If the result has a state, then so has every polyline
    whose points are moved in plan by less than half the plan tolerance, segments shorter than a few
    tolerances turning by less than 15 degrees, and it is the same state as long as no two strands
    change height where they cross. A crossing through a vertex is a crossing; a strand that touches
    another one, runs along it, ends on it, or folds back onto itself is ambiguous.

    O(m^2) comparisons of boxes and O(n log n) beyond.

    Examples
    --------
    A loop, its last strand on top:

    >>> loop = [[0, 0, 0], [4, 0, 0], [4, 2, 0], [2, 2, 1], [2, -2, 1]]
    >>> found = extract_state(loop)
    >>> print(found.state)
    U1+ O1+
    >>> found.visits.parameter.tolist(), found.visits.gap.tolist()
    ([0.5, 3.5], [-1.0, 1.0])
    >>> found.ranges.tolist()
    [[0.0, 0.5], [0.5, 3.5], [3.5, 4.0]]

    Without the difference in height:

    >>> flat = extract_state([[x, y, 0] for x, y, _ in loop])
    >>> flat.state, str(flat.ambiguous[0])
    (None, 'segments 0 and 3 cross at the same height, at (2, 0)')
    """
    points = _checked(points)
    for name, value in (("plan", plan_tolerance), ("height", height_tolerance)):
        if not (math.isfinite(value) and value >= 0):
            raise PolylineError(f"the {name} tolerance is {value}; expected a length, at least 0")
    reach = max(plan_tolerance, ROUNDING * float(np.abs(points[:, :2]).max()))
    seen = projection(points)
    if len(seen.flat) == 1:
        x, y = seen.flat[0].tolist()
        whole = Ambiguity(Reason.REPEATED, (0, len(points) - 2), (x, y))
        return Extraction(None, *_NOTHING, (whole,))
    crossings, contacts = crossings_and_contacts(seen, reach, height_tolerance)
    ambiguous = ambiguities(seen, crossings, contacts, reach, height_tolerance)
    if ambiguous:
        return Extraction(None, *_NOTHING, ambiguous)
    state, visits = _along(seen, crossings)
    marks = np.concatenate(([0.0], visits.parameter, [len(points) - 1.0]))
    return Extraction(state, visits, np.stack((marks[:-1], marks[1:]), axis=1), ())


def _checked(points: ArrayLike) -> FloatArray:
    try:
        rows = np.asarray(points, dtype=np.float64)
    except (TypeError, ValueError):
        raise PolylineError("the points are not rows of three numbers x, y, z") from None
    if rows.ndim != 2 or rows.shape[1] != 3:
        raise PolylineError(f"the points have shape {rows.shape}; expected (m, 3): rows x, y, z")
    if len(rows) < 2:
        raise PolylineError(f"a rope needs at least two points, not {len(rows)}")
    if not (np.abs(rows) < FAR).all():
        row = int(np.flatnonzero(~(np.abs(rows) < FAR).all(axis=1))[0])
        what = f"has coordinates beyond {FAR}" if np.isfinite(rows[row]).all() else "is not finite"
        raise PolylineError(f"row {row} {what}: {rows[row].tolist()}")
    if (rows == rows[0]).all():
        raise PolylineError(f"all {len(rows)} rows are the same point: {rows[0].tolist()}")
    return rows


def _along(seen: Projection, crossings: Crossings) -> tuple[RopeState, Visits]:
    """State and visits in the order of the polyline."""
    count = len(crossings)
    segment = np.concatenate((crossings.i, crossings.j))
    fraction = np.concatenate((crossings.u, crossings.v))
    order = np.lexsort((fraction, segment))
    place = np.empty(2 * count, dtype=np.intp)
    place[order] = np.arange(2 * count)
    partner = place[(order + count) % max(2 * count, 1)]
    gap = np.concatenate((crossings.gap, -crossings.gap))[order]
    positive = np.tile(crossings.left == (crossings.gap > 0), 2)[order]
    code = 4 * partner + 2 * (gap > 0) + positive
    segment, fraction = segment[order], fraction[order]
    start = seen.flat[segment]
    point = start + fraction[:, None] * (seen.flat[segment + 1] - start)
    return RopeState(tuple(code.tolist())), Visits(seen.segment[segment], fraction, gap, point)


_NOTHING = (
    Visits(np.empty(0, dtype=np.intp), np.empty(0), np.empty(0), np.empty((0, 2))),
    np.empty((0, 2)),
)
