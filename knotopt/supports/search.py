"""The smallest set over all cuts of a diagram.

A bound found on one cable serves all: a cable whose lower bound reaches the best set so far is
skipped, and the others are only asked for a smaller set.
"""

from __future__ import annotations

import logging
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass

from formulations.backends import DEFAULT
from formulations.solution import Limits, Status
from formulations.timing import Deadline
from knotopt.cable.cable import Cable
from knotopt.cable.cut import Cut, crossing_free_cuts
from knotopt.diagram.grid import GridDiagram
from knotopt.errors import RequirementError
from knotopt.showing import ShownShort, plural
from knotopt.supports.minimal import MinimalSupports, canonical_supports, minimal_supports
from knotopt.supports.requirements import Requirements

logger = logging.getLogger(__name__)


@dataclass(frozen=True)
class CutOutcome:
    """What is known of one cut.

    Attributes
    ----------
    cut : Cut
    robots : int or None
        Size of its smallest set found; None if it was skipped or has none.
    bound : int or None
        Proven lower bound of its robots; None if nothing is known, or no set exists.
    status : Status
        OPTIMAL with `robots` = `bound`; UNKNOWN with a bound alone if the cut cannot beat another.
    """

    cut: Cut
    robots: int | None
    bound: int | None
    status: Status


@dataclass(frozen=True, repr=False)
class CutSearch(ShownShort):
    """The best cut of a diagram.

    Attributes
    ----------
    best : MinimalSupports
        On the first cut with the fewest robots. If no cut has a set, what is known of the first.
    outcomes : tuple of CutOutcome
        One for every cut, in order.
    interrupted : bool
        Whether Ctrl-C ended the search.
    cut_off : int or None
        Sets that failed a further test, each cut off with others by a row of its own. None where
        there was no such test.
    """

    best: MinimalSupports
    outcomes: tuple[CutOutcome, ...]
    interrupted: bool = False
    cut_off: int | None = None

    @property
    def in_words(self) -> str:
        """The best set, and over how many cuts."""
        return f"best of {plural(len(self.outcomes), 'cut')}: {self.best.in_words}"

    @property
    def status(self) -> Status:
        """What is known over all cuts."""
        if self.is_proven:
            return Status.OPTIMAL
        if self.best.found:
            return Status.FEASIBLE
        if all(outcome.status is Status.INFEASIBLE for outcome in self.outcomes):
            return Status.INFEASIBLE
        return Status.UNKNOWN

    @property
    def bound(self) -> int | None:
        """Proven lower bound of the robots over all cuts; None if some cut has none."""
        bounds = [o.bound for o in self.outcomes if o.status is not Status.INFEASIBLE]
        known = [bound for bound in bounds if bound is not None]
        return min(known) if known and len(known) == len(bounds) else None

    @property
    def is_proven(self) -> bool:
        """Whether no cut has a smaller set."""
        if not self.best.is_proven:
            return False
        left = [outcome for outcome in self.outcomes if outcome.status is not Status.INFEASIBLE]
        if self.best.requirements.max_robots is not None:
            return all(outcome.status is Status.OPTIMAL for outcome in left)
        return all((outcome.bound or 0) >= self.best.robots for outcome in left)


