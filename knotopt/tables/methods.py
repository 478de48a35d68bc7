"""The methods that are compared: what each is called, how it is computed, what its columns mean.

Table I, `compare` and the atlas take their columns from here: a new formulation appears in all
three by one more line of `PROGRAMS`.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace
from fractions import Fraction
from typing import Any

from knotopt.cable.cable import Cable
from knotopt.cable.cut import Cut
from knotopt.diagram.grid import GridDiagram
from knotopt.document.columns import Column
from knotopt.supports.lcf import LcfResult, lcf_by_cut
from knotopt.supports.registry import find_formulation
from knotopt.supports.requirements import Requirements
from knotopt.supports.threading import Threading

Supports = tuple[int, ...]


@dataclass(frozen=True)
class Method(ABC):
    """What chooses a set of supports, and has columns in tables.

    Attributes
    ----------
    key : str
        With which the names of its columns begin.
    head : str
        Over its robots, where a table is shown.
    """

    key: str
    head: str

    @property
    @abstractmethod
    def words(self) -> str:
        """Its set, in the meaning of a column."""

    def columns(self, *chosen: str) -> tuple[Column, ...]:
        """Some of its columns, by their names without the key."""
        known = {column.name: column for column in self._columns()}
        return tuple(replace(known[name], name=f"{self.key}_{name}") for name in chosen)

    def cells(self, **cells: Any) -> dict[str, Any]:
        """The cells under its columns, by their names without the key."""
        return {f"{self.key}_{name}": value for name, value in cells.items()}

    @abstractmethod
    def _columns(self) -> Iterator[Column]:
        yield Column("robots", int, f"robots of {self.words}")
        yield Column("cut", str, f"first cut where {self.words} has the fewest robots")
        points = "turning points, from 1, without the ends"
        yield Column("supports", Supports, f"{self.words}: {points}")


@dataclass(frozen=True)
class Heuristic(Method):
    """The Loop Consistency Filter, plain or layered: no program, and no promise."""

    is_layered: bool = False

    @property
    def words(self) -> str:
        """Its set, in the meaning of a column."""
        return "LCF's layered set" if self.is_layered else "the Loop Consistency Filter's set"

    def best(self, diagram: GridDiagram, cuts: Iterable[Cut]) -> LcfResult:
        """Its set on the cut where it has the fewest robots, of several the first."""
        found = lcf_by_cut(diagram, layered=self.is_layered, cuts=cuts)
        return min(found.values(), key=lambda result: result.robots)

    def _columns(self) -> Iterator[Column]:
        yield from super()._columns()
        for judge, name in JUDGES.items():
            yield Column(f"open{name}", bool, f"whether {self.words} is open{judge.where}")
            fewer = "has fewer robots than any open set"
            yield Column(f"below{name}", bool, f"whether {self.words} {fewer}{judge.where}")
        yield Column("seconds", float, f"{self.words}, on all cuts together [s]")


@dataclass(frozen=True)
class SmallestSet(Method):
    """The smallest set by a formulation, with what threads its regions.

    Attributes
    ----------
    formulation : str
        Its name.
    threading : Threading
    where : str
        What tells it from the others, in the meaning of a column.
    setting : str
        The setting of an atlas that asks for it; "": it is always there.
    """

    formulation: str
    threading: Threading
    where: str
    setting: str = ""

    @property
    def words(self) -> str:
        """Its set, in the meaning of a column."""
        return f"a smallest open set{self.where}"

    @property
    def is_usual(self) -> bool:
        """Whether the threading is the formulation's own, as where nothing is said of it."""
        return find_formulation(self.formulation).threading[0] is self.threading

    def requirements(self, openness: Fraction | float | None = None) -> Requirements:
        """What is asked of a set, with r = `openness` [grid steps]."""
        return Requirements(self.formulation, openness, self.threading)

    def is_met(self, cable: Cable, supports: Supports, openness: Fraction) -> bool:
        """Whether the independent checker finds a set open, from the definition.

        Parameters
        ----------
        cable : Cable
        supports : tuple of int
            Without the ends.
        openness : Fraction
            r [grid steps].
        """
        check = find_formulation(self.formulation).check
        size = cable.diagram.size
        return check(cable.path, size, supports, openness, self.threading).is_open

    def _columns(self) -> Iterator[Column]:
        where, optional = self.where, bool(self.setting)
        for column in super()._columns():
            yield replace(column, optional=True)
        yield Column("bound", int, f"no open set has fewer robots{where}", optional=True)
        refused = ", or refused: the diagram is too large" if optional else ""
        status = f"optimal, feasible, infeasible, unknown or error{refused}"
        yield Column("status", str, status, optional)
        yield Column("rows", int, f"rows of the 0-1 program{where}", optional)
        yield Column("instance", str, "first 16 digits of the SHA-256 of that program", optional)
        yield Column("proven", bool, f"whether no cut has a smaller open set{where}")
        yield Column("same_cut", int, f"robots of {self.words}, on LCF's cut")
        yield Column("open", bool, f"whether the set is open{where}", optional)
        yield Column("seconds", float, f"compile, build and solve{where} [s]", optional)
        yield Column("solve_seconds", float, f"the solver alone{where} [s]", optional)


LCF = Heuristic("lcf", "LCF")
LAYERED = Heuristic("layered", "layered", is_layered=True)
HEURISTICS = (LCF, LAYERED)

OPENING = SmallestSet("opening", "opening", "opening", Threading.TURNING_POINT, ", turning-point")
OVER_UNDER = SmallestSet(
    "over_under", "over-under", "opening", Threading.OVER_UNDER, ", over-under"
)
SPAN = SmallestSet("span", "span", "span", Threading.OVER_UNDER, ", `span`", "span")

PROGRAMS = (OPENING, OVER_UNDER, SPAN)
"""The smallest sets of an atlas, in the order of their columns."""
USUAL_PROGRAMS = tuple(method for method in PROGRAMS if method.is_usual)
"""One a formulation: those of Table I and of `compare`."""
JUDGES = {OPENING: "", OVER_UNDER: "_over_under"}
"""By which a heuristic's set is judged, and how its columns then end."""
