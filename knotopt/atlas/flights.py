"""The sets of a cut flown in simulation: one undisturbed flight each, on the modelled route."""

from __future__ import annotations

import logging
import time
from collections.abc import Mapping

from knotopt.atlas.columns import FLOWN
from knotopt.atlas.programs import Solved
from knotopt.atlas.schema import KnotRow
from knotopt.cable.cable import Cable
from knotopt.document.columns import Row, names
from knotopt.errors import RequirementError
from knotopt.flight.planner import plan_flight
from knotopt.sim.trials import Flight, fly_trial
from knotopt.supports.lcf import LcfResult
from knotopt.supports.selection import GivenSupports
from knotopt.tables.methods import LCF, TRIED_PROGRAMS, SmallestSet, Supports

logger = logging.getLogger(__name__)


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

    Raises
    ------
    MissingExtraError
        MuJoCo is not installed (extra `sim`).
    """
    sets: dict[str, Supports] = {LCF.key: plain.supports}
    for method, program in programs.items():
        if program.supports is not None:
            sets[method.key] = program.supports
    flown: dict[Supports, Flight | str] = {}
    rows, times = [], []
    for name, supports in sets.items():
        seconds = 0.0, 0.0
        if supports not in flown:
            flown[supports], seconds = fly_set(knot.knot, plain.cable, supports)
        keys = {**knot.keys(plain.cable.cut), "supports": name}
        chosen = GivenSupports(plain.cable, supports)
        cells = {**keys, "robots": chosen.robots, **_cells(flown[supports])}
        for method in TRIED_PROGRAMS:
            solved = programs.get(method)
            cells |= method.cells(open=solved.allows(chosen) if solved else None)
        rows.append(cells)
        spent = {"planning_seconds": seconds[0], "simulation_seconds": seconds[1]}
        times.append({**keys, **spent})
    return rows, times


def fly_set(
    name: str, cable: Cable, supports: Supports
) -> tuple[Flight | str, tuple[float, float]]:
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
    Flight or str
        Or why there is none.
    tuple of float
        Times of planning, and of simulating and judging [s].

    Raises
    ------
    MissingExtraError
        MuJoCo is not installed (extra `sim`).
    """
    began = time.perf_counter()
    try:
        plan = plan_flight(name, cable, supports, "file", schedule="optimised")
    except RequirementError as error:
        return str(error), (time.perf_counter() - began, 0.0)
    planned = time.perf_counter()
    flight = fly_trial(plan)
    logger.info("%s, cut %s, supports %s: %s", name, cable.cut, supports, flight.verdict)
    return flight, (planned - began, time.perf_counter() - planned)


def _cells(flown: Flight | str) -> Row:
    """Columns of a row that say what came of a set."""
    if isinstance(flown, str):
        empty: Row = dict.fromkeys(names(FLOWN))
        return empty | {"planned": False, "tied": False, "why": flown}
    plan, record, examination = flown.plan, flown.record, flown.examination
    return {
        "planned": True,
        "tied": flown.is_tied,
        "why": "" if flown.is_tied else flown.amiss or "every crossing as planned",
        "outcome": str(flown.verdict.outcome),
        "verdict": str(flown.verdict),
        "flight_seconds": plan.duration,
        "separation": examination.limits.separation.value if examination else None,
        "strand_distance": record.smallest_distance,
        "tension": record.largest_tension,
        "cable_length": float(plan.lengths.sum()),
    }
