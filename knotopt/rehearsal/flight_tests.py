"""In which flights a set of supports must tie the knot, and how many sets are flown."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

from knotopt.errors import RequirementError
from knotopt.ranges import LARGEST_NOISE, MOST_FLIGHTS, check_at_most

if TYPE_CHECKING:  # the command line takes its defaults from here: no arrays for `--help`
    from knotopt.flight.record import Disturbance


@dataclass(frozen=True)
class FlightTests:
    """What a set of supports is tested by.

    Parameters
    ----------
    noise : float
        Standard deviation of every robot's position error in the disturbed flights [m].
    trials : int
        How many disturbed flights must tie the knot, beside the undisturbed one.
    seconds : float, optional
        No further set is flown after so much time; the flight at hand is finished [s].
    max_cut : int, optional
        No further set is flown once so many are cut off. Counts unless there is a budget of time.

    Raises
    ------
    RequirementError
        A number that makes no sense.

    Examples
    --------
    >>> FlightTests(trials=0)
    Traceback (most recent call last):
    ...
    knotopt.errors.RequirementError: the disturbed flights are at least 1, not 0
    """

    noise: float = 0.01
    trials: int = 3
    seconds: float | None = None
    max_cut: int | None = None

    MAX_CUT = 20
    """Sets that are cut off at most where neither number nor time is limited otherwise."""

    def __post_init__(self) -> None:
        if not (math.isfinite(self.noise) and self.noise >= 0):
            raise RequirementError(f"the noise is a number of metres from 0 up, not {self.noise:g}")
        check_at_most(self, {"noise": (LARGEST_NOISE, " m"), "trials": (MOST_FLIGHTS, "")})
        if self.trials < 1:
            raise RequirementError(f"the disturbed flights are at least 1, not {self.trials}")
        if self.seconds is not None and not self.seconds > 0:
            raise RequirementError(f"the time for flights must be positive, not {self.seconds:g} s")
        if self.max_cut is not None and self.max_cut < 1:
            raise RequirementError(f"at least 1 set may be cut off, not {self.max_cut}")

    @property
    def most_cut(self) -> float:
        """Number of sets cut off after which no further one is flown."""
        if self.max_cut is not None:
            return self.max_cut
        return self.MAX_CUT if self.seconds is None else math.inf

    @property
    def disturbances(self) -> list[Disturbance]:
        """Of the disturbed flights, with seeds 1, 2, ..."""
        from knotopt.flight.record import Disturbance

        return [Disturbance(self.noise, seed=seed) for seed in range(1, self.trials + 1)]
