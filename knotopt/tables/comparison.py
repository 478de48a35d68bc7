"""Every method on the same knots: baseline, LCF, LCF layered, `opening` and `span`, as tables."""

from __future__ import annotations

import csv
import io
import json
import time
from collections.abc import Iterable
from dataclasses import asdict, dataclass, fields
from fractions import Fraction
from typing import Any

from formulations.backends import DEFAULT
from formulations.solution import Limits
from knotopt.cable.cut import Cut, crossing_free_cuts
from knotopt.diagram.grid import GridDiagram
from knotopt.path import measures
from knotopt.path.measures import PathMeasures, both_methods, measure
from knotopt.supports.lcf import LcfResult, lcf_by_cut
from knotopt.supports.requirements import Requirements
from knotopt.supports.search import CutSearch, best_supports
from knotopt.verify.opening import check_opening

HEADS = ("knot", "before", "LCF", "open", "layered", "open", "opening", "span", "proven")
PATH_KEYS = ("supports", "method", "cut", "robots")  # of a path, which the row says already
NOTE = """\
Robots, the two lifting ones included. Each method has its own best of the cuts named (ties: the \
first). LCF is "open" if its set keeps every active region open by the definition of `opening` \
with the same r and threading by turning points, as for `opening`; for `span` strands thread that \
change between over and under. Proven: neither has a smaller set on any of the cuts."""


@dataclass(frozen=True)
class ComparisonRow:
    """One knot; the fields are the columns of the CSV and the keys of the JSON.

    Robots count the lifting robots; `*_cut` is the cut with the fewest; times are for all cuts
    together [s], those of `opening` and `span` with the regions that they take from LCF. `paths`
    are the relaxation's and the program's on LCF's set, then on the smallest of `opening`; in the
    CSV each has columns `lcf_relaxation_length` and so on.
    """

    knot: str
    source: str
    grid_size: int
    crossings: int
    cuts: int
    openness: float
    robots_before: int
    lcf_robots: int
    lcf_cut: str
    lcf_open: bool
    lcf_seconds: float
    layered_robots: int
    layered_cut: str
    layered_open: bool
    opening_robots: int | None
    opening_cut: str
    opening_proven: bool
    opening_seconds: float
    span_robots: int | None
    span_cut: str
    span_proven: bool
    span_seconds: float
    paths: tuple[PathMeasures, ...]


def compare(
    name: str,
    diagram: GridDiagram,
    *,
    source: str = "",
    openness: Fraction | float | None = None,
    cuts: Iterable[Cut] | None = None,
    solver: str = DEFAULT,
    limits: Limits | None = None,
) -> ComparisonRow:
    """All methods on one diagram.

    Parameters
    ----------
    name : str
    diagram : GridDiagram
    source : str
        Where the diagram comes from, in words.
    openness : optional
        r of both formulations [grid steps]; by default 0.5.
    cuts : iterable of Cut, optional
        By default every crossing-free one.
    solver, limits
        As for `best_supports`; the time limit is for each formulation.

    Examples
    --------
    >>> from knotopt.catalogue.lookup import find_knot
    >>> row = compare("5_1", find_knot("5").diagram)
    >>> row.robots_before, row.lcf_robots, row.lcf_open, row.opening_robots, row.span_robots
    (14, 5, False, 6, 9)
    """
    chosen = tuple(crossing_free_cuts(diagram) if cuts is None else cuts)
    opening = Requirements("opening", openness)
    span = Requirements("span", openness)
    began = time.perf_counter()
    plain = _fewest(lcf_by_cut(diagram, cuts=chosen).values())
    lcf_seconds = time.perf_counter() - began
    layered = _fewest(lcf_by_cut(diagram, layered=True, cuts=chosen).values())
    searches: dict[str, CutSearch] = {}
    seconds: dict[str, float] = {}
    for asked in (opening, span):
        began = time.perf_counter()
        searches[asked.formulation] = best_supports(
            diagram, asked, cuts=chosen, solver=solver, limits=limits, canonical=False
        )
        seconds[asked.formulation] = time.perf_counter() - began
        if searches[asked.formulation].interrupted:
            raise KeyboardInterrupt
    by_opening, by_span = searches["opening"], searches["span"]
    return ComparisonRow(
        knot=name,
        source=source,
        grid_size=diagram.size,
        crossings=len(plain.cable.crossings),
        cuts=len(chosen),
        openness=float(opening.openness),
        robots_before=plain.baseline,
        lcf_robots=plain.robots,
        lcf_cut=str(plain.cable.cut),
        lcf_open=is_open(plain, opening),
        lcf_seconds=round(lcf_seconds, 6),
        layered_robots=layered.robots,
        layered_cut=str(layered.cable.cut),
        layered_open=is_open(layered, opening),
        opening_robots=by_opening.best.robots if by_opening.best.found else None,
        opening_cut=str(by_opening.best.cable.cut),
        opening_proven=by_opening.is_proven,
        opening_seconds=round(seconds["opening"], 6),
        span_robots=by_span.best.robots if by_span.best.found else None,
        span_cut=str(by_span.best.cable.cut),
        span_proven=by_span.is_proven,
        span_seconds=round(seconds["span"], 6),
        paths=(
            *(measure(path, "lcf") for path in both_methods(plain)),
            *(
                measure(path, "opening")
                for path in (both_methods(by_opening.best) if by_opening.best.found else ())
            ),
        ),
    )


