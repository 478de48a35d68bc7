"""What an atlas holds: its files, and every column with meaning and unit.

A run's folder has `manifest.json` (what was asked, with which versions), `knots.parquet` (the list
of knots, with grids), `parts/` while it is under way, and in the end `atlas.parquet` (one row a
knot and cut), `times.parquet` (one row for each of these: what differs from run to run) and, where
paths were asked for, `paths.parquet`. All but `times.parquet` are the same byte for byte for the
same list, settings and versions. Rows are sorted by `number`, then by cut in the order L+ ... T-.
"""

from __future__ import annotations

import hashlib
import json
from dataclasses import Field, asdict, dataclass, field
from fractions import Fraction
from functools import cached_property
from typing import Any

from knotopt.diagram.grid import GridDiagram

FORMAT = "knotopt atlas 1"
MANIFEST, KNOTS, ATLAS, TIMES, PATHS, PARTS = (
    "manifest.json",
    "knots.parquet",
    "atlas.parquet",
    "times.parquet",
    "paths.parquet",
    "parts",
)


def _about(meaning: str) -> Any:
    return field(metadata={"meaning": meaning})


def meaning(column: Field[Any]) -> str:
    """What a column holds, in words, with its unit in brackets."""
    words: str = column.metadata["meaning"]
    return words


@dataclass(frozen=True)
class Settings:
    """What decides the results of a run.

    Attributes
    ----------
    openness : str
        r of both formulations [grid steps], as a fraction: "1/2".
    seed : int
        Of the solver.
    span, paths : bool
        Whether the smallest set of `span`, and the cable paths, are computed too.
    check : int
        The sets of one knot in so many are examined by the definition; 0: of none.
    """

    openness: str = "1/2"
    seed: int = 0
    span: bool = False
    paths: bool = False
    check: int = 16

    @property
    def r(self) -> Fraction:
        """The openness [grid steps]."""
        return Fraction(self.openness)


@dataclass(frozen=True)
class KnotRow:
    """One knot of the list: a row of `knots.parquet`, and one item of work."""

    number: int = _about("place in the list, from 1")
    knot: str = _about("name; of a grid from a file, the file's name")
    source: str = _about("where the diagram comes from, in words")
    grid_size: int = _about("N; of a smallest diagram the arc index")
    minus: tuple[int, ...] = _about("row of the -1 in columns 1 ... N")
    plus: tuple[int, ...] = _about("row of the +1 in columns 1 ... N")
    crossing_number: int | None = _about("of the knot, where a table says it")
    arc_index: int | None = _about("of the knot, where a table says it")
    alternating: bool | None = _about("whether the knot is, where a table says it")
    determinant: int | None = _about("of the knot, where a table says it")
    signature: int | None = _about("of the knot in KnotInfo's sign, where a table says it")

    @property
    def diagram(self) -> GridDiagram:
        """The grid diagram."""
        return GridDiagram(self.minus, self.plus)


@dataclass(frozen=True)
class AtlasRow:
    """One knot and cut: a row of `atlas.parquet`. Robots count the two lifting ones.

    `opening_` columns are of formulation `opening` with threading by turning points, `over_under_`
    of the same with strands that change between over and under, `span_` of formulation `span`
    (empty unless asked for). "Open" is by `opening` in the mode named.
    """

    number: int = _about("the knot's place in the list, from 1")
    knot: str = _about("name")
    crossing_number: int | None = _about("of the knot, where a table says it")
    grid_size: int = _about("N")
    crossings: int = _about("of the diagram")
    cut: str = _about("outer cut, L+ ... T-")
    baseline: int = _about("robots at all 2N turning points")
    lcf_robots: int = _about("robots of the Loop Consistency Filter's set")
    lcf_supports: tuple[int, ...] = _about("LCF's set: turning points, from 1, without the ends")
    lcf_open: bool = _about("whether LCF's set is open, turning-point")
    lcf_open_over_under: bool = _about("whether LCF's set is open, over-under")
    lcf_below: bool = _about("whether LCF uses fewer robots than any open set, turning-point")
    lcf_below_over_under: bool = _about("whether LCF uses fewer robots than any open set, o.-u.")
    layered_robots: int = _about("robots of LCF's layered set")
    layered_supports: tuple[int, ...] = _about("LCF's layered set")
    layered_open: bool = _about("whether the layered set is open, turning-point")
    layered_open_over_under: bool = _about("whether the layered set is open, over-under")
    opening_robots: int | None = _about("robots of the smallest open set, turning-point")
    opening_bound: int | None = _about("no open set has fewer robots, turning-point")
    opening_status: str = _about("optimal, feasible, infeasible, unknown or error")
    opening_supports: tuple[int, ...] | None = _about("a smallest open set, turning-point")
    opening_rows: int = _about("rows of the 0-1 program, turning-point")
    opening_instance: str = _about("first 16 digits of the SHA-256 of that program")
    over_under_robots: int | None = _about("robots of the smallest open set, over-under")
    over_under_bound: int | None = _about("no open set has fewer robots, over-under")
    over_under_status: str = _about("optimal, feasible, infeasible, unknown or error")
    over_under_supports: tuple[int, ...] | None = _about("a smallest open set, over-under")
    over_under_rows: int = _about("rows of the 0-1 program, over-under")
    over_under_instance: str = _about("first 16 digits of the SHA-256 of that program")
    span_robots: int | None = _about("robots of the smallest set of `span`")
    span_bound: int | None = _about("no set that `span` allows has fewer robots")
    span_status: str | None = _about("as of `opening`, or refused: the diagram is too large")
    span_supports: tuple[int, ...] | None = _about("a smallest set of `span`")
    span_rows: int | None = _about("rows of the 0-1 program of `span`")
    span_instance: str | None = _about("first 16 digits of the SHA-256 of that program")
    checked: bool | None = _about(
        "whether the independent checkers find the smallest sets open, and LCF's as said here; "
        "empty where they were not asked"
    )


