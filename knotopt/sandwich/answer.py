"""How many robots a knot takes: the least for the knot, to lay its diagram, flown, and safe.

Below stands what is proven necessary, above what is flown in simulation and what keeps every loop
and region open; where the first and the flown meet, the number of robots is settled.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

from formulations.backends import DEFAULT
from formulations.solution import Limits
from knotopt.catalogue.stored_grids import stored_grid
from knotopt.diagram.grid import GridDiagram
from knotopt.identify.identify import Identified
from knotopt.reading.identification import identify_read
from knotopt.reading.record import NamedDiagram
from knotopt.sandwich.known import KnownOfKnot, known_of_knot
from knotopt.search.budget import Budget
from knotopt.supports.diagram_search import DiagramSearch, find_diagram
from knotopt.supports.lcf import LcfResult, best_cut
from knotopt.supports.minimal import MinimalSupports
from knotopt.supports.requirements import Requirements
from knotopt.supports.search import best_supports

BUDGET = Budget(seconds=2.0)
"""Of the search for a grid on which the safe set is small."""

LARGEST_SAFE = 26
"""Grid size above which formulation `span` takes minutes."""


@dataclass(frozen=True)
class Answer:
    """What is known of the number of robots that tie a knot.

    Attributes
    ----------
    named : NamedDiagram
        The diagram asked about.
    identified : Identified
        Which knot it is, by invariants.
    known : KnownOfKnot
        Whatever its diagram.
    laid : MinimalSupports
        The least to hold every loop of the diagram asked about, over its cuts (`loops`).
    safe_search : DiagramSearch or None
        For the smallest safe set (`span` with loops), over grids of the knot; None where the
        smallest grid at hand is larger than `LARGEST_SAFE`.
    lcf : LcfResult
        The heuristic's set, on the diagram asked about.
    seed : int
    """

    named: NamedDiagram
    identified: Identified
    known: KnownOfKnot
    laid: MinimalSupports
    safe_search: DiagramSearch | None
    lcf: LcfResult
    seed: int

    @property
    def safe(self) -> MinimalSupports | None:
        """The smallest safe set found, on the grid on which it is; None if none was."""
        if self.safe_search is None or not self.safe_search.best.best.found:
            return None
        return self.safe_search.best.best

    @property
    def baseline(self) -> int:
        """Robots with one at every turning point of the diagram asked about."""
        return self.laid.baseline

    @cached_property
    def is_settled(self) -> bool:
        """Whether as few robots as are needed fly."""
        needed, flown = self.known.needed, self.known.flown
        return self.is_unknot or (flown is not None and flown.robots == needed.robots)

    @property
    def is_unknot(self) -> bool:
        """Whether there is nothing to tie."""
        return self.identified.name == "0_1"


def answer(
    named: NamedDiagram,
    *,
    openness: float | None = None,
    budget: Budget = BUDGET,
    seed: int = 0,
    solver: str = DEFAULT,
    limits: Limits | None = None,
) -> Answer:
    """How many robots the knot of a diagram takes.

    Parameters
    ----------
    named : NamedDiagram
    openness : float, optional
        r of the safe set [grid steps]; by default half a step.
    budget : Budget
        Of the search for a grid on which the safe set is small.
    seed : int
        Of that search, and of the simplification before the knot is identified.
    solver, limits
        As for `best_supports`.

    Examples
    --------
    >>> from knotopt.reading.knot import read_knot
    >>> found = answer(read_knot("3"), budget=Budget(grids=1000))
    >>> found.known.needed.robots, found.laid.robots, found.known.flown.robots, found.safe.robots
    (3, 3, 3, 4)
    >>> found.lcf.robots, found.baseline, found.is_settled
    (5, 10, True)
    """
    identified = identify_read(named, seed=seed)
    # A torus knot beyond the tables is known by its name.
    own = (named.name,) if named.source == "torus knot" else ()
    known = known_of_knot(identified.candidates or own, identified.invariants.alexander or ())
    laid = best_supports(named.diagram, Requirements("loops"), limits=limits).best
    start = min(named.diagram, identified.grid, key=lambda grid: grid.size)
    safe = None
    if start.size <= LARGEST_SAFE:
        safe = find_diagram(
            start,
            Requirements("span", openness, with_loops=True),
            budget,
            seed,
            starts=_grids_at_hand(identified),
            solver=solver,
            limits=limits,
        )
    return Answer(named, identified, known, laid, safe, best_cut(named.diagram), seed)


def _grids_at_hand(identified: Identified) -> list[GridDiagram]:
    """The stored grids with small safe sets, of a knot that is named for certain."""
    if identified.name is None or not identified.proven:
        return []
    stored = [stored_grid(identified.name, f"safe{openness}") for openness in ("0.5", "0.25")]
    return [grid for grid in stored if grid is not None]
