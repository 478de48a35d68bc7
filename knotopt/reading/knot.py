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
from knotopt.reading.miss import miss
from knotopt.reading.names import mirror_name
from knotopt.reading.over import COLUMNS, ROWS
from knotopt.reading.record import Asked, NamedDiagram, Reading
from knotopt.reading.source import Source, read_source
from knotopt.reading.values import content_of

NAME_KEY = "name"  # of an object that says nothing else


def read_knot(
    knot: Any, *, over: str | None = None, mirror: bool = False, form: str | None = None
) -> NamedDiagram:
    """The grid diagram that a KNOT argument stands for.

    Parameters
    ----------
    knot : str, Path or object
        A text in one of the forms of `knotopt.reading.forms`; the path of a file with one, whatever
        its name; "-" for standard input; or a value: a grid, nested lists, an array, a table of
        pandas, a planar diagram, a link. A text that is the path of a file is that file.
    over : str, optional
        "columns" or "rows", which pass over in a grid; by default as the form has it. Names, codes
        and curves, which have no such lines, are refused.
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
        content = content_of(knot)
    try:
        if isinstance(content.value, GridDiagram | PlanarDiagram):
            what = "grid" if isinstance(content.value, GridDiagram) else "planar diagram"
            found, title, has_lines = Reading(content.value), what, False
        else:
            found, read_as = _read(content, asked, only)
            title, has_lines = read_as.title, read_as.has_lines
        if not has_lines:
            check_no_over(over, title)
        return _finished(found, title, source, mirror=mirror)
    except KnotoptError as error:
        if source.name:
            raise FileFormatError(f"{source.where}: {error}") from error
        raise


def _read(content: Content, asked: Asked, only: Form | None) -> tuple[Reading, Form]:
    """The reading of the first form that can be read, and the form."""
    if isinstance(content.value, str) and content.text.strip()[:1] in {'"', "'"}:
        content = content.without_quotes()
    forms = [form for form in FORMS if not form.only_named] if only is None else [only]
    if isinstance(content.value, dict):
        content, keyed = _under_key(content)
        forms = forms if only is not None or keyed is None else [keyed]
    for form in forms:
        found = form.read(content, asked)
        if found is not None:
            return found, form
    if content.key == NAME_KEY and only is None:
        raise miss(content)
    if content.key and len(forms) == 1:
        raise FileFormatError(f'the key "{content.key}" holds no {forms[0].title}')
    if only is not None:
        raise FileFormatError(
            f"this cannot be read as {only.name} ({only.title}){_instead(content, asked)}"
        )
    raise miss(content)


def _instead(content: Content, asked: Asked) -> str:
    """As which form the content could be read, in words; "" if as none."""
    for form in FORMS:
        try:
            fits = not form.only_named and form.read(content, Asked(asked.over)) is not None
        except KnotoptError:
            fits = False
        if fits:
            return f": it is of the form {form.name}"
    return ""


def _under_key(content: Content) -> tuple[Content, Form | None]:
    """What an object holds under the first key that is a form's, and that form."""
    by_name = {str(key).lower(): key for key in content.value}
    for form in FORMS:
        for name in form.keys:
            if name in by_name:
                return content.inside(name, content.value[by_name[name]]), form
    if any(by_name.keys() >= {*pair} for pair in xo.PAIRS_OF_KEYS):
        return content, _form_named("xo")
    if [*by_name] == [NAME_KEY]:
        return content.inside(NAME_KEY, content.value[by_name[NAME_KEY]]), _form_named("name")
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


def check_no_over(over: str | None, title: str) -> None:
    """Refuse to be asked who passes over in what has no columns and rows, or has said it itself.

    Raises
    ------
    FileFormatError
    """
    if over is not None:
        raise FileFormatError(
            f"over {over} is about grids in writing (matrix, marks, arcs, X and O), and this is "
            f"read as: {title}"
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
