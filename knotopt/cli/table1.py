"""`knotopt table1`: the paper's Table I, recomputed."""

from __future__ import annotations

from dataclasses import asdict
from pathlib import Path
from typing import Annotated

import typer

from knotopt.cli.output import (
    FormatOption,
    JsonOption,
    PictureFormat,
    print_json,
    print_note,
    print_table,
    print_written,
    track,
)


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
    from knotopt.path import measures
    from knotopt.tables.table1 import (
        HEADS,
        NOTE,
        PATH_HEADS,
        chosen_grids,
        compute_table1,
        display,
        display_paths,
        paths_csv,
        paths_markdown,
        table1_csv,
        table1_markdown,
    )

    if out is not None:
        if all_grids:
            raise typer.BadParameter(
                "writes the six rows: leave out --all-grids", param_hint="--out"
            )
        from knotopt.plot.figures import before_after_figure, minimal_figure, save_figure
        from knotopt.plot.path_figures import braid_figure, path_figure, relaxation_figure
    total = len(chosen_grids(all_grids=all_grids))
    results = list(track(compute_table1(all_grids=all_grids), "grids", total))
    rows = [result.row for result in results]
    written = []
    if out is not None:
        from knotopt.files import write_atomically
        from knotopt.path.relaxation import relax

        for result in results:
            row = result.row
            name = f"table1_{row.row.replace(' ', '_')}_{row.knot}"
            title = f"Table I, row {row.row}: {row.knot}"
            figures = {
                name: before_after_figure(result.lcf, f"{title}, cut {row.cut}"),
                f"{name}_minimal": minimal_figure([result.opening, result.span], title),
                f"{name}_fig5": relaxation_figure(
                    relax(result.lcf.cable, result.lcf.supports),
                    result.relaxed,
                    result.optimised,
                    f"{title}, LCF's supports, as in Fig. 5",
                ),
                f"{name}_fig7": braid_figure(result.optimised, f"{title}, as in Fig. 7"),
                f"{name}_path": path_figure([result.optimised], f"{title}, LCF's supports"),
            }
            for stem, figure in figures.items():
                file = out / "figures" / f"{stem}.{picture_format}"
                save_figure(figure, file)
                written.append(file)
        tables = {
            "table1.csv": table1_csv(rows),
            "table1.md": table1_markdown(rows),
            "table1_paths.csv": paths_csv(results),
            "table1_paths.md": paths_markdown(results),
        }
        for name, text in tables.items():
            write_atomically(out / name, text)
            written.append(out / name)
    if as_json:
        print_json(
            [
                asdict(result.row) | {"paths": [asdict(path) for path in result.paths]}
                for result in results
            ]
        )
        return
    print_table(HEADS, map(display, rows))
    print_note(NOTE)
    print_table(PATH_HEADS, display_paths(results))
    print_note(measures.NOTE)
    for path in written:
        print_written(path)
