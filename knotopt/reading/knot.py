"""What KNOT means, for every command: a name, a grid, a code or a curve, from wherever it comes."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

from knotopt.diagram.families import MAX_SIZE
from knotopt.diagram.grid import GridDiagram
from knotopt.errors import FileFormatError, GridError, KnotoptError
from knotopt.planar.planar_diagram import PlanarDiagram
from knotopt.planar.small_grid import small_grid
from knotopt.reading import xo
from knotopt.reading.codes import check_crossings
from knotopt.reading.content import Content
from knotopt.reading.forms import FORMS, Form
from knotopt.reading.lists import Lists
from knotopt.reading.miss import miss
from knotopt.reading.names import mirror_name
from knotopt.reading.over import COLUMNS, ROWS
from knotopt.reading.record import Asked, NamedDiagram, Reading
from knotopt.reading.source import Source, read_source


def read_knot(
    knot: Any, *, over: str | None = None, mirror: bool = False, form: str | None = None
) -> NamedDiagram:
    """The grid diagram that a KNOT argument stands for.

    Parameters
    ----------
    knot : str, Path or object
        A text in one of the forms of `knotopt.reading.forms`; the path of a file with one, whatever
        its name; "-" for standard input; or a value: a grid, nested lists, an array, a planar
        diagram. A text that is the path of a file is that file.
    over : str, optional
        "columns" or "rows", which pass over in a grid; by default as the form has it.
    mirror : bool
        The mirror image of what is read.
    form : str, optional
        The one form to read it in; by default the content decides.

    Raises
    ------
    UnknownKnotError
        No such knot; the message gives the nearest names.
    FileFormatError
        A file that cannot be read, or holds no knot; the message names it.
    MissingExtraError
        A knot of 11 to 13 crossings without the `knotinfo` extra.
    KnotoptError
        A grid or code that is wrong; the message says where.

    Examples
    --------
    >>> read_knot("8_19").diagram.size, read_knot("T(3,4)").diagram.size
    (7, 7)
    >>> read_knot("7 var1").name
    '7_2'
    >>> found = read_knot("[[0, -1, 1], [1, 0, -1], [-1, 1, 0]]")
    >>> found.name, found.source, found.diagram.size
    ('matrix', 'as given', 3)
    >>> read_knot("8_22")
    Traceback (most recent call last):
    ...
    knotopt.errors.UnknownKnotError: no knot is named '8_22'; KnotInfo has 8_1 to 8_21
    """
    asked = Asked(_checked_over(over), form)
    only = _form_named(form)
    if isinstance(knot, NamedDiagram):
        return _mirrored(knot) if mirror else knot
    if isinstance(knot, str | Path | Source):
        source = knot if isinstance(knot, Source) else read_source(knot)
        content = Content(source.text)
    else:
        source = Source("", "", "given")
        content = Content("", Lists(_plain(knot)))
    try:
        if isinstance(content.value, GridDiagram | PlanarDiagram):
            what = "grid" if isinstance(content.value, GridDiagram) else "planar diagram"
            found, title = Reading(content.value), what
        else:
            found, title = _read(content, asked, only)
        return _finished(found, title, source, mirror=mirror)
    except KnotoptError as error:
        if source.name:
            raise FileFormatError(f"{source.where}: {error}") from error
        raise


def _read(content: Content, asked: Asked, only: Form | None) -> tuple[Reading, str]:
    """The reading of the first form that can be read, and the form's title."""
    if isinstance(content.value, str) and content.text.strip()[:1] in {'"', "'"}:
        content = content.without_quotes()
    forms = [form for form in FORMS if not form.only_named] if only is None else [only]
    if isinstance(content.value, dict):
        content, keyed = _under_key(content)
        forms = forms if only is not None or keyed is None else [keyed]
    for form in forms:
        found = form.read(content, asked)
        if found is not None:
            return found, form.title
    if content.key and len(forms) == 1:
        raise FileFormatError(f'the key "{content.key}" holds no {forms[0].title}')
    if only is not None:
        raise FileFormatError(f"this cannot be read as {only.name} ({only.title})")
    raise miss(content)


def _under_key(content: Content) -> tuple[Content, Form | None]:
    """What an object holds under the first key that is a form's, and that form."""
    by_name = {str(key).lower(): key for key in content.value}
    for form in FORMS:
        for name in form.keys:
            if name in by_name:
                return content.inside(name, content.value[by_name[name]]), form
    if any(by_name.keys() >= {*pair} for pair in xo.PAIRS_OF_KEYS):
        return content, _form_named("xo")
    found = ", ".join(map(repr, content.value)) or "none"
    raise FileFormatError(f'expected a key such as "grid", "matrix" or "pd_code", found {found}')


def _finished(found: Reading, title: str, source: Source, *, mirror: bool) -> NamedDiagram:
    """The record of what was read: drawn on a grid if it is not one, mirrored if asked."""
    diagram = found.diagram
    if isinstance(diagram, PlanarDiagram):
        check_crossings(len(diagram.crossings))
        diagram = small_grid(diagram)
    if diagram.size > MAX_SIZE:
        raise GridError(f"a grid of size {diagram.size}; up to {MAX_SIZE} are read")
    named = NamedDiagram(
        found.name or source.name or title,
        diagram,
        found.source or source.words,
        found.prime_knot,
        title,
        tuple(found.notes),
        found.ambiguous,
        found.diagram if isinstance(found.diagram, PlanarDiagram) else None,
        found.summands,
    )
    return _mirrored(named) if mirror else named


def _mirrored(named: NamedDiagram) -> NamedDiagram:
    """The mirror image, and so called if the knot has a name of its own."""
    return replace(
        named,
        name=mirror_name(named.name) if named.form == "name" else named.name,
        diagram=named.diagram.mirrored,
        planar=named.planar and named.planar.mirrored,
        prime_knot=None,
        notes=(*named.notes, "mirror image, as asked"),
        summands=tuple(summand.mirrored for summand in named.summands),
    )


def _checked_over(over: str | None) -> str | None:
    if over not in (None, COLUMNS, ROWS):
        raise FileFormatError(f"who passes over is {over!r}, not {COLUMNS} or {ROWS}")
    return over


def _form_named(name: str | None) -> Form | None:
    if name is None:
        return None
    for form in FORMS:
        if form.name == name:
            return form
    raise FileFormatError(f"no form is named {name!r}; {', '.join(form.name for form in FORMS)}")


def _plain(value: Any) -> Any:
    """Lists of an array; anything else as it is, tuples as lists."""
    if hasattr(value, "tolist"):
        return value.tolist()
    if isinstance(value, list | tuple):
        return [_plain(entry) for entry in value]
    if isinstance(value, dict):
        return {key: _plain(entry) for key, entry in value.items()}
    return value
