"""The atlas as CSV: one row a knot and cut, what a reader wants of it and no times."""

from __future__ import annotations

import csv
import io

from knotopt.atlas.report.results import Results

COLUMNS = (
    "knot",
    "crossing_number",
    "grid_size",
    "crossings",
    "cut",
    "baseline",
    "lcf_robots",
    "lcf_open",
    "lcf_below",
    "layered_robots",
    "layered_open",
    "opening_robots",
    "opening_status",
    "over_under_robots",
    "span_robots",
    "span_status",
    "lcf_supports",
    "opening_supports",
    "span_supports",
)


def listing(results: Results) -> str:
    """The columns of `COLUMNS` that hold anything; lists of turning points have spaces between."""
    rows = results.rows
    names = [name for name in COLUMNS if rows[name].null_count < rows.num_rows]
    buffer = io.StringIO()
    writer = csv.writer(buffer, lineterminator="\n")
    writer.writerow(names)
    columns = (map(_cell, rows[name].to_pylist()) for name in names)
    writer.writerows(zip(*columns, strict=True))
    return buffer.getvalue()


def _cell(value: object) -> object:
    return " ".join(map(str, value)) if isinstance(value, list) else value
