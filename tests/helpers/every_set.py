"""The fewest robots by trying every set of supports, whatever any program says.

A region is lost or kept by the robots on its boundary and the ones next to it before and after
each stretch of that: what the checker said of a region in one set holds in all sets that agree
there, so that few sets need to be examined.
"""

from __future__ import annotations

from collections.abc import Iterator
from itertools import combinations, groupby

from knotopt.cable.cable import Cable
from knotopt.supports.requirements import Requirements
from knotopt.verify.regions import define_regions, lay
from knotopt.verify.registry import DEFINITIONS

Key = tuple[int, ...]


def fewest_by_trying_all(cable: Cable, asked: Requirements) -> int:
    """Robots of the smallest set that is open by the definition, and on every loop if asked."""
    kept = _Regions(cable, asked)
    loops = _loops(cable) if asked.with_loops or asked.formulation == "loops" else []
    count = len(cable.path)
    for size in range(count - 1):
        for supports in combinations(range(2, count), size):
            robots = sum(1 << k for k in supports)
            if all(robots & loop for loop in loops) and kept.all_of(supports):
                return size + 2
    raise AssertionError("not even all turning points are enough")


def _loops(cable: Cable) -> list[int]:
    """Turning points between the two visits of each crossing, as bits."""
    cells = lay(cable.path)
    turns = {cell: number for number, cell in enumerate(cable.path, 1)}
    return [
        sum(1 << turns[c] for c in cells[first:second] if c in turns)
        for first, cell in enumerate(cells)
        for second in range(first + 1, len(cells))
        if cells[second] == cell
    ]


class _Regions:
    """What is known of a cable's regions."""

    def __init__(self, cable: Cable, asked: Requirements) -> None:
        self.cable, self.asked = cable, asked
        self.check = DEFINITIONS[asked.formulation].check
        cells = lay(cable.path)
        times = [cells.index(point) for point in cable.path]
        regions = define_regions(cable.path, cable.diagram.size)
        self.stretches = [
            [_bits(times, run[0], run[-1]) for run in _runs(region.walk)] for region in regions
        ]
        self.known: list[dict[Key, bool]] = [{} for _ in regions]

    def all_of(self, supports: tuple[int, ...]) -> bool:
        """Whether the set keeps them all."""
        count = len(self.cable.path)
        robots = sum(1 << k for k in (1, *supports, count))
        keys = [tuple(_near(robots, stretches)) for stretches in self.stretches]
        said = [known.get(key) for known, key in zip(self.known, keys, strict=True)]
        if None in said and False not in said:
            size, openness = self.cable.diagram.size, self.asked.openness
            report = self.check(self.cable.path, size, supports, openness, self.asked.threading)
            for number, (known, key) in enumerate(zip(self.known, keys, strict=True)):
                known[key] = number not in report.closed_regions
            return report.is_open
        return False not in said


def _near(robots: int, stretches: list[tuple[int, int, int]]) -> Iterator[int]:
    """The robots before, on and after each stretch."""
    for before, on, after in stretches:
        late = robots & after
        yield (robots & before).bit_length()
        yield robots & on
        yield late & -late


def _bits(times: list[int], low: int, high: int) -> tuple[int, int, int]:
    """Turning points before, on and after a stretch of time."""
    before = sum(1 << k for k, time in enumerate(times, 1) if time < low)
    after = sum(1 << k for k, time in enumerate(times, 1) if time > high)
    on = sum(1 << k for k, time in enumerate(times, 1) if low <= time <= high)
    return before, on, after


def _runs(walk: tuple[int, ...]) -> Iterator[list[int]]:
    """The pieces of a boundary that follow the path, in rising order."""
    for _, run in groupby(enumerate(sorted(walk)), lambda each: each[1] - each[0]):
        yield [time for _, time in run]
