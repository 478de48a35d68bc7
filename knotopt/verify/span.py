"""Whether a set of supports keeps the taut cable's regions, by the definition of `span`.

Between two robots the cable is straight. For every active region and every strand that threads it,
entering at time t_in at x_in and turning first at q:

1. no span between two robots on the boundary closes on q (as a chord does in `opening`);
2. at each of the region's crossings the two spans that cover its two visits cross each other,
   inside both (or at x_in, if the leader enters at the region's own last crossing);
3. each moved corner sweeps over no q: the closed curve from the robot before it along the grid to
   the robot after it, and back over the moved crossing(s), has winding number 0 about q;
4. its new edges stay at least r away from q.

A span that ends only after t_in (the region being closed before) is the chord to x_in. A pocket
needs a robot on one of its sides at least; a side without one is a single span, and its two corners
move together.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import chain, pairwise
from typing import Any

from knotopt.errors import CertificateError
from knotopt.verify.definition import MODES, Claim, Closure, Definition, OpeningReport
from knotopt.verify.fields import field, integers
from knotopt.verify.geometry import Point, intersection, squared_distance, winding_number
from knotopt.verify.opening import threading_cells
from knotopt.verify.proofs import by_counting, by_refutation
from knotopt.verify.regions import Cell, DefinedRegion, define_regions, lay

Span = tuple[int, int]
Corner = tuple[Sequence[Point], Sequence[tuple[Point, Point]]]  # closed curve it sweeps, new edges


@dataclass(frozen=True)
class _Interval:
    """A path interval of a boundary and the robots (times) strictly within it."""

    low: int
    high: int
    robots: tuple[int, ...]


@dataclass(frozen=True)
class _Taut:
    """The taut cable seen from one threading point."""

    cells: Sequence[Cell]
    robots: Sequence[int]  # times
    q: Cell
    entry: int
    closes: int

    def span(self, time: int) -> tuple[int, int]:
        """Times of the robots before and after a time."""
        before = max(robot for robot in self.robots if robot < time)
        after = min(robot for robot in self.robots if robot > time)
        return before, after

    def chord(self, span: tuple[int, int]) -> tuple[Cell, Cell, bool]:
        """The span as it lies when the leader enters, and whether its end may be a crossing."""
        tether = span[1] > self.entry >= self.closes
        end = self.entry if tether else span[1]
        return self.cells[span[0]], self.cells[end], tether and self.entry == self.closes

    def crossing(self, one: int, other: int) -> Point | None:
        """Where the spans over two times cross: inside both, or at an end that counts."""
        spans = self.span(one), self.span(other)
        if spans[0] == spans[1]:
            return None
        (a, b, first), (c, d, second) = map(self.chord, spans)
        at = intersection(a, b, c, d)
        if at is None or at in (a, c) or (at == b and not first) or (at == d and not second):
            return None
        return at

    def grid(self, start: int, end: int) -> list[Cell]:
        """Cells of the path from one time to another, forward or backward."""
        if start <= end:
            return list(self.cells[start : end + 1])
        return list(self.cells[end : start + 1])[::-1]


def check_span(
    path: Sequence[Cell],
    size: int,
    supports: Collection[int],
    openness: Fraction,
    mode: str = "over-under",
    *,
    pockets: bool = True,
) -> OpeningReport:
    """Whether the supports keep every threaded region of the taut cable r-open.

    Parameters
    ----------
    path, size, supports, openness, mode
        As for `check_opening`.
    pockets : bool
        Whether pockets must survive, too, or loops only.

    Examples
    --------
    >>> path = [(1, 5), (4, 5), (4, 2), (2, 2), (2, 4), (5, 4), (5, 1), (3, 1), (3, 3), (1, 3)]
    >>> check_span(path, 5, range(2, 10), Fraction(1, 2)).is_open
    True
    >>> print(check_span(path, 5, [], Fraction(1, 2)).closures[0].reason)
    p9: the spans over a crossing no longer cross
    """
    cells = lay(path)
    times = {cell: time for time, cell in enumerate(cells)}
    numbers = sorted({1, *supports, len(path)})
    robots = [times[path[number - 1]] for number in numbers]
    closures: list[Closure] = []
    closed = []
    smallest: Fraction | None = None
    for index, region in enumerate(define_regions(path, size)):
        if region.kind == "pocket" and not pockets:
            continue
        reasons: list[str] = []
        for entry, q in _strands(region, path, cells, mode).items():
            intervals = _intervals(region, robots)
            taut = _Taut(cells, robots, q, entry, max(region.walk))
            opening, found = _examine(taut, intervals, openness)
            reasons += (f"p{path.index(q) + 1}: {reason}" for reason in found)
            smallest = opening if smallest is None else min(smallest, opening)
        closures += (Closure(region.name, reason) for reason in dict.fromkeys(reasons))
        if reasons:
            closed.append(index)
    return OpeningReport(tuple(closures), tuple(closed), smallest)


def _strands(
    region: DefinedRegion, path: Sequence[Cell], cells: Sequence[Cell], mode: str
) -> dict[int, Cell]:
    """For each strand that threads the region: time of entry, first turning point inside."""
    strands: dict[int, Cell] = {}
    for q in threading_cells(region, path, cells, mode):
        entry = cells.index(q)
        while cells[entry] in region.interior:
            entry -= 1
        strands.setdefault(entry, q)
    return strands


def _intervals(region: DefinedRegion, robots: Sequence[int]) -> list[_Interval]:
    """One interval for a loop, two for a pocket, A first."""
    walk = region.walk
    parts = [walk]
    if region.kind == "pocket":
        jump = next(k for k in range(1, len(walk)) if abs(walk[k] - walk[k - 1]) != 1)
        parts = [walk[:jump], walk[jump:]]
    return [
        _Interval(min(p), max(p), tuple(t for t in robots if min(p) < t < max(p))) for p in parts
    ]


def _examine(
    taut: _Taut, intervals: Sequence[_Interval], openness: Fraction
) -> tuple[Fraction, list[str]]:
    """Smallest squared opening about one threading point (0 if it is lost), and what is wrong."""
    distances: list[Fraction] = []
    reasons: list[str] = []
    spans = list(pairwise(taut.robots))
    for stretch, chord in _within(taut, intervals, spans):
        distances += (squared_distance(taut.q, *edge) for edge in chord)
        if distances[-1] > 0 and winding_number(stretch, taut.q) != 0:
            reasons.append("a span on the boundary cuts it off")
    corners = _corners(taut, intervals, spans)
    if len(intervals) == 2 and not any(interval.robots for interval in intervals):
        reasons.append("no robot on either side of a pocket")
    elif corners is None:
        reasons.append("the spans over a crossing no longer cross")
    for curve, edges in corners or ():
        distances += (squared_distance(taut.q, *edge) for edge in edges)
        if min(distances) > 0 and winding_number(curve, taut.q) != 0:
            reasons.append("a moved crossing leaves it outside")
    smallest = Fraction(0) if reasons else min(distances)
    if not reasons and smallest < openness**2:
        reasons.append(f"a span passes at {float(smallest) ** 0.5:.3f}")
    return smallest, reasons


def _within(taut: _Taut, intervals: Sequence[_Interval], laid: Sequence[Span]) -> Iterator[Corner]:
    """The spans on the boundary, each as a chord with the piece of the grid that it cuts short."""
    for interval in intervals:
        for start, end in laid:
            if interval.low < start < end < interval.high:
                stretch = taut.grid(start, end)
                yield stretch, [(stretch[0], stretch[-1])]


def _corners(
    taut: _Taut, intervals: Sequence[_Interval], laid: Sequence[Span]
) -> list[Corner] | None:
    """The corners that these spans settle; None if a crossing is lost."""
    loop = len(intervals) == 1
    first, second = intervals[0], intervals[-1]
    cells = taut.cells
    corners = [(first.low, first.high)]
    if not loop:
        ends = (second.low, second.high)
        corners = [
            (visit, next(other for other in ends if cells[other] == cells[visit]))
            for visit in (first.low, first.high)
        ]

    def over(time: int) -> Span | None:
        return next((span for span in laid if span[0] < time < span[1]), None)

    def anchor(interval: _Interval, visit: int) -> int | None:
        span = over(visit)
        end = None if span is None else span[1] if visit == interval.low else span[0]
        return end if end is not None and interval.low < end < interval.high else None

    found: list[Corner] = []
    at: dict[int, Point] = {}
    for one, other in corners:
        if over(one) is None or over(other) is None:
            continue
        crossing = taut.crossing(one, other)
        if crossing is None:
            return None
        at[one] = at[other] = crossing
        ends_at = anchor(first, one), anchor(second, other)
        if ends_at[0] is not None and ends_at[1] is not None:
            found.append(_one(taut, (ends_at[1], other), (one, ends_at[0]), crossing))
    if loop or len(at) < 4:
        return found
    # Both corners of a pocket: is a side a single span?
    partner = dict(corners) | {other: one for one, other in corners}
    bare = [side for side in intervals if over(side.low) == over(side.high)]
    if len(bare) == 2:
        return None
    for side in bare:
        held = second if side is first else first
        before, after = (anchor(held, partner[visit]) for visit in (side.low, side.high))
        if before is not None and after is not None:
            moved = at[side.low], at[side.high]
            found.append(_together(taut, side, partner, (before, after), moved))
    return found


def _together(
    taut: _Taut,
    bare: _Interval,
    on_held: dict[int, int],
    anchors: tuple[int, int],
    at: tuple[Point, Point],
) -> Corner:
    """Two corners on one span over the interval `bare`, between robots of the other side."""
    curve: list[Point] = [
        *taut.grid(anchors[0], on_held[bare.low]),
        *taut.grid(bare.low, bare.high),
        *taut.grid(on_held[bare.high], anchors[1]),
        at[1],
        at[0],
    ]
    cells = taut.cells
    edges = [(cells[anchors[0]], at[0]), (at[0], at[1]), (at[1], cells[anchors[1]])]
    return curve, edges


def _one(taut: _Taut, before: tuple[int, int], after: tuple[int, int], at: Point) -> Corner:
    """One corner: from a robot to a visit of the crossing, from the other visit to a robot."""
    curve: list[Point] = [*taut.grid(*before), *taut.grid(*after), at]
    return curve, [(taut.cells[before[0]], at), (at, taut.cells[after[1]])]


class SpanRules:
    """Which spans no open set has together, by the definition.

    Parameters
    ----------
    path : sequence of (column, row)
    regions : iterable of DefinedRegion
    openness : Fraction
    mode : "turning-point" or "over-under"

    Examples
    --------
    >>> path = [(1, 5), (4, 5), (4, 2), (2, 2), (2, 4), (5, 4), (5, 1), (3, 1), (3, 3), (1, 3)]
    >>> rules = SpanRules(path, define_regions(path, 5), Fraction(1, 2))
    >>> rules.exclude([(1, 10)]), rules.exclude([(1, 2), (2, 3)])
    (True, False)
    """

    def __init__(
        self,
        path: Sequence[Cell],
        regions: Iterable[DefinedRegion],
        openness: Fraction,
        mode: str = "over-under",
    ) -> None:
        self.points = len(path)
        self._cells = lay(path)
        times = {cell: time for time, cell in enumerate(self._cells)}
        self._times = [times[cell] for cell in path]
        self._openness = openness
        self._threads = [
            (region, q, entry)
            for region in regions
            for entry, q in _strands(region, path, self._cells, mode).items()
        ]

    def exclude(self, spans: Sequence[Span]) -> bool:
        """Whether no open set has all these spans; a span is a pair of turning points (1-based).

        True only if what the definition says of these spans alone rules them out.
        """
        laid = [(self._times[u - 1], self._times[w - 1]) for u, w in spans]
        robots = sorted({time for span in laid for time in span})
        for region, q, entry in self._threads:
            taut = _Taut(self._cells, robots, q, entry, max(region.walk))
            intervals = _intervals(region, robots)
            corners = _corners(taut, intervals, laid)
            if corners is None:
                return True
            curves = chain(_within(taut, intervals, laid), corners)
            if any(self._passes(taut.q, *curve) for curve in curves):
                return True
        return False

    def _passes(
        self, q: Point, curve: Sequence[Point], edges: Sequence[tuple[Point, Point]]
    ) -> bool:
        """Whether an edge comes too close to the threading point, or the curve winds round it."""
        near = any(squared_distance(q, *edge) < self._openness**2 for edge in edges)
        return near or winding_number(curve, q) != 0


def _clauses(claim: Claim, content: Mapping[str, Any]) -> set[frozenset[int]]:
    """The clauses of those listed sets of spans that no open set has together.

    (u, w) is no span: p_u or p_w carries no robot, or one between them does.
    """
    rules = SpanRules(claim.path, claim.regions, claim.openness, claim.mode)
    found = set()
    for entry in field(content, "spans", list):
        spans = [integers(span) for span in entry] if isinstance(entry, list) else [()]
        if not all(len(span) == 2 and 1 <= span[0] < span[1] <= rules.points for span in spans):
            raise CertificateError(f"spans: {entry!r} is no list of pairs of turning points")
        if spans and rules.exclude([(u, w) for u, w in spans]):
            found.add(frozenset(x for u, w in spans for x in (-u, -w, *range(u + 1, w))))
    return found


SPAN = Definition(
    name="span",
    check=check_span,
    modes=MODES,
    proofs={"refutation": by_refutation(_clauses), "count": by_counting(check_span)},
)
