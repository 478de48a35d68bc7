"""Values of Python as contents: lists, arrays of numpy, tables of pandas, diagrams, links."""

from __future__ import annotations

import operator
import re
from numbers import Real
from typing import Any

from knotopt.diagram.grid import GridDiagram
from knotopt.errors import FileFormatError
from knotopt.planar.planar_diagram import PlanarDiagram
from knotopt.reading.content import Content
from knotopt.reading.lists import DEPTH, Lists


def content_of(value: Any) -> Content:
    """The content that a value is.

    Parameters
    ----------
    value : object
        Lists, tuples or dictionaries of numbers, an array, a table (whose columns' names count as
        a header does), a grid or planar diagram, or a link with a method `PD_code`.

    Raises
    ------
    FileFormatError
        Anything else: the message says of which type it is.

    Examples
    --------
    >>> content_of((4, 6, 2)).value
    [4, 6, 2]
    >>> content_of(None)
    Traceback (most recent call last):
    ...
    knotopt.errors.FileFormatError: a knot is given as a text, a path, lists of numbers, an array, \
a table, a diagram or a link, not as None
    """
    if hasattr(value, "to_numpy") and hasattr(value, "columns"):
        return _of_table(value)
    is_link = callable(getattr(value, "PD_code", None))
    if isinstance(value, GridDiagram | PlanarDiagram) or is_link:
        return Content("", Lists(value))
    if hasattr(value, "tolist"):
        value = value.tolist()
    if isinstance(value, list | tuple | dict):
        return Content("", Lists(_plain(value, DEPTH)))
    more = ""
    if callable(getattr(value, "link", None)):
        more = ": its method link() may give its link"
    raise FileFormatError(
        "a knot is given as a text, a path, lists of numbers, an array, a table, a diagram or a "
        f"link, not as {_type_of(value)}{more}"
    )


def _of_table(table: Any) -> Content:
    """The rows of a table; as text with a header if its columns have names and not only numbers."""
    names = [re.sub(r"[\s,;|\"']+", " ", str(name)).strip() for name in table.columns]
    rows = _plain(table.to_numpy().tolist(), DEPTH)
    if all(name.isdecimal() for name in names):
        return Content("", Lists(rows))
    cells = [["" if cell is None or cell != cell else str(cell) for cell in row] for row in rows]  # noqa: PLR0124
    return Content("\n".join(",".join(row) for row in [names, *cells]))


def _plain(value: Any, deep: int) -> Any:
    """Nested lists and dictionaries of numbers and texts."""
    if hasattr(value, "tolist"):
        value = value.tolist()
    if isinstance(value, list | tuple) and deep:
        return [_plain(entry, deep - 1) for entry in value]
    if isinstance(value, dict) and deep:
        return {key: _plain(entry, deep - 1) for key, entry in value.items()}
    if value is None or isinstance(value, str | int | float):
        return value
    if hasattr(value, "__index__"):
        return operator.index(value)
    if isinstance(value, Real):
        return float(value)
    raise FileFormatError(f"a knot's lists hold numbers and texts, not {_type_of(value)}")


def _type_of(value: Any) -> str:
    """In words: "None", "bytes", "snappy.Manifold"."""
    kind = type(value)
    if value is None:
        return "None"
    module = kind.__module__
    return kind.__name__ if module == "builtins" else f"{module}.{kind.__name__}"
