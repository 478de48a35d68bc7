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

from collections.abc import Collection, Iterable, Sequence
from dataclasses import dataclass
from fractions import Fraction

from knotopt.verify.geometry import Point, intersection, squared_distance, winding_number
from knotopt.verify.opening import Closure, OpeningReport, threading_cells
from knotopt.verify.regions import Cell, DefinedRegion, define_regions, lay

Reasons = list[str]


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
    regions: Iterable[DefinedRegion] | None = None,
    *,
    pockets: bool = True,
) -> OpeningReport:
    """Whether the supports keep every threaded region of the taut cable r-open.

    Parameters
    ----------
    path, size, supports, openness, mode, regions
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
    for index, region in enumerate(define_regions(path, size) if regions is None else regions):
        if region.kind == "pocket" and not pockets:
            continue
        reasons: Reasons = []
        strands: dict[int, Cell] = {}  # time of entry to the first turning point inside
        for q in threading_cells(region, path, cells, mode):
            entry = times[q]
            while cells[entry] in region.interior:
                entry -= 1
            strands.setdefault(entry, q)
        for entry, q in strands.items():
            intervals = _intervals(region, robots)
            taut = _Taut(cells, robots, q, entry, max(region.walk))
            opening, found = _examine(taut, intervals, openness)
            reasons += (f"p{path.index(q) + 1}: {reason}" for reason in found)
            smallest = opening if smallest is None else min(smallest, opening)
        closures += (Closure(region.name, reason) for reason in dict.fromkeys(reasons))
        if reasons:
            closed.append(index)
    return OpeningReport(tuple(closures), tuple(closed), smallest)


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
) -> tuple[Fraction, Reasons]:
    """Smallest squared opening about one threading point (0 if it is lost), and what is wrong."""
    distances: list[Fraction] = []
    reasons: Reasons = []
    for interval in intervals:
        for start, end in zip(interval.robots, interval.robots[1:], strict=False):
            stretch = taut.grid(start, end)
            distances.append(squared_distance(taut.q, stretch[0], stretch[-1]))
            if distances[-1] > 0 and winding_number(stretch, taut.q) != 0:
                reasons.append("a span on the boundary cuts it off")
    for curve, edges in _corners(taut, intervals, reasons):
        distances += (squared_distance(taut.q, *edge) for edge in edges)
        if min(distances) > 0 and winding_number(curve, taut.q) != 0:
            reasons.append("a moved crossing leaves it outside")
    smallest = Fraction(0) if reasons else min(distances)
    if not reasons and smallest < openness**2:
        reasons.append(f"a span passes at {float(smallest) ** 0.5:.3f}")
    return smallest, reasons


Corner = tuple[list[Point], list[tuple[Point, Point]]]


def _corners(taut: _Taut, intervals: Sequence[_Interval], reasons: Reasons) -> list[Corner]:
    """For each corner that moves: the closed curve it sweeps, and its new edges."""
    if len(intervals) == 1:
        (loop,) = intervals
        at = taut.crossing(loop.low, loop.high)
        if at is None or not loop.robots:
            reasons.append("the spans over a crossing no longer cross")
            return []
        return [_one(taut, (loop.robots[-1], loop.high), (loop.low, loop.robots[0]), at)]
    a, b = intervals
    cells = taut.cells
    partner = {
        visit: next(other for other in (b.low, b.high) if cells[other] == cells[visit])
        for visit in (a.low, a.high)
    }
    moved = {visit: taut.crossing(visit, partner[visit]) for visit in (a.low, a.high)}
    if not (a.robots or b.robots):
        reasons.append("no robot on either side of a pocket")
        return []
    low, high = moved[a.low], moved[a.high]
    if low is None or high is None:
        reasons.append("the spans over a crossing no longer cross")
        return []

    def anchor(interval: _Interval, visit: int) -> int:
        return interval.robots[0] if visit == interval.low else interval.robots[-1]

    if a.robots and b.robots:
        return [
            _one(taut, (anchor(b, partner[v]), partner[v]), (v, anchor(a, v)), at)
            for v, at in ((a.low, low), (a.high, high))
        ]
    # One side is a single span: both corners move together.
    bare, held = (b, a) if a.robots else (a, b)
    on_held = {partner[v]: v for v in partner} if a.robots else partner
    at_low, at_high = (low, high) if bare is a or partner[a.low] == b.low else (high, low)
    before, after = (anchor(held, on_held[v]) for v in (bare.low, bare.high))
    curve: list[Point] = [
        *taut.grid(before, on_held[bare.low]),
        *taut.grid(bare.low, bare.high),
        *taut.grid(on_held[bare.high], after),
        at_high,
        at_low,
    ]
    edges = [(cells[before], at_low), (at_low, at_high), (at_high, cells[after])]
    return [(curve, edges)]


def _one(taut: _Taut, before: tuple[int, int], after: tuple[int, int], at: Point) -> Corner:
    """One corner: from a robot to a visit of the crossing, from the other visit to a robot."""
    curve: list[Point] = [*taut.grid(*before), *taut.grid(*after), at]
    return curve, [(taut.cells[before[0]], at), (at, taut.cells[after[1]])]
