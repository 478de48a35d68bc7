"""`knotopt compare`: every method on the same knots."""

from __future__ import annotations

import json
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from knotopt.cli import options
from knotopt.cli.printing import print_json, print_tables, print_written
from knotopt.cli.progress import track
from knotopt.cli.sizes import check_size
from knotopt.supports.requirements import Requirements

if TYPE_CHECKING:
    from knotopt.document.columns import Row
    from knotopt.reading.record import NamedDiagram


def compare(
    knots: options.KnotsArgument = None,
    catalogue: options.CatalogueOption = False,
    cut: Annotated[
        str, options.cut_option("best (each method's own of the crossing-free cuts)")
    ] = "best",
    r: options.OpennessOption = None,
    solver: options.SolverOption = "cp-sat",
    time_limit: options.TimeLimitOption = None,
    out: Annotated[
        Path | None,
        typer.Option(metavar="FILE", help="Write the table: .csv, .md or .tex (booktabs)."),
    ] = None,
    as_json: options.JsonOption = False,
) -> None:
    """Compare baseline, LCF, LCF layered, smallest sets, and paths by both methods.

    The smallest sets are of opening, span without loops and with them (safe), and loops.

    With --out, a run that is interrupted goes on where it stopped.
    Example: knotopt compare 3 4 5 8_19 'T(3,5)' --out comparison.tex
    """
    from knotopt.cable.cut import Cut
    from knotopt.document.formats import writer_for
    from knotopt.files import resumable_lines
    from knotopt.tables import comparison

    write = None if out is None else writer_for(out)
    limits = options.solver_limits(time_limit)
    openness = Requirements(openness=r).openness
    found = options.read_knots(knots, catalogue=catalogue)
    for named in found:
        check_size(named.diagram.size, "compare")

    def compare_one(named: NamedDiagram) -> Row:
        return comparison.compare(
            named.name,
            named.diagram,
            source=named.source,
            candidates=[named.prime_knot.name] if named.prime_knot else None,
            openness=openness,
            cuts=None if cut == "best" else [Cut.parse(cut, named.diagram.size)],
            solver=solver,
            limits=limits,
        )

    if out is None or write is None:
        rows = [compare_one(named) for named in track(found, "knots", len(found))]
    else:
        header = options.run_header("compare", [cut, r, solver, time_limit], found)

        def text(lines: list[str]) -> str:
            return write(comparison.comparison_table(list(map(json.loads, lines))))

        with resumable_lines(out, header, text) as lines:
            rows = list(map(json.loads, lines.done))
            for named in track(found[len(rows) :], "knots", len(found) - len(rows)):
                rows.append(compare_one(named))
                lines.write(json.dumps(rows[-1]))
    if as_json:
        print_json(rows)
        return
    print_tables(comparison.comparison_table(rows).document)
    print_written(out)
