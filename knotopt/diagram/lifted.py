"""The closed curve in space whose view from above is a grid diagram."""

from __future__ import annotations

import numpy as np

from knotopt.arrays import FloatArray
from knotopt.diagram.grid import GridDiagram

COLUMNS_AT = 1.0
"""Height of the columns above the rows [grid steps]."""


def lifted(diagram: GridDiagram) -> FloatArray:
    """The corners of the knot in space, shape (4N, 3): [column, row, height] in grid steps.

    Rows lie at height 0 and columns above them; at each turning point the knot runs straight up or
    down. It is closed (the last corner is joined to the first) and runs in direction "+".

    Examples
    --------
    >>> lifted(GridDiagram.from_marks([[1, 1], [1, 2], [2, 1], [2, 2]])).tolist()[:4]
    [[1.0, 1.0, 0.0], [1.0, 1.0, 1.0], [1.0, 2.0, 1.0], [1.0, 2.0, 0.0]]
    """
    plan = np.repeat(np.array(diagram.traversal, dtype=np.float64), 2, axis=0)
    heights = np.tile([0.0, COLUMNS_AT, COLUMNS_AT, 0.0], diagram.size)
    return np.column_stack((plan, heights))
