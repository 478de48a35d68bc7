"""Sets of supports tried in turn until one flies: equally small ones on several cuts.

The formulations see no difference between such sets; flights do. The two directions of a cable, for
one, lay it in opposite orders, and in some the file's hanging cable hooks on what is laid.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import Any, Protocol, Self, TypeVar

from knotopt.errors import RequirementError
from knotopt.flight.limits import FlightLimits
from knotopt.flight.plan import FlightPlan
from knotopt.flight.planner import plan_flight
from knotopt.path.world import World
from knotopt.rehearsal.rehearse import Rehearsal, rehearse_flight
from knotopt.rehearsal.tighten import check_tightening, tighten_flight
from knotopt.supports.support_set import SupportSet


class Notable(Protocol):
    """What takes notes for its user, such as a `FlightPlan` or a `Rehearsal`."""

    def noted(self, *notes: str) -> Self:
        """The same with further notes."""


PASSED = "not on cut"  # begins the note on a set that was passed over
Tried = TypeVar("Tried", bound=Notable)

Asked = tuple[str, World, FlightLimits | None, str]
"""How the supports were chosen, the room, the robots' limits, the schedule; see `plan_flight`."""


def plan_first(name: str, sets: Iterable[SupportSet], asked: Asked) -> FlightPlan:
    """A flight of the first set that has one by the model of laid cable.

    Raises
    ------
    As `plan_flight`.
    """
    return first_good(sets, lambda each: plan_flight(name, each.cable, each.supports, *asked))


def rehearse_first(
    name: str,
    sets: Iterable[SupportSet],
    asked: Asked,
    tighten: float | None = None,
    tell: Callable[[str], None] | None = None,
    attempts: int = 6,
) -> Rehearsal:
    """A flight of the first set that ties the knot in simulation with the robots apart.

    Parameters
    ----------
    name, sets, asked
    tighten : float, optional
        Pull the knot tight after it, the ends at most that far apart [m].
    tell : callable, optional
        Is told what is being flown.
    attempts : int
        Flights that are begun anew at most, for each set.

    Raises
    ------
    As `rehearse_flight` and `tighten_flight`.
    """

    def attempt(chosen: SupportSet) -> Rehearsal:
        if tighten is not None:
            check_tightening(chosen.cable, tighten, asked[1])
        if tell is not None:
            tell(f"{chosen.robots} robots on cut {chosen.cable.cut}")
        flown = (chosen.cable, chosen.supports, *asked)
        found = rehearse_flight(name, *flown, tell=tell, attempts=attempts)
        return found if tighten is None else tighten_flight(found, tighten, tell)

    return first_good(sets, attempt, lambda each: each.against, lambda each: each.rank[:3])


def first_good(
    sets: Iterable[SupportSet],
    attempt: Callable[[SupportSet], Tried],
    against: Callable[[Tried], str] = lambda _: "",
    rank: Callable[[Tried], Any] = lambda _: 0,
) -> Tried:
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
    found: list[tuple[SupportSet, Tried]] = []
    failed: list[tuple[SupportSet, RequirementError]] = []
    for chosen in sets:
        try:
            found.append((chosen, attempt(chosen)))
        except RequirementError as error:
            failed.append((chosen, error))
            continue
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
