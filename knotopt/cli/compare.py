"""`knotopt compare`: every method on the same knots."""

from __future__ import annotations

from dataclasses import asdict
from pathlib import Path
from typing import Annotated

import typer

from knotopt.cli.output import (
    JsonOption,
    OpennessOption,
    SolverOption,
    TimeLimitOption,
    print_json,
    print_note,
    print_table,
    print_written,
    track,
)


def compare(
    knots: Annotated[
        list[str] | None, typer.Argument(metavar="KNOT...", show_default=False, help="Knots.")
    ] = None,
    catalogue: Annotated[
        bool, typer.Option("--catalogue", help="All 249 prime knots up to 10 crossings.")
    ] = False,
    cut: Annotated[
        str, typer.Option(help="best (each method's own of the crossing-free cuts), or one: L+ ...")
    ] = "best",
    r: OpennessOption = None,
    solver: SolverOption = "cp-sat",
    time_limit: TimeLimitOption = None,
    out: Annotated[
        Path | None,
        typer.Option(metavar="FILE", help="Write the table: .csv, .md or .tex (booktabs)."),
    ] = None,
    as_json: JsonOption = False,
) -> None:
    """Compare baseline, LCF, LCF layered, opening and span: robots, open or not, proven or not.

    Example: knotopt compare 3 4 5 8_19 'T(3,5)' --out comparison.tex
    """
    from formulations.solution import BackendError, Limits
    from knotopt import comparison
    from knotopt.cable.cut import Cut
    from knotopt.catalogue.knots import shipped_knots
    from knotopt.catalogue.lookup import find_knot
    from knotopt.errors import OutputError, SolverError
    from knotopt.files import write_atomically

    if catalogue == bool(knots):
        raise typer.BadParameter("give knots, or --catalogue", param_hint="KNOT...")
    if out is not None and out.suffix.lower() not in comparison.FORMATS:
        raise OutputError(f"{out}: tables are written as {', '.join(comparison.FORMATS)}")
    names = list(shipped_knots()) if catalogue else list(knots or ())
    found = [find_knot(name) for name in names]
    try:
        limits = Limits(time_limit)
    except BackendError as error:
        raise SolverError(str(error)) from error
    rows = [
        comparison.compare(
            named.name,
            named.diagram,
            openness=r,
            cuts=None if cut == "best" else [Cut.parse(cut, named.diagram.size)],
            solver=solver,
            limits=limits,
        )
        for named in track(found, "knots", len(found))
    ]
    if out is not None:
        write_atomically(out, comparison.FORMATS[out.suffix.lower()](rows))
    if as_json:
        print_json([asdict(row) for row in rows])
        return
    last = [comparison.averages(rows)] if len(rows) > 1 else []
    print_table(comparison.HEADS, [*map(comparison.display, rows), *last])
    print_note(comparison.NOTE)
    if out is not None:
        print_written(out)
