"""What KNOT means on the command line: a knot's name, a row of Table I, T(p,q), or a file."""

from __future__ import annotations

import difflib
import re
from dataclasses import dataclass
from pathlib import Path

from knotopt.catalogue.knotinfo import SHIPPED_CROSSINGS, is_installed, knotinfo_knots
from knotopt.catalogue.knots import PrimeKnot, shipped_knots
from knotopt.catalogue.table1_grids import table1_grids
from knotopt.diagram.families import torus_knot
from knotopt.diagram.grid import GridDiagram
from knotopt.diagram.reading import read_grid
from knotopt.errors import UnknownKnotError, require_extra


@dataclass(frozen=True)
class NamedDiagram:
    """A grid diagram and what it was asked for by.

    Attributes
    ----------
    name : str
        The knot's name, `T(p,q)`, or the file's name.
    diagram : GridDiagram
    source : str
        Where the diagram comes from, in words.
    prime_knot : PrimeKnot or None
        The catalogue's entry, if it was asked for by name.
    """

    name: str
    diagram: GridDiagram
    source: str
    prime_knot: PrimeKnot | None = None


def find_knot(text: str) -> NamedDiagram:
    """The grid diagram that a KNOT argument stands for.

    Parameters
    ----------
    text : str
        A name (8_19; with the `knotinfo` extra also 11a_1, 12n_242, 13a_4878), a row of Table I
        (3, 4, 5, "7 Var1", "7 Var2", 9), T(p,q), or a `.json` or `.csv` file.

    Raises
    ------
    UnknownKnotError
        No such knot; the message gives the nearest names.
    MissingExtraError
        A knot of 11 to 13 crossings without the `knotinfo` extra.
    KnotoptError
        A file or torus knot that is not a grid diagram of one knot.

    Examples
    --------
    >>> find_knot("8_19").diagram.size, find_knot("T(3,4)").diagram.size
    (7, 7)
    >>> find_knot("7 var1").name
    '7_2'
    >>> find_knot("8_22")  # doctest: +ELLIPSIS
    Traceback (most recent call last):
    ...
    knotopt.errors.UnknownKnotError: no knot is named '8_22'; nearest: 8_2, ...
    """
    if Path(text).suffix.lower() in (".json", ".csv"):
        return NamedDiagram(Path(text).name, read_grid(text), f"file {text}")
    torus = re.fullmatch(
        r"\s*T\(\s*(-?[0-9]{1,18})\s*,\s*(-?[0-9]{1,18})\s*\)\s*", text, re.IGNORECASE
    )
    if torus:
        p, q = (int(number) for number in torus.groups())
        return NamedDiagram(f"T({p},{q})", torus_knot(p, q), "torus knot")
    squeezed = re.sub(r"\s", "", text).lower()
    for grid in table1_grids():
        if squeezed == grid.row.replace(" ", "").lower():
            return NamedDiagram(grid.knot, grid.diagram, f"Table I, row {grid.row}")
    return _by_name(squeezed)


def _by_name(text: str) -> NamedDiagram:
    name = re.sub(r"k?(\d+)([an])_?(\d+)", r"\1\2_\3", text)  # SnapPy's K11a1 is KnotInfo's 11a_1
    crossings = re.match(r"(\d{1,3})[an]?_", name)
    knots = shipped_knots()
    if name not in knots and is_installed():
        knots = knotinfo_knots()
    if name in knots:
        return NamedDiagram(name, knots[name].diagram, "KnotInfo", knots[name])
    if crossings and SHIPPED_CROSSINGS < int(crossings[1]) <= 13:
        require_extra("database_knotinfo", "knotinfo", f"knot {name!r}")
    rows = dict.fromkeys(grid.row for grid in table1_grids())
    near = [row for row in rows if text and row.lower().startswith(text)]
    near += difflib.get_close_matches(name, [*knots, *rows], n=3, cutoff=0.3)
    hint = f"; nearest: {', '.join(near)}" if near else "; `knotopt knots` lists the names"
    raise UnknownKnotError(f"no knot is named {text!r}{hint}")
