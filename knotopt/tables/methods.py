"""The methods that are compared: what each is called, how it is computed, what its columns mean.

Table I, `compare` and the atlas take their columns from here: a new formulation appears in all
three by one more line of `PROGRAMS`.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from fractions import Fraction
from typing import Any, ClassVar

from knotopt.cable.cable import Cable
from knotopt.cable.cut import Cut
from knotopt.diagram.grid import GridDiagram
from knotopt.document.columns import Column
from knotopt.supports.lcf import LcfResult, lcf_by_cut
from knotopt.supports.registry import find_formulation
from knotopt.supports.requirements import Requirements
from knotopt.supports.threading import Threading

Supports = tuple[int, ...]
_FEWER = "whether {} has fewer robots than any open set"
STATUSES = "optimal, feasible, infeasible, unknown, error; refused: the diagram is too large"
_POINTS = "turning points, from 1, without the ends"


@dataclass(frozen=True)
class Method:
    """What chooses a set of supports, and has columns in tables.

    Attributes
    ----------
    key : str
        With which the names of its columns begin.
    head : str
        Over its robots, where a table is shown.
    words : str
        Which set it is, in the meaning of a column.
    setting : str
        The setting of an atlas that asks for it; "": it is always there.
    """

    key: str
    head: str
    words: str
    setting: str = ""
    known: ClassVar[tuple[Column, ...]] = ()

    def columns(self, *chosen: str) -> tuple[Column, ...]:
        """Some of its columns, by their names without the key."""
        known = {column.name: column for column in self.known}
        return tuple(
            Column(
                f"{self.key}_{name}",
                known[name].kind,
                known[name].meaning.format(self.words),
                known[name].optional or bool(self.setting),
            )
            for name in chosen
        )

    def cells(self, **cells: Any) -> dict[str, Any]:
        """The cells under its columns, by their names without the key."""
        return {f"{self.key}_{name}": value for name, value in cells.items()}


def columns_of(methods: Iterable[Method], *chosen: str) -> tuple[Column, ...]:
    """The same columns of several methods, one method after the other."""
    return tuple(column for method in methods for column in method.columns(*chosen))


@dataclass(frozen=True)
class Heuristic(Method):
    """The Loop Consistency Filter, plain or layered: no program, and no promise."""

    is_layered: bool = False
    known = (
        Column("robots", int, "robots of {}"),
        Column("cut", str, "first cut where {} has the fewest robots"),
        Column("supports", Supports, f"{{}}: {_POINTS}"),
        Column("open", bool, "whether {} is open, turning-point"),
        Column("open_over_under", bool, "whether {} is open, over-under"),
        Column("below", bool, f"{_FEWER}, turning-point"),
        Column("below_over_under", bool, f"{_FEWER}, over-under"),
        Column("seconds", float, "{}, on all cuts together [s]"),
    )

    def best(self, diagram: GridDiagram, cuts: Iterable[Cut]) -> LcfResult:
        """Its set on the cut where it has the fewest robots, of several the first."""
        found = lcf_by_cut(diagram, layered=self.is_layered, cuts=cuts)
        return min(found.values(), key=lambda result: result.robots)


@dataclass(frozen=True)
class SmallestSet(Method):
    """The smallest set by a formulation, by its name, with what threads its regions, and whether
    every loop holds a support, too.
    """

    formulation: str = "opening"
    threading: Threading = Threading.TURNING_POINT
    with_loops: bool = False
    known = (
        Column("robots", int, "robots of a smallest open set, {}", True),
        Column("cut", str, "first cut where a smallest open set has the fewest robots, {}"),
        Column("supports", Supports, f"a smallest open set, {{}}: {_POINTS}", True),
        Column("bound", int, "no open set has fewer robots, {}", True),
        Column("status", str, STATUSES),
        Column("rows", int, "rows of the 0-1 program, {}"),
        Column("instance", str, "first 16 digits of the SHA-256 of that program"),
        Column("proven", bool, "whether no cut has a smaller open set, {}"),
        Column("same_cut", int, "robots of a smallest open set on LCF's cut, {}"),
        Column("open", bool, "whether the set is open, {}"),
        Column("seconds", float, "compile, build and solve, {} [s]"),
        Column("solve_seconds", float, "the solver alone, {} [s]"),
    )

    @property
    def is_usual(self) -> bool:
        """Whether the threading is the formulation's own, as where nothing is said of it."""
        return find_formulation(self.formulation).threading[0] is self.threading

    def requirements(self, openness: Fraction | float | None = None) -> Requirements:
        """What is asked of a set, with r = `openness` [grid steps]."""
        return Requirements(self.formulation, openness, self.threading, with_loops=self.with_loops)

    def is_met(self, cable: Cable, supports: Supports, openness: Fraction) -> bool:
        """Whether the independent checker finds a set open by the definition, r = `openness`."""
        check = find_formulation(self.formulation).checker(with_loops=self.with_loops)
        return check(cable.path, cable.diagram.size, supports, openness, self.threading).is_open


LCF = Heuristic("lcf", "LCF", "the Loop Consistency Filter's set")
LAYERED = Heuristic("layered", "layered", "LCF's layered set", is_layered=True)
HEURISTICS = (LCF, LAYERED)

_OVER_UNDER = Threading.OVER_UNDER
OPENING = SmallestSet("opening", "opening", "turning-point")
OVER_UNDER = SmallestSet("over_under", "over-under", "over-under", threading=_OVER_UNDER)
SPAN = SmallestSet("span", "span", "`span` without loops", "span", "span", _OVER_UNDER)
SAFE = SmallestSet(
    "safe", "safe", "`span` with loops", "span", "span", _OVER_UNDER, with_loops=True
)
LOOPS = SmallestSet("loops", "loops", "`loops`", formulation="loops")

PROGRAMS = (OPENING, OVER_UNDER, SPAN, SAFE, LOOPS)
"""The smallest sets of an atlas, in the order of their columns."""
USUAL_PROGRAMS = tuple(method for method in PROGRAMS if method.is_usual)
"""Each formulation in its own mode of threading, `span` without loops and with them (the safe set):
those of Table I and of `compare`."""
TRIED_PROGRAMS = (OPENING, SPAN)
"""Those that an atlas, where asked, also gives to several solvers, and whose sets it flies."""
JUDGES = {OPENING: "", OVER_UNDER: "_over_under"}
"""By which a heuristic's set is judged, and how its columns then end."""
