"""What is asked of a flight, whatever the supports."""

from __future__ import annotations

from dataclasses import dataclass, field

from knotopt.errors import RequirementError
from knotopt.flight.limits import ROOM, FlightLimits
from knotopt.path.world import World
from knotopt.supports.requirements import Requirements

SCHEDULES = ("optimised", "fixed")

FLOWN = Requirements("span", 0.25)
"""What a smallest set is asked for if it is to be flown, unless something else is."""


@dataclass(frozen=True)
class FlightRequest:
    """A flight that is asked for.

    Parameters
    ----------
    name : str
        Of the knot.
    chosen_by : str
        How its supports were chosen: "milp", "lcf", "all" or a file.
    world : World
        The room.
    limits : FlightLimits
        Of the robots, the file and the cable.
    schedule : str
        "optimised", or "fixed": at one path speed throughout, as in the paper.

    Raises
    ------
    RequirementError
        A schedule of no such name.

    Examples
    --------
    >>> FlightRequest("3_1", schedule="quick")
    Traceback (most recent call last):
    ...
    knotopt.errors.RequirementError: a schedule is one of optimised, fixed, not 'quick'
    """

    name: str
    chosen_by: str = "all"
    world: World = ROOM
    limits: FlightLimits = field(default_factory=FlightLimits)
    schedule: str = "optimised"

    def __post_init__(self) -> None:
        if self.schedule not in SCHEDULES:
            names = ", ".join(SCHEDULES)
            raise RequirementError(f"a schedule is one of {names}, not {self.schedule!r}")
