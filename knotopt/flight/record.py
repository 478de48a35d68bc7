"""What happened in a flight, simulated or measured: the cable and its robots over time."""

from __future__ import annotations

import math
from dataclasses import dataclass

from knotopt.arrays import FloatArray, IntArray
from knotopt.errors import RequirementError
from knotopt.ranges import LARGEST_NOISE, LARGEST_WIND, check_at_most, check_not_negative


@dataclass(frozen=True)
class Disturbance:
    """What disturbs a flight.

    Parameters
    ----------
    noise : float
        Standard deviation of every robot's position error, slowly varying [m].
    wind : tuple of float
        Steady wind (x, y) [m/s].
    gust : float
        Standard deviation of the wind about it [m/s].
    seed : int
        Of the random numbers, from 0 up.

    Raises
    ------
    RequirementError
        A value that makes no sense.

    Examples
    --------
    >>> Disturbance(noise=-0.01)
    Traceback (most recent call last):
    ...
    knotopt.errors.RequirementError: noise is a number from 0 up, not -0.01
    """

    noise: float = 0.0
    wind: tuple[float, float] = (0.0, 0.0)
    gust: float = 0.0
    seed: int = 0

    def __post_init__(self) -> None:
        check_not_negative(self, ("noise", "gust"), "a number from 0 up")
        check_at_most(self, {"noise": (LARGEST_NOISE, " m"), "gust": (LARGEST_WIND, " m/s")})
        wind: object = self.wind
        if not isinstance(wind, tuple) or len(wind) != 2 or not all(map(_is_finite, wind)):
            raise RequirementError(f"wind is two numbers (x, y), not {wind!r}")
        if max(map(abs, self.wind)) > LARGEST_WIND:
            raise RequirementError(f"wind is at most {LARGEST_WIND:g} m/s, not {wind!r}")
        if not isinstance(self.seed, int) or self.seed < 0:
            raise RequirementError(f"seed is a whole number from 0 up, not {self.seed!r}")


@dataclass(frozen=True, eq=False)
class FlightRecord:
    """A flight as it happened.

    Attributes
    ----------
    times : float array, shape (T,)
        Evenly spaced [s].
    clock : float array, shape (T,)
        Time of the plan that the robots were following; it waits for late robots [s].
    cable : float array, shape (T, M, 3)
        Centreline of the cable from p_1 to p_2N [m].
    held : int array, shape (R,)
        Vertex of the centreline that each robot holds; robots' positions are those.
    finished : bool
        Whether the plan's end was reached; else a taut cable held the robots back.
    smallest_distance : float
        Least distance of two strands at any time, centreline to centreline [m].
    largest_tension : float
        [N]
    disturbance : Disturbance
    seconds : float
        It took to simulate [s].
    """

    times: FloatArray
    clock: FloatArray
    cable: FloatArray
    held: IntArray
    finished: bool
    smallest_distance: float
    largest_tension: float
    disturbance: Disturbance
    seconds: float

    @property
    def robots(self) -> FloatArray:
        """Positions of the robots, shape (T, R, 3) [m]."""
        robots: FloatArray = self.cable[:, self.held]
        return robots


def _is_finite(value: object) -> bool:
    return isinstance(value, int | float) and math.isfinite(value)
