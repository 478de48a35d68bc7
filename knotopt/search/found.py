"""A grid found, and what is the best of those found."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

from knotopt.diagram.grid import GridDiagram


@dataclass(frozen=True)
class FoundGrid:
    """A grid diagram with what it is searched for.

    Attributes
    ----------
    robots : int
        The fewest under `loops`, over all crossing-free cuts.
    crossings : int
    diagram : GridDiagram
    """

    robots: int
    crossings: int
    diagram: GridDiagram

    @property
    def size(self) -> int:
        """Grid size N."""
        return self.diagram.size

    @property
    def counts(self) -> tuple[int, int, int]:
        """Robots, crossings, grid size: what is to be small, in this order."""
        return self.robots, self.crossings, self.size


def best_by_robots(found: Iterable[FoundGrid]) -> dict[int, FoundGrid]:
    """For each number of robots the first with the fewest crossings, then the smallest grid."""
    best: dict[int, FoundGrid] = {}
    for each in found:
        if each.robots not in best or each.counts < best[each.robots].counts:
            best[each.robots] = each
    return dict(sorted(best.items()))


def front(found: Iterable[FoundGrid]) -> tuple[FoundGrid, ...]:
    """The best of each number of robots for which no fewer robots do with as little.

    That is: no grid for fewer robots has no more crossings and is no larger.
    """
    kept: list[FoundGrid] = []
    for each in best_by_robots(found).values():
        if not any(o.crossings <= each.crossings and o.size <= each.size for o in kept):
            kept.append(each)
    return tuple(kept)
