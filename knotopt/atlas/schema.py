"""What an atlas was asked, and its files; `knotopt.atlas.columns` has their columns.

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
from dataclasses import asdict, dataclass
from enum import StrEnum
from fractions import Fraction
from functools import cached_property
from typing import TYPE_CHECKING, Any

from knotopt.errors import RequirementError

if TYPE_CHECKING:  # options of the command line are read from `Settings`, at once
    from knotopt.cable.cut import Cut
    from knotopt.diagram.grid import GridDiagram
    from knotopt.document.columns import Row

FORMAT = "knotopt atlas 1"
MANIFEST, PARTS = "manifest.json", "parts"


class File(StrEnum):
    """The Parquet files of a run."""

    KNOTS = "knots.parquet"
    ATLAS = "atlas.parquet"
    TIMES = "times.parquet"
    PATHS = "paths.parquet"
    SOLVERS = "solvers.parquet"
    SOLVER_TIMES = "solver_times.parquet"
    FLIGHTS = "flights.parquet"
    FLIGHT_TIMES = "flight_times.parquet"


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
    def requested(self) -> tuple[File, ...]:
        """The files that a run has on request."""
        return (
            *((File.PATHS,) if self.paths else ()),
            *((File.SOLVERS, File.SOLVER_TIMES) if self.solvers else ()),
            *((File.FLIGHTS, File.FLIGHT_TIMES) if self.physics else ()),
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
    """One knot of the list: a row of `knots.parquet`, whose columns say what the fields are."""

    number: int
    knot: str
    source: str
    grid_size: int
    minus: tuple[int, ...]
    plus: tuple[int, ...]
    crossing_number: int | None
    arc_index: int | None
    alternating: bool | None
    determinant: int | None
    signature: int | None

    def keys(self, cut: Cut) -> Row:
        """What says in a file which knot and cut a row is of."""
        return {"number": self.number, "knot": self.knot, "cut": str(cut)}

    @property
    def diagram(self) -> GridDiagram:
        """The grid diagram."""
        from knotopt.diagram.grid import GridDiagram

        return GridDiagram(self.minus, self.plus)


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
