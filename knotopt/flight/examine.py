"""Plans and flights examined from samples of positions alone: limits kept, crossings made.

The plan's own account of its crossings is compared with what `knotopt.verify` finds: in a plan, the
leader's track against laid cable, straight in plan and hanging as catenaries; in a flight, the
leader against the cable as it was.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction

import numpy as np

from knotopt.arrays import FloatArray
from knotopt.flight.plan import FlightPlan, MotionPlan, PlannedCrossing
from knotopt.flight.record import FlightRecord
from knotopt.path.curve import length_along
from knotopt.verify.flight import leader_events, nearest_approaches
from knotopt.verify.flight_limits import LimitsReport, check_limits
from knotopt.verify.flight_places import TOLERANCE, executed_states, planned_states
from knotopt.verify.flight_states import StateComparison, compare_states
from knotopt.verify.flight_word import WordRow, compare_words, plan_word
from knotopt.verify.span import check_span

AS_PLANNED = "as planned"
LIMITS = ("speed", "acceleration", "separation", "downwash")  # of plans and flights alike
HOVERS = ("hover_before", "hover_after")  # of plans alone
LEAST_OPEN = Fraction(1, 1000)  # openness of regions that are there at all [grid steps]


@dataclass(frozen=True)
class CrossingRow:
    """A planned crossing beside what became of it.

    Attributes
    ----------
    planned : str
        Such as "span 4 over span 1"; "" for a crossing that was not planned.
    result : str
        "as planned", "wrong height", "wrong way", "missing" or "extra".
    happened : str
        When and how it was executed, or why it was not.
    """

    planned: str
    result: str
    happened: str

    @property
    def sentence(self) -> str:
        """In one line."""
        return ": ".join(part for part in (self.planned, self.happened) if part)


@dataclass(frozen=True)
class Examination:
    """What a plan or a flight is like.

    Attributes
    ----------
    limits : LimitsReport
    crossings : tuple of CrossingRow
        In order, crossings that undo each other left out.
    states : StateComparison
        Of the cable, after each crossing.
    lost : tuple of str
        Of a plan: regions that the taut cable does not keep, so that it need not be the knot even
        if every crossing is as planned; and why.
    """

    limits: LimitsReport
    crossings: tuple[CrossingRow, ...]
    states: StateComparison
    lost: tuple[str, ...] = ()

    @property
    def amiss(self) -> tuple[CrossingRow, ...]:
        """The crossings that are not as planned."""
        return tuple(row for row in self.crossings if row.result != AS_PLANNED)


def examine_plan(plan: FlightPlan) -> Examination:
    """A plan's limits, and what the leader's track crosses if cable lies as the model has it.

    A plan that was rehearsed flies past cable as it lay in the simulation; the model may then find
    other crossings. The spacing is measured and not judged: it is along the route, which may bend.
    Crossings are those until the knot is laid; limits are for all of the flight.
    """
    report = _limits(plan, plan.times, plan.positions, hover=True)
    track = plan.positions[: plan.laying, -1]
    along = length_along(track)
    moving = np.concatenate(([True], np.diff(track, axis=0).any(axis=1)))
    passes = np.interp(plan.passes, plan.times[: plan.laying], along)
    found = plan_word(track[moving], passes, plan.anchors, plan.lengths)
    cable = plan.cable
    taut = check_span(cable.path, cable.diagram.size, plan.supports, LEAST_OPEN)
    lost = tuple(f"{closure.region}: {closure.reason}" for closure in taut.closures)
    words = compare_words(plan.crossings, found)
    tolerance = TOLERANCE * plan.world.step
    model = (plan.anchors, plan.lengths, tolerance)
    states = planned_states(plan.crossings, *model), planned_states(found, *model)
    return Examination(report, _rows(words), compare_states(*states, words), lost)


def examine_flight(plan: MotionPlan, record: FlightRecord) -> Examination:
    """What robots did that flew a plan, and what the leader crossed until the knot was laid.

    Raises
    ------
    ValueError
        A record of other robots, or with positions that are no finite numbers.
    """
    report = _limits(plan, record.times, record.robots, hover=False)
    count = int(np.searchsorted(record.clock, plan.laid + plan.interval / 2))
    times, clock, cable = record.times[:count], record.clock[:count], record.cable[:count]
    seen = (cable, record.held, plan.passes)
    events = leader_events(times, *seen, clock=clock)
    wanted = [(crossing.span, crossing.older) for crossing in plan.crossings]
    near = nearest_approaches(*seen, clock, wanted)
    words = compare_words(plan.crossings, events, near)
    tolerance = TOLERANCE * plan.world.step
    planned = planned_states(plan.crossings, plan.anchors, plan.lengths, tolerance)
    flown = (times, cable, record.held, tolerance)
    executed = executed_states(events, *flown, plan.crossings)
    return Examination(report, _rows(words), compare_states(planned, executed, words))


def _limits(
    plan: MotionPlan, times: FloatArray, robots: FloatArray, *, hover: bool
) -> LimitsReport:
    kept = {name: getattr(plan.limits, name) for name in (*LIMITS, *(HOVERS if hover else ()))}
    floor, ceiling = plan.world.floor, plan.world.ceiling
    return check_limits(times, robots, plan.lengths, floor=floor, ceiling=ceiling, **kept)


def _rows(rows: Sequence[WordRow]) -> tuple[CrossingRow, ...]:
    found = []
    for row in rows:
        planned = row.planned.name if isinstance(row.planned, PlannedCrossing) else ""
        happened = row.sentence.removeprefix(f"{planned}: ").removeprefix(f"{row.kind}: ")
        found.append(CrossingRow(planned, row.kind, happened))
    return tuple(found)
