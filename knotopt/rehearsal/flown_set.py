"""One set of supports, flown: the one value that rehearsing, tightening and cutting off hand on."""

from __future__ import annotations

from dataclasses import dataclass, replace

from knotopt.flight.plan import FlightPlan
from knotopt.sim.trials import Flight


@dataclass(frozen=True, eq=False)
class FlownSet:
    """A plan for a set of supports, what came of flying it, and how it was found.

    Attributes
    ----------
    undisturbed : Flight
        Of the plan; its schedule is "rehearsed" where the optimised one did not tie the knot.
    disturbed : tuple of Flight
        With other disturbances than those that the plan was chosen by.
    robust : int
        In how many of the disturbed flights by which the plan was chosen the knot was tied. Its
        success rate is for other disturbances to tell.
    separation : float
        Least distance of two robots in the plan, 1 on the ellipsoid of the limits.
    steady : float
        Duration of the same flight at one path speed throughout [s].
    given_up : tuple of str
        Crossings that no way tried made happen, in the order of flight.
    rehearsals, ways : int
        Flights begun anew, and ways from crossing to crossing that were simulated; none where a
        modelled route is flown.
    """

    undisturbed: Flight
    disturbed: tuple[Flight, ...] = ()
    robust: int = 0
    separation: float = 1.0
    steady: float = 0.0
    given_up: tuple[str, ...] = ()
    rehearsals: int = 0
    ways: int = 0

    @property
    def plan(self) -> FlightPlan:
        """The plan that is flown."""
        return self.undisturbed.plan

    @property
    def flights(self) -> tuple[Flight, ...]:
        """All flights, the undisturbed one first."""
        return self.undisturbed, *self.disturbed

    @property
    def lost(self) -> Flight | None:
        """The first flight that does not tie the knot."""
        return next((flight for flight in self.flights if not flight.is_tied), None)

    @property
    def is_tied(self) -> bool:
        """Whether every flight ties the knot wanted."""
        return self.lost is None

    @property
    def against(self) -> str:
        """What speaks against flying it, "" if nothing does."""
        if self.lost is not None:
            return str(self.lost.verdict)
        if self.separation < 1:
            return f"robots come within {self.separation:.2f} of their separation"
        return ""

    @property
    def rank(self) -> tuple[bool, bool, int, int]:
        """Larger is better: tied, robots apart, robust, few crossings given up."""
        return self.is_tied, self.separation >= 1, self.robust, -len(self.given_up)

    def noted(self, *notes: str) -> FlownSet:
        """The same with further notes of its plan."""
        return replace(self, undisturbed=replace(self.undisturbed, plan=self.plan.noted(*notes)))
