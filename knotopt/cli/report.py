"""`knotopt report`: what an atlas says, as Markdown, LaTeX and HTML with figures."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from knotopt.cli.printing import print_written


def report(
    run_dir: Annotated[
        Path,
        typer.Argument(metavar="RUN_DIR", show_default=False, help="Folder of a complete atlas."),
    ],
    out: Annotated[
        Path,
        typer.Option(
            metavar="DIR",
            help="Write report.md, .tex, .html, the figures and atlas.csv. Replaces a former "
            "report there.",
        ),
    ],
) -> None:
    """Report an atlas: distributions, LCF's excess and deficit, families, correlations, times.

    Example: knotopt report atlas249 --out report249
    """
    from knotopt.atlas.report.report import report_files, why_kept
    from knotopt.atlas.report.results import read_results
    from knotopt.files import check_folder, write_folder

    check_folder(out, why_kept)
    write_folder(out, report_files(read_results(run_dir)), why_kept)
    print_written(out)
