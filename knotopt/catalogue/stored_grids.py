"""Grids of the shipped knots that were searched for few robots.

Others may do better, but for best4: no diagram of the knot has fewer crossings.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache

from knotopt.catalogue.knots import shipped_json
from knotopt.diagram.grid import GridDiagram

GRIDS = {
    "best3": "fewest crossings for at most 3 robots",
    "best4": "fewest crossings for at most 4 robots",
    "safe0.5": "smallest safe set at r = 0.5",
    "safe0.25": "smallest safe set at r = 0.25",
}
"""What is stored for each knot: for `loops` then the smallest grid, for `span` with loops."""


@dataclass(frozen=True)
class StoredGrid:
    """A grid that was searched for.

    Attributes
    ----------
    knot, name : str
        KnotInfo's name, and what the grid is best for.
    robots : int
        That lay it, or of its smallest safe set, over all crossing-free cuts.
    minus, plus : tuple of int
        As of `GridDiagram`.
    seed, runs : int
        That found it: of so many runs of annealing from KnotInfo's grid.
    solved : int
        Of safe sets: grids solved after these runs.
    """

    knot: str
    name: str
    robots: int
    minus: tuple[int, ...]
    plus: tuple[int, ...]
    seed: int
    runs: int
    solved: int = 0

    @property
    def diagram(self) -> GridDiagram:
        """The grid itself."""
        return GridDiagram(self.minus, self.plus)


@cache
def stored_grids() -> dict[tuple[str, str], StoredGrid]:
    """The stored grids by knot and name.

    Examples
    --------
    >>> stored = stored_grids()["8_19", "best3"]
    >>> stored.robots, int(stored.diagram.crossing_cells.sum())
    (3, 8)
    """
    entries = [*shipped_json("laid_grids.json"), *shipped_json("safe_grids.json")]
    return {
        (entry["knot"], entry["name"]): StoredGrid(
            **entry | {"minus": tuple(entry["minus"]), "plus": tuple(entry["plus"])}
        )
        for entry in entries
    }


def stored_grid(knot: str, name: str) -> GridDiagram | None:
    """The grid of a knot by name, or of its mirror image; None if none is stored.

    Examples
    --------
    >>> stored_grid("m8_19", "best4") == stored_grid("8_19", "best4").mirrored
    True
    """
    stored = stored_grids().get((knot.removeprefix("m"), name))
    if stored is None:
        return None
    return stored.diagram.mirrored if knot.startswith("m") else stored.diagram
