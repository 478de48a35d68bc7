"""Who passes over: a grid drawn with rows over columns as the grid with columns over rows.

Exchanging over and under makes the mirror image, and so does reversing the order of the rows; both
together leave the knot as it is. KnotInfo's grids come out as the catalogue has them.
"""

from __future__ import annotations

from knotopt.diagram.grid import GridDiagram
from knotopt.reading.record import Asked

COLUMNS, ROWS = "columns", "rows"


def with_over(
    diagram: GridDiagram, asked: Asked, own: str, whose: str = ""
) -> tuple[GridDiagram, str]:
    """A grid read as the form has it, or as asked, and the note that says which.

    Parameters
    ----------
    diagram : GridDiagram
        With the marks as they were read, turned only if rows pass over.
    asked : Asked
    own : str
        Who passes over in that form, where it is not asked otherwise.
    whose : str
        Whose way that is: "KnotInfo's way".
    """
    over = asked.over or own
    if over == ROWS:
        diagram = diagram.mirrored
    note = f"{over} pass over {COLUMNS if over == ROWS else ROWS}"
    if asked.over is None and whose:
        note += f" ({whose})"
    return diagram, note
