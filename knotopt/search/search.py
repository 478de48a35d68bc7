"""Search over the grid diagrams of a knot for few robots, few crossings and small grids.

Run after run of simulated annealing, each from the given grid: so many runs find the same every
time, and later ones add to what is found already.
"""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property

from knotopt.diagram.grid import GridDiagram
from knotopt.search.budget import Budget
from knotopt.search.found import FoundGrid, front
from knotopt.search.run import Run, counted, run


@dataclass(frozen=True)
class GridSearch:
    """What a search has found so far.

    Attributes
    ----------
    diagram : GridDiagram
        Where every run begins.
    seed : int
    runs : tuple of Run
        Numbered from 0.
    """

    diagram: GridDiagram
    seed: int = 0
    runs: tuple[Run, ...] = ()

    @property
    def looked(self) -> int:
        """How many grids were looked at."""
        return sum(each.looked for each in self.runs)

    @property
    def found(self) -> tuple[FoundGrid, ...]:
        """All grids that were kept, the given one first."""
        return (counted(self.diagram), *(found for each in self.runs for found in each.found))

    @cached_property
    def front(self) -> tuple[FoundGrid, ...]:
        """The best grid for each number of robots for which no fewer do with as little."""
        return front(self.found)


def search_grids(
    search: GridDiagram | GridSearch,
    budget: Budget,
    *,
    seed: int = 0,
    compile: bool | None = None,
    progress: Callable[[GridSearch], None] | None = None,
) -> GridSearch:
    """Search the grid diagrams of a knot, or go on with a search.

    Ctrl-C ends it with what is known.

    Parameters
    ----------
    search : GridDiagram or GridSearch
        A grid of the knot, or what was found already, which counts for the budget of grids.
    budget : Budget
        At least one run is made if none was.
    seed : int
        Of a new search.
    compile : bool, optional
        As for `run`.
    progress : callable, optional
        Told after each run what is known.

    Examples
    --------
    >>> from knotopt.diagram.families import torus_knot
    >>> found = search_grids(torus_knot(3, 4), Budget(grids=1000))
    >>> [grid.counts for grid in found.front]
    [(3, 8, 9), (4, 8, 7)]
    """
    known = GridSearch(search, seed) if isinstance(search, GridDiagram) else search
    start = time.monotonic()
    while not (known.runs and budget.is_spent(known.looked, time.monotonic() - start)):
        try:
            made = run(known.diagram, len(known.runs), known.seed, compile=compile)
        except KeyboardInterrupt:
            break
        known = replace(known, runs=(*known.runs, made))
        if progress is not None:
            progress(known)
    return known
