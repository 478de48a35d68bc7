"""The smallest set of supports that ties the knot in simulation: solve, fly, cut off, solve again.

Sets come in order of their robots. A set whose flights do not all tie the knot is cut off, by
itself: whether a set ties says nothing of the sets that contain it. That a set was cut off is no
proof that it cannot be flown; it says that the flights tried failed.
"""

from __future__ import annotations

import importlib.util
import math
import time
from collections import Counter, defaultdict
from collections.abc import Callable, Iterable, Sequence
from dataclasses import asdict, dataclass
from enum import StrEnum
from typing import Any

from formulations.backends import DEFAULT
from formulations.solution import Limits, Status
from knotopt.cable.cut import Cut
from knotopt.diagram.grid import GridDiagram
from knotopt.errors import MissingExtraError, RequirementError
from knotopt.flight.examine import examine_flight
from knotopt.flight.record import Disturbance
from knotopt.rehearsal.rehearse import Rehearsal, rehearse_flight
from knotopt.sim.judge import Outcome, Verdict
from knotopt.sim.trials import Trial, fly_trials
from knotopt.supports.by_size import Supports, sets_in_order
from knotopt.supports.minimal import MinimalSupports
from knotopt.supports.requirements import Requirements
from knotopt.supports.search import CutSearch

NOISE = 0.01  # of the robots' positions [m]
TRIALS = 3
MAX_CUT = 20


class FlownStatus(StrEnum):
    """How a search for a set that ties has ended."""

    TIED = "tied"  # a set tied the knot in all its flights
    BUDGET = "budget"  # no set did so before time or number of sets ran out
    NO_SET = "no set"  # every set that meets the requirements was flown, or there is none
    UNKNOWN = "unknown"  # the solver stopped at a limit before it had a further set


@dataclass(frozen=True)
class FlightTest:
    """What came of flying one set.

    Attributes
    ----------
    verdict : Verdict or None
        Of the undisturbed flight; None if no flight could be planned.
    trials : tuple of Verdict
        Of the disturbed flights; none are flown where the undisturbed one fails.
    failed : str
        The first crossing that did not happen as planned, and how, in the first flight that failed;
        or why there is no plan.
    rehearsal : Rehearsal or None
    """

    verdict: Verdict | None
    trials: tuple[Verdict, ...] = ()
    failed: str = ""
    rehearsal: Rehearsal | None = None

    @property
    def is_tied(self) -> bool:
        """Whether every flight tied the knot."""
        return self.verdict is not None and all(
            verdict.outcome is Outcome.TIED for verdict in (self.verdict, *self.trials)
        )


@dataclass(frozen=True)
class CutOff:
    """A set that was flown and did not tie the knot in all flights.

    Attributes
    ----------
    cut : str
        Of the diagram, such as "L+".
    supports : tuple of int
        1-based on the path, without p_1 and p_n.
    verdict, trials, failed
        As in `FlightTest`.
    """

    cut: str
    supports: Supports
    verdict: Verdict | None
    trials: tuple[Verdict, ...]
    failed: str

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
    flight : FlightTest or None
        Of the set that ties.
    noise : float
        Standard deviation of every robot's position error in the disturbed flights [m].
    trials : int
        Disturbed flights that each set had to tie in, with seeds 1, 2, ...
    """

    status: FlownStatus
    search: CutSearch
    cut_off: tuple[CutOff, ...]
    flight: FlightTest | None
    noise: float
    trials: int

    @property
    def result(self) -> MinimalSupports:
        """The solver's set, of the best cut."""
        return self.search.best

    @property
    def rehearsal(self) -> Rehearsal | None:
        """The flight of the set that ties."""
        return self.flight.rehearsal if self.flight else None

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


Fly = Callable[[MinimalSupports], FlightTest]


