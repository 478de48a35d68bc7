"""The smallest set of supports that ties the knot in simulation: solve, fly, cut off, solve again.

Sets come in order of their robots. A set whose flights do not all tie the knot is cut off, by
itself: whether a set ties says nothing of the sets that contain it. That a set was cut off is no
proof that it cannot be flown; it says that the flights tried failed.
"""

from __future__ import annotations

import logging
import time
from collections import Counter, defaultdict
from collections.abc import Callable, Iterable, Sequence
from dataclasses import asdict, dataclass, replace
from enum import StrEnum
from functools import partial
from typing import Any

from formulations.backends import DEFAULT
from formulations.solution import Limits, Status
from knotopt.cable.cut import Cut
from knotopt.diagram.grid import GridDiagram
from knotopt.errors import RequirementError
from knotopt.flight.request import FlightRequest
from knotopt.rehearsal.flight_tests import FlightTests
from knotopt.rehearsal.flown_set import FlownSet
from knotopt.rehearsal.rehearse import rehearse_flight
from knotopt.sim.judge import Outcome, Verdict
from knotopt.sim.simulators import MUJOCO, Simulator
from knotopt.sim.trials import fly_trials
from knotopt.supports.by_size import Lacks, Supports, sets_in_order
from knotopt.supports.minimal import MinimalSupports
from knotopt.supports.requirements import Requirements
from knotopt.supports.search import CutSearch
from knotopt.supports.support_set import SupportSet

logger = logging.getLogger(__name__)

AS_PLANNED = "every crossing happened as planned; where along the spans is not compared"


class FlownStatus(StrEnum):
    """How a search for a set that ties has ended."""

    TIED = "tied"  # a set tied the knot in all its flights
    BUDGET = "budget"  # no set did so before time or number of sets ran out
    NO_SET = "no set"  # every set that meets the requirements was flown, or there is none
    UNKNOWN = "unknown"  # the solver stopped at a limit before it had a further set


@dataclass(frozen=True)
class CutOff:
    """A set that was flown and did not tie the knot in all flights.

    Attributes
    ----------
    cut : str
        Of the diagram, such as "L+".
    supports : tuple of int
        1-based on the path, without p_1 and p_n.
    verdict : Verdict or None
        Of the undisturbed flight; None if no flight could be planned.
    trials : tuple of Verdict
        Of the disturbed flights; none are flown where the undisturbed one fails.
    failed : str
        The first crossing that did not happen as planned, and how, in the first flight that failed;
        or why there is no plan.
    """

    cut: str
    supports: Supports
    verdict: Verdict | None
    trials: tuple[Verdict, ...]
    failed: str

    @classmethod
    def of(cls, chosen: SupportSet, flown: FlownSet | RequirementError) -> CutOff:
        """A set, and its flights, one of which does not tie the knot; or why it was not flown."""
        place = str(chosen.cable.cut), chosen.supports
        if isinstance(flown, RequirementError):
            return cls(*place, None, (), str(flown))
        first, *trials = (flight.verdict for flight in flown.flights)
        amiss = flown.lost.amiss if flown.lost else ""
        return cls(*place, first, tuple(trials), amiss or AS_PLANNED)

    @property
    def robots(self) -> int:
        """The supports and the two lifting robots."""
        return len(self.supports) + 2

    @property
    def tied_instead(self) -> str:
        """What the first flight that failed tied, in words."""
        if self.verdict is None:
            return "no flight planned"
        flights = (self.verdict, *self.trials)
        return str(next(each for each in flights if each.outcome is not Outcome.TIED))

    def to_json(self) -> dict[str, Any]:
        """As values that JSON knows."""
        return asdict(self)

    @classmethod
    def from_json(cls, content: dict[str, Any]) -> CutOff:
        """What `to_json` gave."""
        return cls(
            cut=content["cut"],
            supports=tuple(content["supports"]),
            verdict=None if content["verdict"] is None else _verdict(content["verdict"]),
            trials=tuple(map(_verdict, content["trials"])),
            failed=content["failed"],
        )


@dataclass(frozen=True)
class FlownResult:
    """The smallest set that ties, or how far the search for it got.

    Attributes
    ----------
    status : FlownStatus
    search : CutSearch
        The solver's answer once the sets in `cut_off` are excluded: the set that ties; where the
        budget ended, the next one, which was not flown; else without a set.
    cut_off : tuple of CutOff
        In the order in which they were flown.
    tied : FlownSet or None
        The set that ties.
    tests : FlightTests
        That each set was put to.
    """

    status: FlownStatus
    search: CutSearch
    cut_off: tuple[CutOff, ...]
    tied: FlownSet | None
    tests: FlightTests

    @property
    def result(self) -> MinimalSupports:
        """The solver's set, of the best cut."""
        return self.search.best

    @property
    def cut_off_by_robots(self) -> dict[int, int]:
        """Number of robots to how many sets of so many were cut off."""
        return dict(sorted(Counter(each.robots for each in self.cut_off).items()))

    @property
    def smaller_cut_off(self) -> int:
        """How many of the sets that were cut off have fewer robots than the result."""
        robots = self.result.robots
        return sum(each.robots < robots for each in self.cut_off) if self.result.found else 0

    @property
    def is_proven(self) -> bool:
        """Whether no smaller set meets the requirements but those that were cut off."""
        return self.search.is_proven


