"""Where the crossings of a flight lie along the cable, planned and executed, and the states then.

Crossings of one span that undo each other are left out as in words (`flight_word`). Those there and
back on two spans are kept if they are planned: a robot between them holds the cable there.
"""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import groupby
from typing import Protocol

import numpy as np
from numpy.typing import ArrayLike

from knotopt.arrays import FloatArray, IntArray
from knotopt.topology.extract import extract_state
from knotopt.verify.flight import LeaderEvent
from knotopt.verify.flight_states import (
    EndCrossing,
    Interval,
    StateSequence,
    crossing_key,
    state_sequence,
)
from knotopt.verify.flight_word import AnyLetter, Letter, reduced_word

TOLERANCE = 0.1  # between crossings along the cable whose order is not trusted [grid steps]


class PlacedLetter(Letter, Protocol):
    """A crossing and where it is in plan, (x, y) [m]."""

    @property
    def place(self) -> tuple[float, float]: ...


def planned_states(
    crossings: Sequence[PlacedLetter],
    anchors: ArrayLike,
    lengths: ArrayLike,
    tolerance: float,
) -> StateSequence:
    """The states that a route leads through past laid cable, straight in plan.

    A crossing is there where the route crosses the older span until the newer one is laid. Then it
    is between that and where the two straight spans cross, or, where the newer one is wound about
    the older one, between the crossings of both.

    Parameters
    ----------
    crossings : sequence of PlannedCrossing or RouteCrossing
    anchors : float array, shape (R, 3)
        Where the robots hover in the end [m].
    lengths : float array, shape (R - 1,)
        Of cable between consecutive robots [m].
    tolerance : float
        See `state_sequence` [m].
    """
    flat = np.asarray(anchors, dtype=float)[:, :2]
    starts = np.concatenate(([0.0], np.cumsum(np.asarray(lengths, dtype=float))))
    kept = _span_by_span(crossings)
    ways = [(letter.span, letter.older) for letter in kept]
    at = []
    for letter in kept:
        start, end = flat[letter.older - 1 : letter.older + 1]
        share = (letter.place - start) @ (end - start) / ((end - start) @ (end - start))
        at.append(_along(starts, letter.older, min(max(float(share), 0.0), 1.0)))

    def where(earlier: int, flown: int) -> tuple[Interval, Interval]:
        span, older = ways[earlier]
        newer = _along(starts, span, 0), _along(starts, span, 1)
        if span == flown:
            return (at[earlier], at[earlier]), newer
        alike = [place for place, way in zip(at, ways, strict=True) if way == ways[earlier]]
        shares = _chords_meet(flat, older, span) if len(alike) == 1 else None
        if shares is not None:
            alike.append(_along(starts, older, shares[0]))
            newer = (_along(starts, span, shares[1]),) * 2
        return (min(alike), max(alike)), newer

    found = []
    for k, letter in enumerate(kept):
        earlier = tuple(where(each, letter.span) for each in range(k))
        found.append(EndCrossing(letter.over, letter.sense, at[k], earlier))
    return replace(state_sequence(found, tolerance), letters=kept)


def executed_states(
    events: Sequence[LeaderEvent],
    times: ArrayLike,
    cable: ArrayLike,
    held: Sequence[int] | IntArray,
    tolerance: float,
    planned: Sequence[Letter] = (),
) -> StateSequence:
    """The states that a flight led through, from what the leader crossed.

    Where earlier crossings are when one is made is seen from above just before. The cable then
    hangs in bights between robots that follow, and a crossing may show several times, or not at
    all; it is then anywhere between, or anywhere on its spans.

    Parameters
    ----------
    events : sequence of LeaderEvent
        All of them.
    times, cable, held
        As for `leader_events`.
    tolerance : float
        See `state_sequence` [m].
    planned : sequence of letters
        Crossings there and back among these are kept.
    """
    times, cable = np.asarray(times, dtype=float), np.asarray(cable, dtype=float)
    held = np.asarray(held, dtype=np.int64)
    kept = _without_detours(_span_by_span(events), _span_by_span(planned))
    crossings = []
    for k, event in enumerate(kept):
        points = cable[max(int(np.searchsorted(times, event.time)) - 1, 0)]
        moved = np.linalg.norm(np.diff(points, axis=0), axis=1)
        along = np.concatenate(([0.0], np.cumsum(moved)))
        seen = _seen(points, along, held)
        at = float(np.interp(event.edge + event.share, np.arange(len(along)), along))
        earlier = tuple(_place(kept[:k], j, seen, along[held]) for j in range(k))
        crossings.append(EndCrossing(event.over, event.sense, at, earlier))
    return replace(state_sequence(crossings, tolerance), letters=kept)


