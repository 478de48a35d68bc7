"""The command `knotopt`. Commands import what they compute with when they run, not before."""

from __future__ import annotations

import io
import sys
from typing import Annotated

import typer

from knotopt import __version__
from knotopt.cli import (
    atlas,
    compare,
    doctor,
    fly,
    knots,
    lcf,
    logs,
    path,
    prove,
    report,
    show,
    solve,
    table1,
    topology,
)
from knotopt.errors import KnotoptError


def _print_version(wanted: bool) -> None:
    if wanted:
        print(__version__)
        raise typer.Exit


app = typer.Typer(
    name="knotopt",
    help="Smallest robot teams that tie a knot in a cable in midair. "
    "KNOT is a name (8_19), a row of Table I (3, '7 Var1'), a torus knot 'T(2,7)', "
    "or a .json or .csv file with a grid diagram.",
    no_args_is_help=True,
    pretty_exceptions_enable=False,
    rich_markup_mode=None,  # help without importing rich answers in half the time
)


@app.callback()
def options(
    context: typer.Context,
    version: Annotated[  # noqa: ARG001
        bool,
        typer.Option(
            "--version", callback=_print_version, is_eager=True, help="Print the version."
        ),
    ] = False,
    verbose: logs.VerboseOption = 0,
    log: logs.LogOption = None,
) -> None:
    """Options before the command, where --verbose and --log may stand as well as after it."""
    context.with_resource(logs.logging_to(verbose, log))


for command in (
    knots.knots,
    show.show,
    lcf.lcf,
    solve.solve,
    path.path,
    fly.fly,
    topology.topology,
    compare.compare,
    atlas.atlas,
    report.report,
    prove.prove,
    prove.check,
    table1.table1,
    doctor.doctor,
):
    app.command()(logs.logged(command))


def main() -> None:
    """Run the command line; wrong input ends with one sentence and exit status 1."""
    if isinstance(sys.stdout, io.TextIOWrapper):
        sys.stdout.reconfigure(errors="replace")  # drawings on a terminal that knows ASCII only
    try:
        app()
    except KnotoptError as error:
        sys.exit(f"knotopt: {error}")
    except OSError as error:  # files are written elsewhere: this is the output, on a full disk
        sys.exit(f"knotopt: cannot print the result: {error.strerror}")
