"""The forms in which a knot may be given, in the order in which they are tried.

A form's reader takes the content and what is asked, and answers with a `Reading`, with None where
the content is of another form, or with an error that says where it is wrong as one of this form.
The first answer counts: a matrix with a wrong entry is not read as anything else.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from knotopt.reading import arc, braid, curve, dt, gauss, marks, matrix, names, pd, xo
from knotopt.reading.content import Content
from knotopt.reading.record import Asked, Reading


@dataclass(frozen=True)
class Form:
    """One form.

    Attributes
    ----------
    name : str
        As the option --as has it: "pd".
    title : str
        In words: "PD code".
    read : callable
        The form's reader.
    keys : tuple of str
        Keys of a JSON object that hold a knot in this form; in lower case.
    only_named : bool
        Whether it is read only if its name or key says so.
    has_lines : bool
        Whether it has columns and rows, of which one may be said to pass over.
    """

    name: str
    title: str
    read: Callable[[Content, Asked], Reading | None]
    keys: tuple[str, ...] = ()
    only_named: bool = False
    has_lines: bool = False


FORMS: tuple[Form, ...] = (
    Form("name", "name", names.read),
    Form("matrix", "matrix", matrix.read, ("matrix",), has_lines=True),
    Form("marks", "marks of a grid", marks.read, ("grid", "marks"), has_lines=True),
    Form(
        "grid_notation",
        "KnotInfo's grid notation",
        marks.read_grid_notation,
        ("grid_notation",),
        only_named=True,
        has_lines=True,
    ),
    Form("pd", "PD code", pd.read, ("pd", "pd_code", "pd_notation")),
    Form("dt", "DT code", dt.read, ("dt", "dt_code", "dt_notation")),
    Form(
        "gauss",
        "Gauss code",
        gauss.read,
        ("gauss", "gauss_code", "gauss_notation", "oriented_gauss_code"),
    ),
    Form("xo", "grid of X and O", xo.read, has_lines=True),
    Form(
        "arc",
        "arc presentation",
        arc.read,
        ("arc_notation", "arc_presentation", "arcs", "arc"),
        has_lines=True,
    ),
    Form("braid", "braid word", braid.read, ("braid", "br", "braid_word", "braid_notation")),
    Form("curve", "curve in space", curve.read, ("points", "curve", "coordinates")),
)
