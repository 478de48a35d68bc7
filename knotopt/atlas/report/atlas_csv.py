"""The atlas as CSV: one row a knot and cut, what a reader wants of it and no times."""

from __future__ import annotations

from knotopt.atlas.report.results import Results
from knotopt.document.columns import names
from knotopt.document.csv import csv_text
from knotopt.tables.methods import LAYERED, LCF, PROGRAMS, USUAL_PROGRAMS

COLUMNS = (
    "knot",
    "crossing_number",
    "grid_size",
    "crossings",
    "cut",
    "baseline",
    *names(LCF.columns("robots", "open", "below")),
    *names(LAYERED.columns("robots", "open")),
    *(
        name
        for method in PROGRAMS
        for name in names(method.columns("robots", *(["status"] if method.is_usual else [])))
    ),
    *(name for method in (LCF, *USUAL_PROGRAMS) for name in names(method.columns("supports"))),
)


def atlas_csv(results: Results) -> str:
    """The columns of `COLUMNS` that hold anything; lists of turning points have spaces between."""
    rows = results.rows
    known = (name for name in COLUMNS if name in rows.column_names)
    held = rows.select([name for name in known if rows[name].null_count < rows.num_rows])
    spaced = (
        {name: " ".join(map(str, v)) if isinstance(v, list) else v for name, v in row.items()}
        for row in held.to_pylist()
    )
    return csv_text(held.column_names, spaced)
