"""The files of Table I: its tables and the figures of each row."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from matplotlib.figure import Figure

from knotopt.document.formats import WRITERS
from knotopt.files import write_atomically
from knotopt.path.relaxation import relax
from knotopt.plot.figures import before_after_figure, minimal_figure, save_figure
from knotopt.plot.path_figures import braid_figure, path_figure, relaxation_figure
from knotopt.tables.methods import SPAN, USUAL_PROGRAMS
from knotopt.tables.table1 import Table1Result, tabulated, tabulated_paths


def write_table1(
    folder: Path, results: Sequence[Table1Result], picture_format: str = "png"
) -> list[Path]:
    """Write five figures for every row, and both tables as CSV and Markdown.

    Parameters
    ----------
    folder : Path
    results : sequence of Table1Result
    picture_format : str
        Suffix of the figures' files.

    Returns
    -------
    list of Path
        What was written, in order.

    Raises
    ------
    OutputError
        Something cannot be written there.
    """
    written = []
    for result in results:
        for stem, figure in _figures(result).items():
            written.append(folder / "figures" / f"{stem}.{picture_format}")
            save_figure(figure, written[-1])
    for stem, table in (("table1", tabulated(results)), ("table1_paths", tabulated_paths(results))):
        for suffix in (".csv", ".md"):
            written.append(folder / f"{stem}{suffix}")
            write_atomically(written[-1], WRITERS[suffix](table))
    return written


def _figures(result: Table1Result) -> dict[str, Figure]:
    """The figures of one row by the stems of their names."""
    row, knot = result.cells["row"], result.cells["knot"]
    name = f"table1_{row.replace(' ', '_')}_{knot}"
    title = f"Table I, row {row}: {knot}"
    of_methods = zip(USUAL_PROGRAMS, result.smallest, strict=True)
    shown = [smallest for method, smallest in of_methods if method is not SPAN]
    return {
        name: before_after_figure(result.lcf, f"{title}, cut {result.cells['cut']}"),
        f"{name}_minimal": minimal_figure(shown, title),
        f"{name}_fig5": relaxation_figure(
            relax(result.lcf.cable, result.lcf.supports),
            result.relaxed,
            result.optimised,
            f"{title}, LCF's supports, as in Fig. 5",
        ),
        f"{name}_fig7": braid_figure(result.optimised, f"{title}, as in Fig. 7"),
        f"{name}_path": path_figure([result.optimised], f"{title}, LCF's supports"),
    }
