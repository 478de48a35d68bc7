"""A knot written in the forms that other programs, and this package's reader, take.

All of them are of the closed knot in its direction "+", and tell it from its mirror image: the DT
code by SnapPy's flips.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping
from dataclasses import dataclass

from knotopt.diagram.grid import GridDiagram
from knotopt.diagram.lifted import lifted
from knotopt.errors import DiagramError
from knotopt.planar.braid_of_grid import braid_of_grid
from knotopt.planar.dt import dt_code, dt_flips
from knotopt.planar.from_grid import planar_diagram
from knotopt.planar.gauss import gauss_letters
from knotopt.planar.planar_diagram import PlanarDiagram


@dataclass(frozen=True)
class WrittenForm:
    """One form.

    Attributes
    ----------
    words : str
        What it is, and who passes over where that is not plain.
    write : callable
        The diagram's text, whose last line ends.
    """

    words: str
    write: Callable[[GridDiagram], str]


def write_knot(diagram: GridDiagram, form: str) -> str:
    """The diagram in a form of `WRITTEN_FORMS`.

    Raises
    ------
    DiagramError
        There is no such form.

    Examples
    --------
    >>> from knotopt.diagram.families import torus_knot
    >>> for form in ("pd", "gauss", "braid", "dt"):
    ...     print(write_knot(torus_knot(2, 3), form), end="")
    [[4, 2, 5, 1], [2, 6, 3, 5], [6, 4, 1, 3]]
    O1+U2+O3+U1+O2+U3+
    BR[2, {1, 1, 1}]
    DT: [(4, 6, 2)], [0, 0, 1]
    """
    if form not in WRITTEN_FORMS:
        raise DiagramError(f"no form is named {form!r}: knots are written as {LISTED_FORMS}")
    return WRITTEN_FORMS[form].write(diagram)


def _planar(diagram: GridDiagram) -> PlanarDiagram:
    """The planar diagram; a circle without crossings, which has no code, gets one loop."""
    planar = planar_diagram(diagram)
    return planar if planar.crossings else PlanarDiagram(((0, 0, 1, 1),))


def _pd(diagram: GridDiagram) -> str:
    return f"{[list(crossing) for crossing in _planar(diagram).pd_code]}\n"


def _dt(diagram: GridDiagram) -> str:
    planar = _planar(diagram)
    return f"DT: {[dt_code(planar)]}, {[*dt_flips(planar)]}\n"


def _gauss(diagram: GridDiagram) -> str:
    return gauss_letters(_planar(diagram)) + "\n"


def _braid(diagram: GridDiagram) -> str:
    word, strands = braid_of_grid(diagram)
    return f"BR[{strands}, {{{', '.join(map(str, word))}}}]\n"


def _grid(diagram: GridDiagram) -> str:
    return f"{[list(mark) for mark in diagram.marks]}\n"


def _arc(diagram: GridDiagram) -> str:
    columns: list[list[int]] = [[] for _ in range(diagram.size)]
    for column, row in diagram.marks:
        columns[row - 1].append(column)
    pairs = ", ".join(f"{{{low}, {high}}}" for low, high in columns)
    return f"ArcPresentation[{pairs}]\n"


def _xo(diagram: GridDiagram) -> str:
    # Rows of the marks by column, counted from 0, as Gridlink has them.
    rows = {
        "X": [row - 1 for row in diagram.minus],
        "O": [row - 1 for row in diagram.plus],
    }
    return json.dumps(rows) + "\n"


def _json(diagram: GridDiagram) -> str:
    return json.dumps({"grid": [list(mark) for mark in diagram.marks]}) + "\n"


def _csv(diagram: GridDiagram) -> str:
    return "".join(",".join(map(str, line)) + "\n" for line in diagram.matrix.tolist())


def _xyz(diagram: GridDiagram) -> str:
    corners = lifted(diagram).tolist()
    corners.append(corners[0])  # said to be closed, however far the last corner is from the first
    return "".join(f"{x:g} {y:g} {z:g}\n" for x, y, z in corners)


def _obj(diagram: GridDiagram) -> str:
    corners = lifted(diagram).tolist()
    lines = [f"v {x:g} {y:g} {z:g}\n" for x, y, z in corners]
    around = " ".join(map(str, [*range(1, len(corners) + 1), 1]))
    return "".join([*lines, f"l {around}\n"])


WRITTEN_FORMS: Mapping[str, WrittenForm] = {
    "pd": WrittenForm("PD code", _pd),
    "dt": WrittenForm("DT code with SnapPy's flips", _dt),
    "gauss": WrittenForm("Gauss code with signs", _gauss),
    "braid": WrittenForm("braid word", _braid),
    "grid": WrittenForm("marks [column, row], columns over rows", _grid),
    "arc": WrittenForm("arc presentation", _arc),
    "xo": WrittenForm("rows of X and O by column, from 0", _xo),
    "json": WrittenForm("an object with the marks", _json),
    "csv": WrittenForm("the matrix, columns over rows", _csv),
    "xyz": WrittenForm("points of the curve in space", _xyz),
    "obj": WrittenForm("the curve as Wavefront OBJ", _obj),
}
LISTED_FORMS = ", ".join(WRITTEN_FORMS)
