"""Grids for the rows of the paper's Table I, which the paper shows as pictures only."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache

from knotopt.catalogue.knots import shipped_json
from knotopt.diagram.grid import GridDiagram, Mark


@dataclass(frozen=True)
class Table1Grid:
    """A grid for a row of the paper's Table I.

    The paper shows its grids as pictures only, so which knots its rows show is not known; the knot
    is named up to mirror image. `preferred` marks the one grid per row that the table uses.
    """

    row: str
    knot: str
    preferred: bool
    robots_after_paper: int
    marks: tuple[Mark, ...]

    @property
    def diagram(self) -> GridDiagram:
        """The row's grid diagram."""
        return GridDiagram.from_marks(self.marks)


@cache
def table1_grids() -> tuple[Table1Grid, ...]:
    """The grids for the six rows of Table I, in the table's order, preferred ones first."""
    return tuple(
        Table1Grid(marks=tuple((column, row) for column, row in entry.pop("grid")), **entry)
        for entry in shipped_json("table1_grids.json")
    )
