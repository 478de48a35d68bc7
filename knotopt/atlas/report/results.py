"""The results of a complete atlas, as arrays: one row a knot, one column a cut."""

from __future__ import annotations

from dataclasses import dataclass, field, fields
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
import pyarrow as pa

from knotopt.arrays import BoolArray, FloatArray
from knotopt.atlas.schema import File, KnotRow, Manifest
from knotopt.atlas.store import read_manifest, read_rows
from knotopt.cable.cut import OUTER_CUTS
from knotopt.document.columns import Row
from knotopt.errors import OutputError
from knotopt.frames import data_frame
from knotopt.tables.methods import HEURISTICS, PROGRAMS, USUAL_PROGRAMS, Supports

if TYPE_CHECKING:
    import pandas as pd

METHODS = {
    "baseline": "baseline",
    **{f"{method.key}_robots": method.head for method in HEURISTICS},
    **{f"{p.key}_robots": f"`{p.head}`" if p.is_usual else p.head for p in PROGRAMS},
}
"""Columns of robots, and what they are called."""


@dataclass(frozen=True)
class Results:
    """A complete run of an atlas, of K knots.

    Attributes
    ----------
    manifest : Manifest
    knots : tuple of KnotRow
        In the order of the list.
    rows, times : pyarrow.Table
        Eight rows a knot, in the order of the outer cuts.
    requested : dict of str to pyarrow.Table
        The files that the run was asked for, by name.
    """

    manifest: Manifest
    knots: tuple[KnotRow, ...]
    rows: pa.Table
    times: pa.Table
    requested: dict[str, pa.Table] = field(default_factory=dict)

    def to_dataframe(self) -> pd.DataFrame:
        """The atlas, a row a knot and cut, as a data frame of pandas.

        Raises
        ------
        MissingExtraError
            pandas is not installed.
        """
        return data_frame(self.rows.to_pylist(), self.rows.column_names)

    def cuts(self, column: str) -> FloatArray:
        """Numbers of a column of the atlas, empty cells as nan, shape (K, 8)."""
        return self._shaped(self.rows[column])

    def holds(self, column: str) -> BoolArray:
        """Where a column of the atlas is true, shape (K, 8)."""
        held: BoolArray = self.cuts(column) == 1
        return held

    def seconds(self, column: str) -> FloatArray:
        """Numbers of a column of the times, empty cells as nan, shape (K, 8)."""
        return self._shaped(self.times[column])

    def best(self, column: str) -> FloatArray:
        """Fewest of a column over a knot's cuts, nan where a cell is empty, shape (K,)."""
        fewest: FloatArray = self.cuts(column).min(axis=1)
        return fewest

    def supports(self, column: str, knot: int, cut: int) -> Supports:
        """A set of supports, without the ends."""
        return tuple(self.rows[column][len(OUTER_CUTS) * knot + cut].as_py())

    @cached_property
    def paths(self) -> list[Row]:
        """Rows of the paths; none if the run was not asked for them."""
        return self._listed(File.PATHS)

    @cached_property
    def solvers(self) -> list[Row]:
        """Rows of the solvers with their times; none if the run was not asked for them."""
        return self._joined(File.SOLVERS, File.SOLVER_TIMES)

    @cached_property
    def flights(self) -> list[Row]:
        """Rows of the flights with their times; none if the run was not asked for them."""
        return self._joined(File.FLIGHTS, File.FLIGHT_TIMES)

    @cached_property
    def methods(self) -> dict[str, str]:
        """Those of `METHODS` that have numbers for every knot and cut."""
        return {
            column: words
            for column, words in METHODS.items()
            if column in self.rows.column_names and not np.isnan(self.cuts(column)).any()
        }

    @property
    def smallest(self) -> list[str]:
        """Columns of robots of one smallest set a formulation, those that have all numbers."""
        usual = (f"{method.key}_robots" for method in USUAL_PROGRAMS)
        return [column for column in usual if column in self.methods]

    @cached_property
    def proven(self) -> BoolArray:
        """Where the smallest set of `opening` is proven, shape (K, 8)."""
        proven: BoolArray = self.cuts("opening_bound") == self.cuts("opening_robots")
        return proven

    @property
    def size(self) -> str:
        """How many knots and cuts, in words."""
        return f"{_count(len(self.knots), 'knot')}, {_count(self.rows.num_rows, 'cut')}"

    def _listed(self, name: str) -> list[Row]:
        return list(self.requested[name].to_pylist()) if name in self.requested else []

    def _joined(self, name: str, times: str) -> list[Row]:
        pairs = zip(self._listed(name), self._listed(times), strict=True)
        return [{**row, **spent} for row, spent in pairs]

    def _shaped(self, column: pa.ChunkedArray) -> FloatArray:
        values = column.cast(pa.float64()).to_numpy()
        return np.asarray(values, dtype=float).reshape(len(self.knots), len(OUTER_CUTS))


def read_results(folder: Path) -> Results:
    """A run that is complete.

    Raises
    ------
    OutputError
        The folder holds no run, an unfinished one, or damaged files; or the solver found no set.
    """
    manifest = read_manifest(folder)
    rows, times, listed = (read_rows(folder, name) for name in (File.ATLAS, File.TIMES, File.KNOTS))
    requested: dict[str, pa.Table] = {
        name: read_rows(folder, name) for name in manifest.settings.requested
    }
    knots = tuple(KnotRow(**_hashable(row)) for row in listed.to_pylist())
    numbers = np.repeat([knot.number for knot in knots], len(OUTER_CUTS))
    cuts = list(OUTER_CUTS) * len(knots)
    for name, table in ((File.ATLAS, rows), (File.TIMES, times)):
        if table["cut"].to_pylist() != cuts or not np.array_equal(table["number"], numbers):
            raise OutputError(
                f"{folder / name} does not have the {len(OUTER_CUTS)} outer cuts of every knot of "
                f"{File.KNOTS} in their order: the run must be done again"
            )
    if missing := rows["opening_robots"].null_count + rows["over_under_robots"].null_count:
        raise OutputError(
            f"{folder / File.ATLAS}: {missing} smallest open sets were not found; opening_status "
            "and over_under_status say why"
        )
    for one, other in ((File.SOLVERS, File.SOLVER_TIMES), (File.FLIGHTS, File.FLIGHT_TIMES)):
        if one in requested and requested[one].num_rows != requested[other].num_rows:
            raise OutputError(
                f"{folder / one} and {other} do not have the same rows: the run must be done again"
            )
    return Results(manifest, knots, rows, times, requested)


def _hashable(row: Row) -> Row:
    known = {column.name for column in fields(KnotRow)}
    return {
        name: tuple(value) if isinstance(value, list) else value
        for name, value in row.items()
        if name in known
    }


def _count(number: int, what: str) -> str:
    return f"{number:,} {what}" + ("" if number == 1 else "s")
