"""A mission for JSON: everything found out about a plan and its flights."""

from __future__ import annotations

import math
from dataclasses import asdict
from typing import Any

from knotopt.export.recheck import FitReport
from knotopt.mission.mission import Mission
from knotopt.sim.trials import Flight
from knotopt.supports.support_set import place
from knotopt.verify.flight_limits import LimitsReport
from knotopt.verify.flight_states import StateComparison, format_states

MEASURED = ("deviation", "speed", "acceleration", "separation", "cable", "lowest", "highest")
"""What is said of the fitted polynomials, in this order."""


def mission_content(mission: Mission) -> dict[str, Any]:
    """Everything found out, for JSON."""
    plan, flown = mission.plan, mission.flown
    return {
        "knot": plan.name,
        "cut": str(plan.cable.cut),
        "robots": plan.robots,
        "supports": [list(each) for each in place(plan.cable, plan.supports)],
        "chosen_by": plan.chosen_by,
        "ok": not mission.reasons,
        "reasons": list(mission.reasons),
        "notes": list(plan.notes),
        "schedule": plan.schedule,
        "duration": round(plan.duration, 3),
        "tightening": round(plan.tightening, 3),
        "ends_apart": [round(each, 4) for each in plan.ends_apart],
        "supports_within": [round(each, 4) for each in plan.supports_within],
        "duration_fixed": None if mission.steady is None else round(mission.steady, 3),
        "cable_lengths": plan.lengths.round(4).tolist(),
        "taut_loses": list(mission.examination.lost),
        "limits": limits_content(mission.examination.limits),
        "crossings": [asdict(row) for row in mission.examination.crossings],
        "states": states_content(mission.examination.states),
        "polynomials": _fit_content(mission.fit),
        "rehearsal": None
        if flown is None
        else {
            "rehearsals": flown.rehearsals,
            "ways": flown.ways,
            "robust": flown.robust,
            "failed": list(flown.given_up),
        },
        "undisturbed": None if flown is None else flight_content("undisturbed", flown.undisturbed),
        "disturbed": [dict(each) for each in mission.disturbed],
        "tied": mission.tied,
        "interval": None if mission.interval is None else list(mission.interval),
    }


def flight_content(name: str, flight: Flight) -> dict[str, Any]:
    """A flight in physics, for JSON; its record is left out."""
    verdict, record, examination = flight.verdict, flight.record, flight.examination
    return {
        "flight": name,
        **asdict(record.disturbance),
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
    return {
        "planned": [format_states(states) for states in comparison.planned.steps],
        "executed": [format_states(states) for states in comparison.executed.steps],
        "results": list(comparison.results),
        "difference": comparison.difference,
    }


def limits_content(report: LimitsReport) -> dict[str, Any]:
    """What was measured beside each limit, for JSON."""
    return {
        name: {
            "value": _number(worst.value),
            "limit": _number(worst.limit),
            "robots": list(worst.robots),
            "time": _number(worst.time),
            "broken": worst.broken,
        }
        for name, worst in vars(report).items()
    }


def _fit_content(fit: FitReport) -> dict[str, Any]:
    return {
        "parts": fit.parts,
        "pieces": fit.pieces,
        **{name: _number(getattr(fit, name).value) for name in MEASURED},
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


def _number(value: float) -> float | None:
    return round(float(value), 6) if math.isfinite(value) else None