def _span_by_span(letters: Sequence[AnyLetter]) -> tuple[AnyLetter, ...]:
    """The letters without those that undo each other, and curls, while one span is flown."""
    spans = groupby(letters, lambda letter: letter.span)
    return tuple(letter for _, word in spans for letter in reduced_word(tuple(word)))


def _without_detours(
    letters: Sequence[AnyLetter], planned: Sequence[Letter]
) -> tuple[AnyLetter, ...]:
    """The letters without those that undo each other, unless as many are planned."""
    wanted = Counter(crossing_key(planned[there]) for there, _ in _detours(planned))
    dropped: set[int] = set()
    for there, back in _detours(letters):
        key = crossing_key(letters[there])
        wanted[key] -= 1
        if wanted[key] < 0:
            dropped |= {there, back}
    return tuple(letter for k, letter in enumerate(letters) if k not in dropped)


def _detours(letters: Sequence[Letter]) -> list[tuple[int, int]]:
    """Pairs of indices of letters that undo each other, in order of the first."""
    left: list[int] = []
    pairs = []
    for k, letter in enumerate(letters):
        if left and not reduced_word((letters[left[-1]], letter)):
            pairs.append((left.pop(), k))
        else:
            left.append(k)
    return sorted(pairs)


@dataclass(frozen=True)
class _Seen:
    """A crossing of the cable seen from above: spans, older strand over, sign, places along it."""

    older: int
    older_over: bool
    sign: int
    first: float
    second: float


def _along(starts: FloatArray, span: int, share: float) -> float:
    return float(starts[span - 1] + share * (starts[span] - starts[span - 1]))


def _chords_meet(anchors: FloatArray, one: int, other: int) -> tuple[float, float] | None:
    """Shares of two straight spans at which they cross in plan, or None."""
    (a, b), (p, q) = anchors[one - 1 : one + 1], anchors[other - 1 : other + 1]
    matrix = np.column_stack((b - a, p - q))
    if abs(np.linalg.det(matrix)) < 1e-12:
        return None
    u, v = np.linalg.solve(matrix, p - a).tolist()
    return (u, v) if 0 <= u <= 1 and 0 <= v <= 1 else None


def _seen(points: FloatArray, along: FloatArray, held: IntArray) -> list[_Seen]:
    """All crossings of the cable, in the order of their newer strands; none if not clear."""
    found = extract_state(points)
    if found.state is None:
        return []
    at = np.interp(found.visits.parameter, np.arange(len(along)), along).tolist()
    span = np.searchsorted(held, found.visits.segment, side="right").tolist()
    return [
        _Seen(span[entry >> 2], not entry & 2, 2 * (entry & 1) - 1, at[entry >> 2], at[visit])
        for visit, entry in enumerate(found.state.code)
        if entry >> 2 < visit
    ]


def _place(
    events: Sequence[LeaderEvent], which: int, seen: Sequence[_Seen], starts: FloatArray
) -> tuple[Interval, Interval]:
    """Where a crossing that the leader made is now, on its older and on its newer strand."""
    event = events[which]
    if event.own:
        unknown = float(starts[max(event.span - 1, 0)]), math.inf
        return unknown, unknown
    alike = [k for k, other in enumerate(events) if crossing_key(other) == crossing_key(event)]
    sign = -event.sense if event.over else event.sense
    strands = [
        each
        for each in seen
        if (each.older, each.older_over, each.sign) == (event.older, not event.over, sign)
        and each.second >= starts[events[alike[0]].span - 1]
    ]
    if len(strands) == len(alike):
        one = strands[alike.index(which)]
        return (one.first, one.first), (one.second, one.second)
    start = float(starts[event.span - 1])
    later = [each for each in strands if each.second >= start]
    if not later:
        span = float(starts[event.older - 1]), float(starts[event.older])
        return span, (start, math.inf)
    first, second = [each.first for each in later], [each.second for each in later]
    return (min(first), max(first)), (min(second), max(second))
