"""What cable and robots are made of."""

from __future__ import annotations

from dataclasses import dataclass, fields

from knotopt.errors import RequirementError
from knotopt.ranges import check_not_negative


@dataclass(frozen=True)
class Material:
    """Cable and robots of a simulated flight.

    Parameters
    ----------
    radius : float
        Of the cable, in contact with itself [m].
    density : float
        Mass of the cable per length [kg/m].
    edge : float
        Length of the straight pieces that the cable is made of, about [grid steps].
    bending : float
        Length over which the cable bends under its own weight, (EI / w)^(1/3) with bending
        stiffness EI and weight per length w [grid steps].
    drag_time : float
        Time in which moving air takes a loose piece of cable along [s].
    friction : float
        Coefficient of cable on cable; without any, contacts are cheaper to compute.
    robot_mass : float
        [kg]
    response : float
        Time in which a robot takes up the velocity that is commanded [s].
    force : float
        That a robot has to spare for the cable, along each axis [N].

    Raises
    ------
    RequirementError
        A value that makes no sense.

    Examples
    --------
    >>> Material(radius=-1.0)
    Traceback (most recent call last):
    ...
    knotopt.errors.RequirementError: radius is a positive number, not -1.0
    """

    radius: float = 0.02
    density: float = 0.002
    edge: float = 0.2
    bending: float = 0.3
    drag_time: float = 0.3
    friction: float = 0.0
    robot_mass: float = 0.03
    response: float = 0.01
    force: float = 0.5

    def __post_init__(self) -> None:
        names = [field.name for field in fields(self)]
        check_not_negative(self, names, "a positive number")
        for name in names:
            if getattr(self, name) == 0 and name not in ("bending", "friction"):
                raise RequirementError(f"{name} is a positive number, not 0")
