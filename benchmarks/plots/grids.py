"""The page `grids.md`, from the results of drawing grid diagrams from codes."""

from __future__ import annotations

from statistics import median
from typing import Any

from matplotlib.figure import Figure

from benchmarks.plots.words import machine_words, ruled
from benchmarks.results import grouped, load

Rows = list[dict[str, Any]]
FORMS = {"planar": "PD code", "braid": "braid word"}
"""Key of the results to what the grids are made from."""


def sizes_table(rows: Rows) -> str:
    """One line a crossing number, alternating or not; the last for all."""
    lines = ruled(
        "| crossings | alternating | knots |"
        + "".join(f" {form}: larger | median [ms] | worst [ms] |" for form in FORMS.values())
    )
    groups = grouped(rows, "crossings", "alternating").items()
    for (crossings, alternating), some in [*groups, (("all", None), rows)]:
        cells = [str(crossings), {True: "yes", False: "no", None: ""}[alternating]]
        cells.append(f"{sum(row['knots'] for row in some):,}")
        for form in FORMS:
            times = [ms for row in some for ms in row[form]["milliseconds"]]
            cells.append(str(sum(len(row[form]["larger"]) for row in some)))
            cells += [f"{median(times):.1f}", f"{max(times):.1f}"]
        lines.append(f"| {' | '.join(cells)} |")
    return "\n".join(lines)


def larger_words(rows: Rows, form: str) -> str:
    """The knots whose grids are above the arc index, with the sizes of these."""
    larger = {name: size for row in rows for name, size in row[form]["larger"].items()}
    named = ", ".join(f"{name} ({size})" for name, size in larger.items()) or "none"
    knots = sum(row["knots"] for row in rows)
    share = 100 * (1 - len(larger) / knots)
    return f"From a {FORMS[form]} {share:.2f} % are at the arc index; larger than it: {named}."


def write_parts() -> tuple[list[str], dict[str, Figure]]:
    """The parts of the page; it has no figure."""
    header, rows = load("grids_catalogue")
    parts = [
        "# Grid diagrams from codes",
        f"One machine, one core: {machine_words(header)}.",
        sizes_table(rows),
        "All knots of KnotInfo with 3 to 13 crossings. Larger: grids above the arc index. Times "
        "are the processor's for one grid, drawn and simplified, from the planar diagram or the "
        "word. Each grid has KnotInfo's Alexander polynomial and signature.",
        *(larger_words(rows, form) for form in FORMS),
    ]
    return parts, {}