@dataclass(frozen=True)
class TimesRow:
    """What differs from run to run: a row of `times.parquet`, for the same row of the atlas."""

    number: int = _about("the knot's place in the list, from 1")
    knot: str = _about("name")
    cut: str = _about("outer cut, L+ ... T-")
    lcf_seconds: float = _about("LCF and its layered set [s]")
    opening_seconds: float = _about("compile, build and solve, turning-point, without LCF [s]")
    opening_solve_seconds: float = _about("the solver alone, turning-point [s]")
    over_under_seconds: float = _about("compile, build and solve, over-under [s]")
    over_under_solve_seconds: float = _about("the solver alone, over-under [s]")
    span_seconds: float | None = _about("compile, build and solve, `span` [s]")
    span_solve_seconds: float | None = _about("the solver alone, `span` [s]")
    paths_seconds: float | None = _about("four paths and their checks [s]")
    check_seconds: float | None = _about("the independent checkers [s]")
    worker_mib: float = _about("largest memory of the worker's process so far [MiB]")


@dataclass(frozen=True)
class PathRow:
    """One cable path: a row of `paths.parquet`. Lengths in grid steps, empty: nothing to measure.

    Sorted like the atlas, then LCF before the smallest open set, relaxation before program.
    """

    number: int = _about("the knot's place in the list, from 1")
    knot: str = _about("name")
    cut: str = _about("outer cut, L+ ... T-")
    supports: str = _about("whose supports: lcf, or opening (turning-point)")
    method: str = _about("relaxation (eq. 11-13) or nlp")
    robots: int = _about("supports and the two lifting robots")
    status: str = _about("what came of it: solved, converged, stopped ...")
    length: float = _about("of the path in space [grid steps]")
    stretch: float = _about("length over that of the taut string")
    smallest_radius: float = _about("of a turn [grid steps]")
    clearance: float | None = _about("smallest distance of strands in plan [grid steps]")
    opening: float | None = _about("room where a strand threads an active region [grid steps]")
    gap: float | None = _about("vertical distance at crossings [grid steps]")
    same_diagram: bool = _about("whether the path has the grid's diagram")
    same_knot: bool = _about("whether its Alexander polynomial is the grid's")
    smooth: bool = _about("whether the spline, not the polyline, was kept")
    blocked: str = _about("which limit the program could not meet, in words")


@dataclass(frozen=True)
class Manifest:
    """What tells one run from another; also the metadata of every Parquet file of the run.

    Attributes
    ----------
    settings : Settings
    versions : dict of str to str
        Of the packages that results depend on.
    knots : int
        How many.
    list_hash : str
        SHA-256 of names, sources and grids in their order.
    """

    settings: Settings
    versions: dict[str, str]
    knots: int
    list_hash: str

    @cached_property
    def text(self) -> str:
        """As JSON, the same text for the same run."""
        return json.dumps({"format": FORMAT, **asdict(self)}, indent=1) + "\n"

    @classmethod
    def from_text(cls, text: str) -> Manifest:
        """The inverse of `text`.

        Raises
        ------
        ValueError, KeyError, TypeError
            It is something else.
        """
        content = json.loads(text)
        if content.pop("format") != FORMAT:
            raise ValueError(f"not of format {FORMAT!r}")
        return cls(**{**content, "settings": Settings(**content["settings"])})


def list_hash(knots: tuple[KnotRow, ...]) -> str:
    """SHA-256 of names, sources and grids in their order."""
    listed = [[knot.knot, knot.source, knot.minus, knot.plus] for knot in knots]
    return hashlib.sha256(json.dumps(listed).encode()).hexdigest()
