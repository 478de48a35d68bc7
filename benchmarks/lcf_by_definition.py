"""The Loop Consistency Filter spelled out from its definition, slowly and without arrays.

Shares nothing with `knotopt.supports`; its regions are those of `knotopt.verify`.
"""

from __future__ import annotations

from knotopt.verify.regions import Cell, define_regions, lay


def slow_lcf(path: list[Cell], size: int, layered: bool) -> tuple[int, ...]:
    cells = lay(path)
    regions = define_regions(path, size)
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
