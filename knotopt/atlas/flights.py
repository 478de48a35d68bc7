"""The sets of a cut flown in simulation: one undisturbed flight each, on the modelled route."""

from __future__ import annotations

import time
from collections.abc import Mapping
from dataclasses import asdict, dataclass, replace

from knotopt.atlas.optional_rows import FlightRow, FlightTimesRow
from knotopt.atlas.programs import Solved
from knotopt.atlas.schema import KnotRow
from knotopt.cable.cable import Cable
from knotopt.errors import RequirementError
from knotopt.flight.examine import examine_flight
from knotopt.flight.plan import FlightPlan
from knotopt.flight.planner import plan_flight
from knotopt.sim.trials import Trial, fly_trial
from knotopt.supports.lcf import LcfResult
from knotopt.supports.selection import GivenSupports

Supports = tuple[int, ...]


@dataclass(frozen=True)
class Flown:
    """What came of one set: columns of its row, and the time [s].

    Attributes
    ----------
    planned, tied : bool
    why : str
        Why there is no plan, or what went wrong in flight.
    planning_seconds, simulation_seconds : float
    outcome, verdict, flight_seconds, separation, strand_distance, tension, cable_length
        As in `FlightRow`, None without a plan.
    """

    planned: bool
    tied: bool
    why: str
    planning_seconds: float
    simulation_seconds: float = 0.0
    outcome: str | None = None
    verdict: str | None = None
    flight_seconds: float | None = None
    separation: float | None = None
    strand_distance: float | None = None
    tension: float | None = None
    cable_length: float | None = None


def fly_sets(
    knot: KnotRow, plain: LcfResult, programs: Mapping[str, Solved]
) -> tuple[list[FlightRow], list[FlightTimesRow]]:
    """Fly LCF's set and the smallest set of each program; sets that are equal fly once.

    Parameters
    ----------
    knot : KnotRow
    plain : LcfResult
        On one cut.
    programs : mapping of str to Solved
        `opening` in mode turning-point, and `span` if it was asked for.

    Raises
    ------
    MissingExtraError
        MuJoCo is not installed (extra `sim`).
    """
    sets: dict[str, Supports] = {"lcf": plain.supports}
    for formulation, program in programs.items():
        if program.supports is not None:
            sets[formulation] = program.supports
    flown: dict[Supports, Flown] = {}
    rows, times = [], []
    for name, supports in sets.items():
        if supports in flown:
            result = replace(flown[supports], planning_seconds=0.0, simulation_seconds=0.0)
        else:
            result = flown[supports] = fly_set(knot.knot, plain.cable, supports)
        cells = asdict(result)
        spent = {key: cells.pop(key) for key in ("planning_seconds", "simulation_seconds")}
        place = (knot.number, knot.knot, str(plain.cable.cut), name)
        chosen = GivenSupports(plain.cable, supports)
        span = programs.get("span")
        rows.append(
            FlightRow(
                *place,
                robots=chosen.robots,
                opening_open=programs["opening"].allows(chosen),
                span_open=span.allows(chosen) if span else None,
                **cells,
            )
        )
        times.append(FlightTimesRow(*place, **spent))
    return rows, times


def fly_set(name: str, cable: Cable, supports: Supports) -> Flown:
    """Plan a flight by the model of laid cable, without rehearsals, and fly it undisturbed.

    Parameters
    ----------
    name : str
        Of the knot.
    cable : Cable
    supports : tuple of int
        Turning points with a support robot (1-based).

    Raises
    ------
    MissingExtraError
        MuJoCo is not installed (extra `sim`).
    """
    began = time.perf_counter()
    try:
        plan = plan_flight(name, cable, supports, "file", schedule="optimised")
    except RequirementError as error:
        return Flown(False, False, str(error), time.perf_counter() - began)
    planned = time.perf_counter()
    trial = fly_trial(plan)
    simulated = time.perf_counter()
    separation, amiss = _examined(plan, trial)
    return Flown(
        planned=True,
        tied=trial.is_tied,
        why="" if trial.is_tied else amiss,
        planning_seconds=planned - began,
        simulation_seconds=simulated - planned,
        outcome=str(trial.verdict.outcome),
        verdict=str(trial.verdict),
        flight_seconds=plan.duration,
        separation=separation,
        strand_distance=trial.record.smallest_distance,
        tension=trial.record.largest_tension,
        cable_length=float(plan.lengths.sum()),
    )


def _examined(plan: FlightPlan, trial: Trial) -> tuple[float | None, str]:
    """Least separation of two robots in a flight, and the first crossing amiss, in words."""
    try:
        found = examine_flight(plan, trial.record)
    except ValueError:  # positions that are no numbers
        return None, "the simulation broke down"
    amiss = found.amiss[0].sentence if found.amiss else "every crossing as planned"
    return found.limits.separation.value, amiss
