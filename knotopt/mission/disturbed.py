"""The disturbed flights of a mission: how many, and what disturbs them."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from knotopt.ranges import MOST_FLIGHTS, check_at_most

if TYPE_CHECKING:  # the command line takes its defaults from here: no arrays for `--help`
    from knotopt.flight.record import Disturbance


@dataclass(frozen=True)
class DisturbedFlights:
    """Flights of one plan with consecutive seeds.

    Parameters
    ----------
    noise, wind, gust, seed
        Of the first one, as for `Disturbance`.
    runs : int
        How many.

    Examples
    --------
    >>> [each.seed for each in DisturbedFlights(seed=7, runs=2).disturbances()]
    [7, 8]
    """

    noise: float = 0.01
    wind: tuple[float, float] = (0.0, 0.0)
    gust: float = 0.0
    seed: int = 1
    runs: int = 5

    def disturbances(self) -> list[Disturbance]:
        """Of each flight.

        Raises
        ------
        RequirementError
            A value that makes no sense.
        """
        from knotopt.flight.record import Disturbance

        check_at_most(self, {"runs": (MOST_FLIGHTS, "")})
        first = Disturbance(self.noise, self.wind, self.gust, self.seed)
        return [replace(first, seed=self.seed + k) for k in range(self.runs)]
