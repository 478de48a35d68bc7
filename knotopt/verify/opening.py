"""Whether a set of supports keeps a cable open, by the definition of `opening`.

For an active region the opening polygon runs through its apexes and the selected turning points on
its boundary, in the order walked. For consecutive nodes u, w the chord uw closes on a threading
point q if |q - uw| < r, or if the closed curve "boundary from u to w, chord back" winds round q.
The region is r-open if no edge of its polygon closes on a threading point and at least 2 selected
turning points lie strictly inside a loop, at least 1 on a pocket.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Sequence
from fractions import Fraction

from knotopt.verify.definition import MODES, Closure, Definition, OpeningReport
from knotopt.verify.geometry import squared_distance, winding_number
from knotopt.verify.proofs import by_counting, by_refutation
from knotopt.verify.regions import Cell, DefinedRegion, define_regions, lay


def check_opening(
    path: Sequence[Cell],
    size: int,
    supports: Collection[int],
    openness: Fraction,
    mode: str = "turning-point",
) -> OpeningReport:
    """Whether the supports keep every active region r-open.

    Parameters
    ----------
    path : sequence of (column, row)
        Turning points p_1 ... p_n.
    size : int
        Grid size N.
    supports : collection of int
        Turning points with a support robot (1-based).
    openness : Fraction
        r [grid steps].
    mode : "turning-point" or "over-under"
        Which turning points inside a region thread it; in `over-under` columns pass over rows.

    Examples
    --------
    >>> path = [(1, 5), (4, 5), (4, 2), (2, 2), (2, 4), (5, 4), (5, 1), (3, 1), (3, 3), (1, 3)]
    >>> check_opening(path, 5, [3, 4, 5, 6], Fraction(1, 2)).is_open
    True
    >>> print(check_opening(path, 5, [4, 6], Fraction(1, 2)).closures[0].reason)
    1 selected turning points on it, 2 needed
    """
    cells = lay(path)
    corner = {cell: number for number, cell in enumerate(path, 1)}
    selected = {path[number - 1] for number in supports} | {path[0], path[-1]}
    closures: list[Closure] = []
    closed = []
    smallest: Fraction | None = None
    for index, region in enumerate(define_regions(path, size)):
        threading = list(threading_cells(region, path, cells, mode))
        if not threading:
            continue
        opening, reasons = _examine(region, cells, corner, selected, threading, openness)
        smallest = opening if smallest is None else min(smallest, opening)
        closures += (Closure(region.name, reason) for reason in reasons)
        if reasons:
            closed.append(index)
    return OpeningReport(tuple(closures), tuple(closed), smallest)


def threading_cells(
    region: DefinedRegion, path: Sequence[Cell], cells: Sequence[Cell], mode: str
) -> Iterator[Cell]:
    """Turning points that thread the region, in the order met."""
    times = {cell: time for time, cell in enumerate(cells)}
    for cell in path:
        if cell not in region.interior or times[cell] < min(region.walk):
            continue
        if mode == "over-under":
            into = times[cell]
            while cells[into] in region.interior:
                into -= 1
            out = times[cell]
            while out < len(cells) and cells[out] in region.interior:
                out += 1
            if out == len(cells) or _is_over(cells, into) == _is_over(cells, out):
                continue
        yield cell


def _is_over(cells: Sequence[Cell], time: int) -> bool:
    """Whether the strand at a crossing runs along a column, which passes over rows."""
    return cells[time - 1][0] == cells[time + 1][0]


def closing_clauses(
    path: Sequence[Cell],
    regions: Iterable[DefinedRegion],
    openness: Fraction,
    mode: str = "turning-point",
) -> set[frozenset[int]]:
    """What every r-open set satisfies, as clauses: literal +k (-k) says p_k is (not) selected.

    For each pair of boundary nodes whose chord closes on a threading point: not both selected
    (apexes always are) with nothing between. For each loop: all but any one of its turning points
    hold a selected one; for each pocket: all of them do.
    """
    cells = lay(path)
    corner = {cell: number for number, cell in enumerate(path, 1)}
    clauses: set[frozenset[int]] = set()
    for region in regions:
        threading = list(threading_cells(region, path, cells, mode))
        if not threading:
            continue
        around = _around(region, cells)
        count = len(around)
        apexes = [k for k, cell in enumerate(around) if cell in region.apexes]
        for start, end in zip(apexes, [*apexes[1:], apexes[0] + count], strict=True):
            # One side of the region, from apex to apex.
            side = [around[k % count] for k in range(start, end + 1)]
            nodes = [0, *(k for k in range(1, len(side) - 1) if side[k] in corner), len(side) - 1]
            for i, u in enumerate(nodes):
                for w in nodes[i + 2 :]:
                    if any(_closes(side[u : w + 1], q, openness) for q in threading):
                        between = {corner[side[k]] for k in nodes if u < k < w}
                        ends = {-corner[side[k]] for k in (u, w) if side[k] in corner}
                        clauses.add(frozenset(between | ends))
        on = {corner[cell] for cell in around if cell in corner}
        if region.kind == "loop":
            clauses.update(frozenset(on - {left_out}) for left_out in on)
        else:
            clauses.add(frozenset(on))
    return clauses


def _around(region: DefinedRegion, cells: Sequence[Cell]) -> list[Cell]:
    """Cells round the boundary; where two pieces of it meet the walk has the apex twice."""
    around = [cells[time] for time in region.walk]
    if around[0] == around[-1]:
        around.pop()
    return [cell for k, cell in enumerate(around) if k == 0 or cell != around[k - 1]]


def _closes(stretch: Sequence[Cell], q: Cell, openness: Fraction) -> bool:
    """Whether the chord between the ends of a boundary stretch closes on q."""
    near = squared_distance(q, stretch[0], stretch[-1]) < openness**2
    return near or winding_number(stretch, q) != 0


def _examine(
    region: DefinedRegion,
    cells: Sequence[Cell],
    corner: dict[Cell, int],
    selected: Collection[Cell],
    threading: Sequence[Cell],
    openness: Fraction,
) -> tuple[Fraction, list[str]]:
    """Smallest squared opening of one region, and why it is not open."""
    around = _around(region, cells)
    nodes = [k for k, cell in enumerate(around) if cell in selected or cell in region.apexes]
    reasons = []
    inside = sum(around[k] in selected for k in nodes)
    needed = 2 if region.kind == "loop" else 1
    if inside < needed:
        reasons.append(f"{inside} selected turning points on it, {needed} needed")
    distances: list[Fraction] = []
    for k, u in enumerate(nodes):
        w = nodes[(k + 1) % len(nodes)]
        stretch = around[u : w + 1] if u < w else [*around[u:], *around[: w + 1]]
        for q in threading:
            distance = squared_distance(q, around[u], around[w])
            lost = distance > 0 and winding_number(stretch, q) != 0
            what = f"the chord {_label(around[u], corner)} to {_label(around[w], corner)}"
            where = f"p{corner[q]}"
            if distance < openness**2:
                reasons.append(
                    f"{what} passes {where} at {float(distance) ** 0.5:.3f}, "
                    f"closer than {float(openness):g}"
                )
            elif lost:
                reasons.append(f"{what} cuts {where} off")
            distances.append(Fraction(0) if lost else distance)
    return min(distances), reasons


def _label(cell: Cell, corner: dict[Cell, int]) -> str:
    return f"p{corner[cell]}" if cell in corner else f"apex [{cell[0]},{cell[1]}]"


OPENING = Definition(
    name="opening",
    check=check_opening,
    modes=MODES,
    proofs={
        "refutation": by_refutation(
            lambda claim, _: closing_clauses(claim.path, claim.regions, claim.openness, claim.mode)
        ),
        "count": by_counting(check_opening),
    },
)
