"""The smallest open set as a shortest path: exact for what speaks of consecutive robots only.

Every clause of `opening` forbids pairs of consecutive robots, and "two robots inside a loop"
forbids triples: a smallest set is a shortest path over pairs of consecutive robots, in polynomial
time. The one exception is "a robot on one of a pocket's two sides", which is left out here.
"""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from knotopt.verify.regions import Cell, DefinedRegion, lay

INFINITY = 10**9


def smallest_path(
    path: list[Cell],
    clauses: Iterable[frozenset[int]],
    regions: Iterable[DefinedRegion],
) -> int:
    """Fewest robots of a path from p_1 to p_n; `clauses` from `closing_clauses`, r-open regions."""
    count = len(path)
    forbidden = np.zeros((count + 1, count + 1), dtype=bool)
    before, after = np.ogrid[: count + 1, : count + 1]
    loops = []
    times = {cell: time for time, cell in enumerate(lay(path))}
    for region in regions:
        if region.kind == "loop":
            low, high = min(region.walk), max(region.walk)
            on = [k for k, cell in enumerate(path, 1) if low < times[cell] < high]
            loops.append((on[0], on[-1]))
            forbidden |= (before < on[0]) & (after > on[-1])
    for clause in clauses:
        positive = sorted(k for k in clause if k > 0)
        negative = sorted(-k for k in clause if k < 0)
        if not positive or positive[-1] - positive[0] + 1 != len(positive):
            continue  # a row of a loop or a pocket
        first, last = positive[0], positive[-1]
        ends = {k for k in negative if k in (first - 1, last + 1)}
        assert len(ends) == len(negative)
        low = before == first - 1 if first - 1 in ends else before < first
        high = after == last + 1 if last + 1 in ends else after > last
        forbidden |= low & high
    cost = np.full((count + 1, count + 1), INFINITY)
    cost[1, 2:] = np.where(forbidden[1, 2:], INFINITY, 2)
    for w in range(2, count):
        alone = np.zeros((count + 1, count + 1), dtype=bool)
        for first, last in loops:
            if first <= w <= last:
                alone |= (before < first) & (after > last)
        reach = np.where(alone, INFINITY, cost[:, w, None] + 1).min(axis=0)
        later = np.arange(count + 1) > w
        cost[w] = np.where(later & ~forbidden[w], reach, INFINITY)
    return int(cost[:, count].min())
