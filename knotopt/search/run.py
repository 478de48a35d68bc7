"""One run of simulated annealing from a grid diagram, with random numbers of its own.

What it finds depends on the diagram, its number and the seed alone, compiled or not.
"""

from __future__ import annotations

import math
import random
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache
from typing import Any

from knotopt.diagram.grid import GridDiagram
from knotopt.search.annealing import DRAWN, SIZES, anneal
from knotopt.search.compiled import can_compile, compiled, numbers
from knotopt.search.found import FoundGrid
from knotopt.search.lines import lines_of, trace
from knotopt.search.loops import NONE, fewest_robots, find_crossings

STEPS = 10_000
"""Steps of a run for each line of a given grid of at most `USUAL` lines."""

USUAL = 16
"""Of larger grids, which take longer to look at by the square of their size, fewer are."""

LONG_FROM, LONGER = 40, 10
"""Once so many runs have not found enough, the next ones are so many times as long."""

ROOM = 4
"""How many lines larger than the given grid others may be."""

WEIGHTS = ((30, 10, 3), (10, 10, 3))
"""Of a robot, a crossing and a line in the energy [tenths], for one run after the other."""

HOT, COLD = 4.0, 0.2
"""Temperature at the beginning and the end of a run [crossings]."""

LEVELS, ENERGIES = 64, 400
"""Levels of temperature, and rises of energy beyond which no step is taken [tenths]."""

ROBOTS = 24
"""Grids for fewer robots than so many are kept."""

WIDEST = 62
"""Largest grid whose rows are the bits of a compiled number."""


@dataclass(frozen=True)
class Run:
    """What one run found.

    Attributes
    ----------
    number : int
    looked : int
        Grids looked at.
    found : tuple of FoundGrid
        For each number of robots met the first grid with the fewest crossings, then the smallest.
    """

    number: int
    looked: int
    found: tuple[FoundGrid, ...]


def run(diagram: GridDiagram, number: int, seed: int = 0, *, compile: bool | None = None) -> Run:
    """One run of simulated annealing.

    Parameters
    ----------
    diagram : GridDiagram
        Where it begins.
    number, seed : int
        The run's random numbers are made of them.
    compile : bool, optional
        By default where numba is installed and the grids are no larger than `WIDEST`; what is found
        is the same.

    Examples
    --------
    >>> from knotopt.diagram.families import torus_knot
    >>> [found.counts for found in run(torus_knot(3, 4), 0).found][:2]
    [(3, 8, 9), (4, 8, 7)]
    """
    widest = diagram.size + ROOM
    if compile is None:
        compile = can_compile() and widest <= WIDEST

    def listed(values: list[int]) -> Any:
        return numbers(values, compile=compile)

    def empty(count: int) -> Any:
        return listed([0] * count)

    lines = lines_of(diagram, widest)
    source = random.Random(f"{seed} {number}")
    state = [diagram.size, source.randrange(1, DRAWN), source.randrange(1, DRAWN)]
    plan = [_steps(diagram.size, number), widest, LEVELS, ENERGIES, *WEIGHTS[number % len(WEIGHTS)]]
    best, kept = listed([NONE] * ROBOTS), empty(ROBOTS * 2 * widest)
    walk = compiled(anneal) if compile else anneal
    looked = walk(
        tuple(map(listed, lines)),
        tuple(empty(widest) for _ in lines),
        listed(state),
        listed(plan),
        listed(_chances()),
        (empty(2 * widest), empty(2 * widest)),
        best,
        kept,
    )
    return Run(number, int(looked), tuple(_found(list(best), list(kept))))


def counted(diagram: GridDiagram) -> FoundGrid:
    """A grid with its robots and crossings.

    Examples
    --------
    >>> from knotopt.diagram.families import torus_knot
    >>> counted(torus_knot(3, 4)).counts
    (4, 8, 7)
    """
    size = diagram.size
    lines = lines_of(diagram, size)
    trace(lines, size)
    reach, closing = [0] * 2 * size, [0] * 2 * size
    crossings = find_crossings(lines, size, reach)
    return FoundGrid(fewest_robots(size, reach, closing), crossings, diagram)


def _steps(size: int, number: int) -> int:
    """Steps of a run."""
    steps = STEPS * size * USUAL**2 // max(size, USUAL) ** 2
    return max(1, steps * (LONGER if number >= LONG_FROM else 1))


def _found(best: list[int], kept: list[int]) -> Iterator[FoundGrid]:
    """The grids that a run kept."""
    width = len(kept) // len(best)
    for robots, counts in enumerate(best):
        if counts < NONE:
            crossings, size = divmod(int(counts), SIZES)
            rows = [int(row) + 1 for row in kept[robots * width : robots * width + 2 * size]]
            yield FoundGrid(robots, crossings, GridDiagram(tuple(rows[0::2]), tuple(rows[1::2])))


@cache
def _chances() -> list[int]:
    """By level and rise of energy: below what number drawn a step is taken."""
    temperatures = [10 * HOT * (COLD / HOT) ** (level / LEVELS) for level in range(LEVELS)]
    return [
        int(math.exp(-rise / temperature) * DRAWN)
        for temperature in temperatures
        for rise in range(ENERGIES)
    ]
