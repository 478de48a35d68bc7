"""Cuts: the crossing-free segment at which the closed path is opened into a cable.

The cut must carry no crossing, else the cable itself is not knotted. The four outermost segments
never do: L (column 1), R (column N), B (row 1), T (row N). Every other segment has a name too:
col5, row7. "+" follows the closed traversal that starts at the lexicographically smallest turning
point and moves along its column first; "-" is the other direction.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import Literal

from knotopt.diagram.grid import GridDiagram
from knotopt.errors import CutError

OUTER_CUTS = ("L+", "L-", "R+", "R-", "B+", "B-", "T+", "T-")
"""Names of the cuts at the outermost segments, in the order that breaks ties."""


@dataclass(frozen=True)
class Cut:
    """A segment of a grid diagram, and the direction in which the cable is walked.

    Parameters
    ----------
    axis : "column" or "row"
        Whether the segment removed is the one in a column or the one in a row.
    index : int
        That column or row, 1-based.
    direction : "+" or "-"
    size : int
        Grid size N, which decides whether the segment is an outermost one.

    Examples
    --------
    >>> Cut.parse("T-", size=5)
    Cut(axis='row', index=5, direction='-', size=5)
    >>> str(Cut.parse("row5-", size=5)), str(Cut.parse("col3+", size=5))
    ('T-', 'col3+')
    """

    axis: Literal["column", "row"]
    index: int
    direction: Literal["+", "-"]
    size: int

    def __post_init__(self) -> None:
        if self.axis not in ("column", "row") or self.direction not in ("+", "-"):
            raise CutError(
                f"a cut is at a column or row, in direction + or -, "
                f"not at {self.axis!r} in direction {self.direction!r}"
            )
        if not 1 <= self.index <= self.size:
            raise CutError(f"cut at {self.axis} {self.index}: outside the grid of size {self.size}")

    @classmethod
    def parse(cls, name: str, size: int) -> Cut:
        """Cut by its name: L+ ... T-, or col3+, row5-.

        Raises
        ------
        CutError
            The name is of neither form, or the column or row is outside the grid.
        """
        match = re.fullmatch(
            r"\s*(?:([LRBT])|(col|row)\s*([0-9]{1,9}))([+-])\s*", name, re.IGNORECASE
        )
        if match is None:
            raise CutError(
                f"no cut is named {name!r}: expected one of {', '.join(OUTER_CUTS)}, "
                "or a column or row such as col3+ or row5-"
            )
        letter, line, number, sign = match.groups()
        place = (letter or line).upper()
        index = int(number) if number else 1 if place in "LB" else size
        axis: Literal["column", "row"] = "column" if place in ("L", "R", "COL") else "row"
        return cls(axis, index, "+" if sign == "+" else "-", size)

    @property
    def is_outer(self) -> bool:
        """Whether the segment is one of the four outermost ones."""
        return self.index in (1, self.size)

    def __str__(self) -> str:
        if self.is_outer:
            letters = "LR" if self.axis == "column" else "BT"
            return letters[self.index != 1] + self.direction
        return f"{'col' if self.axis == 'column' else 'row'}{self.index}{self.direction}"


def outer_cuts(diagram: GridDiagram) -> tuple[Cut, ...]:
    """The eight cuts L+ ... T- at the outermost segments, in the order that breaks ties."""
    return tuple(Cut.parse(name, diagram.size) for name in OUTER_CUTS)


def crossing_free_cuts(diagram: GridDiagram) -> tuple[Cut, ...]:
    """Every cut at a segment without crossings: the outer ones first, then columns, then rows.

    Examples
    --------
    >>> from knotopt.diagram.families import torus_knot
    >>> [str(cut) for cut in crossing_free_cuts(torus_knot(2, 3))]
    ['L+', 'L-', 'R+', 'R-', 'B+', 'B-', 'T+', 'T-']
    """
    crossed = diagram.crossing_cells
    size = diagram.size
    inner = [
        Cut.parse(f"{line}{index}{direction}", size)
        for line, along in (("col", 0), ("row", 1))
        for index in range(2, size)
        if not crossed.take(index - 1, axis=along).any()
        for direction in "+-"
    ]
    return (*outer_cuts(diagram), *inner)
