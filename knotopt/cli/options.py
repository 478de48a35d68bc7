"""Options that several commands take, and what they stand for.

An option's default is that of the dataclass that it fills, read from there.
"""

from __future__ import annotations

import json
import re
from collections.abc import Collection, Iterable
from enum import StrEnum
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, NoReturn

import typer

from formulations.backends import BACKENDS
from formulations.solution import BackendError, Limits
from knotopt.cli.completion import CUTS, among, knot_names
from knotopt.errors import OutputError, SolverError
from knotopt.supports.requirements import Requirements

if TYPE_CHECKING:
    from knotopt.reading.record import NamedDiagram


class PictureFormat(StrEnum):
    """Of figures whose names a command chooses."""

    PNG = "png"
    PDF = "pdf"
    SVG = "svg"


def unless_given(default: Any, help: str, *names: str, **settings: Any) -> Any:
    """An option that is None where it is not given; the help shows what then holds.

    For options that are refused in company of others, which a default would not be.

    Parameters
    ----------
    default : number or str
        What holds where it is not given, such as `World.altitude`.
    help : str
    *names : str
        Such as "--r"; by default as the parameter is called.
    **settings
        As for `typer.Option`.
    """
    shown = default if isinstance(default, str) else f"{float(default):g}"
    return typer.Option(*names, help=help, show_default=shown, **settings)


def openness_option(default: Any = Requirements.openness) -> Any:
    """The option --r of a command whose requirements have that openness by default."""
    return unless_given(default, "Openness r in (0, 1] [grid steps].", "--r")


def cut_option(words: str) -> Any:
    """The option --cut: what else it can be, before the cuts' own names."""
    help = f"{words}, or one: L+ L- R+ R- B+ B- T+ T-, col3+, row5-."
    also = [name for name in ("best", "all") if re.search(rf"\b{name} \(|^{name}\b", words)]
    return typer.Option(metavar="CUT", help=help, autocompletion=among((*also, *CUTS)))


def _check_picture(path: Path | None) -> Path | None:
    """A picture's name of a wrong format or folder is refused before anything is computed."""
    if path is not None:
        from knotopt.files import check_file
        from knotopt.plot.figures import check_format

        check_format(path)
        check_file(path)
        if not path.parent.is_dir():
            raise OutputError(f"cannot write {path}: there is no folder {path.parent}")
    return path


KnotArgument = Annotated[
    str,
    typer.Argument(
        metavar="KNOT",
        autocompletion=knot_names,
        help="A name (8_19, 'T(2,7)', a row of Table I: 3, '7 Var1'), a code (PD, DT, Gauss, "
        "braid word), a grid, or a file with one; - for standard input.",
    ),
]
KnotsArgument = Annotated[
    list[str] | None,
    typer.Argument(
        metavar="KNOT",
        autocompletion=knot_names,
        help="Names (8_19, 'T(2,7)', rows of Table I: 3, '7 Var1'), codes (PD, DT, Gauss, braid "
        "words), grids, or files with one; - for standard input.",
    ),
]
CatalogueOption = Annotated[
    bool, typer.Option("--catalogue", help="All 249 prime knots up to 10 crossings.")
]
JsonOption = Annotated[bool, typer.Option("--json", help="Print JSON instead of text.")]
PlotOption = Annotated[
    Path | None,
    typer.Option(
        "--plot",
        metavar="FILE",
        callback=_check_picture,
        help="Draw a picture: .png, .pdf or .svg.",
    ),
]
SupportsOption = Annotated[
    str,
    typer.Option(
        metavar="NAME|FILE",
        autocompletion=among(("milp", "lcf", "all")),
        help="milp (the provably smallest set), lcf, all (turning points), or a .json file "
        "such as solve --json and lcf --json print.",
    ),
]
SupportsCutOption = Annotated[str, cut_option("best (for those supports; a file's own)")]
FormatOption = Annotated[PictureFormat, typer.Option("--format", help="Of the figures.")]
OpennessOption = Annotated[float | None, openness_option()]
SolverOption = Annotated[
    str,
    typer.Option(
        metavar="NAME",
        autocompletion=among(BACKENDS),
        help=f"{', '.join(BACKENDS)} (22 points at most).",
    ),
]
TimeLimitOption = Annotated[
    float | None, typer.Option(help="Stop after so many seconds.", metavar="S")
]


def refuse(option: str, why: str) -> NoReturn:
    """End with exit status 2, usage, and what is wrong with an option."""
    raise typer.BadParameter(why, param_hint=option)


def given(**options: Any) -> dict[str, Any]:
    """Those of the options that are given, by name."""
    return {name: value for name, value in options.items() if value is not None}


def check_choice(option: str, value: str, names: Iterable[str]) -> None:
    """Refuse what is not one of the names."""
    if value not in (listed := [*names]):
        refuse(option, f"is one of {', '.join(listed)}")


def check_suffix(path: Path | None, what: str, suffixes: Collection[str]) -> None:
    """A wrong name of a file to be written is refused before anything is computed."""
    if path is not None and path.suffix.lower() not in suffixes:
        raise OutputError(f"{path}: {what} written as {', '.join(suffixes)}")


def read_knots(names: list[str] | None, *, catalogue: bool) -> list[NamedDiagram]:
    """The knots named, or all of the catalogue."""
    from knotopt.catalogue.knots import shipped_knots
    from knotopt.cli.reading import read

    if catalogue == bool(names):
        refuse("KNOT...", "give knots, or --catalogue")
    return [read(name) for name in (shipped_knots() if catalogue else names or ())]


def solver_limits(
    seconds: float | None,
    gap: float = Limits.gap,
    threads: int = Limits.threads,
    seed: int = Limits.seed,
) -> Limits:
    """Limits of a solver from options; wrong ones are this package's errors."""
    try:
        return Limits(seconds, gap, threads, seed)
    except BackendError as error:
        raise SolverError(str(error)) from error


def run_header(command: str, settings: list[Any], knots: list[NamedDiagram]) -> str:
    """What tells one long run from another: command, options, grids."""
    import hashlib

    grids = [[named.name, named.diagram.minus, named.diagram.plus] for named in knots]
    run = json.dumps([settings, grids])
    return f"knotopt {command} {hashlib.sha256(run.encode()).hexdigest()}"
