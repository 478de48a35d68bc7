"""The simulators at hand. Another one is a class that follows `Simulation`, and a line here."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from knotopt.arrays import FloatArray
from knotopt.errors import require_extra
from knotopt.flight.record import Disturbance
from knotopt.sim.mujoco_simulation import MujocoSimulation
from knotopt.sim.simulation import Simulation


@dataclass(frozen=True)
class Simulator:
    """A way to simulate flights.

    Parameters
    ----------
    name : str
    package, extra : str
        What has to be installed for it, and the extra of knotopt that installs that.
    begin : callable
        Begins a simulation, with the parameters of `start`; imports the package no earlier.
    """

    name: str
    package: str
    extra: str
    begin: Callable[..., Simulation]

    def require(self) -> None:
        """Refuse to go on where flights cannot be simulated; nothing is computed in vain then.

        Raises
        ------
        MissingExtraError
            The package is not installed; the message is the line that installs it.
        """
        require_extra(self.package, self.extra, "simulating a flight")

    def start(
        self,
        start: FloatArray,
        lengths: FloatArray,
        *,
        step: float,
        speed: float,
        disturbance: Disturbance | None = None,
    ) -> Simulation:
        """Robots hover in their file, the cable hanging between them.

        Parameters
        ----------
        start : float array, shape (R, 3)
            Positions of the robots [m].
        lengths : float array, shape (R - 1,)
            Of cable between consecutive robots [m].
        step : float
            Grid step [m].
        speed : float
            Largest speed of a robot [m/s].
        disturbance : Disturbance, optional

        Raises
        ------
        MissingExtraError
            As `require` raises it.
        RequirementError
            Robots that start too close or farther apart than the cable is long, or a cable that
            cannot be simulated.
        """
        self.require()
        return self.begin(
            start, lengths, step=step, speed=speed, disturbance=disturbance or Disturbance()
        )


MUJOCO = Simulator("mujoco", "mujoco", "sim", MujocoSimulation)

SIMULATORS = {simulator.name: simulator for simulator in (MUJOCO,)}