def solve_flown(
    name: str,
    diagram: GridDiagram,
    requirements: Requirements | None = None,
    *,
    cuts: Iterable[Cut] | None = None,
    noise: float = NOISE,
    trials: int = TRIALS,
    seconds: float | None = None,
    max_cut: int | None = None,
    solver: str = DEFAULT,
    limits: Limits | None = None,
    known: Sequence[CutOff] = (),
    fly: Fly | None = None,
    on_cut_off: Callable[[CutOff], None] | None = None,
    tell: Callable[[str], None] | None = None,
) -> FlownResult:
    """The first set, by number of robots, cut and clearance, that ties the knot in simulation.

    Parameters
    ----------
    name : str
        Of the knot.
    diagram, requirements, cuts, solver, limits
        As for `sets_in_order`; the time limit is for each solve.
    noise : float
        Standard deviation of every robot's position error in the disturbed flights [m].
    trials : int
        How many disturbed flights must tie the knot, beside the undisturbed one.
    seconds : float, optional
        No further set is flown after so much time; the flight at hand is finished [s].
    max_cut : int, optional
        No further set is flown once so many are cut off, those known included. 20 unless a budget
        is given.
    known : sequence of CutOff
        Sets cut off before, which are not flown again.
    fly : callable, optional
        Flies a set. By default it is rehearsed and flown in physics, see `fly_set`.
    on_cut_off : callable, optional
        Is given each set that is cut off, at once.
    tell : callable, optional
        Is told what is being done.

    Raises
    ------
    MissingExtraError
        MuJoCo is not installed (extra `sim`); nothing is solved then.
    RequirementError
        Noise, trials or a budget that make no sense, or requirements with `max_robots`.
    """
    _check_numbers(noise, trials, seconds, max_cut)
    tell = tell or (lambda _: None)
    if fly is None:
        require_simulation()

        def fly(result: MinimalSupports) -> FlightTest:
            return fly_set(name, result, noise, trials, tell)

    if max_cut is None and seconds is None:
        max_cut = MAX_CUT
    began = time.monotonic()
    passed = defaultdict[Cut, list[Supports]](list)
    for each in known:
        passed[Cut.parse(each.cut, diagram.size)].append(each.supports)
    cut_off = list(known)

    def ended(
        status: FlownStatus, search: CutSearch, flight: FlightTest | None = None
    ) -> FlownResult:
        return FlownResult(status, search, tuple(cut_off), flight, noise, trials)

    for search in sets_in_order(
        diagram, requirements, cuts=cuts, excluded=passed, solver=solver, limits=limits
    ):
        best = search.best
        if not best.found:
            none = search.status is Status.INFEASIBLE
            return ended(FlownStatus.NO_SET if none else FlownStatus.UNKNOWN, search)
        late = seconds is not None and time.monotonic() - began >= seconds
        if late or (max_cut is not None and len(cut_off) >= max_cut):
            return ended(FlownStatus.BUDGET, search)
        points = " ".join(f"p{k}" for k in best.supports) or "no supports"
        tell(f"set {len(cut_off) + 1}: {best.robots} robots, cut {best.cable.cut}, {points}")
        flight = fly(best)
        if flight.is_tied:
            return ended(FlownStatus.TIED, search, flight)
        cut_off.append(
            CutOff(str(best.cable.cut), best.supports, flight.verdict, flight.trials, flight.failed)
        )
        tell(f"set {len(cut_off)}: cut off: {cut_off[-1].tied_instead}; {flight.failed}")
        if on_cut_off is not None:
            on_cut_off(cut_off[-1])
    raise AssertionError("sets in order end with a search that found none")


def require_simulation() -> None:
    """Whether sets can be flown here.

    Raises
    ------
    MissingExtraError
        MuJoCo is not installed (extra `sim`).
    """
    if importlib.util.find_spec("mujoco") is None:
        raise MissingExtraError("mujoco", "sim", "flying sets of supports")


def fly_set(
    name: str,
    result: MinimalSupports,
    noise: float = NOISE,
    trials: int = TRIALS,
    tell: Callable[[str], None] | None = None,
) -> FlightTest:
    """Plan a set's flight by rehearsal, fly it undisturbed, then disturbed with seeds 1, 2, ...

    Raises
    ------
    MissingExtraError
        MuJoCo is not installed (extra `sim`).
    """
    try:
        rehearsal = rehearse_flight(name, result.cable, result.supports, "milp", tell=tell)
    except RequirementError as error:
        return FlightTest(None, failed=str(error))
    flown = [Trial(rehearsal.record, rehearsal.verdict)]
    if rehearsal.is_tied:
        disturbances = [Disturbance(noise, seed=seed) for seed in range(1, trials + 1)]
        flown += fly_trials(rehearsal.plan, disturbances)
    failed = next((trial for trial in flown if not trial.is_tied), None)
    verdicts = tuple(trial.verdict for trial in flown)
    words = "" if failed is None else _first_amiss(rehearsal, failed)
    return FlightTest(verdicts[0], verdicts[1:], words, rehearsal)


def _first_amiss(rehearsal: Rehearsal, trial: Trial) -> str:
    """The first crossing that a flight did not make as planned."""
    try:
        amiss = examine_flight(rehearsal.plan, trial.record).amiss
    except ValueError:  # positions that are no numbers
        return "the simulation broke down"
    if amiss:
        return amiss[0].sentence
    return "every crossing happened as planned; where along the spans is not compared"


def _check_numbers(noise: float, trials: int, seconds: float | None, max_cut: int | None) -> None:
    if not (math.isfinite(noise) and noise >= 0):
        raise RequirementError(f"the noise is a number of metres from 0 up, not {noise:g}")
    if trials < 1:
        raise RequirementError(f"the disturbed flights are at least 1, not {trials}")
    if seconds is not None and not seconds > 0:
        raise RequirementError(f"the time for flights must be positive, not {seconds:g} s")
    if max_cut is not None and max_cut < 1:
        raise RequirementError(f"at least 1 set may be cut off, not {max_cut}")


def _verdict(content: dict[str, Any]) -> Verdict:
    return Verdict(**{**content, "outcome": Outcome(content["outcome"])})
