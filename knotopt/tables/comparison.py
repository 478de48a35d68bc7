"""Every method on the same knots: baseline, LCF, LCF layered and the smallest sets, as tables."""

from __future__ import annotations

import time
from collections.abc import Collection, Iterable, Mapping, Sequence
from dataclasses import asdict, fields, replace
from fractions import Fraction
from itertools import chain

from formulations.backends import DEFAULT
from formulations.solution import Limits
from knotopt.cable.cut import Cut, crossing_free_cuts
from knotopt.diagram.grid import GridDiagram
from knotopt.document.cells import mean, median, percent, yes
from knotopt.document.columns import Column, Row, names
from knotopt.document.formats import Tabulation
from knotopt.document.model import table, table_of, tables
from knotopt.identify.identify import identify
from knotopt.path import measures
from knotopt.path.measures import PathMeasures, both_methods, measure
from knotopt.supports.search import CutSearch, best_supports
from knotopt.supports.support_set import SupportSet
from knotopt.tables import of_the_knot
from knotopt.tables.methods import (
    HEURISTICS,
    LAYERED,
    LCF,
    OPENING,
    USUAL_PROGRAMS,
    SmallestSet,
    columns_of,
)

COLUMNS = (
    Column("knot", str, "name"),
    Column("source", str, "where the diagram comes from, in words"),
    Column("grid_size", int, "N"),
    Column("crossings", int, "of the diagram"),
    Column("cuts", int, "how many there are to choose from"),
    Column("openness", float, "r [grid steps]"),
    Column("robots_before", int, "robots at all 2N turning points"),
    *of_the_knot.COLUMNS,
    *LCF.columns("robots", "cut", "open", "seconds"),
    *LAYERED.columns("robots", "cut", "open"),
    *columns_of(USUAL_PROGRAMS, "robots", "cut", "proven", "seconds"),
)
"""Columns of a row. Robots count the lifting robots; times are of all cuts together, those of the
smallest sets with the regions that they take from LCF."""
PATH_KEYS = ("supports", "method", "cut", "robots")  # of a path, which the row says already
PATH_HEADS = {
    "stretch": "/ taut",
    "smallest_radius": "radius",
    "clearance": "clearance",
    "opening": "opening",
    "gap": "gap",
}
"""Measures of a path of which tables show medians, and their heads."""
HEADS = (
    *("knot", *of_the_knot.HEADS, "before"),
    *(head for method in HEURISTICS for head in (method.head, "open")),
    *(method.head for method in USUAL_PROGRAMS),
    "proven",
)
NOTE = """\
Robots, the two lifting ones included. Each method has its own best of the cuts named (ties: the \
first). LCF is "open" if its set keeps every active region open by the definition of `opening` \
with the same r and threading by turning points, as for `opening`; for `span` strands thread that \
change between over and under. "Safe" is `span` with a support on every loop of the cable, too; \
"loops" asks for that alone: the fewest robots that lay this diagram with straight spans, no bound \
for flights of the knot. Proven: none of the four has a smaller set on any of the cuts. """
NOTE += of_the_knot.NOTE


def compare(
    name: str,
    diagram: GridDiagram,
    *,
    source: str = "",
    candidates: Collection[str] | None = None,
    openness: Fraction | float | None = None,
    cuts: Iterable[Cut] | None = None,
    solver: str = DEFAULT,
    limits: Limits | None = None,
) -> Row:
    """All methods on one diagram: the cells of `COLUMNS`, and under "paths" the paths' measures.

    Parameters
    ----------
    name : str
    diagram : GridDiagram
    source : str
        Where the diagram comes from, in words.
    candidates : collection of str, optional
        Names of the knot, as `known_of_knot` takes them; by default by its invariants.
    openness : optional
        r of every formulation [grid steps]; by default 0.5.
    cuts : iterable of Cut, optional
        By default every crossing-free one.
    solver, limits
        As for `best_supports`; the time limit is for each formulation.

    Examples
    --------
    >>> from knotopt.reading.knot import read_knot
    >>> row = compare("5_1", read_knot("5").diagram)
    >>> [row[f"{method}_robots"] for method in ("lcf", "layered", "opening", "span")]
    [5, 5, 6, 9]
    >>> row["robots_before"], row["lcf_open"]
    (14, False)
    """
    chosen = tuple(crossing_free_cuts(diagram) if cuts is None else cuts)
    judge = OPENING.requirements(openness)
    began = time.perf_counter()
    plain = LCF.best(diagram, chosen)
    seconds = time.perf_counter() - began
    row = {
        "knot": name,
        "source": source,
        "grid_size": diagram.size,
        "crossings": len(plain.cable.crossings),
        "cuts": len(chosen),
        "openness": float(judge.openness),
        "robots_before": plain.baseline,
        **_of_the_knot(diagram, candidates),
    }
    for heuristic, found in ((LCF, plain), (LAYERED, LAYERED.best(diagram, chosen))):
        row |= heuristic.cells(
            robots=found.robots,
            cut=str(found.cable.cut),
            open=OPENING.is_met(found.cable, found.supports, judge.openness),
        )
    row |= LCF.cells(seconds=round(seconds, 6))
    searches: dict[SmallestSet, CutSearch] = {}
    for program in USUAL_PROGRAMS:
        began = time.perf_counter()
        search = searches[program] = best_supports(
            diagram,
            program.requirements(openness),
            cuts=chosen,
            solver=solver,
            limits=limits,
            canonical=False,
        )
        if search.interrupted:
            raise KeyboardInterrupt
        row |= program.cells(
            robots=search.best.robots if search.best.found else None,
            cut=str(search.best.cable.cut),
            proven=search.is_proven,
            seconds=round(time.perf_counter() - began, 6),
        )
    sets: dict[str, SupportSet] = {LCF.key: plain}
    if searches[OPENING].best.found:
        sets[OPENING.key] = searches[OPENING].best
    return {column: row[column] for column in names(COLUMNS)} | {"paths": path_rows(sets)}


