"""What a text is understood as, without drawing it on a grid, which takes most of the time."""

from __future__ import annotations

from typing import Any

from knotopt.planar.planar_diagram import PlanarDiagram
from knotopt.reading.content import Content
from knotopt.reading.knot import _form_named, _read
from knotopt.reading.lists import Lists
from knotopt.reading.record import Asked
from knotopt.reading.source import read_source


def understood(knot: Any, form: str | None = None) -> tuple[str, PlanarDiagram, tuple[str, ...]]:
    """The form's title, the planar diagram that is read, and the notes."""
    text = isinstance(knot, str)
    content = Content(read_source(knot).text) if text else Content("", Lists(knot))
    found, read_as = _read(content, Asked(form=form), _form_named(form))
    assert isinstance(found.diagram, PlanarDiagram), read_as.title
    return read_as.title, found.diagram, tuple(found.notes)
