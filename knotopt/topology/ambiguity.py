"""Where the topological state of a polyline cannot be told: what is degenerate within tolerance.

When the points move, the state changes only where a vertex or an end of the rope crosses a strand,
where three strands pass through one point, or where two strands pass through each other in height.
The first two need a contact (see `crossings`). Most contacts are harmless: those of neighbours on a
stretch that runs on nearly straight, and those of two strands that cross once there and go on
crossing once when their vertices move.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from enum import StrEnum
from itertools import product

import numpy as np

from knotopt.arrays import FloatArray, IntArray
from knotopt.topology.crossings import Contact, Crossings, Projection

Pair = tuple[int, int]

STRAIGHT = 0.5  # least cosine between the pieces of a stretch that does not come back to itself
CLEAR = 0.5  # sine between two strands that short pieces' small turns cannot undo


class Reason(StrEnum):
    """Why the state cannot be told, as words that follow "segments 2 and 7"."""

    HEIGHT = "cross at the same height"
    OVERLAP = "run along each other in plan"
    TANGENT = "touch in plan without surely crossing"
    FOLD = "fold back onto each other in plan"
    REPEATED = "are joined by points that coincide in plan"
    TRIPLE = "pass through one point in plan"
    END = "meet in plan at an end of the rope"


@dataclass(frozen=True)
class Ambiguity:
    """One place where the state cannot be told.

    Attributes
    ----------
    reason : Reason
    segments : tuple of int
        Segments of the polyline, from 0, in order: two, or three at a triple point.
    place : tuple of float
        (x, y) in plan [the polyline's unit].

    Examples
    --------
    >>> print(Ambiguity(Reason.TRIPLE, (0, 2, 4), (0.5, 0.0)))
    segments 0, 2 and 4 pass through one point in plan, at (0.5, 0)
    """

    reason: Reason
    segments: tuple[int, ...]
    place: tuple[float, float]

    def __str__(self) -> str:
        *others, last = self.segments
        listed = ", ".join(str(segment) for segment in others)
        x, y = self.place
        return f"segments {listed} and {last} {self.reason}, at ({x:.6g}, {y:.6g})"


def ambiguities(
    seen: Projection,
    crossings: Crossings,
    contacts: list[Contact],
    plan_tolerance: float,
    height_tolerance: float,
) -> tuple[Ambiguity, ...]:
    """Every place where the state cannot be told, in the order of the segments."""
    meeting = np.stack((crossings.i, crossings.j), axis=1)
    level = set(np.flatnonzero(crossings.touches).tolist())
    found = []
    if contacts:
        number = {(i, j): c for c, (i, j) in enumerate(meeting.tolist())}
        clear = set(number)  # pairs of segments that meet, or nearly, at places that are clear
        for group in _groups(seen, contacts):
            pairs = {pair for contact in group for pair in _pairs_of(contact, len(seen.flat))}
            reason = _reason(seen, number, group, pairs, plan_tolerance)
            if reason is None:
                crossing = _crossings_among(number, pairs)[0]
                if _heights_meet(seen, crossings, crossing, group, height_tolerance):
                    level.add(crossing)
                clear |= pairs
            else:
                vertex, segment = group[0]  # not named as neighbours, if there is a choice
                named = (vertex - 1, segment) if 0 < vertex < segment else (vertex, segment)
                found.append(_at(seen, reason, named, seen.flat[vertex]))
                clear -= pairs
                level.difference_update(_crossings_among(number, pairs))
        meeting = np.array(sorted(clear), dtype=np.intp).reshape(-1, 2)
    for c in level:
        i, j = int(crossings.i[c]), int(crossings.j[c])
        place = seen.flat[i] + crossings.u[c] * (seen.flat[i + 1] - seen.flat[i])
        found.append(_at(seen, Reason.HEIGHT, (i, j), place))
    if len(meeting) > 2:
        found.extend(_triple_points(seen, meeting, plan_tolerance))
    return tuple(sorted(found, key=lambda ambiguity: ambiguity.segments))


def _groups(seen: Projection, contacts: list[Contact]) -> list[list[Contact]]:
    """The contacts that matter, those that share a pair of segments together."""
    group_of: dict[Pair, list[Contact]] = {}
    for contact in contacts:
        if _runs_on(seen, contact):
            continue
        merged = [contact]
        pairs = _pairs_of(contact, len(seen.flat))
        for group in {id(group_of[p]): group_of[p] for p in pairs if p in group_of}.values():
            merged.extend(group)
        for member in merged:
            for pair in _pairs_of(member, len(seen.flat)):
                group_of[pair] = merged
    return [sorted(group) for group in {id(group): group for group in group_of.values()}.values()]


def _pairs_of(contact: Contact, vertices: int) -> list[Pair]:
    """The pairs of segments whose crossing can change at a contact."""
    vertex, segment = contact
    own = range(max(vertex - 1, 0), min(vertex + 1, vertices - 1))
    return [(min(k, segment), max(k, segment)) for k in own]


def _runs_on(seen: Projection, contact: Contact) -> bool:
    """Whether the rope runs on nearly straight from the vertex to the segment."""
    vertex, segment = contact
    start, end = (vertex, segment) if vertex < segment else (segment, vertex - 1)
    steps = np.diff(seen.flat[start : end + 2], axis=0)
    steps /= np.hypot(steps[:, 0], steps[:, 1])[:, None]
    return bool((steps @ steps.T).min() > STRAIGHT)


def _reason(
    seen: Projection,
    number: dict[Pair, int],
    group: list[Contact],
    pairs: set[Pair],
    tolerance: float,
) -> Reason | None:
    """Why strands in contact are ambiguous; None if they cross once for certain.

    A vertex that passes over a strand changes two crossings at once, so within a group without
    ends of the rope the number of crossings stays odd or even. Of one vertex and one segment it is
    at most two, hence one if it is odd. In general it is at most one if all pieces of one strand
    turn to the same side of all pieces of the other: between two crossings both strands would go
    the same way.
    """
    for vertex, segment in group:
        if vertex in {0, len(seen.flat) - 1}:
            return Reason.END
        if vertex in {segment - 1, segment + 2}:
            joint = segment + (vertex > segment)
            gap = np.linalg.norm(seen.flat[vertex] - seen.flat[joint])
            return Reason.REPEATED if gap <= tolerance else Reason.FOLD
    first = range(min(i for i, _ in pairs), max(i for i, _ in pairs) + 1)
    second = range(min(j for _, j in pairs), max(j for _, j in pairs) + 1)
    if first[-1] + 1 >= second[0]:
        return Reason.FOLD
    crosses_once = len(_crossings_among(number, pairs)) == 1
    if crosses_once and (len(group) == 1 or _cross_clearly(seen, first, second, tolerance)):
        return None
    corners = seen.flat[[vertex for vertex, _ in group]]
    spread = np.linalg.norm(corners - corners[0], axis=1).max()
    return Reason.TANGENT if spread <= 2 * tolerance else Reason.OVERLAP


def _cross_clearly(seen: Projection, first: range, second: range, tolerance: float) -> bool:
    """Whether all pieces of one strand turn to the same side of all pieces of the other, and still
    do when vertices move by half the tolerance or, if short, turn by up to 15 degrees."""
    a = np.diff(seen.flat[first[0] : first[-1] + 2], axis=0)[:, None]
    b = np.diff(seen.flat[second[0] : second[-1] + 2], axis=0)[None]
    sizes = np.hypot(a[..., 0], a[..., 1]), np.hypot(b[..., 0], b[..., 1])
    sine = (a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0]) / (sizes[0] * sizes[1])
    shift = (1 + tolerance / sizes[0]) * (1 + tolerance / sizes[1]) - 1
    least = np.minimum(CLEAR, shift)
    return bool((sine > least).all() or (sine < -least).all())


def _crossings_among(number: dict[Pair, int], pairs: set[Pair]) -> list[int]:
    """Crossings of the two strands that these pairs of segments are pieces of."""
    first, second = ({pair[side] for pair in pairs} for side in (0, 1))
    whole = product(range(min(first), max(first) + 1), range(min(second), max(second) + 1))
    return [number[pair] for pair in whole if pair in number]


def _heights_meet(
    seen: Projection,
    crossings: Crossings,
    crossing: int,
    group: list[Contact],
    tolerance: float,
) -> bool:
    """Whether the strands' heights at their crossing and at the vertices there meet."""
    i = crossings.i[crossing]
    height = seen.start[i] + crossings.u[crossing] * (seen.end[i] - seen.start[i])
    heights = [[height], [height - crossings.gap[crossing]]]
    for vertex, segment in group:
        heights[vertex > segment] += [seen.low[vertex], seen.high[vertex]]
    (low, high), (other_low, other_high) = ((min(side), max(side)) for side in heights)
    return bool(low - other_high <= tolerance and other_low - high <= tolerance)


def _triple_points(seen: Projection, meeting: IntArray, tolerance: float) -> Iterable[Ambiguity]:
    """Three segments that meet pairwise and pass within half the tolerance of one point.

    Lines n . x = c with unit normals, each moved by up to r, can be brought to one point exactly
    if |det (n, c)| <= r (|n1 x n2| + |n2 x n3| + |n3 x n1|).
    """
    named, place = np.unique(meeting, return_inverse=True)
    first, second = place.reshape(-1, 2).T
    meets = np.zeros((len(named), len(named)), dtype=np.bool_)
    meets[first, second] = True
    pair, third = np.nonzero(meets[first] & meets[second])
    triples = named[np.stack((first[pair], second[pair], third), axis=1)]
    origin = seen.flat[triples[:, 0]]
    starts = seen.flat[triples]  # (T, 3, 2)
    steps = seen.flat[triples + 1] - starts
    steps /= np.hypot(steps[..., 0], steps[..., 1])[..., None]
    starts = starts - origin[:, None]
    offsets = steps[..., 0] * starts[..., 1] - steps[..., 1] * starts[..., 0]
    after = np.roll(steps, -1, axis=1)
    turns = steps[..., 0] * after[..., 1] - steps[..., 1] * after[..., 0]  # 1 to 2, 2 to 3, 3 to 1
    spread = np.abs((np.roll(offsets, 1, axis=1) * turns).sum(axis=1))
    for t in np.flatnonzero(spread <= tolerance / 2 * np.abs(turns).sum(axis=1)).tolist():
        normals = np.stack((-steps[t, :, 1], steps[t, :, 0]), axis=1)
        place = origin[t] + np.linalg.lstsq(normals, offsets[t])[0]
        yield _at(seen, Reason.TRIPLE, triples[t].tolist(), place)


def _at(seen: Projection, reason: Reason, segments: Iterable[int], place: FloatArray) -> Ambiguity:
    last = len(seen.segment) - 1
    own = tuple(sorted(int(seen.segment[min(segment, last)]) for segment in segments))
    return Ambiguity(reason, own, (float(place[0]), float(place[1])))
