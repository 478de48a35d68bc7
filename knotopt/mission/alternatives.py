"""Sets of supports tried in turn until one flies: equally small ones on several cuts.

The formulations see no difference between such sets; flights do. The two directions of a cable, for
one, lay it in opposite orders, and in some the file's hanging cable hooks on what is laid.
"""

from __future__ import annotations

import logging
from collections.abc import Callable, Iterable
from typing import Any, Protocol, Self, TypeVar

from knotopt.errors import RequirementError
from knotopt.flight.plan import FlightPlan
from knotopt.flight.planner import plan_flight
from knotopt.flight.request import FlightRequest
from knotopt.rehearsal.flown_set import FlownSet
from knotopt.rehearsal.rehearse import rehearse_flight
from knotopt.rehearsal.tighten import check_tightening, tighten_flight
from knotopt.sim.simulators import MUJOCO, Simulator
from knotopt.supports.support_set import SupportSet

logger = logging.getLogger(__name__)


class Notable(Protocol):
    """What takes notes for its user, such as a `FlightPlan` or a `FlownSet`."""

    def noted(self, *notes: str) -> Self:
        """The same with further notes."""


PASSED = "not on cut"  # begins the note on a set that was passed over
Found = TypeVar("Found", bound=Notable)


def plan_first(sets: Iterable[SupportSet], request: FlightRequest) -> FlightPlan:
    """A flight of the first set that has one by the model of laid cable.

    Raises
    ------
    As `plan_flight`.
    """
    return first_good(sets, lambda chosen: plan_set(chosen, request))


def plan_set(chosen: SupportSet, request: FlightRequest) -> FlightPlan:
    """A flight of one set by the model of laid cable.

    Raises
    ------
    As `plan_flight`.
    """
    return plan_flight(cable=chosen.cable, supports=chosen.supports, **vars(request))


def rehearse_first(
    sets: Iterable[SupportSet],
    request: FlightRequest,
    tighten: float | None = None,
    attempts: int = 6,
    simulator: Simulator = MUJOCO,
) -> FlownSet:
    """A flight of the first set that ties the knot in simulation with the robots apart.

    Parameters
    ----------
    sets : iterable of SupportSet
    request : FlightRequest
    tighten : float, optional
        Pull the knot tight after it, the ends at most that far apart [m].
    attempts : int
        Flights that are begun anew at most, for each set.
    simulator : Simulator

    Raises
    ------
    As `rehearse_flight` and `tighten_flight`.
    """

    def attempt(chosen: SupportSet) -> FlownSet:
        if tighten is not None:
            check_tightening(chosen.cable, tighten, request.world)
        logger.info("%d robots on cut %s", chosen.robots, chosen.cable.cut)
        flown = rehearse_flight(chosen.cable, chosen.supports, request, attempts, simulator)
        return flown if tighten is None else tighten_flight(flown, tighten, simulator)

    return first_good(sets, attempt, lambda each: each.against, lambda each: each.rank[:3])


def first_good(
    sets: Iterable[SupportSet],
    attempt: Callable[[SupportSet], Found],
    against: Callable[[Found], str] = lambda _: "",
    rank: Callable[[Found], Any] = lambda _: 0,
) -> Found:
    """What comes of the first set that nothing speaks against, or else of the best one.

    Parameters
    ----------
    sets : iterable of SupportSet
        At least one, each on another cut; no more are drawn from it than needed.
    attempt : callable
        What comes of a set.
    against : callable
        What speaks against that, "" if nothing does.
    rank : callable
        The largest is the best where something speaks against all.

    Returns
    -------
    What `attempt` returned, with a note for every other set tried.

    Raises
    ------
    RequirementError
        Every attempt raised one; it is that of the first.
    """
    found: list[tuple[SupportSet, Found]] = []
    failed: list[tuple[SupportSet, RequirementError]] = []
    for chosen in sets:
        try:
            found.append((chosen, attempt(chosen)))
        except RequirementError as error:
            failed.append((chosen, error))
        else:
            if not against(found[-1][1]):
                break
    if not found:
        raise failed[0][1]
    best = found[-1][1]
    if against(best):
        best = max((result for _, result in found), key=rank)
    why: list[tuple[SupportSet, object]] = [
        *failed,
        *((chosen, against(result)) for chosen, result in found if result is not best),
    ]
    return best.noted(*(f"{PASSED} {chosen.cable.cut}: {words}" for chosen, words in why))
