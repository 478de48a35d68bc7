"""`knotopt table1`: the paper's Table I, recomputed."""

from __future__ import annotations

from dataclasses import asdict
from pathlib import Path
from typing import Annotated

import typer

from knotopt.cli.options import FormatOption, JsonOption, PictureFormat, refuse
from knotopt.cli.printing import print_json, print_tables, print_written
from knotopt.cli.progress import track


def table1(
    all_grids: Annotated[
        bool, typer.Option("--all-grids", help="Print also the other grids that reproduce a row.")
    ] = False,
    out: Annotated[
        Path | None,
        typer.Option(
            metavar="DIR",
            help="Write table1.csv, table1.md, the same of the paths, and five figures for every "
            "row there.",
        ),
    ] = None,
    picture_format: FormatOption = PictureFormat.PNG,
    as_json: JsonOption = False,
) -> None:
    """Recompute the paper's Table I: robots before and after LCF, the smallest sets, the paths.

    Example: knotopt table1 --out paper_results
    """
    from knotopt.tables.table1 import chosen_grids, compute_table1, tabulated, tabulated_paths

    if out is not None:
        if all_grids:
            refuse("--out", "writes the six rows: leave out --all-grids")
        # Before the work, so that what is not installed is said at once.
        from knotopt.tables.table1_files import write_table1
    total = len(chosen_grids(all_grids=all_grids))
    results = list(track(compute_table1(all_grids=all_grids), "grids", total))
    written = write_table1(out, results, picture_format) if out is not None else []
    if as_json:
        print_json([each.cells | {"paths": list(map(asdict, each.paths))} for each in results])
        return
    for table in (tabulated(results), tabulated_paths(results)):
        print_tables(table.document)
    print_written(*written)
