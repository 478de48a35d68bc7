"""What came of planning a flight and, in physics, of flying it: measures, verdicts, reasons."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import asdict, dataclass, fields
from typing import TYPE_CHECKING, Any

from knotopt.export.recheck import FitReport
from knotopt.flight.examine import CrossingRow, Examination, examine_flight
from knotopt.flight.plan import FlightPlan
from knotopt.flight.record import FlightRecord
from knotopt.supports.support_set import place
from knotopt.verify.flight_limits import LimitsReport, Worst
from knotopt.verify.flight_states import StateComparison, format_states

if TYPE_CHECKING:
    from knotopt.rehearsal.rehearse import Rehearsal
    from knotopt.sim.judge import Verdict

UNDISTURBED = "undisturbed"


@dataclass(frozen=True, eq=False)
class Flown:
    """One flight in physics and what it was like.

    Attributes
    ----------
    name : str
        "undisturbed", or "seed 3".
    verdict : Verdict
    examination : Examination or None
        None where the simulation broke down, so that there is nothing to examine.
    record : FlightRecord
    """

    name: str
    verdict: Verdict
    examination: Examination | None
    record: FlightRecord

    @property
    def is_tied(self) -> bool:
        """Whether the wanted knot was tied."""
        return str(self.verdict.outcome) == "tied"

    @property
    def came_of(self) -> str:
        """What came of it: what was tied, and how far a flight came that got stuck."""
        if self.examination is None:
            return f"{self.verdict}; the simulation broke down"
        if not self.record.finished:
            return f"{self.verdict}, held back at {self.record.clock[-1]:.1f} s of the plan"
        return str(self.verdict)

    @property
    def why(self) -> str:
        """What came of it, and the first crossing that was not as planned."""
        if self.examination is None:
            return self.came_of
        amiss = self.examination.amiss
        if amiss:
            return f"{self.came_of}; {amiss[0].sentence}"
        difference = self.examination.states.difference
        return f"{self.came_of}; " + (
            difference or "every crossing is as planned, which is not enough"
        )


def examined(name: str, plan: FlightPlan, record: FlightRecord, verdict: Verdict) -> Flown:
    """A flight that was judged, examined too."""
    try:
        examination = examine_flight(plan, record)
    except ValueError:
        examination = None
    return Flown(name, verdict, examination, record)


@dataclass(frozen=True, eq=False)
class FlightResult:
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
    rehearsal : Rehearsal or None
        Where the plan comes from, with physics.
    flown : Flown or None
        The undisturbed flight.
    failed : Flown or None
        The first disturbed flight that did not tie the knot.
    disturbed : tuple of mapping
        Disturbed flights as in the content of `content`.
    interval : tuple of float or None
        Wilson's 95 % interval for the share of disturbed flights that tie the knot.
    """

    plan: FlightPlan
    examination: Examination
    exports: Mapping[str, str]
    fit: FitReport
    steady: float | None = None
    rehearsal: Rehearsal | None = None
    flown: Flown | None = None
    failed: Flown | None = None
    disturbed: tuple[Mapping[str, Any], ...] = ()
    interval: tuple[float, float] | None = None

    @property
    def reasons(self) -> tuple[str, ...]:
        """Why the plan is not good as it is: in sentences, empty if it is."""
        reasons = [f"the plan: {each}" for each in self.examination.limits.broken]
        reasons += [f"the polynomials: {each}" for each in self.fit.broken]
        if self.flown is None:
            reasons += [f"on laid cable: {row.sentence}" for row in self.examination.amiss]
        elif not self.flown.is_tied:
            reasons.append(f"the undisturbed flight: {self.flown.why}")
        return tuple(reasons)

    @property
    def tied(self) -> int:
        """How many disturbed flights tie the knot."""
        return sum(each["outcome"] == "tied" for each in self.disturbed)

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
        if self.rehearsal is not None and self.flown is not None:
            record = self.flown.record
            found += [
                (
                    "rehearsal",
                    f"{self.rehearsal.ways} ways tried in {self.rehearsal.rehearsals} flights",
                ),
                ("undisturbed", self.flown.came_of),
                ("strands apart", f"{record.smallest_distance:.3f} m at least"),
                ("tension", f"{record.largest_tension:.2f} N at most"),
            ]
        if self.interval is not None:
            found.append(("disturbed", self.success))
        return found

    def content(self) -> dict[str, Any]:
        """Everything found out, for JSON."""
        plan = self.plan
        return {
            "knot": plan.name,
            "cut": str(plan.cable.cut),
            "robots": plan.robots,
            "supports": [list(each) for each in place(plan.cable, plan.supports)],
            "chosen_by": plan.chosen_by,
            "ok": not self.reasons,
            "reasons": list(self.reasons),
            "notes": list(plan.notes),
            "schedule": plan.schedule,
            "duration": round(plan.duration, 3),
            "tightening": round(plan.tightening, 3),
            "ends_apart": [round(each, 4) for each in plan.ends_apart],
            "supports_within": [round(each, 4) for each in plan.supports_within],
            "duration_fixed": None if self.steady is None else round(self.steady, 3),
            "cable_lengths": plan.lengths.round(4).tolist(),
            "taut_loses": list(self.examination.lost),
            "limits": limits_content(self.examination.limits),
            "crossings": [asdict(row) for row in self.examination.crossings],
            "states": states_content(self.examination.states),
            "polynomials": _fit_content(self.fit),
            "rehearsal": None
            if self.rehearsal is None
            else {
                "rehearsals": self.rehearsal.rehearsals,
                "ways": self.rehearsal.ways,
                "robust": self.rehearsal.robust,
                "failed": list(self.rehearsal.failed),
            },
            "undisturbed": None if self.flown is None else flown_content(self.flown),
            "disturbed": [dict(each) for each in self.disturbed],
            "tied": self.tied,
            "interval": None if self.interval is None else list(self.interval),
        }

    def events(self) -> list[tuple[str, CrossingRow]]:
        """Crossings as executed, of the undisturbed flight and of the first that failed."""
        return [
            (flight.name, row)
            for flight in (self.flown, self.failed)
            if flight is not None and flight.examination is not None
            for row in flight.examination.crossings
        ]


