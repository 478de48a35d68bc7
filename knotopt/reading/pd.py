"""PD codes: KnotTheory's `PD[X[1,5,2,4], ...]`, KnotInfo's lists, the Knot Atlas's X1524."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Sequence
from typing import Any

from knotopt.errors import DiagramError
from knotopt.planar.planar_diagram import PlanarDiagram
from knotopt.reading.codes import check_crossings, is_named, is_something_else, whole
from knotopt.reading.content import Content
from knotopt.reading.record import Asked, Reading

_HEADS = ("PD", "X", "Xp", "Xm", "Loop")  # Xp, Xm: KnotTheory's crossings with their sign
_ATLAS = re.compile(r"X(?:(\d)(\d)(\d)(\d)(?!\d)|(\d{1,6}),(\d{1,6}),(\d{1,6}),(\d{1,6}))[\s,;]*")


def read(content: Content, asked: Asked) -> Reading | None:
    """The planar diagram of a PD code, its edges numbered from 0, from 1 or in any way.

    A link of Spherogram or SnapPy is read by its method `PD_code`.

    Raises
    ------
    DiagramError
        Naming the crossing, entry or edge that is wrong, or how many components a link has.
    """
    value = content.value
    if callable(getattr(value, "PD_code", None)):
        return Reading(_of_link(value), source="link object")
    if is_something_else(content, _HEADS):
        return None
    named = is_named(content, asked, "pd", _HEADS)
    rows: list[list[Any]] | None = _of_atlas(content.text) or content.rows
    if "Loop" in content.heads:
        rows = []  # PD[Loop[1]], KnotTheory's unknot
    elif named and isinstance(value, list) and not any(isinstance(x, list) for x in value):
        rows = [value] if value else []  # X[1,1,2,2] alone; PD[]
    if rows is None or not (named or _are_crossings(rows)):
        if named and value is not None:
            raise DiagramError("a PD code is a list of crossings, of four edges each")
        return None
    check_crossings(len(rows))
    crossings = [
        [whole(edge, f"edge {k} of crossing {number}") for k, edge in enumerate(row, 1)]
        for number, row in enumerate(rows, 1)
    ]
    return Reading(PlanarDiagram.from_edges(crossings))


def _of_link(link: Any) -> PlanarDiagram:
    code = link.PD_code()
    check_crossings(len(code))
    circles = getattr(link, "unlinked_unknot_components", 0)
    if circles > bool(not code):
        raise DiagramError(f"the link object has {circles} circles beside its crossings")
    return PlanarDiagram.from_edges([[int(edge) for edge in crossing] for crossing in code])


def _of_atlas(text: str) -> list[list[int]]:
    """Crossings written as X1524 or X10,2,11,1; empty if the text is anything else."""
    if not _ATLAS.match(text.lstrip()):
        return []
    check_crossings(text.count("X"))
    if not re.fullmatch(rf"\s*(?:{_ATLAS.pattern})+", text):
        return []
    return [[int(edge) for edge in groups if edge] for groups in _ATLAS.findall(text)]


def _are_crossings(rows: Sequence[Sequence[Any]]) -> bool:
    """Whether most rows are of four whole numbers, and most numbers occur twice.

    Two rows of the same four numbers are the X and O of a grid.
    """
    four = sum(len(row) == 4 and all(isinstance(e, int) for e in row) for row in rows)
    if 2 * four <= len(rows) or (len(rows) == 2 and {*rows[0]} == {*rows[1]}):
        return False
    counts = Counter(entry for row in rows for entry in row)
    twice = sum(count == 2 for count in counts.values())
    return 2 * twice > len(counts) or len(rows) == 1
