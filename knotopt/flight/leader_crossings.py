"""What the leader crosses while a planned flight is tried: letters as they happen.

Over time the cable sweeps a surface, and the leader a line through it; every crossing is a point
where the line pierces the surface. Between two samples the part that an edge of the cable sweeps is
taken as two triangles with a common diagonal. Seen from the leader, a triangle is pierced if all
its sides have the leader on the same hand. Each side is shared with the next triangle and decided
once, so no crossing is lost, or counted twice, where triangles meet.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from knotopt.arrays import BoolArray, FloatArray
from knotopt.flight.layout import Letter, reduced
from knotopt.flight.record import FlightRecord
from knotopt.topology.crossings import crossings_and_contacts, projection

BEFORE = 0.3  # by which samples are looked at that come before the span is flown [s]


@dataclass(frozen=True)
class LeaderCrossing:
    """One crossing of the leader with cable, its own tether included.

    Attributes
    ----------
    letter : Letter
        Its `older` is the span that the leader is flying where it crosses its own tether.
    gap : float
        Height of the leader above the strand [m].
    is_own : bool
        Whether it is its own tether.
    is_curl : bool
        Whether the loop of tether from there to the leader lies wholly over, or under, all other
        cable: a pull takes it out (Reidemeister's first move).
    """

    letter: Letter
    gap: float
    is_own: bool
    is_curl: bool

    def cancels(self, other: LeaderCrossing) -> bool:
        """Whether this crossing followed by the other is none at all."""
        return self.letter.cancels(other.letter)


def leader_crossings(record: FlightRecord, span: int, since: float) -> tuple[LeaderCrossing, ...]:
    """Crossings of the leader on a span, in order of time.

    Parameters
    ----------
    record : FlightRecord
    span : int
        That is being flown (1-based).
    since : float
        When it began, by the record's clock [s].

    Notes
    -----
    O(T M) for T samples of a centreline of M vertices, and O(M^2) for every crossing of the tether.
    """
    later = record.clock >= since - BEFORE
    clock, cable = record.clock[later], record.cable[later]
    found = []
    for k, edge, sense, when, share, gap in _pierced(cable):
        if clock[k] + when * (clock[k + 1] - clock[k]) < since:
            continue
        older = int(np.searchsorted(record.held, edge, side="right"))
        letter = Letter(min(older, span), gap > 0, sense, None)
        is_own = older >= span
        lies = cable[k] + when * (cable[k + 1] - cable[k])
        is_curl = is_own and _lies_on_one_side(lies, edge + share, over=gap > 0)
        found.append((k + when, LeaderCrossing(letter, gap, is_own, is_curl)))
    return tuple(crossing for _, crossing in sorted(found, key=lambda each: each[0]))


def happened_word(crossings: Sequence[LeaderCrossing]) -> tuple[Letter, ...]:
    """The letters that are left of crossings: neither undone nor curls.

    A curl may be what undoes a crossing that was none, so curls are taken out last.
    """
    left = [crossing for crossing in reduced(crossings) if not crossing.is_curl]
    return tuple(crossing.letter for crossing in reduced(left))


def _pierced(cable: FloatArray) -> list[tuple[int, int, int, float, float, float]]:
    """Where the leader's line pierces the surface that the cable sweeps, shape (T, M, 3).

    Returns
    -------
    list of (interval, edge, sense, share of the interval, share of the edge, gap)
    """
    seen = cable[:, :-1] - cable[:, -1:]  # from the leader; the edge that ends there is left out
    start, end = seen[:, :-1], seen[:, 1:]
    along = _is_left(start, end)  # of each edge at each sample
    across = _is_left(seen[:-1], seen[1:])  # of each vertex's way in each interval
    diagonal = _is_left(start[:-1], end[1:])  # from an edge's start to its end a sample later
    # Corners in (share of the edge, of the interval), and the three sides in cyclic order.
    triangles = (
        (((0, 0), (1, 0), (1, 1)), (along[:-1], across[:, 1:], ~diagonal)),
        (((0, 0), (1, 1), (0, 1)), (diagonal, ~along[1:], ~across[:, :-1])),
    )
    found = []
    for corners, (one, two, three) in triangles:
        for k, edge in np.argwhere((one == two) & (two == three)).tolist():
            sense = -1 if one[k, edge] else 1
            p, q, r = (seen[k + later, edge + ahead] for ahead, later in corners)
            areas = np.array([_area(q, r), _area(r, p), _area(p, q)])
            weights = areas / areas.sum()
            share, when = (weights @ np.array(corners)).tolist()
            gap = -float(weights @ [p[2], q[2], r[2]])
            found.append((k, edge, sense, when, share, gap))
    return found


def _is_left(start: FloatArray, end: FloatArray) -> BoolArray:
    """Whether the leader, in the origin, is on the left of lines, or on them."""
    return np.asarray(_area(start, end) >= 0)


def _area(p: FloatArray, q: FloatArray) -> FloatArray:
    return np.asarray(p[..., 0] * q[..., 1] - p[..., 1] * q[..., 0])


def _lies_on_one_side(cable: FloatArray, loop: float, *, over: bool) -> bool:
    """Whether the cable from a place (edge + share) on is over, or under, the rest of it."""
    met, _ = crossings_and_contacts(projection(cable), 0.0, 0.0)
    apart = (met.i + met.u < loop) & (met.j + met.v > loop)
    return bool(((met.gap[apart] < 0) == over).all())