def _of_the_knot(diagram: GridDiagram, candidates: Collection[str] | None) -> Row:
    if candidates is not None:
        return of_the_knot.cells(candidates)
    found = identify(diagram)
    return of_the_knot.cells(found.candidates, found.invariants.alexander or ())


def comparison_table(rows: Sequence[Row]) -> Tabulation:
    """The rows for people, with means and the paths' medians, and all of their cells for programs.

    A path's columns are called `lcf_relaxation_length` and so on.
    """
    lines = [_display(row) for row in rows]
    if len(rows) > 1:
        lines.append(_averages(rows))
    medians = f"Medians over {len(rows)} knot{'' if len(rows) == 1 else 's'}. {measures.NOTE}"
    document = tables(
        "",
        table(HEADS, lines, NOTE, "l" + "r" * (len(HEADS) - 1)),
        replace(table_of(_paths(rows), medians), sides="l" + "r" * (4 + len(PATH_HEADS))),
    )
    path_names = [
        f"{supports}_{method}_{field.name}"
        for supports in (LCF.key, OPENING.key)
        for method in ("relaxation", "nlp")
        for field in fields(PathMeasures)
        if field.name not in PATH_KEYS
    ]
    return Tabulation(document, (*names(COLUMNS), *path_names), tuple(map(_flat, rows)))


def _paths(rows: Sequence[Row]) -> list[list[tuple[str, str]]]:
    """Medians over the rows, by supports and method."""

    def count(held: Sequence[bool]) -> str:
        return f"{sum(held)} of {len(held)}"

    return [
        [
            ("supports", supports),
            ("method", method),
            ("done", count(is_done(paths))),
            ("same knot", count([path["same_diagram"] for path in paths])),
            *path_medians(paths),
            ("ms", median([p["milliseconds"] for p in paths], 0)),
        ]
        for (supports, method), paths in path_groups(chain(*(row["paths"] for row in rows))).items()
    ]


def path_groups(paths: Iterable[Row]) -> dict[tuple[str, str], list[Row]]:
    """The measures of paths by supports and method."""
    groups: dict[tuple[str, str], list[Row]] = {}
    for path in paths:
        groups.setdefault((path["supports"], path["method"]), []).append(path)
    return groups


def is_done(paths: Sequence[Row]) -> list[bool]:
    """Which of the paths came to an end, not to a limit."""
    return [path["status"] in ("solved", "converged") for path in paths]


def path_medians(paths: Sequence[Row]) -> list[tuple[str, str]]:
    """Medians of what is measured of paths, with their heads."""
    return [(head, median([path[name] for path in paths], 3)) for name, head in PATH_HEADS.items()]


def path_rows(sets: Mapping[str, SupportSet]) -> list[Row]:
    """The measures of both paths of each of the sets, which are named."""
    chosen = ((name, path) for name, each in sets.items() for path in both_methods(each))
    return [asdict(measure(path, name)) for name, path in chosen]


def _flat(row: Row) -> Row:
    """The row with its paths' measures in columns of their own."""
    return {name: row[name] for name in names(COLUMNS)} | {
        f"{path['supports']}_{path['method']}_{name}": value
        for path in row["paths"]
        for name, value in path.items()
        if name not in PATH_KEYS
    }


def _display(row: Row) -> list[str]:
    """The cells of a row under `HEADS`."""
    # One knot may have several grids: those of Table I are told from KnotInfo's.
    source = f" ({row['source']})" if row["source"].startswith("Table I") else ""
    cells = [row["knot"] + source, *of_the_knot.display(row), str(row["robots_before"])]
    for heuristic in HEURISTICS:
        cells += [str(row[f"{heuristic.key}_robots"]), yes(row[f"{heuristic.key}_open"])]
    for program in USUAL_PROGRAMS:
        robots = row[f"{program.key}_robots"]
        cells.append("none" if robots is None else str(robots))
    return [*cells, yes(_is_proven(row))]


def _averages(rows: Sequence[Row]) -> list[str]:
    """A last line under `HEADS`: means, and how often each property holds."""

    def average(column: str) -> str:
        return mean([row[column] for row in rows])

    flown = [row["flown"] for row in rows if row["flown"] is not None]
    known = f"{mean(flown)} of {len(flown)}" if flown else "–"
    cells = [f"mean of {len(rows)}", average("needed"), known, average("robots_before")]
    for heuristic in HEURISTICS:
        is_open = [row[f"{heuristic.key}_open"] for row in rows]
        cells += [average(f"{heuristic.key}_robots"), percent(is_open, 0)]
    cells += [average(f"{program.key}_robots") for program in USUAL_PROGRAMS]
    return [*cells, percent(list(map(_is_proven, rows)), 0)]


def _is_proven(row: Row) -> bool:
    return all(row[f"{program.key}_proven"] for program in USUAL_PROGRAMS)
