"""The Loop Consistency Filter spelled out from its definition, slowly and without arrays.

Shares nothing with `knotopt.supports`: regions are sought among all pairs of crossings and both
pairings of their visits, cells are sets, and the flood fill is a queue. Times and turning points
are those of the cable's path alone.
"""

from __future__ import annotations

from collections import deque
from dataclasses import dataclass
from itertools import combinations, pairwise

Cell = tuple[int, int]


@dataclass(frozen=True)
class SlowRegion:
    kind: str
    apexes: frozenset[Cell]
    walk: tuple[int, ...]  # times on the boundary, in the order walked from its start
    interior: frozenset[Cell]
    threaded_by: int | None  # 1-based


def lay(path: list[Cell]) -> list[Cell]:
    """Lattice points of the path by time."""
    cells = [path[0]]
    for (c0, r0), (c1, r1) in pairwise(path):
        steps = abs(c1 - c0) + abs(r1 - r0)
        cells += [
            (c0 + (c1 - c0) * step // steps, r0 + (r1 - r0) * step // steps)
            for step in range(1, steps + 1)
        ]
    return cells


def slow_regions(path: list[Cell], size: int) -> list[SlowRegion]:
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
        regions.append(SlowRegion(kind, apexes, walk, interior, later[0] if later else None))
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


def slow_lcf(path: list[Cell], size: int, layered: bool) -> tuple[int, ...]:
    cells = lay(path)
    regions = slow_regions(path, size)
    crossings = {cell for cell in cells if cells.count(cell) == 2}
    chosen: set[Cell] = set()
    for region in regions:
        if region.threaded_by is None:
            continue
        places = {cells[t]: k for k, t in enumerate(region.walk)}
        on = [point for point in path if point in places]  # in the order met on the path
        extremal = {
            max(on, key=lambda p: p[0]),
            min(on, key=lambda p: p[0]),
            max(on, key=lambda p: p[1]),
            min(on, key=lambda p: p[1]),
        }
        ring = sorted(extremal, key=places.__getitem__)
        for point in list(ring):
            if len(ring) <= 2:
                break
            k = ring.index(point)
            stretches = [(ring[k - 1], point), (point, ring[(k + 1) % len(ring)])]
            if not any(
                cell in crossings - region.apexes
                for start, end in stretches
                for cell in stretch(region.walk, cells, places[start], places[end])
            ):
                ring.remove(point)
        chosen |= set(ring)
    if layered:
        inside = {cell for r in regions if r.threaded_by is not None for cell in r.interior}
        chosen -= inside
    return tuple(k for k, point in enumerate(path, 1) if point in chosen and 1 < k < len(path))


def stretch(walk: tuple[int, ...], cells: list[Cell], start: int, end: int) -> list[Cell]:
    """Cells from one place of a closed walk on to another, past its end if need be."""
    places = range(start, end) if start < end else [*range(start, len(walk)), *range(end)]
    return [cells[walk[k]] for k in places]
