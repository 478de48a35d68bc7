"""The regions of a cable by their definition, in sets and whole numbers.

Loops (eq. 7), pockets (eq. 8), interiors (eq. 9) of the paper, from the path's turning points.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import lru_cache
from itertools import pairwise

Cell = tuple[int, int]
_Boundary = tuple[str, frozenset[Cell], tuple[int, ...]]  # kind, apexes, walk


@dataclass(frozen=True)
class DefinedRegion:
    """One region.

    Attributes
    ----------
    kind : "loop" or "pocket"
    apexes : set of cells
        One crossing for a loop, two for a pocket.
    walk : tuple of int
        Times on the boundary [grid steps from p_1], in the order walked from its start.
    interior : set of cells
    threaded_by : int or None
        The first later turning point inside (1-based); None makes the region passive.
    """

    kind: str
    apexes: frozenset[Cell]
    walk: tuple[int, ...]
    interior: frozenset[Cell]
    threaded_by: int | None

    @property
    def name(self) -> str:
        """Kind and crossings, such as `loop [3,4]`."""
        return " ".join([self.kind, *(f"[{c},{r}]" for c, r in sorted(self.apexes))])


def lay(path: Sequence[Cell]) -> list[Cell]:
    """Lattice points of the path by time."""
    cells = [path[0]]
    for (c0, r0), (c1, r1) in pairwise(path):
        steps = abs(c1 - c0) + abs(r1 - r0)
        cells += [
            (c0 + (c1 - c0) * step // steps, r0 + (r1 - r0) * step // steps)
            for step in range(1, steps + 1)
        ]
    return cells


def define_regions(path: Sequence[Cell], size: int) -> tuple[DefinedRegion, ...]:
    """Every region of the cable along `path`, on a grid of the given size.

    Loops come first, by their crossing's first visit, then pockets, by the time at which they
    close. Those of the cables asked for last are kept, as several sets of one cable are examined.
    """
    return _define(tuple(path), size)


@lru_cache(maxsize=4)
def _define(path: tuple[Cell, ...], size: int) -> tuple[DefinedRegion, ...]:
    cells = lay(path)
    visits: dict[Cell, list[int]] = {}
    for time, cell in enumerate(cells):
        visits.setdefault(cell, []).append(time)
    crossings = {cell: times for cell, times in visits.items() if len(times) == 2}
    loops = [
        ("loop", frozenset([cell]), tuple(range(t1, t2 + 1)))
        for cell, (t1, t2) in crossings.items()
    ]
    pockets = sorted(_pockets(cells, list(crossings.values())), key=lambda pocket: max(pocket[2]))
    regions = []
    for kind, apexes, walk in (*loops, *pockets):
        interior = enclosed({cells[t] for t in walk}, size)
        threading = (
            k
            for k, point in enumerate(path, 1)
            if point in interior and visits[point][0] > min(walk)
        )
        regions.append(DefinedRegion(kind, apexes, walk, interior, next(threading, None)))
    return tuple(regions)


def _pockets(cells: Sequence[Cell], crossings: Sequence[list[int]]) -> Iterator[_Boundary]:
    """Two stretches of the path between the same two crossings, the later one closing the pocket.

    Each is a single arc when the pocket closes: a crossing inside it is complete only later. So
    neither crosses itself, and they meet at their ends alone.
    """
    other = {time: pair[1 - k] for pair in crossings for k, time in enumerate(pair)}
    times = sorted(other)
    place = {time: index for index, time in enumerate(times)}
    complete = [max(time, other[time]) for time in times]
    for first, start in enumerate(times):
        passed = {start}
        for last in range(first + 1, len(times)):
            end = times[last]
            if other[end] in passed:
                break  # crosses itself
            passed.add(end)
            low, high = sorted((other[start], other[end]))
            inside = *complete[first + 1 : last], *complete[place[low] + 1 : place[high]]
            if low <= end or min(inside, default=high + 1) <= high:
                continue
            later = range(low, high + 1)
            back = later if other[end] == low else reversed(later)
            apexes = frozenset([cells[start], cells[end]])
            yield "pocket", apexes, (*range(start, end + 1), *back)


def enclosed(boundary: set[Cell], size: int) -> frozenset[Cell]:
    """Cells that a flood fill of 4 neighbours from outside the padded grid does not reach.

    Sets of cells are whole numbers with a bit for each cell; columns follow each other, and a step
    beyond a column's end leads from padding to padding.
    """
    width = size + 2
    free = (1 << width * width) - 1
    for c, r in boundary:
        free &= ~(1 << c * width + r)
    reached, before = 1, 0
    while reached != before:
        before = reached
        reached |= reached << 1 | reached >> 1 | reached << width | reached >> width
        reached &= free
    inside, found = free & ~reached, []
    while inside:
        bit = inside.bit_length() - 1
        inside ^= 1 << bit
        found.append(divmod(bit, width))
    return frozenset(found)
