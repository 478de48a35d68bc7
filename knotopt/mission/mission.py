"""A mission: the plan of a flight, what was found out about it, and what came of it in physics."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from knotopt.export.recheck import FitReport
from knotopt.flight.examine import CrossingRow, Examination
from knotopt.flight.plan import FlightPlan
from knotopt.rehearsal.flown_set import FlownSet
from knotopt.sim.trials import Flight, wilson_interval
from knotopt.verify.flight_limits import Worst


@dataclass(frozen=True, eq=False)
class Mission:
    """A plan, what was found out about it, and its files for robots.

    Attributes
    ----------
    plan : FlightPlan
    examination : Examination
        Of the plan.
    exports : mapping of str to str
        Files that a swarm takes, by name.
    fit : FitReport
        Of the polynomials in them.
    steady : float or None
        Time of flight at one path speed throughout on the same route, if that was planned [s].
    flown : FlownSet or None
        Where the plan comes from, with physics.
    failed : Flight or None
        The first disturbed flight that did not tie the knot.
    disturbed : tuple of mapping
        What `flight_content` says of each disturbed flight; records of many would fill the memory.
    """

    plan: FlightPlan
    examination: Examination
    exports: Mapping[str, str]
    fit: FitReport
    steady: float | None = None
    flown: FlownSet | None = None
    failed: Flight | None = None
    disturbed: tuple[Mapping[str, Any], ...] = ()

    @property
    def flights(self) -> tuple[tuple[str, Flight], ...]:
        """Flights to be looked at, with their names: the undisturbed one, the first that failed."""
        named = () if self.flown is None else (("undisturbed", self.flown.undisturbed),)
        if self.failed is None:
            return named
        return *named, (seed_name(self.failed), self.failed)

    @property
    def reasons(self) -> tuple[str, ...]:
        """Why the plan is not good as it is: in sentences, empty if it is."""
        reasons = [f"the plan: {each}" for each in self.examination.limits.broken]
        reasons += [f"the polynomials: {each}" for each in self.fit.broken]
        if self.flown is None:
            reasons += [f"on laid cable: {row.sentence}" for row in self.examination.amiss]
        elif not self.flown.is_tied:
            reasons.append(f"the undisturbed flight: {self.flown.undisturbed.why}")
        return tuple(reasons)

    @property
    def tied(self) -> int:
        """How many disturbed flights tie the knot."""
        return sum(each["outcome"] == "tied" for each in self.disturbed)

    @property
    def interval(self) -> tuple[float, float] | None:
        """Wilson's 95 % interval for the share of disturbed flights that tie the knot."""
        return wilson_interval(self.tied, len(self.disturbed)) if self.disturbed else None

    @property
    def success(self) -> str:
        """How many disturbed flights tie the knot, in words."""
        if self.interval is None:
            return ""
        low, high = (round(100 * bound) for bound in self.interval)
        one = self.disturbed[0]
        blown = f", wind ({one['wind'][0]:g}, {one['wind'][1]:g}) m/s" if any(one["wind"]) else ""
        blown += f", gusts of {one['gust']:g} m/s" if one["gust"] else ""
        return (
            f"{self.tied} of {len(self.disturbed)} tie it (95 % interval {low} to {high} %); "
            f"noise of {1e3 * one['noise']:g} mm{blown}"
        )

    @property
    def taut(self) -> str:
        """Whether the cable, once taut, is the knot by the model of spans, in words."""
        lost = self.examination.lost
        if not lost:
            return "keeps every region of the knot"
        return f"need not be the knot: it loses {lost[0]}" + (
            f", and {len(lost) - 1} more" if lost[1:] else ""
        )

    @property
    def pulled(self) -> str:
        """How tight the knot is pulled, in words."""
        plan = self.plan
        ends, supports = plan.ends_apart, plan.supports_within
        return (
            f"in {plan.tightening:.1f} s more: ends {ends[0]:.2f}, then {ends[1]:.2f} m apart; "
            f"supports within {supports[0]:.2f}, then {supports[1]:.2f} m"
        )

    def measures(self) -> list[tuple[str, str]]:
        """Names and values for a reader."""
        plan, limits, fit = self.plan, self.examination.limits, self.fit
        time = f"{plan.laid:.1f} s, {plan.schedule} schedule"
        if self.steady is not None:
            shorter = round(100 * (1 - plan.laid / self.steady))
            time += f"; {self.steady:.1f} s at one pace throughout: {shorter} % shorter"
        least = f"{limits.separation.value:.2f} of the separation"
        found = [
            ("time of flight", time),
            *([("pulled tight", self.pulled)] if plan.tightening else []),
            ("cable", f"{plan.lengths.sum():.2f} m between robots, in all"),
            ("speed", f"{limits.speed.value:.2f} m/s at most; {_where(limits.speed)}"),
            (
                "acceleration",
                f"{limits.acceleration.value:.2f} m/s² at most; {_where(limits.acceleration)}",
            ),
            ("robots apart", f"{least} at least; {_where(limits.separation)}"),
            ("taut cable", self.taut),
            ("heights", f"{limits.lowest.value:.2f} to {limits.highest.value:.2f} m"),
            ("limits", "kept" if limits.ok else "NOT kept"),
            (
                "polynomials",
                f"within {1e3 * fit.deviation.value:.1f} mm of the plan, at most {fit.pieces} "
                f"pieces a robot" + (f" in {fit.parts} parts" if fit.parts > 1 else ""),
            ),
            ("their limits", "kept" if fit.reached else "NOT kept"),
        ]
        if self.flown is not None:
            flight, record = self.flown.undisturbed, self.flown.undisturbed.record
            ways = f"{self.flown.ways} ways tried in {self.flown.rehearsals} flights"
            found += [
                ("rehearsal", ways),
                ("undisturbed", flight.came_of),
                ("strands apart", f"{record.smallest_distance:.3f} m at least"),
                ("tension", f"{record.largest_tension:.2f} N at most"),
            ]
        if self.interval is not None:
            found.append(("disturbed", self.success))
        return found

    def crossings(self) -> list[tuple[str, CrossingRow]]:
        """Crossings as executed, of the undisturbed flight and of the first that failed."""
        return [
            (name, row)
            for name, flight in self.flights
            if flight.examination is not None
            for row in flight.examination.crossings
        ]


def seed_name(flight: Flight) -> str:
    """What a disturbed flight is called."""
    return f"seed {flight.record.disturbance.seed}"


def _where(worst: Worst) -> str:
    return f"robot{'s' * (len(worst.robots) > 1)} {' and '.join(map(str, worst.robots))} " + (
        f"at {worst.time:.1f} s"
    )
