"""Cables of a grid diagram from its marks: closed path, crossing-free cuts, open path."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Sequence

from knotopt.verify.regions import Cell

OUTER = {"L": ("col", 1), "R": ("col", 0), "B": ("row", 1), "T": ("row", 0)}  # 0: the last one


def closed_path(marks: Sequence[Cell]) -> list[Cell]:
    """Turning points of the closed path, from the smallest one along its column.

    Raises
    ------
    ValueError
        Not two marks in every column and row, or more than one closed path.

    Examples
    --------
    >>> closed_path([(1, 1), (1, 2), (2, 2), (2, 1)])
    [(1, 1), (1, 2), (2, 2), (2, 1)]
    """
    size = len(marks) // 2
    lines = set(range(1, size + 1))
    for axis, name in ((0, "column"), (1, "row")):
        counts = Counter(mark[axis] for mark in marks)
        if set(counts) != lines or set(counts.values()) != {2} or len(set(marks)) != 2 * size:
            raise ValueError(f"not two marks in every {name} from 1 to {size}")
    here, axis = min(marks), 0
    loop = []
    for _ in marks:
        loop.append(here)
        (here,) = (mark for mark in marks if mark[axis] == here[axis] and mark != here)
        axis = 1 - axis
    if len(set(loop)) != len(marks) or here != loop[0]:
        raise ValueError("more than one closed path")
    return loop


def crossing_free_cuts(marks: Sequence[Cell]) -> set[str]:
    """Names of all cuts at segments that no other segment crosses.

    Examples
    --------
    >>> sorted(crossing_free_cuts([(1, 1), (1, 2), (2, 2), (2, 1)]))
    ['B+', 'B-', 'L+', 'L-', 'R+', 'R-', 'T+', 'T-']
    """
    size = len(marks) // 2
    names = {(axis, line or size): letter for letter, (axis, line) in OUTER.items()}
    return {
        names.get((axis, line), f"{axis}{line}") + sign
        for axis in ("col", "row")
        for line in range(1, size + 1)
        if not _crossings(marks, axis, line)
        for sign in "+-"
    }


def cable_path(marks: Sequence[Cell], cut: str) -> list[Cell]:
    """Turning points p_1 ... p_n of the cable cut at a crossing-free segment.

    Raises
    ------
    ValueError
        There is no such cut, or its segment carries crossings.

    Examples
    --------
    >>> cable_path([(1, 1), (1, 2), (2, 2), (2, 1)], "T-")
    [(1, 2), (1, 1), (2, 1), (2, 2)]
    """
    size = len(marks) // 2
    match = re.fullmatch(r"(?:([LRBT])|(col|row)(\d+))([+-])", cut)
    if match is None:
        raise ValueError(f"no cut is named {cut!r}")
    axis, line = OUTER[match[1]] if match[1] else (match[2], int(match[3]))
    line = line or size
    if _crossings(marks, axis, line):
        raise ValueError(f"cut {cut} carries crossings")
    loop = closed_path(marks)
    which = 0 if axis == "col" else 1
    for k in range(len(loop)):
        opened = loop[k:] + loop[:k]
        if opened[0][which] == opened[-1][which] == line:
            return opened if match[4] == "+" else opened[::-1]
    raise ValueError(f"no cut is named {cut!r}")


def _crossings(marks: Sequence[Cell], axis: str, line: int) -> int:
    """How many segments cross the one in a column or row."""
    which = 0 if axis == "col" else 1
    low, high = sorted(mark[1 - which] for mark in marks if mark[which] == line)
    count = 0
    for other in range(low + 1, high):
        start, end = sorted(mark[which] for mark in marks if mark[1 - which] == other)
        count += start < line < end
    return count
