"""The smallest teams that are known to tie a knot in simulation, from the stored flights.

`python -m benchmarks flown` writes the file anew. A team counts that ties the knot undisturbed and
in at least three of four disturbed flights, with its robots apart throughout; the disturbances are
others than those that its plan was chosen by.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache

from knotopt.catalogue.knots import shipped_json
from knotopt.diagram.grid import GridDiagram, Mark


@dataclass(frozen=True)
class FlownTeam:
    """A team that ties a knot, or its mirror image, in simulation.

    Attributes
    ----------
    knot : str
        KnotInfo's name, up to mirror image: the mirror image of a flight ties the mirror image.
    marks : tuple of [column, row]
        The grid flown.
    cut : str
    supports : tuple of int
        Turning points with a support robot (1-based).
    step : float
        Metres per grid step.
    tied, flights : int
        In how many of so many disturbed flights it ties the knot.
    noise : float
        Standard deviation of the robots' positions in these flights [m].
    results : str
        The benchmark that flew it.
    """

    knot: str
    marks: tuple[Mark, ...]
    cut: str
    supports: tuple[int, ...]
    step: float
    tied: int
    flights: int
    noise: float
    results: str

    @property
    def robots(self) -> int:
        """With the two at the ends of the cable."""
        return len(self.supports) + 2

    @property
    def diagram(self) -> GridDiagram:
        """The grid flown."""
        return GridDiagram.from_marks(self.marks)


@cache
def flown_teams() -> dict[str, FlownTeam]:
    """The smallest team that flies, by the knot's name.

    Examples
    --------
    >>> team = flown_teams()["3_1"]
    >>> team.robots, team.cut, team.supports, f"{team.tied} of {team.flights}"
    (3, 'L+', (4,), '12 of 12')
    """
    return {
        entry["knot"]: FlownTeam(
            **{key: value for key, value in entry.items() if key not in ("grid", "supports")},
            marks=tuple((column, row) for column, row in entry["grid"]),
            supports=tuple(entry["supports"]),
        )
        for entry in shipped_json("flown.json")
    }
