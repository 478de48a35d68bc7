"""From grid steps to the room that the robots fly in: metres, altitudes, drones."""

from __future__ import annotations

from dataclasses import dataclass, fields, replace
from typing import TYPE_CHECKING

from knotopt.errors import RequirementError
from knotopt.path.requirements import LARGEST, PathRequirements
from knotopt.ranges import check_at_most, check_not_negative

if TYPE_CHECKING:
    from knotopt.path.curve import Curve
    from knotopt.path.result import PathResult

LARGEST_STEP = 1000.0  # [m]


@dataclass(frozen=True)
class World:
    """The scale of a flight, and what the drones and the room ask for [m].

    Parameters
    ----------
    step : float
        Length of a grid step.
    altitude : float
        Height above the ground at which robots hover.
    floor, ceiling : float
        Lowest and highest altitude that the cable may have.
    drone_height, downwash : float
        Height of a drone, and how far its downwash reaches below it: a drone that flies over a
        strand keeps their sum above it.

    Raises
    ------
    RequirementError
        A value that makes no sense.

    Examples
    --------
    >>> World(step=0.5, downwash=0.15).requirements(PathRequirements()).gap
    0.36
    >>> World(step=0.01)
    Traceback (most recent call last):
    ...
    knotopt.errors.RequirementError: a gap of 0.33 m is more than 10 grid steps of 0.01 m
    """

    step: float
    altitude: float = 1.5
    floor: float = 0.5
    ceiling: float = 2.5
    drone_height: float = 0.03
    downwash: float = 0.3

    def __post_init__(self) -> None:
        names = [field.name for field in fields(self)]
        check_not_negative(self, names, "a length in metres")
        if not self.step > 0:
            raise RequirementError(f"a grid step is a positive length in metres, not {self.step}")
        check_at_most(self, {"step": (LARGEST_STEP, " m")})
        if not self.gap > 0:
            raise RequirementError("a drone and its downwash need some height; 0 m is none")
        if self.gap > LARGEST * self.step:
            raise RequirementError(
                f"a gap of {self.gap:g} m is more than {LARGEST:g} grid steps of {self.step:g} m"
            )
        if self.gap > self.ceiling - self.floor:
            raise RequirementError(
                f"between the floor {self.floor:g} m and the ceiling {self.ceiling:g} m there is "
                f"no room for a gap of {self.gap:g} m"
            )
        if not self.floor < self.altitude < self.ceiling:
            raise RequirementError(
                f"the altitude {self.altitude:g} m is not between the floor {self.floor:g} m and "
                f"the ceiling {self.ceiling:g} m"
            )

    @property
    def gap(self) -> float:
        """Vertical gap that a drone needs at a crossing [m]."""
        return self.drone_height + self.downwash

    def requirements(self, asked: PathRequirements) -> PathRequirements:
        """The requirements with gap, floor and ceiling of this world, in grid steps."""
        return replace(
            asked,
            gap=round(self.gap / self.step, 9),
            floor=(self.floor - self.altitude) / self.step,
            ceiling=(self.ceiling - self.altitude) / self.step,
        )

    def curve(self, result: PathResult) -> Curve:
        """A path in metres; z is the altitude."""
        points = result.curve.points * self.step + (0.0, 0.0, self.altitude)
        return replace(result.curve, points=points)

    def measures(self, result: PathResult) -> dict[str, float]:
        """Lengths of a path that matter in the room [m]."""
        report, step = result.report, self.step
        return {
            "cable_length": result.curve.length * step,
            "shortest_possible": result.taut_length * step,
            "smallest_radius": report.smallest_radius * step,
            "clearance": report.clearance * step,
            "vertical_gap": report.gap * step,
            "vertical_gap_needed": self.gap,
            "nearest_to_a_robot": report.nearest_to_a_robot * step,
            "lowest": self.altitude + report.lowest * step,
            "highest": self.altitude + report.highest * step,
            "above_floor": self.altitude + report.lowest * step - self.floor,
            "below_ceiling": self.ceiling - self.altitude - report.highest * step,
        }
