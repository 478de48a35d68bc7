"""The sets of a cut flown in simulation: one undisturbed flight each, on the modelled route."""

from __future__ import annotations

import time
from collections.abc import Mapping

from knotopt.atlas.columns import FLOWN
from knotopt.atlas.programs import Solved
from knotopt.atlas.schema import KnotRow
from knotopt.cable.cable import Cable
from knotopt.document.columns import Row
from knotopt.errors import RequirementError
from knotopt.flight.examine import examine_flight
from knotopt.flight.plan import FlightPlan
from knotopt.flight.planner import plan_flight
from knotopt.sim.trials import Trial, fly_trial
from knotopt.supports.lcf import LcfResult
from knotopt.supports.selection import GivenSupports
from knotopt.tables.methods import LCF, USUAL_PROGRAMS, SmallestSet, Supports


def fly_sets(
    knot: KnotRow, plain: LcfResult, programs: Mapping[SmallestSet, Solved]
) -> tuple[list[Row], list[Row]]:
    """Fly LCF's set and the smallest set of each program; sets that are equal fly once.

    Parameters
    ----------
    knot : KnotRow
    plain : LcfResult
        On one cut.
    programs : mapping of SmallestSet to Solved

    Returns
    -------
    (rows, times)
        Of `FLIGHTS` and of `FLIGHT_TIMES`.

    Raises
    ------
    MissingExtraError
        MuJoCo is not installed (extra `sim`).
    """
    sets: dict[str, Supports] = {LCF.key: plain.supports}
    for method, program in programs.items():
        if program.supports is not None:
            sets[method.key] = program.supports
    flown: dict[Supports, Row] = {}
    rows, times = [], []
    for name, supports in sets.items():
        spent: Row = {"planning_seconds": 0.0, "simulation_seconds": 0.0}
        if supports not in flown:
            flown[supports], spent = fly_set(knot.knot, plain.cable, supports)
        keys = {
            "number": knot.number,
            "knot": knot.knot,
            "cut": str(plain.cable.cut),
            "supports": name,
        }
        chosen = GivenSupports(plain.cable, supports)
        cells = {**keys, "robots": chosen.robots, **flown[supports]}
        for method in USUAL_PROGRAMS:
            solved = programs.get(method)
            cells |= method.cells(open=solved.allows(chosen) if solved else None)
        rows.append(cells)
        times.append({**keys, **spent})
    return rows, times


def fly_set(name: str, cable: Cable, supports: Supports) -> tuple[Row, Row]:
    """Plan a flight by the model of laid cable, without rehearsals, and fly it undisturbed.

    Parameters
    ----------
    name : str
        Of the knot.
    cable : Cable
    supports : tuple of int
        Turning points with a support robot (1-based).

    Returns
    -------
    (cells, times)
        Of `FLIGHTS` from "planned" on, and of `FLIGHT_TIMES`.

    Raises
    ------
    MissingExtraError
        MuJoCo is not installed (extra `sim`).
    """
    cells: Row = dict.fromkeys(column.name for column in FLOWN)
    began = time.perf_counter()
    try:
        plan = plan_flight(name, cable, supports, "file", schedule="optimised")
    except RequirementError as error:
        cells |= {"planned": False, "tied": False, "why": str(error)}
        spent = {"planning_seconds": time.perf_counter() - began, "simulation_seconds": 0.0}
        return cells, spent
    planned = time.perf_counter()
    trial = fly_trial(plan)
    simulated = time.perf_counter()
    separation, amiss = _examined(plan, trial)
    cells |= {
        "planned": True,
        "outcome": str(trial.verdict.outcome),
        "verdict": str(trial.verdict),
        "tied": trial.is_tied,
        "why": "" if trial.is_tied else amiss,
        "flight_seconds": plan.duration,
        "separation": separation,
        "strand_distance": trial.record.smallest_distance,
        "tension": trial.record.largest_tension,
        "cable_length": float(plan.lengths.sum()),
    }
    return cells, {
        "planning_seconds": planned - began,
        "simulation_seconds": simulated - planned,
    }


def _examined(plan: FlightPlan, trial: Trial) -> tuple[float | None, str]:
    """Least separation of two robots in a flight, and the first crossing amiss, in words."""
    try:
        found = examine_flight(plan, trial.record)
    except ValueError:  # positions that are no numbers
        return None, "the simulation broke down"
    amiss = found.amiss[0].sentence if found.amiss else "every crossing as planned"
    return found.limits.separation.value, amiss
