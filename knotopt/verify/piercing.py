"""Loops of a cable, and whether a support lies on each, from the path's turning points alone.

A crossing is visited at times t1 < t2. Its loop is what the path runs through in between, and is
*pierced* if a turning point v with t1 < t(v) < t2 carries a support: else both visits lie on one
straight span, which cannot cross itself, and the crossing does not exist once the cable is laid.
"""

from __future__ import annotations

from collections.abc import Collection, Sequence

from knotopt.verify.regions import Cell, lay


def loops_of(path: Sequence[Cell]) -> dict[Cell, frozenset[int]]:
    """For each crossing, in the order of first visits: the turning points (1-based) on its loop.

    Examples
    --------
    >>> loops_of([(1, 2), (3, 2), (3, 1), (2, 1), (2, 3)])
    {(2, 2): frozenset({2, 3, 4})}
    """
    visits: dict[Cell, list[int]] = {}
    for time, cell in enumerate(lay(path)):
        visits.setdefault(cell, []).append(time)
    turns = [(number, visits[cell][0]) for number, cell in enumerate(path, 1)]
    return {
        cell: frozenset(number for number, time in turns if times[0] < time < times[1])
        for cell, times in visits.items()
        if len(times) == 2
    }


def bare_loops(path: Sequence[Cell], supports: Collection[int]) -> list[tuple[int, Cell]]:
    """The loops without a support on them: number of the crossing (0-based) and its place.

    Examples
    --------
    >>> bare_loops([(1, 2), (3, 2), (3, 1), (2, 1), (2, 3)], [])
    [(0, (2, 2))]
    """
    held = frozenset(supports)
    loops = enumerate(loops_of(path).items())
    return [(number, cell) for number, (cell, on) in loops if held.isdisjoint(on)]


def loop_clauses(path: Sequence[Cell]) -> set[frozenset[int]]:
    """What every set that pierces all loops satisfies: literal +k says p_k carries a robot."""
    return set(loops_of(path).values())
