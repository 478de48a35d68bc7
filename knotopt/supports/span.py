"""Formulation `span`, compiled from a cable: the taut cable itself, whose crossings move.

Between two robots the cable is straight. A strand threads a region at the first turning point q
that it meets inside. A threaded region survives if

- no span within its boundary closes on q (as a chord does in `opening`);
- at each of its crossings c the two spans that cover c's two visits still cross, at c', and moving
  the corner from c to c' does not sweep over q: the closed curve "from the robot before the corner
  along the grid over c to the robot after it, and back over c'" has winding number 0 about q;
- the new edges at the corner stay r away from q.

If the last of these spans ends only after the leader enters the region, at x_in, the cable trails
behind the leader: its last span is the chord from its robot d to x_in. Spans cross inside both;
only where the leader enters at the region's own last crossing may the tether end on the other. A
pocket may have a side without robots: then one span carries both its crossings, and the three
spans are judged together. For a loop this is the definition by winding numbers of the whole
polygon, as one corner moves.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from functools import partial
from math import prod

import numpy as np

from formulations.span import Conflict, SpanProgram
from formulations.team import Team
from knotopt.arrays import BoolArray, FloatArray, IntArray
from knotopt.cable.cable import Cable
from knotopt.errors import RequirementError
from knotopt.supports.chords import Chords, between, distance_to, meet, ray_to
from knotopt.supports.formulation import Formulation
from knotopt.supports.opening import path_turns, stretch_margins
from knotopt.supports.proofs import by_counting, by_refutation_of_spans
from knotopt.supports.regions import Regions
from knotopt.supports.threading import Threading
from knotopt.supports.threading_points import threading_points

MAX_TRIPLES = 40_000_000  # pairs or triples of spans judged at one region


@dataclass(frozen=True, eq=False)
class _Ends:
    """Spans over one visit of a crossing, each with a robot (its anchor) on the boundary.

    spans: (S, 2) turning points (0-based); anchor: (S,), the end that lies on the boundary;
    visit: the time covered.
    """

    spans: IntArray
    anchor: IntArray
    visit: int


@dataclass(frozen=True, eq=False)
class _Thread:
    """One threading point q and the time and place at which the leader enters."""

    q: IntArray
    index: int
    entry: int


def compile_span(
    regions: Regions,
    mode: Threading = Threading.OVER_UNDER,
    team: Team | None = None,
    start: tuple[int, ...] | None = None,
    *,
    pockets: bool = True,
) -> SpanProgram:
    """The program `span` of a cable.

    Parameters
    ----------
    regions : Regions
    mode : Threading
    team : Team, optional
    start : tuple of int, optional
        Turning points (1-based) of a first guess.
    pockets : bool
        Whether pockets must survive, too, or loops only.

    Raises
    ------
    RequirementError
        A region with more than `MAX_TRIPLES` pairs or triples of spans (random grids beyond N of
        some 36 to 40).

    Notes
    -----
    O(R K n^4) time and O(n^4) memory at worst for R active regions with K threading points.

    Examples
    --------
    >>> from knotopt.diagram.families import torus_knot
    >>> program = compile_span(Regions(Cable(torus_knot(2, 3), "L+")))
    >>> program.points, [conflict.origin for conflict in program.conflicts]
    (10, ['loop c1', 'loop c2'])
    """
    cable = regions.cable
    count = len(cable.path)
    threading = threading_points(regions, mode).first_of_strands()
    forbidden = np.full((count + 1, count + 1), np.inf)
    conflicts: list[Conflict] = []
    for index in np.unique(threading.region).tolist():
        pocket = bool(regions.boundaries.is_pocket[index])
        if pocket and not pockets:
            continue
        of_region = threading.region == index
        threads = [
            _Thread(cable.points[point], point, int(entry))
            for point, entry in zip(
                threading.point[of_region].tolist(), threading.entry[of_region], strict=True
            )
        ]
        _forbid_within(regions, index, threads, forbidden)
        compile_region = _pocket if pocket else _loop
        conflicts.extend(compile_region(regions, index, threads, forbidden))
    return SpanProgram(
        name=f"span, {mode}, cut {cable.cut}",
        points=count,
        forbidden=forbidden,
        conflicts=tuple(conflicts),
        team=team or Team(),
        start=start,
    )


def _loop(
    regions: Regions, index: int, threads: list[_Thread], forbidden: FloatArray
) -> Iterator[Conflict]:
    interval = regions.boundaries.a[index].tolist()
    _forbid_covering(regions.cable, interval, forbidden)
    first, second = (_ends(regions.cable, interval, visit) for visit in interval)
    yield _corner(regions.cable, first, second, threads, interval[1], regions.name(index))


def _pocket(
    regions: Regions, index: int, threads: list[_Thread], forbidden: FloatArray
) -> Iterator[Conflict]:
    cable, name = regions.cable, regions.name(index)
    a, b = regions.boundaries.a[index].tolist(), regions.boundaries.b[index].tolist()
    # The two corners, as pairs (visit on A, visit on B).
    forward = bool(regions.boundaries.b_forward[index])
    corners = [(a[0], b[1]), (a[1], b[0])] if forward else [(a[0], b[0]), (a[1], b[1])]
    for corner in corners:
        _forbid_covering(cable, corner, forbidden)
    closes, ends = max(a[1], b[1]), partial(_ends, cable)
    # Robots on both sides: each corner moves by itself.
    for on_a, on_b in corners:
        yield _corner(cable, ends(a, on_a), ends(b, on_b), threads, closes, name)
    # No robot on one side: one span carries both corners.
    (a0, b0), (a1, b1) = corners
    whole_a, whole_b = _covering(cable, a), _covering(cable, b)
    yield _side(cable, whole_a, (a0, a1), (ends(b, b0), ends(b, b1)), threads, closes, name)
    yield _side(cable, whole_b, (b0, b1), (ends(a, a0), ends(a, a1)), threads, closes, name)
    # No robot on either side: two straight spans meet once at most.
    none = np.zeros((len(whole_a), len(whole_b)))
    yield Conflict(whole_a + 1, whole_b + 1, None, none, name)


def _first_after(cable: Cable, time: int) -> int:
    return int(np.searchsorted(cable.times, time))  # a crossing's time is no turning point's


def _ends(cable: Cable, interval: list[int], visit: int) -> _Ends:
    """Spans over one end of an interval, with a robot within the interval."""
    i, j = (_first_after(cable, time) for time in interval)
    leaves = visit == interval[0]
    grid = np.mgrid[:i, i:j] if leaves else np.mgrid[i:j, j : len(cable.path)]
    spans = grid.reshape(2, -1).T
    return _Ends(spans, spans[:, int(leaves)], visit)


def _covering(cable: Cable, interval: list[int]) -> IntArray:
    """Spans over a whole interval."""
    i, j = (_first_after(cable, time) for time in interval)
    return np.mgrid[:i, j : len(cable.path)].reshape(2, -1).T


def _forbid_covering(cable: Cable, visits: Iterable[int], forbidden: FloatArray) -> None:
    """A span over both visits of a crossing loses it."""
    spans = _covering(cable, sorted(visits)) + 1
    forbidden[spans[:, 0], spans[:, 1]] = 0.0


def _forbid_within(
    regions: Regions, index: int, threads: list[_Thread], forbidden: FloatArray
) -> None:
    """Spans within the boundary must not close on a threading point."""
    cable = regions.cable
    for interval in (regions.boundaries.a[index], regions.boundaries.b[index]):
        inside = np.arange(*(_first_after(cable, time) for time in interval))
        i, j = np.triu_indices(len(inside), k=2)
        u, w = inside[i], inside[j]
        for thread in threads:
            q = np.full(len(u), thread.index)
            margins = stretch_margins(cable, cable.times[u], cable.times[w], q)
            np.minimum.at(forbidden, (u + 1, w + 1), margins)


def _laid(cable: Cable, spans: IntArray, thread: _Thread, closes: int) -> Chords:
    """The spans as chords when the leader threads the region, closed at time `closes`."""
    start, end = cable.points[spans[:, 0]], cable.points[spans[:, 1]]
    tether = (cable.times[spans[:, 1]] > thread.entry) & (thread.entry >= closes)
    chord_end = np.where(tether[:, None], cable.cells[thread.entry], end)
    return Chords(start, chord_end, tether & (thread.entry == closes))


def _corner(
    cable: Cable, first: _Ends, second: _Ends, threads: list[_Thread], closes: int, origin: str
) -> Conflict:
    """Two spans that must keep one crossing, each with a robot on the boundary.

    Closed curve: from the second's anchor along the grid over c to the first's, back over c'.
    """
    before, after = cable.points[first.anchor][:, None], cable.points[second.anchor][None]
    times = cable.times
    margins = _no_margins(cable, len(first.spans), len(second.spans))
    for thread in threads:
        q = thread.q
        moved = meet(
            _laid(cable, first.spans, thread, closes), _laid(cable, second.spans, thread, closes)
        )
        wound = (
            path_turns(cable, times[second.anchor], second.visit, thread.index)[None]
            + path_turns(cable, first.visit, times[first.anchor], thread.index)[:, None]
            + ray_to(before, moved, q)
            - ray_to(after, moved, q)
        )
        clear = np.minimum(distance_to(before, moved, q), distance_to(after, moved, q))
        margins = np.minimum(margins, np.where(moved.meets & (wound == 0), clear, 0.0))
    margins[_overlap(first.spans[:, None], second.spans[None])] = np.inf
    return Conflict(first.spans + 1, second.spans + 1, None, margins, origin)


def _no_margins(cable: Cable, *shape: int) -> FloatArray:
    if prod(shape) > MAX_TRIPLES:
        raise RequirementError(
            f"formulation span on a grid of size {cable.diagram.size} judges {prod(shape):,} sets "
            f"of spans at one region; {MAX_TRIPLES:,} are allowed (some 3 GiB)"
        )
    return np.full(shape, np.inf)


def _side(
    cable: Cable,
    spans: IntArray,
    corners: tuple[int, int],
    ends: tuple[_Ends, _Ends],
    threads: list[_Thread],
    closes: int,
    origin: str,
) -> Conflict:
    """One span that carries both crossings of a pocket, and the two spans that cross it.

    Closed curve: from one anchor along the grid over both crossings to the other, back over the
    moved ones. Arrays have shape (span, first end, second end) or broadcast to it.
    """
    first, second = ends
    times = cable.times
    before, after = cable.points[first.anchor][None], cable.points[second.anchor][None]
    margins = _no_margins(cable, len(spans), len(first.spans), len(second.spans))
    for thread in threads:
        q, turns = thread.q, partial(path_turns, cable, q=thread.index)
        chords = _laid(cable, spans, thread, closes)
        moved0 = meet(chords, _laid(cable, first.spans, thread, closes))
        moved1 = meet(chords, _laid(cable, second.spans, thread, closes))
        middle, shortest = between(chords, moved0, moved1, q)
        wound = (
            turns(times[first.anchor], first.visit)[None, :, None]
            + turns(*corners)
            + turns(second.visit, times[second.anchor])[None, None]
            + ray_to(after, moved1, q)[:, None]
            + middle
            - ray_to(before, moved0, q)[:, :, None]
        )
        clear = np.minimum(
            distance_to(before, moved0, q)[:, :, None], distance_to(after, moved1, q)[:, None]
        )
        kept = moved0.meets[:, :, None] & moved1.meets[:, None] & (wound == 0)
        margins = np.minimum(margins, np.where(kept, np.minimum(clear, shortest), 0.0))
    apart = _overlap(first.spans[:, None], second.spans[None])[None]
    apart = apart | _overlap(spans[:, None], first.spans[None])[:, :, None]
    apart = apart | _overlap(spans[:, None], second.spans[None])[:, None]
    margins[apart] = np.inf
    return Conflict(first.spans + 1, second.spans + 1, spans + 1, margins, origin)


def _overlap(first: IntArray, second: IntArray) -> BoolArray:
    """Whether two spans cannot both be part of one path."""
    apart = (first[..., 1] <= second[..., 0]) | (second[..., 1] <= first[..., 0])
    overlap: BoolArray = ~apart & (first != second).any(axis=-1)
    return overlap


SPAN = Formulation(
    name="span",
    words="the taut cable itself",
    compile=compile_span,
    threading=(Threading.OVER_UNDER, Threading.TURNING_POINT),
    proofs={"refutation": by_refutation_of_spans, "count": by_counting},
    threads_once=True,
    is_taut=True,
    with_loops=True,
)