def flown_content(flown: Flown) -> dict[str, Any]:
    """A flight in physics, for JSON; its record is left out."""
    verdict, record, examination = flown.verdict, flown.record, flown.examination
    return {
        "flight": flown.name,
        "noise": record.disturbance.noise,
        "wind": list(record.disturbance.wind),
        "gust": record.disturbance.gust,
        "seed": record.disturbance.seed,
        "outcome": str(verdict.outcome),
        "knot": verdict.knot,
        "polynomial": verdict.polynomial,
        "closures_agree": verdict.closures_agree,
        "finished": record.finished,
        "duration": round(float(record.times[-1]), 3),
        "smallest_distance": _number(record.smallest_distance),
        "largest_tension": _number(record.largest_tension),
        "seconds": round(record.seconds, 3),
        "crossings": [asdict(row) for row in examination.crossings] if examination else [],
        "states": states_content(examination.states) if examination else None,
        "limits": limits_content(examination.limits) if examination else None,
    }


def states_content(comparison: StateComparison) -> dict[str, Any]:
    """The cable's states after each crossing, for JSON."""
    planned, executed = (
        [format_states(states) for states in sequence.steps]
        for sequence in (comparison.planned, comparison.executed)
    )
    return {
        "planned": planned,
        "executed": executed,
        "results": list(comparison.results),
        "difference": comparison.difference,
    }


def limits_content(report: LimitsReport) -> dict[str, Any]:
    """What was measured beside each limit, for JSON."""
    found = {}
    for field in fields(report):
        worst: Worst = getattr(report, field.name)
        found[field.name] = {
            "value": _number(worst.value),
            "limit": _number(worst.limit),
            "robots": list(worst.robots),
            "time": _number(worst.time),
            "broken": worst.broken,
        }
    return found


def _fit_content(fit: FitReport) -> dict[str, Any]:
    return {
        "parts": fit.parts,
        "pieces": fit.pieces,
        "deviation": _number(fit.deviation.value),
        "speed": _number(fit.speed.value),
        "acceleration": _number(fit.acceleration.value),
        "separation": _number(fit.separation.value),
        "cable": _number(fit.cable.value),
        "lowest": _number(fit.lowest.value),
        "highest": _number(fit.highest.value),
        "gaps": [
            {
                "crossing": each.crossing.name,
                "planned": _number(each.planned),
                "gap": _number(each.gap),
            }
            for each in fit.crossings
        ],
        "broken": list(fit.broken),
    }


def _where(worst: Worst) -> str:
    return f"robot{'s' * (len(worst.robots) > 1)} {' and '.join(map(str, worst.robots))} " + (
        f"at {worst.time:.1f} s"
    )


def _number(value: float) -> float | None:
    return round(float(value), 6) if math.isfinite(value) else None
