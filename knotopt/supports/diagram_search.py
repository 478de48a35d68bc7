"""The smallest set over grid diagrams of a knot.

First a search for grids that few robots lay, with few crossings (`knotopt.search`). From the best
of them a walk goes on to neighbouring grids that are solved for what is asked; a step is taken if
it needs no more robots. The number found is an upper bound for the knot: others may do better.
"""

from __future__ import annotations

import random
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from importlib.util import find_spec
from math import inf

from formulations.backends import DEFAULT
from formulations.solution import Limits
from knotopt.cable.cable import Cable
from knotopt.cable.cut import Cut, crossing_free_cuts
from knotopt.diagram.grid import GridDiagram
from knotopt.search.budget import Budget
from knotopt.search.neighbours import neighbour
from knotopt.search.run import ROOM, counted
from knotopt.search.search import GridSearch, search_grids
from knotopt.supports.minimal import minimal_supports
from knotopt.supports.requirements import Requirements
from knotopt.supports.search import CutSearch, best_supports

LOOKED_PER_SOLVED = 20_000
"""Of a budget in grids, so many are looked at for one that is solved."""

SHARE_LOOKED = 0.25
"""Of a budget in seconds: for looking at grids; the rest is for solving some."""

STARTS = 12
"""Grids found that the walk is first tried from, the best by what they were searched for."""

PATIENCE = 60
"""Grids solved without less cost before the walk goes on from another start."""

LIKELY_CUTS = 2
"""Cuts of a grid that are solved for `span`; all are of the diagram found in the end."""

MORE_CROSSINGS = 2
"""A neighbour with more crossings than so many more is not solved."""


_QUICK_SOLVER = "maxsat" if find_spec("pysat") else None
"""Of small programs the one with least to set up, where it is installed; any gives the same."""


@dataclass(frozen=True)
class Walk:
    """Where the walk over diagrams stands.

    Attributes
    ----------
    here : GridDiagram
    cost : float or None
        Fewest robots for what is asked; with a largest number of robots, minus the largest smallest
        opening. None if no set is known.
    best : GridDiagram
    best_cost : float or None
    solved : int
        Grids solved.
    waited : int
        Grids solved since the cost became less.
    started : int
        Starts tried.
    """

    here: GridDiagram
    cost: float | None
    best: GridDiagram
    best_cost: float | None
    solved: int = 1
    waited: int = 0
    started: int = 0


@dataclass(frozen=True)
class DiagramSearch:
    """The best set found over diagrams of a knot.

    Attributes
    ----------
    best : CutSearch
        On the diagram with the fewest robots that was found.
    grids : GridSearch
        The search for grids that few robots lay, with its front.
    walk : Walk
    """

    best: CutSearch
    grids: GridSearch
    walk: Walk


def find_diagram(
    diagram: GridDiagram,
    requirements: Requirements | None = None,
    budget: Budget | None = None,
    seed: int = 0,
    *,
    known: tuple[GridSearch, Walk | None] | None = None,
    starts: Sequence[GridDiagram] = (),
    solver: str = DEFAULT,
    limits: Limits | None = None,
    compile: bool | None = None,
    progress: Callable[[Walk], None] | None = None,
) -> DiagramSearch:
    """The best set found over grid diagrams of the knot.

    The same budget in grids and seed give the same result. Ctrl-C ends the search with what is
    known.

    Parameters
    ----------
    diagram : GridDiagram
    requirements : Requirements, optional
    budget : Budget, optional
        By default two seconds. Solving the diagram found, with proof, comes on top.
    seed : int
    known : (GridSearch, Walk or None), optional
        What an earlier search found, to go on from.
    starts : sequence of GridDiagram
        Grids of the same knot, such as stored ones, that are solved whatever the budget, on all
        cuts, before those that the search finds.
    solver, limits
        As for `best_supports`, for the diagram found.
    compile : bool, optional
        As for `knotopt.search.run.run`.
    progress : callable, optional
        Told after each grid solved where the walk stands.

    Examples
    --------
    >>> from knotopt.diagram.families import torus_knot
    >>> found = find_diagram(torus_knot(2, 3), Requirements("loops"), Budget(grids=1000))
    >>> found.best.best.robots, found.grids.front[0].counts
    (3, (3, 3, 5))
    """
    asked, budget = requirements or Requirements(), budget or Budget(seconds=2.0)
    start = time.monotonic()
    grids, walk = known or (GridSearch(diagram, seed), None)
    looking, solving = budget, budget
    if budget.seconds is not None:
        looking = replace(budget, seconds=SHARE_LOOKED * budget.seconds)
    grids = search_grids(grids, looking, compile=compile)
    if asked == Requirements("loops"):  # which they were searched for
        first = grids.front[0]
        walk = Walk(first.diagram, first.robots, first.diagram, first.robots)
    else:
        if budget.seconds is not None:
            left = budget.seconds - (time.monotonic() - start)
            solving = replace(budget, seconds=max(left, 0.5 * budget.seconds))
        walk = _Walker(grids, starts, asked, solver).walk(walk, solving, progress)
    best = best_supports(walk.best, asked, solver=solver, limits=limits)
    return DiagramSearch(best, grids, walk)


