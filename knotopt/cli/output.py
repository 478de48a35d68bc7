"""What the commands share: the options that several take, and how results are printed."""

from __future__ import annotations

import json
import sys
from collections.abc import Iterable, Iterator, Sequence
from enum import StrEnum
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, TypeVar

import typer

if TYPE_CHECKING:
    from formulations.solution import Limits
    from knotopt.catalogue.lookup import NamedDiagram

Item = TypeVar("Item")


class PictureFormat(StrEnum):
    """Of figures whose names a command chooses."""

    PNG = "png"
    PDF = "pdf"
    SVG = "svg"


KnotArgument = Annotated[
    str,
    typer.Argument(
        metavar="KNOT",
        show_default=False,
        help="A name (8_19), a row of Table I (3, '7 Var1'), 'T(2,7)', or a .json or .csv file.",
    ),
]
KnotsArgument = Annotated[
    list[str] | None,
    typer.Argument(metavar="KNOT...", show_default=False, help="Knots, each as above."),
]
CatalogueOption = Annotated[
    bool, typer.Option("--catalogue", help="All 249 prime knots up to 10 crossings.")
]
JsonOption = Annotated[bool, typer.Option("--json", help="Print JSON instead of text.")]
PlotOption = Annotated[
    Path | None,
    typer.Option("--plot", metavar="FILE", help="Draw a picture: .png, .pdf or .svg."),
]
FormatOption = Annotated[PictureFormat, typer.Option("--format", help="Of the figures.")]
LayeredOption = Annotated[
    bool,
    typer.Option("--layered", help="Also drop supports that lie inside another active region."),
]
SupportsOption = Annotated[
    str,
    typer.Option(
        help="milp (the provably smallest set), lcf, all (turning points), or a .json file "
        "such as solve --json and lcf --json print."
    ),
]
SupportsCutOption = Annotated[
    str, typer.Option(help="best (for those supports; a file's own), or one: L+ L- ... row5-.")
]

FormulationOption = Annotated[
    str,
    typer.Option(
        help="opening (polygons through the grid's crossings) or span (the taut cable itself)."
    ),
]
ThreadingOption = Annotated[
    str | None,
    typer.Option(
        help="What threads a region: turning-point or over-under; by default the former for "
        "opening, the latter for span.",
        show_default=False,
    ),
]
OpennessOption = Annotated[
    float | None,
    typer.Option("--r", help="Openness r in (0, 1] [grid steps]; default 0.5.", show_default=False),
]
SolverOption = Annotated[
    str, typer.Option(help="cp-sat, highs, scip, maxsat or exhaustive (22 points at most).")
]
TimeLimitOption = Annotated[
    float | None,
    typer.Option(help="Stop after so many seconds.", metavar="S", show_default=False),
]


UNBROKEN = 1_000_000  # characters
NARROWEST = 9  # of a column whose cells are longer [characters]


def print_json(content: Any) -> None:
    """Print JSON with each innermost list on one line, where `json` would use a line a number."""
    print(_indented(content, ""))


def print_table(columns: Sequence[str], rows: Iterable[Sequence[Any]]) -> None:
    """Print a table; numbers stand to the right."""
    from rich import box
    from rich.console import Console
    from rich.table import Table
    from rich.text import Text

    # Text, not markup: columns and cells hold [brackets].
    table = Table(box=box.SIMPLE_HEAD, pad_edge=False)
    cells = [[_cell(value) for value in row] for row in rows]
    for index, column in enumerate(columns):
        numeric = all(row[index].replace(".", "").lstrip("-").isdigit() for row in cells)
        # In a narrow terminal long cells break into lines; no column vanishes.
        width = max(map(len, [column, *(row[index] for row in cells)]))
        table.add_column(
            Text(column),
            justify="right" if numeric else "left",
            min_width=min(width, NARROWEST),
            overflow="fold",
        )
    for row in cells:
        table.add_row(*(Text(cell) for cell in row))
    # Into a pipe or a file, a row is one line.
    Console(width=None if sys.stdout.isatty() else UNBROKEN).print(table)


def print_written(path: Path) -> None:
    """Say where a result was written."""
    print(f"written: {path}")


def find_knots(names: list[str] | None, *, catalogue: bool) -> list[NamedDiagram]:
    """The knots named, or all of the catalogue."""
    from knotopt.catalogue.knots import shipped_knots
    from knotopt.catalogue.lookup import find_knot

    if catalogue == bool(names):
        raise typer.BadParameter("give knots, or --catalogue", param_hint="KNOT...")
    return [find_knot(name) for name in (shipped_knots() if catalogue else names or ())]


def run_header(command: str, settings: list[Any], knots: list[NamedDiagram]) -> str:
    """What tells one long run from another: command, options, grids."""
    import hashlib

    grids = [[named.name, named.diagram.minus, named.diagram.plus] for named in knots]
    run = json.dumps([settings, grids])
    return f"knotopt {command} {hashlib.sha256(run.encode()).hexdigest()}"


def solver_limits(
    seconds: float | None, gap: float = 0.0, threads: int = 1, seed: int = 0
) -> Limits:
    """Limits of a solver from options; wrong ones are this package's errors."""
    from formulations.solution import BackendError, Limits
    from knotopt.errors import SolverError

    try:
        return Limits(seconds, gap, threads, seed)
    except BackendError as error:
        raise SolverError(str(error)) from error


def track(items: Iterable[Item], what: str, total: int) -> Iterator[Item]:
    """The items, with a progress bar on the error stream while they are gone through."""
    from rich.console import Console
    from rich.progress import track as rich_track

    console = Console(stderr=True)
    yield from rich_track(
        items, what, total, console=console, transient=True, disable=not console.is_terminal
    )


def print_note(text: str) -> None:
    """Print a paragraph, broken between words at the terminal's width."""
    from rich.console import Console

    Console().print(text, markup=False, highlight=False)


def print_facts(facts: Iterable[tuple[str, Any]]) -> None:
    """Print names and values, one to a line."""
    listed = list(facts)
    width = max(len(name) for name, _ in listed)
    for name, value in listed:
        print(f"{name:<{width}}  {value}")


def _cell(value: Any) -> str:
    if isinstance(value, bool):
        return "yes" if value else "no"
    return str(value)


def _indented(content: Any, indent: str) -> str:
    deeper = indent + "  "
    if isinstance(content, dict) and content:
        lines = [f"{deeper}{json.dumps(k)}: {_indented(v, deeper)}" for k, v in content.items()]
        return "{\n" + ",\n".join(lines) + f"\n{indent}}}"
    if isinstance(content, list) and any(isinstance(entry, dict) for entry in content):
        return "[\n" + ",\n".join(deeper + _indented(e, deeper) for e in content) + f"\n{indent}]"
    return json.dumps(content, ensure_ascii=False)
