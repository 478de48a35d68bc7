"""Options whose help is what the registry of formulations holds, which imports all programs."""

from __future__ import annotations

from typing import Annotated

import typer

from knotopt.cli import options
from knotopt.cli.completion import among
from knotopt.supports.registry import FORMULATIONS
from knotopt.supports.threading import Threading

FormulationOption = Annotated[
    str,
    typer.Option(
        metavar="NAME",
        autocompletion=among(FORMULATIONS),
        help=" or ".join(f"{each.name} ({each.words})" for each in FORMULATIONS.values()) + ".",
    ),
]
WITH = {"loops": True, "none": False}
WithOption = Annotated[
    str | None,
    typer.Option(
        "--with",
        metavar="NAME",
        help="loops (every loop of the cable holds a support, too) or none; by default "
        + ", ".join(
            f"{'loops' if each.with_loops else 'none'} for {each.name}"
            for each in FORMULATIONS.values()
            if each.has_openness
        )
        + ".",
        show_default=False,
    ),
]
ThreadingOption = Annotated[
    str | None,
    typer.Option(
        metavar="NAME",
        autocompletion=among(Threading),
        help=f"What threads a region: {' or '.join(Threading)}; by default "
        + ", ".join(f"{each.threading[0]} for {each.name}" for each in FORMULATIONS.values())
        + ".",
    ),
]


def with_loops(value: str | None) -> bool | None:
    """What --with says; None where it is not given."""
    if value is None:
        return None
    options.check_choice("--with", value, WITH)
    return WITH[value]