class _Walker:
    """Goes from grid to grid, each solved for what is asked."""

    def __init__(
        self,
        grids: GridSearch,
        starts: Sequence[GridDiagram],
        asked: Requirements,
        solver: str,
    ) -> None:
        self._asked, self._solver, self._seed = asked, solver, grids.seed
        self._given = grids.diagram
        found = sorted(grids.found, key=lambda each: each.counts)
        self._at_hand = tuple(starts)
        self._starts = [*starts, *(each.diagram for each in found)]
        self._known: dict[GridDiagram, tuple[float, float | None]] = {}

    def walk(
        self, walk: Walk | None, budget: Budget, progress: Callable[[Walk], None] | None
    ) -> Walk:
        """Go on until the budget is spent; from the given grid, if it is not yet begun."""
        start = time.monotonic()
        try:
            if walk is None:
                cost = self._cost(self._given, None)
                walk = Walk(self._given, cost, self._given, cost)
            while walk.started < len(self._at_hand) or not budget.is_spent(
                walk.solved * LOOKED_PER_SOLVED, time.monotonic() - start
            ):
                walk = self._step(walk)
                if progress is not None:
                    progress(walk)
        except KeyboardInterrupt:
            if walk is None:
                raise
        return walk

    def _step(self, walk: Walk) -> Walk:
        """Solve the next start or a neighbour, and go there if it needs no more robots."""
        source = random.Random(f"{self._seed} {walk.solved}")
        if walk.started < min(len(self._at_hand) + STARTS, len(self._starts)):
            return self._tried(self._starts[walk.started], walk, is_start=True)
        if walk.waited >= PATIENCE:
            again = replace(walk, here=source.choice(self._starts), cost=None, waited=0)
            return self._tried(again.here, again)
        crossings = counted(walk.here).crossings + MORE_CROSSINGS
        while True:
            there = neighbour(walk.here, source, self._given.size + ROOM)
            if there != walk.here and counted(there).crossings <= crossings:
                return self._tried(there, walk)

    def _tried(self, there: GridDiagram, walk: Walk, *, is_start: bool = False) -> Walk:
        cost = self._cost(there, walk.cost)
        walk = replace(
            walk, solved=walk.solved + 1, waited=walk.waited + 1, started=walk.started + is_start
        )
        if cost is None:
            return walk
        waited = walk.waited if cost == walk.cost else 0
        walk = replace(walk, here=there, cost=cost, waited=waited)
        is_best = walk.best_cost is None or cost < walk.best_cost
        return replace(walk, best=there, best_cost=cost) if is_best else walk

    def _cost(self, diagram: GridDiagram, at_most: float | None) -> float | None:
        """The diagram's cost, if it is known to be no more than so much."""
        tried, cost = self._known.get(diagram, (-inf, None))
        if cost is None and tried < (inf if at_most is None else at_most):
            cost = self._solved(diagram, at_most)
            self._known[diagram] = (inf if at_most is None else at_most, cost)
        return None if cost is None or (at_most is not None and cost > at_most) else cost

    def _solved(self, diagram: GridDiagram, at_most: float | None) -> float | None:
        asked, limit = self._asked, None
        if at_most is not None and asked.max_robots is None:
            limit = int(at_most) + 1
        cuts = self._likely_cuts(diagram, limit)
        if not cuts:
            return None
        best = best_supports(
            diagram, asked, cuts=cuts, solver=self._solver, canonical=False, better_than=limit
        ).best
        if not best.found:
            return None
        return best.robots if asked.max_robots is None else -(best.smallest_opening or inf)

    def _likely_cuts(self, diagram: GridDiagram, limit: int | None) -> Sequence[Cut]:
        """For `span`: the cuts that need fewest robots for `opening`, which is solved far sooner.

        None that needs as many as the limit there is likely to need fewer for `span`.
        """
        cuts, asked = crossing_free_cuts(diagram), self._asked
        is_other = asked.formulation != "span" or asked.max_robots is not None
        if is_other or diagram in self._at_hand:
            return cuts
        quick = replace(asked, formulation="opening")
        needed = []
        for cut in cuts:
            result = minimal_supports(
                Cable(diagram, cut),
                quick,
                solver=_QUICK_SOLVER or self._solver,
                canonical=False,
                explain=False,
                better_than=limit,
            )
            if result.found:
                needed.append((result.robots, cut))
        needed.sort(key=lambda each: each[0])
        return [cut for _, cut in needed[:LIKELY_CUTS]]
