"""What the leader crossed in a flight, from the cable's centreline over time alone.

The cable's head is its only moving end, so the knot is made by the crossings between the leader's
vertical line and the cable, whoever moves. Between two samples every vertex moves straight. Seen
from the leader, an edge then sweeps a quadrilateral in plan, and it meets the leader as often,
sense counted, as that winds around the leader. The winding number is a sum over the quadrilateral's
sides, each shared with the next edge or the next interval: however it is rounded, no crossing is
lost or counted twice at a vertex or at a sample.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from knotopt.arrays import FloatArray, IntArray

CHUNK = 400  # intervals looked at together, which bounds the memory


@dataclass(frozen=True)
class LeaderEvent:
    """One crossing between the leader's vertical line and the cable.

    Attributes
    ----------
    time : float
        [s]
    clock : float
        Time of the plan that was being followed [s].
    span : int
        Span that the leader is flying, 1-based; 0 before its first anchor.
    older : int
        Span of the cable that is crossed, 1-based.
    over : bool
        Whether the leader is above it.
    sense : int
        +1 where the leader gets from the right of the strand, seen along it from p_1, to its left,
        else -1.
    edge : int
        Edge of the centreline that is crossed, from 0.
    share : float
        How far along that edge, 0 to 1.
    place : tuple of float
        Where in plan, (x, y) [m].
    height, cable_height : float
        Of the leader and of the strand there [m].
    loop : float
        Length of cable from there to the leader [m].
    curl : bool
        Whether the leader crosses its own tether with a loop that lies wholly on the same side,
        over or under, of all other cable: a curl that a pull takes out (Reidemeister's first move).
    """

    time: float
    clock: float
    span: int
    older: int
    over: bool
    sense: int
    edge: int
    share: float
    place: tuple[float, float]
    height: float
    cable_height: float
    loop: float
    curl: bool

    @property
    def own(self) -> bool:
        """Whether the cable crossed is the tether, which trails behind the leader."""
        return self.older >= self.span

    @property
    def gap(self) -> float:
        """Height of the leader above the strand [m]."""
        return self.height - self.cable_height

    @property
    def when(self) -> str:
        """The time in words."""
        return f"at {self.time:.2f} s"


def leader_events(
    times: ArrayLike,
    cable: ArrayLike,
    held: Sequence[int] | IntArray,
    span_times: ArrayLike,
    *,
    clock: ArrayLike | None = None,
) -> tuple[LeaderEvent, ...]:
    """Every crossing between the leader's vertical line and the cable, in order of time.

    Parameters
    ----------
    times : float array, shape (T,)
        Increasing [s].
    cable : float array, shape (T, M, 3)
        Centreline from p_1 to p_2N [m]; its last vertex is the leader.
    held : int array, shape (R,)
        Vertices that the robots hold, from 0 to M - 1.
    span_times : float array, shape (R - 1,)
        When the leader passes anchors 1 to R - 1, by the clock [s].
    clock : float array, shape (T,), optional
        Time of the plan that was being followed; `times` unless given [s].

    Raises
    ------
    ValueError
        Arrays of shapes that do not fit, a number that is not finite, times that do not increase.

    Notes
    -----
    O(T M). Vertices at the end of the centreline that lie in plan exactly where the leader is count
    as part of it. Two crossings of an edge in one interval are both found.

    Examples
    --------
    The leader turns back and flies over its own tether, which hangs 1 m below.

    >>> tail = [[0.0, 0.0, 1.0], [2.0, 0.0, 1.0], [2.0, 1.0, 2.0]]
    >>> cable = np.array([[*tail, [1.0, y, 2.0]] for y in (1.0, -1.0)])
    >>> event, = leader_events([0.0, 1.0], cable, [0, 3], [0.0])
    >>> event.time, event.edge, event.share, event.over, event.sense, event.own, event.curl
    (0.5, 0, 0.5, True, -1, True, True)
    """
    times, cable, held, span_times, clock = _checked(times, cable, held, span_times, clock)
    events: list[LeaderEvent] = []
    for start in range(0, len(times) - 1, CHUNK):
        part = cable[start : start + CHUNK + 1]
        interval, *where = (x.tolist() for x in _crossings(part[:, :, :2]))
        events.extend(
            _event(times, cable, held, span_times, clock, start + k, *rest)
            for k, *rest in zip(interval, *where, strict=True)
        )
    return tuple(sorted(events, key=lambda event: event.time))


def nearest_approaches(
    cable: ArrayLike,
    held: Sequence[int] | IntArray,
    span_times: ArrayLike,
    clock: ArrayLike,
    wanted: Sequence[tuple[int, int]],
) -> list[tuple[float, float]]:
    """How near the leader came in plan to spans that it was to cross.

    Parameters
    ----------
    cable, held, span_times, clock
        As for `leader_events`.
    wanted : sequence of (span, older)
        Span being flown, and span to be crossed.

    Returns
    -------
    list of (distance, time)
        Least distance in plan at a sample [m] and when, by the clock [s]; (inf, nan) where the
        flight ended before.
    """
    clock, cable, held, span_times, _ = _checked(clock, cable, held, span_times, None, strict=False)
    flown = np.searchsorted(span_times, clock, side="right")
    found = []
    for span, older in wanted:
        rows = np.flatnonzero(flown == span)
        if not len(rows):
            found.append((np.inf, np.nan))
            continue
        strand = cable[rows, held[older - 1] : held[older] + 1, :2] - cable[rows, -1:, :2]
        a, d = strand[:, :-1], np.diff(strand, axis=1)
        share = -(a * d).sum(axis=2) / np.maximum((d * d).sum(axis=2), 1e-300)
        nearest = a + np.clip(share, 0, 1)[:, :, None] * d
        distance = np.linalg.norm(nearest, axis=2).min(axis=1)
        best = int(distance.argmin())
        found.append((float(distance[best]), float(clock[rows[best]])))
    return found


def _checked(
    times: ArrayLike,
    cable: ArrayLike,
    held: Sequence[int] | IntArray,
    span_times: ArrayLike,
    clock: ArrayLike | None,
    *,
    strict: bool = True,
) -> tuple[FloatArray, FloatArray, IntArray, FloatArray, FloatArray]:
    """The arrays, or a plain sentence about what is wrong with them."""
    times, cable = np.asarray(times, dtype=float), np.asarray(cable, dtype=float)
    held, span_times = np.asarray(held, dtype=np.int64), np.asarray(span_times, dtype=float)
    clock = times if clock is None else np.asarray(clock, dtype=float)
    if cable.ndim != 3 or cable.shape[2] != 3 or cable.shape[1] < 2:
        raise ValueError(f"a cable over time has the shape (T, M, 3), not {cable.shape}")
    if times.shape != cable.shape[:1] or clock.shape != times.shape:
        raise ValueError(
            f"{len(cable)} samples of the cable need as many times, not {times.shape} and "
            f"{clock.shape}"
        )
    if not np.isfinite(cable).all():
        bad = np.argwhere(~np.isfinite(cable).all(axis=2))[0]
        raise ValueError(f"vertex {bad[1]} of the cable is not finite at sample {bad[0]}")
    if not (np.isfinite(times).all() and np.isfinite(clock).all()):
        raise ValueError("a time is not finite")
    if strict and not (np.diff(times) > 0).all():
        raise ValueError("times do not increase")
    if held.ndim != 1 or len(held) < 2 or held[0] != 0 or held[-1] != cable.shape[1] - 1:
        raise ValueError(
            f"robots hold vertices from 0 to {cable.shape[1] - 1}, not {held.tolist()}"
        )
    if not (np.diff(held) > 0).all():
        raise ValueError(f"held vertices do not increase: {held.tolist()}")
    if span_times.shape != (len(held) - 1,) or not (np.diff(span_times) >= 0).all():
        raise ValueError(
            f"{len(held)} robots need {len(held) - 1} times in order at which the leader passes "
            f"anchors, not {span_times.tolist()}"
        )
    return times, cable, held, span_times, clock


def _crossings(
    plan: FloatArray,
) -> tuple[IntArray, IntArray, IntArray, FloatArray, FloatArray]:
    """Interval, edge, sense, share of the interval and share of the edge of each crossing."""
    seen = plan - plan[:, -1:]
    attached = np.logical_and.accumulate((seen == 0).all(axis=2)[:, ::-1], axis=1)[:, ::-1]
    low = np.minimum(seen[:, :-1], seen[:, 1:])
    high = np.maximum(seen[:, :-1], seen[:, 1:])
    around = (np.minimum(low[:-1], low[1:]) <= 0) & (np.maximum(high[:-1], high[1:]) >= 0)
    candidates = around.all(axis=2) & ~(attached[:-1, 1:] | attached[1:, 1:])
    k, e = np.nonzero(candidates)
    a, b, a_end, b_end = seen[k, e], seen[k, e + 1], seen[k + 1, e], seen[k + 1, e + 1]
    net = _half_turn(a, a_end) + _half_turn(a_end, b_end) + _half_turn(b_end, b) + _half_turn(b, a)
    # The area between the edge and the leader is square * s^2 + linear * s + constant.
    constant, square = _cross(a, b), _cross(a_end - a, b_end - b)
    linear = _cross(a, b_end - b) + _cross(a_end - a, b)
    roots = {sense: _root(square, linear, constant, sense) for sense in (1, -1)}
    shares = {}
    inside = (net == 0) & (linear * linear > 4 * square * constant)
    for sense, when in roots.items():
        here = a + when[:, None] * (a_end - a)
        along = b + when[:, None] * (b_end - b) - here
        with np.errstate(divide="ignore", invalid="ignore"):
            shares[sense] = -(here * along).sum(axis=1) / (along * along).sum(axis=1)
            inside &= (when > 0) & (when < 1) & (shares[sense] > 0) & (shares[sense] < 1)
    senses = np.array(list(roots))
    order, which = np.nonzero((net == senses[:, None]) | inside)
    when, share = (np.stack(list(each.values()))[order, which] for each in (roots, shares))
    # Where rounding decides whether there is a root, it lies at the end of the interval or edge.
    when, share = (np.clip(np.nan_to_num(x, nan=0.5), 0, 1) for x in (when, share))
    return k[which], e[which], senses[order], when, share


def _cross(p: FloatArray, q: FloatArray) -> FloatArray:
    area: FloatArray = p[..., 0] * q[..., 1] - p[..., 1] * q[..., 0]
    return area


def _half_turn(p: FloatArray, q: FloatArray) -> IntArray:
    """+1 where the segment from p to q crosses the positive x axis upwards, -1 downwards.

    Exactly the negative of the segment from q to p, whatever is rounded.
    """
    area = _cross(p, q)
    up = (p[:, 1] <= 0) & (q[:, 1] > 0) & (area > 0)
    down = (q[:, 1] <= 0) & (p[:, 1] > 0) & (area < 0)
    return up.astype(np.int64) - down.astype(np.int64)


def _root(a: FloatArray, b: FloatArray, c: FloatArray, sense: int) -> FloatArray:
    """Where a s^2 + b s + c is zero, or nearest to it, with the sign `sense` of the slope."""
    with np.errstate(divide="ignore", invalid="ignore"):
        slope = sense * np.sqrt(np.maximum(b * b - 4 * a * c, 0))
        root = np.where(sense * b > 0, -2 * c / (b + slope), (slope - b) / (2 * a))
    return np.where(np.isfinite(root), root, np.nan)


def _event(
    times: FloatArray,
    cable: FloatArray,
    held: IntArray,
    span_times: FloatArray,
    clock: FloatArray,
    k: int,
    edge: int,
    sense: int,
    when: float,
    share: float,
) -> LeaderEvent:
    points = cable[k] + when * (cable[k + 1] - cable[k])
    strand = points[edge] + share * (points[edge + 1] - points[edge])
    height = float(points[-1, 2])
    over = height > float(strand[2])
    now = float(clock[k] + when * (clock[k + 1] - clock[k]))
    span = int(np.searchsorted(span_times, now, side="right"))
    older = int(np.searchsorted(held, edge, side="right"))
    place = (float(points[-1, 0]), float(points[-1, 1]))
    points[-1, :2] = strand[:2]  # the same point in plan: the curl's ends touch and do not cross
    loop = np.concatenate((strand[None], points[edge + 1 :]))
    rest = np.concatenate((points[: edge + 1], strand[None]))
    return LeaderEvent(
        time=float(times[k] + when * (times[k + 1] - times[k])),
        clock=now,
        span=span,
        older=older,
        over=over,
        sense=sense,
        edge=edge,
        share=share,
        place=place,
        height=height,
        cable_height=float(strand[2]),
        loop=float(np.linalg.norm(np.diff(loop, axis=0), axis=1).sum()),
        curl=older >= span and _all_on_one_side(loop, rest, over),
    )


def _all_on_one_side(loop: FloatArray, rest: FloatArray, over: bool) -> bool:
    """Whether a polyline passes over (else under) another wherever they cross in plan."""
    p, q, a, b = loop[:-1, None], loop[1:, None], rest[None, :-1], rest[None, 1:]
    p_side, q_side = _cross(b - a, p - a), _cross(b - a, q - a)
    a_side, b_side = _cross(q - p, a - p), _cross(q - p, b - p)
    i, j = np.nonzero((p_side * q_side < 0) & (a_side * b_side < 0))
    u = p_side[i, j] / (p_side[i, j] - q_side[i, j])
    v = a_side[i, j] / (a_side[i, j] - b_side[i, j])
    z, w = loop[:, 2], rest[:, 2]
    gap = z[i] + u * (z[i + 1] - z[i]) - w[j] - v * (w[j + 1] - w[j])
    return bool((gap > 0).all() if over else (gap < 0).all())