def is_open(result: LcfResult, requirements: Requirements) -> bool:
    """Whether LCF's set keeps every active region open by the definition of `opening`."""
    cable = result.cable
    return check_opening(
        cable.path,
        cable.diagram.size,
        result.supports,
        requirements.openness,
        requirements.threading,
    ).is_open


def display(row: ComparisonRow) -> list[str]:
    """The cells of a row under `HEADS`."""

    def yes(value: bool) -> str:
        return "yes" if value else "no"

    def robots(value: int | None) -> str:
        return "none" if value is None else str(value)

    return [
        # One knot may have several grids: those of Table I are told from KnotInfo's.
        f"{row.knot} ({row.source})" if row.source.startswith("Table I") else row.knot,
        str(row.robots_before),
        str(row.lcf_robots),
        yes(row.lcf_open),
        str(row.layered_robots),
        yes(row.layered_open),
        robots(row.opening_robots),
        robots(row.span_robots),
        yes(row.opening_proven and row.span_proven),
    ]


def averages(rows: list[ComparisonRow]) -> list[str]:
    """A last line under `HEADS`: means, and how often each property holds."""

    def mean(values: list[int | None]) -> str:
        known = [value for value in values if value is not None]
        return f"{sum(known) / len(known):.2f}" if known else "-"

    def share(values: list[bool]) -> str:
        return f"{100 * sum(values) / len(values):.0f} %"

    return [
        f"mean of {len(rows)}",
        mean([row.robots_before for row in rows]),
        mean([row.lcf_robots for row in rows]),
        share([row.lcf_open for row in rows]),
        mean([row.layered_robots for row in rows]),
        share([row.layered_open for row in rows]),
        mean([row.opening_robots for row in rows]),
        mean([row.span_robots for row in rows]),
        share([row.opening_proven and row.span_proven for row in rows]),
    ]


def to_csv(rows: list[ComparisonRow]) -> str:
    """All fields of the rows as CSV."""
    buffer = io.StringIO()
    names = [field.name for field in fields(ComparisonRow) if field.name != "paths"]
    names += [
        f"{supports}_{method}_{field.name}"
        for supports in ("lcf", "opening")
        for method in ("relaxation", "nlp")
        for field in fields(PathMeasures)
        if field.name not in PATH_KEYS
    ]
    writer = csv.DictWriter(buffer, names, lineterminator="\n")
    writer.writeheader()
    for row in rows:
        cells = asdict(row)
        for path in cells.pop("paths"):
            prefix = f"{path['supports']}_{path['method']}_"
            cells |= {prefix + k: v for k, v in path.items() if k not in PATH_KEYS}
        writer.writerow(cells)
    return buffer.getvalue()


def path_summary(rows: list[ComparisonRow]) -> list[list[str]]:
    """Cells under `measures.SUMMARY_HEADS`: medians over the rows, by supports and method."""
    return measures.summary(path for row in rows for path in row.paths)


def to_markdown(rows: list[ComparisonRow]) -> str:
    """The displayed cells and the summary of the paths as Markdown tables, with their notes."""
    parts = []
    for heads, lines, note in _tables(rows):
        parts += ["| " + " | ".join(heads) + " |", "|---" + "|---:" * (len(heads) - 1) + "|"]
        parts += ["| " + " | ".join(cells) + " |" for cells in lines]
        parts += ["", note, ""]
    return "\n".join(parts)


def to_latex(rows: list[ComparisonRow]) -> str:
    """The same two tables as LaTeX in the style of booktabs, without notes."""

    def line(cells: list[str]) -> str:
        escaped = [cell.replace("_", r"\_").replace("%", r"\%") for cell in cells]
        return " & ".join(escaped) + r" \\"

    parts = ["% needs \\usepackage{booktabs}"]
    for heads, lines, _ in _tables(rows):
        parts += [
            r"\begin{tabular}{l" + "r" * (len(heads) - 1) + "}",
            r"\toprule",
            line(list(heads)),
            r"\midrule",
            *map(line, lines),
            r"\bottomrule",
            r"\end{tabular}",
            "",
        ]
    return "\n".join(parts)


def from_json(line: str) -> ComparisonRow:
    """The row that `json.dumps(asdict(row))` wrote."""
    content = json.loads(line)
    paths = tuple(PathMeasures(**path) for path in content.pop("paths"))
    return ComparisonRow(**content, paths=paths)


FORMATS: dict[str, Any] = {".csv": to_csv, ".md": to_markdown, ".tex": to_latex}
"""Suffix of a file to what writes its text."""


def _tables(
    rows: list[ComparisonRow],
) -> list[tuple[tuple[str, ...], list[list[str]], str]]:
    """Heads, lines and note of each table."""
    return [
        (HEADS, _lines(rows), NOTE),
        (measures.SUMMARY_HEADS, path_summary(rows), measures.NOTE),
    ]


def _lines(rows: list[ComparisonRow]) -> list[list[str]]:
    lines = [display(row) for row in rows]
    return [*lines, averages(rows)] if len(rows) > 1 else lines


def _fewest(results: Iterable[LcfResult]) -> LcfResult:
    return min(results, key=lambda result: result.robots)
