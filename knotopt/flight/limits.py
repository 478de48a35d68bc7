"""What robots may do in the air: speeds, distances, cable."""

from __future__ import annotations

import math
from dataclasses import dataclass

from knotopt.errors import RequirementError
from knotopt.path.world import World
from knotopt.ranges import check_not_negative

ROOM = World(step=0.5, altitude=2.2, floor=0.2, ceiling=3.2)
"""The room that flights are planned for unless another is given."""

RANGES = {
    "speed": (0.01, 20.0, "m/s"),
    "acceleration": (0.01, 100.0, "m/s^2"),
    "separation": (0.01, 10.0, "m"),
    "downwash": (0.01, 10.0, "m"),
    "spacing": (0.01, 10.0, "m"),
    "slack": (0.0, 10.0, "of it"),
    "hover_before": (0.05, 600.0, "s"),
    "hover_after": (0.05, 600.0, "s"),
}
"""Of what a quadrotor may be asked; beyond, flights take days or programs are out of scale. Without
a moment of hovering robots would have to accelerate all at once, which no polynomial does."""


@dataclass(frozen=True)
class FlightLimits:
    """Limits of a flight [m, s].

    Parameters
    ----------
    speed, acceleration : float
        Largest speed [m/s] and acceleration [m/s^2] of a robot.
    separation : float
        Distance that two robots at one height keep [m].
    downwash : float
        Distance that a robot keeps straight below another [m]. In between, the lower robot stays
        outside the ellipsoid with these semi-axes about the upper one.
    spacing : float
        Distance between robots in single file, along the route [m].
    slack : float
        Cable between two robots beyond the farthest that they get apart, as a share of it.
    hover_before, hover_after : float
        Time that every robot hovers before and after [s].

    Raises
    ------
    RequirementError
        A value outside `RANGES`, or a file whose robots would be too close.

    Examples
    --------
    >>> FlightLimits(spacing=0.1)
    Traceback (most recent call last):
    ...
    knotopt.errors.RequirementError: a spacing of 0.1 m is less than the separation of 0.2 m
    """

    speed: float = 0.6
    acceleration: float = 1.5
    separation: float = 0.2
    downwash: float = 0.33
    spacing: float = 0.3
    slack: float = 0.1
    hover_before: float = 2.0
    hover_after: float = 3.0

    def __post_init__(self) -> None:
        check_not_negative(self, RANGES, "a number from 0 up")
        for name, (least, most, unit) in RANGES.items():
            value = getattr(self, name)
            if least and not value:
                raise RequirementError(f"{name} must be positive")
            if not least <= value <= most:
                raise RequirementError(
                    f"{name} lies between {least:g} and {most:g} {unit}, not at {value!r}"
                )
        if _is_less(self.downwash, self.separation):
            raise RequirementError(
                f"a downwash of {self.downwash} m is less than the separation of "
                f"{self.separation} m: the ellipsoid is larger below, not beside"
            )
        if _is_less(self.spacing, self.separation):
            raise RequirementError(
                f"a spacing of {self.spacing} m is less than the separation of {self.separation} m"
            )


def _is_less(distance: float, other: float) -> bool:
    """Whether one is less than the other by more than the rounding of 3 * 0.1."""
    return distance < other and not math.isclose(distance, other)
