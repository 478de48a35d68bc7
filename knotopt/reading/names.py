"""A knot by its name: KnotInfo's, a row of Table I, a torus knot."""

from __future__ import annotations

import difflib
import re

from knotopt.catalogue.knotinfo import SHIPPED_CROSSINGS, is_installed, knotinfo_knots
from knotopt.catalogue.knots import shipped_knots
from knotopt.catalogue.table1_grids import table1_grids
from knotopt.diagram.families import torus_knot
from knotopt.errors import UnknownKnotError, require_extra
from knotopt.reading.content import Content
from knotopt.reading.record import Asked, Reading

_LONGEST = 200


def read(content: Content, _asked: Asked) -> Reading | None:
    """The knot of that name.

    Raises
    ------
    GridError
        A torus link of several components.
    MissingExtraError
        A knot of 11 to 13 crossings without the `knotinfo` extra.
    """
    text = content.text
    if len(text) > _LONGEST or "\n" in text.strip():
        return None
    torus = re.fullmatch(
        r"\s*T\(\s*(-?[0-9]{1,18})\s*,\s*(-?[0-9]{1,18})\s*\)\s*", text, re.IGNORECASE
    )
    if torus:
        p, q = (int(number) for number in torus.groups())
        return Reading(torus_knot(p, q), name=f"T({p},{q})", source="torus knot")
    squeezed = re.sub(r"\s", "", text).lower()
    for grid in table1_grids():
        if squeezed == grid.row.replace(" ", "").lower():
            return Reading(grid.diagram, name=grid.knot, source=f"Table I, row {grid.row}")
    name = _knotinfo_name(squeezed)
    crossings = re.match(r"(\d{1,3})[an]?_", name)
    knots = shipped_knots()
    if name not in knots and crossings and is_installed():
        knots = knotinfo_knots()
    if name in knots:
        return Reading(knots[name].diagram, name=name, source="KnotInfo", prime_knot=knots[name])
    if crossings and SHIPPED_CROSSINGS < int(crossings[1]) <= 13:
        require_extra("database_knotinfo", "knotinfo", f"knot {name!r}")
    return None


def unknown(text: str) -> UnknownKnotError:
    """What is said of a text that is no form of a knot: the nearest names."""
    squeezed = re.sub(r"\s", "", text).lower()[:_LONGEST]
    large = bool(re.match("k?1[123]", squeezed))
    knots = knotinfo_knots() if large and is_installed() else shipped_knots()
    rows = dict.fromkeys(grid.row for grid in table1_grids())
    near = [row for row in rows if squeezed and row.lower().startswith(squeezed)]
    near += difflib.get_close_matches(_knotinfo_name(squeezed), [*knots, *rows], n=3, cutoff=0.3)
    hint = f"; nearest: {', '.join(near)}" if near else "; `knotopt knots` lists the names"
    shown = text if len(text) <= 60 else f"{text[:57]}..."
    return UnknownKnotError(f"no knot is named {shown!r}{hint}")


def _knotinfo_name(squeezed: str) -> str:
    """SnapPy's K11a1 is KnotInfo's 11a_1."""
    return re.sub(r"k?(\d+)([an])_?(\d+)", r"\1\2_\3", squeezed)
