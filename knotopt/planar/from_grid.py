"""The planar diagram of a grid diagram's closed knot."""

from __future__ import annotations

from itertools import pairwise

from knotopt.diagram.grid import GridDiagram
from knotopt.planar.gauss import from_visits
from knotopt.planar.planar_diagram import PlanarDiagram


def planar_diagram(grid: GridDiagram) -> PlanarDiagram:
    """The closed knot of a grid diagram, columns over rows.

    Edges are numbered from the start of ``grid.traversal``, along it; crossings in the order of
    their first visits.

    Examples
    --------
    >>> from knotopt.diagram.families import torus_knot
    >>> print(planar_diagram(torus_knot(2, 3)))
    PD[X[4,2,5,1], X[2,6,3,5], X[6,4,1,3]]
    """
    crossed = grid.crossing_cells
    met: dict[tuple[int, int], int] = {}
    visits, over, ways = [], [], []
    loop = grid.traversal
    for (column, row), (to_column, to_row) in pairwise((*loop, loop[0])):
        step = 1 if (column, row) < (to_column, to_row) else -1
        ways.append(step)
        rows = range(row + step, to_row, step) if column == to_column else (row,)
        columns = range(column + step, to_column, step) if row == to_row else (column,)
        for cell in ((c, r) for c in columns for r in rows):
            if crossed[cell[0] - 1, cell[1] - 1]:
                visits.append(met.setdefault(cell, len(met)))
                over.append(column == to_column)
    up = {column: way for (column, _), way in zip(loop[::2], ways[::2], strict=True)}
    right = {row: way for (_, row), way in zip(loop[1::2], ways[1::2], strict=True)}
    # Up over leftwards is positive: the strand above passes from left to right of that below.
    return from_visits(visits, over, [-up[column] * right[row] for column, row in met])