def best_supports(
    diagram: GridDiagram,
    requirements: Requirements | None = None,
    *,
    cuts: Iterable[Cut] | None = None,
    solver: str = DEFAULT,
    limits: Limits | None = None,
    canonical: bool = True,
    better_than: int | None = None,
    progress: Callable[[int], None] | None = None,
) -> CutSearch:
    """The smallest set of supports over the cuts of a diagram.

    Ctrl-C ends the search with what is known.

    Parameters
    ----------
    diagram : GridDiagram
    requirements : Requirements, optional
    cuts : iterable of Cut, optional
        By default every crossing-free one; ties are broken in their order.
    solver, limits, canonical
        As for `minimal_supports`; the time limit is for all cuts together.
    better_than : int, optional
        Only sets of fewer robots are of interest.
    progress : callable, optional
        Told after each cut how many are done.

    Raises
    ------
    As `minimal_supports`; RequirementError also if no cut is given.

    Examples
    --------
    >>> from knotopt.reading.knot import read_knot
    >>> search = best_supports(read_knot("9").diagram)
    >>> search.best.robots, str(search.best.cable.cut), search.is_proven
    (5, 'L+', True)
    >>> [(str(o.cut), o.robots, o.bound) for o in search.outcomes[:3]]
    [('L+', 5, 5), ('L-', None, 5), ('R+', None, 5)]
    """
    asked = requirements or Requirements()
    deadline = Deadline(limits or Limits())
    chosen = tuple(crossing_free_cuts(diagram) if cuts is None else cuts)
    best: MinimalSupports | None = None
    outcomes: list[CutOutcome] = []
    widest = asked.max_robots is not None
    incumbent, interrupted = None if widest else better_than, False
    for cut in chosen:
        if best is not None and deadline.passed:
            break
        try:
            result = minimal_supports(
                Cable(diagram, cut),
                asked,
                solver=solver,
                limits=deadline.left(),
                canonical=False,
                explain=False,
                better_than=incumbent,
            )
        except KeyboardInterrupt:  # outside the solver, which ends by itself
            if best is None:
                raise
            interrupted = True
            break
        outcomes.append(_outcome(result, incumbent))
        if result.found and not widest:
            incumbent = result.robots
        if best is None or is_better(result, best):
            best = result
        logger.debug("cut %s: %s robots, bound %s", cut, outcomes[-1].robots, outcomes[-1].bound)
        if progress is not None:
            progress(len(outcomes))
        interrupted = result.solution.interrupted
        if interrupted:
            break
    outcomes += [CutOutcome(cut, None, None, Status.UNKNOWN) for cut in chosen[len(outcomes) :]]
    if best is None:
        raise RequirementError("no cut is given")
    if not (interrupted or deadline.passed):
        if best.found and canonical:
            best = canonical_supports(best, solver=solver, limits=deadline.left())
        elif best.solution.status is Status.INFEASIBLE and better_than is None:
            best = minimal_supports(best.cable, asked, solver=solver, limits=deadline.left())
    return CutSearch(best, tuple(outcomes), interrupted)


def supports_by_cut(
    diagram: GridDiagram,
    requirements: Requirements | None = None,
    *,
    cuts: Iterable[Cut] | None = None,
    solver: str = DEFAULT,
    limits: Limits | None = None,
) -> Iterator[MinimalSupports]:
    """The smallest set of every cut by itself; by default of every crossing-free one.

    Ctrl-C ends it after the cut at hand.
    """
    deadline = Deadline(limits or Limits())
    for cut in crossing_free_cuts(diagram) if cuts is None else cuts:
        result = minimal_supports(
            Cable(diagram, cut), requirements, solver=solver, limits=deadline.left()
        )
        yield result
        if result.solution.interrupted:
            return


def _outcome(result: MinimalSupports, incumbent: int | None) -> CutOutcome:
    """What a solve says of its cut, if only sets smaller than the incumbent were asked for."""
    status, bound = result.solution.status, result.solution.bound
    if status is Status.INFEASIBLE and incumbent is not None:
        status, bound = Status.UNKNOWN, max(incumbent, bound or 0)
    robots = result.robots if result.found else None
    if result.requirements.max_robots is not None and result.found and not result.canonical:
        status = Status.FEASIBLE  # a larger opening is not excluded
    return CutOutcome(result.cable.cut, robots, bound, status)


def is_better(result: MinimalSupports, other: MinimalSupports) -> bool:
    """Fewer robots; with a largest number of robots: a larger smallest opening."""
    if not (result.found or other.found):  # of two failures the undecided one
        return result.solution.status is not Status.INFEASIBLE is other.solution.status
    if not (result.found and other.found):
        return result.found
    if result.requirements.max_robots is None:
        return result.robots < other.robots
    opening, best = result.smallest_opening, other.smallest_opening
    return best is not None and (opening is None or opening > best)
