"""The shipped catalogue: all 249 prime knots up to 10 crossings.

Facts from KnotInfo (Livingston and Moore, https://knotinfo.org), with the grids' rows reversed so
that columns over rows gives KnotInfo's chirality.
"""

from __future__ import annotations

import json
from dataclasses import dataclass
from functools import cache
from importlib.resources import files
from typing import Any

from knotopt.diagram.grid import GridDiagram, Mark


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
    """

    name: str
    crossing_number: int
    arc_index: int
    alternating: bool
    determinant: int
    signature: int
    alexander: tuple[int, ...]
    marks: tuple[Mark, ...]

    @property
    def diagram(self) -> GridDiagram:
        """The knot's grid diagram."""
        return GridDiagram.from_marks(self.marks)

    def to_json(self) -> dict[str, Any]:
        """The entry as a JSON object, as the catalogue's files hold it."""
        facts = {key: value for key, value in vars(self).items() if key != "marks"}
        grid = [list(mark) for mark in self.marks]
        return facts | {"alexander": list(self.alexander), "grid": grid}

    @classmethod
    def from_json(cls, entry: dict[str, Any]) -> PrimeKnot:
        """The inverse of `to_json`."""
        facts = {key: value for key, value in entry.items() if key != "grid"}
        facts["alexander"] = tuple(entry["alexander"])
        return cls(**facts, marks=tuple((column, row) for column, row in entry["grid"]))


@cache
def shipped_knots() -> dict[str, PrimeKnot]:
    """The 249 prime knots up to 10 crossings by name, in KnotInfo's order.

    Examples
    --------
    >>> knots = shipped_knots()
    >>> len(knots), knots["8_19"].arc_index, knots["4_1"].alexander
    (249, 7, (1, -3, 1))
    """
    return {entry["name"]: PrimeKnot.from_json(entry) for entry in shipped_json("prime_knots.json")}


def shipped_json(name: str) -> list[dict[str, Any]]:
    """The entries of a JSON file that ships beside this one."""
    entries: list[dict[str, Any]] = json.loads(
        files("knotopt.catalogue").joinpath(name).read_text(encoding="utf-8")
    )
    return entries
