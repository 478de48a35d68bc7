"""The regions of a cable by their definition, slowly: all pairs of crossings, sets, a queue.

Loops (eq. 7), pockets (eq. 8), interiors (eq. 9) of the paper, from the path's turning points.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import combinations, pairwise

Cell = tuple[int, int]


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


def define_regions(path: Sequence[Cell], size: int) -> list[DefinedRegion]:
    """Every region of the cable along `path`, on a grid of the given size."""
    cells = lay(path)
    visits: dict[Cell, list[int]] = {}
    for time, cell in enumerate(cells):
        visits.setdefault(cell, []).append(time)
    crossings = {cell: times for cell, times in visits.items() if len(times) == 2}

    walks: list[tuple[str, frozenset[Cell], tuple[int, ...]]] = []
    for cell, (t1, t2) in crossings.items():
        walks.append(("loop", frozenset([cell]), tuple(range(t1, t2 + 1))))
    for a, b in combinations(crossings, 2):
        (a1, a2), (b1, b2) = crossings[a], crossings[b]
        for ends in (((a1, b1), (a2, b2)), ((a1, b2), (a2, b1))):
            early, late = sorted(sorted(end) for end in ends)
            if early[1] >= late[0]:
                continue  # not disjoint
            first = range(early[0], early[1] + 1)
            second = range(late[0], late[1] + 1)
            on_first = [cells[t] for t in first]
            on_second = [cells[t] for t in second]
            if len(set(on_first)) < len(on_first) or len(set(on_second)) < len(on_second):
                continue  # crosses itself
            if set(on_first) & set(on_second) != {a, b}:
                continue
            inside = set(first[1:-1]) | set(second[1:-1])
            if any(times[1] <= late[1] and inside & set(times) for times in crossings.values()):
                continue  # not a single arc when the pocket closes
            back = second if cells[early[1]] == cells[late[0]] else reversed(second)
            walks.append(("pocket", frozenset([a, b]), (*first, *back)))

    regions = []
    for kind, apexes, walk in walks:
        boundary = {cells[t] for t in walk}
        interior = enclosed(boundary, size)
        later = [
            k
            for k, point in enumerate(path, 1)
            if visits[point][0] > min(walk) and point in interior
        ]
        regions.append(DefinedRegion(kind, apexes, walk, interior, later[0] if later else None))
    return regions


def enclosed(boundary: set[Cell], size: int) -> frozenset[Cell]:
    """Cells that a flood fill of 4 neighbours from outside the padded grid does not reach."""
    reached, queue = {(0, 0)}, deque([(0, 0)])
    while queue:
        c, r = queue.popleft()
        for cell in ((c + 1, r), (c - 1, r), (c, r + 1), (c, r - 1)):
            padded = 0 <= cell[0] <= size + 1 and 0 <= cell[1] <= size + 1
            if padded and cell not in reached and cell not in boundary:
                reached.add(cell)
                queue.append(cell)
    every = {(c, r) for c in range(1, size + 1) for r in range(1, size + 1)}
    return frozenset(every - reached - boundary)
