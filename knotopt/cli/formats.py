"""`knotopt show --format`: a knot in the forms that other programs take."""

from __future__ import annotations

from typing import Annotated, Any

import typer

from knotopt.cli.completion import among
from knotopt.cli.options import check_choice, refuse
from knotopt.cli.reading import read
from knotopt.cli.sizes import check_size
from knotopt.reading.writing import LISTED_FORMS, WRITTEN_FORMS, write_knot

WrittenOption = Annotated[
    str | None,
    typer.Option(
        "--format",
        metavar="NAME",
        autocompletion=among(WRITTEN_FORMS),
        help=f"Print only the closed knot, as one of {LISTED_FORMS}.",
    ),
]


def print_form(knot: str, form: str, others: dict[str, Any]) -> None:
    """Print a knot in a form; what else is asked for is refused."""
    check_choice("--format", form, WRITTEN_FORMS)
    for option, value in others.items():
        if value:
            refuse(option, "does not go with --format, which prints the knot alone")
    named = read(knot)
    check_size(named.diagram.size, "show --format")
    print(write_knot(named.diagram, form), end="")