Fly = Callable[[MinimalSupports], FlownSet]


def solve_flown(
    name: str,
    diagram: GridDiagram,
    requirements: Requirements | None = None,
    tests: FlightTests | None = None,
    *,
    cuts: Iterable[Cut] | None = None,
    solver: str = DEFAULT,
    limits: Limits | None = None,
    lacks: Lacks | None = None,
    known: Sequence[CutOff] = (),
    fly: Fly | None = None,
    on_cut_off: Callable[[CutOff], None] | None = None,
) -> FlownResult:
    """The first set, by number of robots, cut and clearance, that ties the knot in simulation.

    Parameters
    ----------
    name : str
        Of the knot.
    diagram, requirements, cuts, lacks, solver, limits
        As for `sets_in_order`; the time limit is for each solve. Sets that fail the test are not
        flown.
    tests : FlightTests, optional
        What each set is put to, and how many sets; those known are counted.
    known : sequence of CutOff
        Sets cut off before, which are not flown again.
    fly : callable, optional
        Flies a set; raises RequirementError where there is no flight. By default it is rehearsed
        and flown in physics, see `fly_set`.
    on_cut_off : callable, optional
        Is given each set that is cut off, at once, to keep it.

    Raises
    ------
    MissingExtraError
        MuJoCo is not installed (extra `sim`); nothing is solved then.
    RequirementError
        Requirements with `max_robots`.
    """
    tests = tests or FlightTests()
    if fly is None:
        MUJOCO.require()
        fly = partial(fly_set, name, tests=tests)
    began = time.monotonic()
    passed = defaultdict[Cut, list[Supports]](list)
    for each in known:
        passed[Cut.parse(each.cut, diagram.size)].append(each.supports)
    cut_off = list(known)
    for search in sets_in_order(
        diagram,
        requirements,
        cuts=cuts,
        excluded=passed,
        lacks=lacks,
        solver=solver,
        limits=limits,
    ):
        best = search.best
        tied: FlownSet | None = None
        late = tests.seconds is not None and time.monotonic() - began >= tests.seconds
        if not best.found:
            none = search.status is Status.INFEASIBLE
            status = FlownStatus.NO_SET if none else FlownStatus.UNKNOWN
        elif late or len(cut_off) >= tests.most_cut:
            status = FlownStatus.BUDGET
        else:
            outcome = _flown(best, fly, len(cut_off) + 1)
            if isinstance(outcome, CutOff):
                cut_off.append(outcome)
                if on_cut_off is not None:
                    on_cut_off(outcome)
                continue
            status, tied = FlownStatus.TIED, outcome
        return FlownResult(status, search, tuple(cut_off), tied, tests)
    raise AssertionError("sets in order end with a search that found none")


def _flown(chosen: MinimalSupports, fly: Fly, number: int) -> FlownSet | CutOff:
    """A set that ties the knot in every flight, or why it is cut off."""
    points = " ".join(f"p{k}" for k in chosen.supports) or "no supports"
    place = f"{chosen.robots} robots, cut {chosen.cable.cut}, {points}"
    logger.info("set %d: %s", number, place)
    flown: FlownSet | RequirementError
    try:
        flown = fly(chosen)
    except RequirementError as error:
        flown = error
    else:
        if flown.is_tied:
            return flown
    cut_off = CutOff.of(chosen, flown)
    logger.info("set %d: cut off: %s; %s", number, cut_off.tied_instead, cut_off.failed)
    return cut_off


def fly_set(
    name: str,
    chosen: SupportSet,
    tests: FlightTests | None = None,
    simulator: Simulator = MUJOCO,
) -> FlownSet:
    """Plan a set's flight by rehearsal, fly it undisturbed and, if that ties the knot, disturbed.

    Raises
    ------
    RequirementError
        There is no flight.
    MissingExtraError
        The simulator is not installed (extra `sim`).
    """
    request = FlightRequest(name, "milp")
    rehearsed = rehearse_flight(chosen.cable, chosen.supports, request, simulator=simulator)
    if not rehearsed.is_tied:
        return rehearsed
    disturbances = (tests or FlightTests()).disturbances
    return replace(rehearsed, disturbed=fly_trials(rehearsed.plan, disturbances, simulator))


def _verdict(content: dict[str, Any]) -> Verdict:
    return Verdict(**{**content, "outcome": Outcome(content["outcome"])})
