"""Options whose help is what the registry of formulations holds, which imports all programs."""

from __future__ import annotations

from typing import Annotated

import typer

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
