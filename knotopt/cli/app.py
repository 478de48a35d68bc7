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
    version: Annotated[
        bool,
        typer.Option(
            "--version", callback=_print_version, is_eager=True, help="Print the version."
        ),
    ] = False,
) -> None:
    """Options of the command itself."""


app.command("knots")(knots.knots)
app.command("show")(show.show)
app.command("lcf")(lcf.lcf)
app.command("solve")(solve.solve)
app.command("path")(path.path)
app.command("fly")(fly.fly)
app.command("topology")(topology.topology)
app.command("compare")(compare.compare)
app.command("atlas")(atlas.atlas)
app.command("report")(report.report)
app.command("prove")(prove.prove)
app.command("check")(prove.check)
app.command("table1")(table1.table1)
app.command("doctor")(doctor.doctor)


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
