"""The options by which a KNOT is read, of every command that takes one, and what was read.

A form that leaves open which of two mirror images it shows is read in that form's own way; a line
on the error stream then says so, unless the command itself does or --mirror chose the other way.
"""

from __future__ import annotations

import inspect
import sys
from collections.abc import Callable, Mapping
from contextvars import ContextVar
from functools import wraps
from types import MappingProxyType
from typing import TYPE_CHECKING, Annotated, Any

import typer

from knotopt.cli.completion import among, form_names

if TYPE_CHECKING:
    from pathlib import Path

    from knotopt.reading.record import NamedDiagram

_TAKING_KNOTS = {"knot", "knots", "goal"}

OverOption = Annotated[
    str | None,
    typer.Option(
        "--over",
        metavar="LINES",
        autocompletion=among(("columns", "rows")),
        help="Of a grid's lines, columns or rows pass over; by default as the form has it.",
    ),
]
MirrorOption = Annotated[
    bool, typer.Option("--mirror", help="Take the mirror image of every KNOT.")
]
FormOption = Annotated[
    str | None,
    typer.Option(
        "--as",
        metavar="FORM",
        autocompletion=form_names,
        help="Read KNOT in this form only, such as grid_notation (KnotInfo's), pd or braid.",
    ),
]

_OPTIONS = (
    ("over", None, OverOption),
    ("mirror", False, MirrorOption),
    ("read_as", None, FormOption),
)
_asked: ContextVar[Mapping[str, Any]] = ContextVar("asked", default=MappingProxyType({}))


def reading_options(command: Callable[..., None]) -> Callable[..., None]:
    """The command with --over, --mirror and --as, if it takes a KNOT."""
    signature = inspect.signature(command, eval_str=True)
    if not _TAKING_KNOTS & signature.parameters.keys():
        return command

    @wraps(command)
    def run(
        *arguments: Any, over: str | None, mirror: bool, read_as: str | None, **options: Any
    ) -> None:
        token = _asked.set({"over": over, "mirror": mirror, "form": read_as})
        try:
            command(*arguments, **options)
        finally:
            _asked.reset(token)

    more = [
        inspect.Parameter(name, inspect.Parameter.KEYWORD_ONLY, default=default, annotation=kind)
        for name, default, kind in _OPTIONS
    ]
    parameters = [*signature.parameters.values(), *more]
    run.__signature__ = signature.replace(parameters=parameters)  # type: ignore[attr-defined]
    run.__annotations__ = {each.name: each.annotation for each in parameters}
    return run


def asked() -> dict[str, Any]:
    """What the options say, as keywords of `read_knot`."""
    return dict(_asked.get())


def read(knot: str | Path, *, says: bool = False) -> NamedDiagram:
    """The knot that an argument is, by the options given.

    Parameters
    ----------
    knot : str or Path
    says : bool
        Whether the command itself says how it was read.
    """
    from knotopt.reading.knot import read_knot

    named = read_knot(knot, **asked())
    if named.ambiguous and not says and not asked().get("mirror"):
        say_reading(named.form, named.notes)
    return named


def say_reading(form: str, notes: tuple[str, ...]) -> None:
    """Say on the error stream how something was read that can be read in two ways."""
    line = f"read as {reading_in_words(form, notes)}"
    print(f"\033[2m{line}\033[0m" if sys.stderr.isatty() else line, file=sys.stderr)


def reading_in_words(form: str, notes: tuple[str, ...]) -> str:
    """`marks of a grid: columns pass over rows; rows are counted upwards`."""
    return f"{form}: {'; '.join(notes)}" if notes else form
