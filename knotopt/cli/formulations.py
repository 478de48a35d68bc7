"""Options whose help is what the registry of formulations holds, which imports all programs."""

from __future__ import annotations

from typing import Annotated

import typer

from knotopt.cli import options
from knotopt.cli.completion import among
from knotopt.supports.registry import FORMULATIONS, find_formulation
from knotopt.supports.threading import Threading

_NAMES = " or ".join(f"{each.name} ({each.words})" for each in FORMULATIONS.values())
FormulationOption = Annotated[
    str, typer.Option(metavar="NAME", autocompletion=among(FORMULATIONS), help=f"{_NAMES}.")
]
WhichFormulationOption = Annotated[
    str | None,
    typer.Option(
        "--formulation",
        metavar="NAME",
        autocompletion=among(FORMULATIONS),
        help=f"{_NAMES}; by default all that is known of the number of robots is said.",
        show_default=False,
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


def check_openness(formulation: str, r: float | None) -> None:
    """Refuse --r where sets do not depend on it."""
    if r is not None and not find_formulation(formulation).has_openness:
        options.refuse("--r", f"formulation {formulation} has no openness")
