"""`knotopt table1`: the paper's Table I, recomputed."""

from __future__ import annotations

from dataclasses import asdict
from pathlib import Path
from typing import Annotated

import typer

from knotopt.cli.output import JsonOption, print_json, print_note, print_table, print_written


def table1(
    all_grids: Annotated[
        bool, typer.Option("--all-grids", help="Print also the other grids that reproduce a row.")
    ] = False,
    out: Annotated[
        Path | None,
        typer.Option(
            metavar="DIR", help="Write table1.csv, table1.md and a figure for every row there."
        ),
    ] = None,
    as_json: JsonOption = False,
) -> None:
    """Recompute the paper's Table I: robots before and after LCF.

    Example: knotopt table1 --out paper_results
    """
    from knotopt.table1 import (
        HEADS,
        NOTE,
        compute_table1,
        display,
        table1_csv,
        table1_markdown,
    )

    results = compute_table1(all_grids=all_grids)
    rows = [row for row, _ in results]
    written = []
    if out is not None:
        if all_grids:
            raise typer.BadParameter(
                "writes the six rows: leave out --all-grids", param_hint="--out"
            )
        from knotopt.files import write_atomically
        from knotopt.plot.figures import before_after_figure, save_figure

        for row, result in results:
            path = out / "figures" / f"table1_{row.row.replace(' ', '_')}_{row.knot}.png"
            title = f"Table I, row {row.row}: {row.knot}, cut {row.cut}"
            save_figure(before_after_figure(result, title), path)
            written.append(path)
        for name, text in (("table1.csv", table1_csv(rows)), ("table1.md", table1_markdown(rows))):
            write_atomically(out / name, text)
            written.append(out / name)
    if as_json:
        print_json([asdict(row) for row in rows])
        return
    print_table(HEADS, map(display, rows))
    print_note(NOTE)
    for path in written:
        print_written(path)
