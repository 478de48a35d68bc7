"""What a simulated flight is to everything that flies: a cable and its robots, under way.

Whatever computes it follows this protocol. Rehearsals, trials and tightening know nothing else of a
simulation; `knotopt.sim.simulators` lists what there is.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, Protocol

from knotopt.arrays import FloatArray, IntArray
from knotopt.flight.record import FlightRecord

FRAME_TIME = 0.1  # between frames of the record [s]
STALL = 5.0  # time without progress after which robots are stuck [s]
PROGRESS = 0.25  # of the clock that counts as such [s]

Checkpoint = Any
"""What a simulation gives to come back to; only itself knows what is in it."""


class Simulation(Protocol):
    """A cable and its robots in the air, from the start of a flight on.

    A plan is followed by a clock that waits for robots that are late. Where the cable holds a robot
    back the clock stands still; after `STALL` without `PROGRESS` the robots are stuck.
    """

    @property
    def cable(self) -> FloatArray:
        """The centreline now, from p_1 to p_2N, shape (M, 3) [m]."""

    @property
    def held(self) -> IntArray:
        """Vertex of the centreline that each robot holds, shape (R,)."""

    @property
    def robots(self) -> FloatArray:
        """Positions of the robots now, shape (R, 3) [m]."""

    @property
    def clock(self) -> float:
        """Time of the plan that the robots are at [s]."""

    def follow(self, positions: FloatArray, interval: float) -> bool:
        """Fly along setpoints.

        Parameters
        ----------
        positions : float array, shape (T, R, 3)
            Of the robots at evenly spaced times, the first one now [m].
        interval : float
            Between them, by the clock [s].

        Returns
        -------
        bool
            Whether the last of them was reached, not stuck before.

        Raises
        ------
        RequirementError
            Setpoints that are not finite, or not of these robots, or an interval of no time.
        """

    def pull(self, velocities: FloatArray, goes_on: Callable[[FloatArray], bool]) -> bool:
        """Fly some robots steadily away; the others keep their height and go where cable draws.

        Parameters
        ----------
        velocities : float array, shape (R, 3)
            Of the robots that pull; 0 for the others [m/s].
        goes_on : callable
            Of the robots' positions, shape (R, 3) [m]: whether to pull on.

        Returns
        -------
        bool
            Whether it went on for as long as it should; else the cable holds the robots.
        """

    def checkpoint(self) -> Checkpoint:
        """A point to come back to."""

    def restore(self, checkpoint: Checkpoint) -> None:
        """Go back to a checkpoint of this simulation; what follows is what would have followed."""

    def record(self) -> FlightRecord:
        """What happened since the start, a frame every `FRAME_TIME`."""
