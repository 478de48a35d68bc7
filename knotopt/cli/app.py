"""The command `knotopt`. Commands are imported when they are asked for, not before."""

from __future__ import annotations

import importlib
import io
import sys
from typing import Annotated, Any

import typer
from typer.core import TyperGroup

from knotopt import __version__
from knotopt.cli import logs, reading
from knotopt.errors import KnotoptError

COMMANDS = {
    "knots": ("knots", "List the prime knots in the catalogue."),
    "show": ("show", "Show a knot: cable, crossings, codes and invariants."),
    "identify": ("identify", "Name the knot of any diagram, by invariants."),
    "lcf": ("lcf", "Select supports by the Loop Consistency Filter."),
    "solve": ("solve", "Find the provably smallest set of supports."),
    "path": ("path", "Find the path of the cable, and check it."),
    "fly": ("fly", "Plan a flight that ties a knot, check and simulate it."),
    "topology": ("topology", "List the ways in which one arm ties a rope."),
    "compare": ("compare", "Compare every method on the same knots."),
    "atlas": ("atlas", "Measure every method on every outer cut of many knots."),
    "report": ("report", "Report what an atlas says."),
    "prove": ("prove", "Write certificates of smallest sets."),
    "check": ("prove", "Check certificates, without any solver."),
    "table1": ("table1", "Recompute the paper's Table I."),
    "doctor": ("doctor", "Check versions, solvers and extras."),
}
"""Name of a command to the module of `knotopt.cli` that has it, and what it does in one line."""

HELP = (
    "Smallest robot teams that tie a knot in a cable in midair. "
    "KNOT is a name (8_19, 'T(2,7)', a row of Table I such as 3 or '7 Var1'), a code (PD, DT, "
    "Gauss, braid word), a grid diagram, or a file with one of these; - is standard input."
)


class Commands(TyperGroup):
    """The commands, each built when it is asked for: the list of them needs none."""

    def __init__(self, **attributes: Any) -> None:
        super().__init__(**attributes)
        self.commands = dict.fromkeys(COMMANDS)  # type: ignore[assignment]

    def get_command(self, ctx: Any, cmd_name: str) -> Any:  # noqa: ARG002
        """The command of that name; None if there is none."""
        if cmd_name not in COMMANDS:
            return None
        module = importlib.import_module(f"knotopt.cli.{COMMANDS[cmd_name][0]}")
        alone = typer.Typer(add_completion=False, rich_markup_mode=None)
        command = reading.reading_options(getattr(module, cmd_name))
        alone.command(cmd_name)(logs.logged(command))
        return typer.main.get_command(alone)

    def format_commands(self, ctx: Any, formatter: Any) -> None:  # noqa: ARG002
        """Write the list of commands into the help."""
        with formatter.section("Commands"):
            formatter.write_dl([(name, words) for name, (_, words) in COMMANDS.items()])


app = typer.Typer(
    name="knotopt",
    cls=Commands,
    help=HELP,
    no_args_is_help=True,
    pretty_exceptions_enable=False,
    rich_markup_mode=None,  # help without importing rich answers in half the time
)


def _print_version(wanted: bool) -> None:
    if wanted:
        print(__version__)
        raise typer.Exit


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
