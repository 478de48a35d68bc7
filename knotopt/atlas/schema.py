"""What an atlas holds: its files, and every column with meaning and unit.

A run's folder has `manifest.json` (what was asked, with which versions), `knots.parquet` (the list
of knots, with grids), `parts/` while it is under way, and in the end `atlas.parquet` (one row a
knot and cut) and `times.parquet` (one row for each of these: what differs from run to run). On
request: `paths.parquet`; `solvers.parquet` with `solver_times.parquet`; `flights.parquet` with
`flight_times.parquet`. All but the three files of times are the same byte for byte for the same
list, settings and versions (flights: on the same kind of machine; solvers: those that no time limit
stopped). Rows are sorted by `number`, then by cut in the order L+ ... T-.
"""

from __future__ import annotations

import hashlib
import json
import math
from dataclasses import Field, asdict, dataclass, field
from fractions import Fraction
from functools import cached_property
from typing import TYPE_CHECKING, Any

from knotopt.errors import RequirementError

if TYPE_CHECKING:  # options of the command line are read from `Settings`, at once
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
SOLVERS, SOLVER_TIMES = "solvers.parquet", "solver_times.parquet"
FLIGHTS, FLIGHT_TIMES = "flights.parquet", "flight_times.parquet"


def about(meaning: str) -> Any:
    """A column of a row, and what it holds in words."""
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
    solvers : tuple of str
        By which the programs are solved as well.
    solver_limit : float
        Of each of these solves [s].
    physics : bool
        Whether the sets are flown in simulation too.

    Raises
    ------
    RequirementError
        A time limit that makes no sense.
    """

    openness: str = "1/2"
    seed: int = 0
    span: bool = False
    paths: bool = False
    check: int = 16
    solvers: tuple[str, ...] = ()
    solver_limit: float = 60.0
    physics: bool = False

    def __post_init__(self) -> None:
        if not 0 < self.solver_limit < math.inf:
            raise RequirementError(
                f"the time limit of a solver must be positive, not {self.solver_limit} s"
            )

    @property
    def requested(self) -> tuple[str, ...]:
        """The files that a run has on request."""
        return (
            *((PATHS,) if self.paths else ()),
            *((SOLVERS, SOLVER_TIMES) if self.solvers else ()),
            *((FLIGHTS, FLIGHT_TIMES) if self.physics else ()),
        )

    @property
    def content(self) -> dict[str, Any]:
        """As values that JSON knows, which `from_content` takes back.

        Without the settings after `check` where nothing was asked of them: a run that does without
        has the manifest that it had when there were none.
        """
        usual = Settings()
        late = ("solvers", "solver_limit", "physics")
        return {
            name: list(value) if isinstance(value, tuple) else value
            for name, value in asdict(self).items()
            if name not in late or value != getattr(usual, name)
        }

    @classmethod
    def from_content(cls, content: dict[str, Any]) -> Settings:
        """The inverse of `content`."""
        return cls(**{**content, "solvers": tuple(content.get("solvers", ()))})

    @property
    def r(self) -> Fraction:
        """The openness [grid steps]."""
        return Fraction(self.openness)


@dataclass(frozen=True)
class KnotRow:
    """One knot of the list: a row of `knots.parquet`, and one item of work."""

    number: int = about("place in the list, from 1")
    knot: str = about("name; of a grid from a file, the file's name")
    source: str = about("where the diagram comes from, in words")
    grid_size: int = about("N; of a smallest diagram the arc index")
    minus: tuple[int, ...] = about("row of the -1 in columns 1 ... N")
    plus: tuple[int, ...] = about("row of the +1 in columns 1 ... N")
    crossing_number: int | None = about("of the knot, where a table says it")
    arc_index: int | None = about("of the knot, where a table says it")
    alternating: bool | None = about("whether the knot is, where a table says it")
    determinant: int | None = about("of the knot, where a table says it")
    signature: int | None = about("of the knot in KnotInfo's sign, where a table says it")

    @property
    def diagram(self) -> GridDiagram:
        """The grid diagram."""
        from knotopt.diagram.grid import GridDiagram

        return GridDiagram(self.minus, self.plus)


@dataclass(frozen=True)
class AtlasRow:
    """One knot and cut: a row of `atlas.parquet`. Robots count the two lifting ones.

    `opening_` columns are of formulation `opening` with threading by turning points, `over_under_`
    of the same with strands that change between over and under, `span_` of formulation `span`
    (empty unless asked for). "Open" is by `opening` in the mode named.
    """

    number: int = about("the knot's place in the list, from 1")
    knot: str = about("name")
    crossing_number: int | None = about("of the knot, where a table says it")
    grid_size: int = about("N")
    crossings: int = about("of the diagram")
    cut: str = about("outer cut, L+ ... T-")
    baseline: int = about("robots at all 2N turning points")
    lcf_robots: int = about("robots of the Loop Consistency Filter's set")
    lcf_supports: tuple[int, ...] = about("LCF's set: turning points, from 1, without the ends")
    lcf_open: bool = about("whether LCF's set is open, turning-point")
    lcf_open_over_under: bool = about("whether LCF's set is open, over-under")
    lcf_below: bool = about("whether LCF uses fewer robots than any open set, turning-point")
    lcf_below_over_under: bool = about("whether LCF uses fewer robots than any open set, o.-u.")
    layered_robots: int = about("robots of LCF's layered set")
    layered_supports: tuple[int, ...] = about("LCF's layered set")
    layered_open: bool = about("whether the layered set is open, turning-point")
    layered_open_over_under: bool = about("whether the layered set is open, over-under")
    opening_robots: int | None = about("robots of the smallest open set, turning-point")
    opening_bound: int | None = about("no open set has fewer robots, turning-point")
    opening_status: str = about("optimal, feasible, infeasible, unknown or error")
    opening_supports: tuple[int, ...] | None = about("a smallest open set, turning-point")
    opening_rows: int = about("rows of the 0-1 program, turning-point")
    opening_instance: str = about("first 16 digits of the SHA-256 of that program")
    over_under_robots: int | None = about("robots of the smallest open set, over-under")
    over_under_bound: int | None = about("no open set has fewer robots, over-under")
    over_under_status: str = about("optimal, feasible, infeasible, unknown or error")
    over_under_supports: tuple[int, ...] | None = about("a smallest open set, over-under")
    over_under_rows: int = about("rows of the 0-1 program, over-under")
    over_under_instance: str = about("first 16 digits of the SHA-256 of that program")
    span_robots: int | None = about("robots of the smallest set of `span`")
    span_bound: int | None = about("no set that `span` allows has fewer robots")
    span_status: str | None = about("as of `opening`, or refused: the diagram is too large")
    span_supports: tuple[int, ...] | None = about("a smallest set of `span`")
    span_rows: int | None = about("rows of the 0-1 program of `span`")
    span_instance: str | None = about("first 16 digits of the SHA-256 of that program")
    checked: bool | None = about(
        "whether the independent checkers find the smallest sets open, and LCF's as said here; "
        "empty where they were not asked"
    )


@dataclass(frozen=True)
class TimesRow:
    """What differs from run to run: a row of `times.parquet`, for the same row of the atlas."""

    number: int = about("the knot's place in the list, from 1")
    knot: str = about("name")
    cut: str = about("outer cut, L+ ... T-")
    lcf_seconds: float = about("LCF and its layered set [s]")
    opening_seconds: float = about("compile, build and solve, turning-point, without LCF [s]")
    opening_solve_seconds: float = about("the solver alone, turning-point [s]")
    over_under_seconds: float = about("compile, build and solve, over-under [s]")
    over_under_solve_seconds: float = about("the solver alone, over-under [s]")
    span_seconds: float | None = about("compile, build and solve, `span` [s]")
    span_solve_seconds: float | None = about("the solver alone, `span` [s]")
    paths_seconds: float | None = about("four paths and their checks [s]")
    check_seconds: float | None = about("the independent checkers [s]")
    worker_mib: float = about("largest memory of the worker's process so far [MiB]")


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
        content = {**asdict(self), "settings": self.settings.content}
        return json.dumps({"format": FORMAT, **content}, indent=1) + "\n"

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
        return cls(**{**content, "settings": Settings.from_content(content["settings"])})


def list_hash(knots: tuple[KnotRow, ...]) -> str:
    """SHA-256 of names, sources and grids in their order."""
    listed = [[knot.knot, knot.source, knot.minus, knot.plus] for knot in knots]
    return hashlib.sha256(json.dumps(listed).encode()).hexdigest()
