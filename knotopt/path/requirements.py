"""What is asked of a cable's path, in grid steps."""

from __future__ import annotations

import math
from dataclasses import dataclass, fields

from knotopt.errors import RequirementError

NEIGHBOURHOOD = 4.0
"""Two points of the cable count as apart if the way between them along the cable, changing strands
at crossings, is longer than so many clearances. Strands that are `clearance` apart at that distance
leave a crossing at an angle of at least 2 asin(1 / NEIGHBOURHOOD) = 29 degrees."""

LARGEST = 10.0  # of clearance, opening and gap that are considered [grid steps]
STEEPEST = 1000.0  # slope, and weight of bending [grid steps], that are considered


@dataclass(frozen=True)
class PathRequirements:
    """Limits and weights of a path; lengths in grid steps, heights above the robots' own.

    Parameters
    ----------
    clearance : float
        Smallest distance in plan between strands, away from crossings (see `NEIGHBOURHOOD`).
    opening : float
        Room where a strand threads an active region: some point of it, in the region, is so far
        from the region's boundary.
    gap : float
        Smallest vertical distance between the strands at a crossing.
    slope : float
        Steepest rise or fall of the cable, height over length in plan, on stretches of 0.1.
    floor, ceiling : float
        Lowest and highest the cable may get; robots hover at height 0.
    bending : float
        Weight of the bending, the integral of the squared curvature along the cable, against its
        length [grid steps]: a straight span and a circle of radius r trade length 2 pi r against
        bending 2 pi / r, so free bends have radii of up to sqrt(bending).

    Raises
    ------
    RequirementError
        A value that makes no sense.

    Examples
    --------
    >>> PathRequirements(clearance=-1)
    Traceback (most recent call last):
    ...
    knotopt.errors.RequirementError: clearance must be a positive number of grid steps, not -1
    """

    clearance: float = 0.15
    opening: float = 0.25
    gap: float = 0.3
    slope: float = 1.0
    floor: float = -1.0
    ceiling: float = 1.0
    bending: float = 0.04

    def __post_init__(self) -> None:
        for field in fields(self):
            value = getattr(self, field.name)
            if not isinstance(value, int | float) or not math.isfinite(value):
                raise RequirementError(f"{field.name} must be a finite number, not {value!r}")
        for name in ("clearance", "opening", "gap", "slope", "bending"):
            value = getattr(self, name)
            if value <= 0:
                unit = "" if name == "slope" else " of grid steps"
                raise RequirementError(f"{name} must be a positive number{unit}, not {value}")
        for name in ("clearance", "opening", "gap"):
            if getattr(self, name) > LARGEST:
                raise RequirementError(
                    f"{name} {getattr(self, name):g} is more than {LARGEST:g} grid steps"
                )
        for name in ("slope", "bending"):
            if getattr(self, name) > STEEPEST:
                raise RequirementError(f"{name} is at most {STEEPEST:g}, not {getattr(self, name)}")
        if not self.floor < 0 < self.ceiling:
            raise RequirementError(
                "robots hover at height 0, between floor and ceiling; "
                f"not so with floor {self.floor:g} and ceiling {self.ceiling:g}"
            )
        if self.ceiling - self.floor < self.gap:
            raise RequirementError(
                f"between floor {self.floor:g} and ceiling {self.ceiling:g} grid steps "
                f"there is no room for a gap of {self.gap:g}"
            )

    @property
    def neighbourhood(self) -> float:
        """How long the way along the cable between two points is at least [grid steps] for their
        distance to count."""
        return NEIGHBOURHOOD * self.clearance

    @property
    def crossing_angle(self) -> float:
        """Smallest angle between strands at a crossing or a robot [rad]."""
        return 2 * math.asin(1 / NEIGHBOURHOOD)
