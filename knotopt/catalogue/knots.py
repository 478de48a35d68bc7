"""The shipped catalogue: all 249 prime knots up to 10 crossings.

Facts from KnotInfo (Livingston and Moore, https://knotinfo.org), with the grids' rows reversed so
that columns over rows gives KnotInfo's chirality.
"""

from __future__ import annotations

import json
from dataclasses import dataclass, fields
from functools import cache
from importlib.resources import files
from typing import TYPE_CHECKING, Any

from knotopt.diagram.grid import GridDiagram, Mark
from knotopt.frames import data_frame

if TYPE_CHECKING:
    import pandas as pd


@dataclass(frozen=True)
class PrimeKnot:
    """A prime knot with its grid diagram and invariants.

    Attributes
    ----------
    name : str
        KnotInfo's name: 8_19, 11a_1, 12n_242.
    crossing_number, arc_index, determinant : int
    alternating : bool
    signature : int
        In KnotInfo's sign, the opposite of that of V + V^T for a Seifert matrix V.
    alexander : tuple of int
        Alexander polynomial, constant term first, leading coefficient positive.
    marks : tuple of [column, row]
    other_names : tuple of str
        The knot's other names in KnotInfo: that of Hoste and Thistlethwaite (3a_1) where it is not
        the same, that of Conway's list of 11 crossings (11_1).
    symmetry : str
        KnotInfo's word for it: "chiral" (neither its reverse nor its mirror image), "reversible",
        "positive amphicheiral", "negative amphicheiral", "fully amphicheiral".
    """

    name: str
    crossing_number: int
    arc_index: int
    alternating: bool
    determinant: int
    signature: int
    alexander: tuple[int, ...]
    marks: tuple[Mark, ...]
    other_names: tuple[str, ...]
    symmetry: str

    @property
    def is_amphicheiral(self) -> bool:
        """Whether the knot is its own mirror image, orientations aside."""
        return "amphicheiral" in self.symmetry

    @property
    def diagram(self) -> GridDiagram:
        """The knot's grid diagram."""
        return GridDiagram.from_marks(self.marks)

    def to_json(self) -> dict[str, Any]:
        """The entry as a JSON object, as the catalogue's files hold it."""
        facts = {key: value for key, value in vars(self).items() if key != "marks"}
        grid = [list(mark) for mark in self.marks]
        lists = {"alexander": list(self.alexander), "other_names": list(self.other_names)}
        return facts | lists | {"grid": grid}

    @classmethod
    def from_json(cls, entry: dict[str, Any]) -> PrimeKnot:
        """The inverse of `to_json`."""
        facts = {key: value for key, value in entry.items() if key != "grid"}
        for key in ("alexander", "other_names"):
            facts[key] = tuple(entry[key])
        return cls(**facts, marks=tuple((column, row) for column, row in entry["grid"]))


class KnotTable(dict[str, PrimeKnot]):
    """Knots by name."""

    def to_dataframe(self) -> pd.DataFrame:
        """A row a knot, a column a fact, as a data frame of pandas.

        Raises
        ------
        MissingExtraError
            pandas is not installed.
        """
        columns = [field.name for field in fields(PrimeKnot)]
        return data_frame(map(vars, self.values()), columns)

    def __repr__(self) -> str:
        return f"<KnotTable: {len(self)} knots>"


@cache
def shipped_knots() -> KnotTable:
    """The 249 prime knots up to 10 crossings by name, in KnotInfo's order.

    Examples
    --------
    >>> knots = shipped_knots()
    >>> len(knots), knots["8_19"].arc_index, knots["4_1"].alexander
    (249, 7, (1, -3, 1))
    """
    entries = shipped_json("prime_knots.json")
    return KnotTable((entry["name"], PrimeKnot.from_json(entry)) for entry in entries)


@cache
def unknot() -> PrimeKnot:
    """The knot 0_1, on the grid of size 2; it is prime no more than 1 is, and in no list.

    Examples
    --------
    >>> unknot().name, unknot().diagram.size
    ('0_1', 2)
    """
    return PrimeKnot(
        name="0_1",
        crossing_number=0,
        arc_index=2,
        alternating=True,
        determinant=1,
        signature=0,
        alexander=(1,),
        marks=((1, 1), (1, 2), (2, 1), (2, 2)),
        other_names=(),
        symmetry="fully amphicheiral",
    )


def shipped_json(name: str) -> list[dict[str, Any]]:
    """The entries of a JSON file that ships beside this one."""
    entries: list[dict[str, Any]] = json.loads(
        files("knotopt.catalogue").joinpath(name).read_text(encoding="utf-8")
    )
    return entries
