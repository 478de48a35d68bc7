"""Sets of supports in order: fewest robots first, then by cut, then the canonical one of a cut.

A set that was given is excluded by a row of its own, and its cut is solved again; the other cuts
keep what is known of them. A set that fails a further test is passed over in the same way, by the
row that the test gives.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

from formulations.backends import DEFAULT
from formulations.solution import Limits, Status
from knotopt.cable.cable import Cable
from knotopt.cable.cut import Cut, crossing_free_cuts
from knotopt.diagram.grid import GridDiagram
from knotopt.errors import RequirementError
from knotopt.supports.minimal import MinimalSupports, canonical_supports, minimal_supports
from knotopt.supports.requirements import Requirements
from knotopt.supports.search import CutOutcome, CutSearch

Supports = tuple[int, ...]
Clause = tuple[int, ...]
Lacks = Callable[[MinimalSupports], Clause | None]
"""What a set says of others if it fails a test: a clause, as in `Requirements.clauses`, that every
set that passes satisfies and it does not. None if it passes."""


@dataclass(frozen=True)
class OptimalSets:
    """The smallest sets of a diagram, by cut, those of a cut in canonical order.

    `complete` says that there are no others as small.
    """

    sets: tuple[MinimalSupports, ...]
    complete: bool


def optimal_sets(
    diagram: GridDiagram,
    requirements: Requirements | None = None,
    limit: int = 20,
    *,
    cuts: Iterable[Cut] | None = None,
    solver: str = DEFAULT,
    limits: Limits | None = None,
) -> OptimalSets:
    """All smallest sets of supports over the cuts of a diagram, or the first `limit` of them.

    In contrast to `all_minimal` every solver will do, and of more sets of a cut than `limit` those
    with the largest smallest opening are given.

    Parameters
    ----------
    diagram : GridDiagram
    requirements : Requirements, optional
    limit : int
    cuts, solver, limits
        As for `sets_in_order`.

    Raises
    ------
    RequirementError
        A limit below 1, or requirements with `max_robots`.

    Examples
    --------
    >>> from knotopt.reading.knot import read_knot
    >>> found = optimal_sets(read_knot("9").diagram, cuts=[Cut.parse("L+", 11)])
    >>> [each.supports for each in found.sets], found.complete
    ([(9, 10, 11), (9, 10, 12), (9, 10, 13)], True)
    """
    if limit < 1:
        raise RequirementError(f"at least 1 set is asked for, not {limit}")
    found: list[MinimalSupports] = []
    for search in sets_in_order(diagram, requirements, cuts=cuts, solver=solver, limits=limits):
        best = search.best
        if not best.found:
            return OptimalSets(tuple(found), search.status is Status.INFEASIBLE)
        if not search.is_proven:
            break
        if found and best.robots > found[0].robots:
            return OptimalSets(tuple(found), complete=True)
        if len(found) == limit:
            break
        found.append(best)
    return OptimalSets(tuple(found), complete=False)


def sets_in_order(
    diagram: GridDiagram,
    requirements: Requirements | None = None,
    *,
    cuts: Iterable[Cut] | None = None,
    excluded: Mapping[Cut, Sequence[Supports]] | None = None,
    lacks: Lacks | None = None,
    solver: str = DEFAULT,
    limits: Limits | None = None,
) -> Iterator[CutSearch]:
    """Every set that meets the requirements, one after the other.

    Parameters
    ----------
    diagram : GridDiagram
    requirements : Requirements, optional
        Not with `max_robots`.
    cuts : iterable of Cut, optional
        By default every crossing-free one; among equals the first cut comes first.
    excluded : mapping of Cut to sets, optional
        Sets that are passed over.
    lacks : callable, optional
        A test that sets must pass to be given.
    solver, limits
        As for `minimal_supports`; the time limit is for each solve. Where it strikes, sets may come
        out of order, and `is_proven` says so.

    Yields
    ------
    CutSearch
        What is known once all sets before are excluded. After the last set comes one without a set,
        whose status says whether there is no other or a limit struck.

    Raises
    ------
    As `minimal_supports`; KeyboardInterrupt also if the solver heard it.

    Examples
    --------
    >>> from itertools import islice
    >>> from knotopt.reading.knot import read_knot
    >>> for search in islice(sets_in_order(read_knot("9").diagram), 4):
    ...     print(search.best.cable.cut, search.best.supports, search.is_proven)
    L+ (9, 10, 11) True
    L+ (9, 10, 12) True
    L+ (9, 10, 13) True
    R+ (10, 11, 12) True
    """
    asked = requirements or Requirements()
    if asked.max_robots is not None:
        raise RequirementError("sets come in order of their robots: not with a largest number")
    passed = excluded or {}
    states = [
        _CutState(Cable(diagram, cut), _without(asked, passed.get(cut, ())))
        for cut in (crossing_free_cuts(diagram) if cuts is None else cuts)
    ]
    if not states:
        raise RequirementError("no cut is given")
    while waiting := [(state.rank, index) for index, state in enumerate(states) if state.waits]:
        index = min(waiting)[1]
        state = states[index]
        if state.result is None:
            _solve(state, index, states, solver, limits)
            continue
        if state.cut_off(state.result, lacks):
            continue
        best = canonical_supports(state.result, solver=solver, limits=limits)
        if state.cut_off(best, lacks):
            continue
        cut_off = None if lacks is None else _clauses(states)
        yield CutSearch(best, tuple(each.outcome for each in states), cut_off=cut_off)
        state.exclude(best.supports)
    nothing = _nothing_left(asked, states, solver, limits)
    yield nothing if lacks is None else replace(nothing, cut_off=_clauses(states))


def _clauses(states: list[_CutState]) -> int:
    """How many sets have failed the test."""
    return sum(len(state.asked.clauses) for state in states)


@dataclass
class _CutState:
    """What is known of one cut.

    Attributes
    ----------
    asked : Requirements
        With the sets that were given.
    bound : int
        Proven lower bound of the robots of the sets left.
    answer : MinimalSupports or None
        Of the last solve.
    waits : bool
        Whether there may be further sets.
    """

    cable: Cable
    asked: Requirements
    bound: int = 2
    answer: MinimalSupports | None = None
    waits: bool = True

    @property
    def result(self) -> MinimalSupports | None:
        """The smallest set left, once it is known."""
        return self.answer if self.answer is not None and self.answer.found else None

    @property
    def rank(self) -> int:
        """Robots of the smallest set left, as far as they are known."""
        return self.bound if self.result is None else self.result.robots

    @property
    def outcome(self) -> CutOutcome:
        cut = self.cable.cut
        if self.result is not None:
            return CutOutcome(cut, self.result.robots, self.bound, self.result.solution.status)
        if not self.waits and self.answer and self.answer.solution.status is Status.INFEASIBLE:
            return CutOutcome(cut, None, None, Status.INFEASIBLE)
        return CutOutcome(cut, None, self.bound, Status.UNKNOWN)

    def exclude(self, supports: Supports) -> None:
        self.asked = _without(self.asked, [supports])
        self.answer = None

    def cut_off(self, chosen: MinimalSupports, lacks: Lacks | None) -> bool:
        """Whether a set fails the test; then this cut is to be solved again."""
        clause = None if lacks is None else lacks(chosen)
        if clause is None:
            return False
        self.asked = replace(self.asked, clauses=(*self.asked.clauses, clause))
        self.answer = None
        return True


def _without(asked: Requirements, sets: Sequence[Supports]) -> Requirements:
    return replace(asked, excluded=(*asked.excluded, *sets))


def _solve(
    state: _CutState, index: int, states: list[_CutState], solver: str, limits: Limits | None
) -> None:
    """Find the smallest set left on a cut, unless another cut has one that comes before it."""
    known = (
        each.result.robots + (index < k) for k, each in enumerate(states) if each.result is not None
    )
    better = min(known, default=None)
    result = minimal_supports(
        state.cable,
        state.asked,
        solver=solver,
        limits=limits,
        canonical=False,
        explain=False,
        better_than=better,
    )
    if result.solution.interrupted:
        raise KeyboardInterrupt
    state.answer = result
    state.bound = max(state.bound, result.solution.bound or 0)
    if result.solution.status is Status.INFEASIBLE and better is not None:
        state.bound = max(state.bound, better)
    else:
        state.waits = result.found


def _nothing_left(
    asked: Requirements, states: list[_CutState], solver: str, limits: Limits | None
) -> CutSearch:
    """The end; if there never was a set, with what cannot be met together on the first cut."""
    outcomes = tuple(state.outcome for state in states)
    first = next(
        (state for state in states if state.outcome.status is not Status.INFEASIBLE), states[0]
    )
    assert first.answer is not None
    best = first.answer
    passed = any(state.asked.excluded or state.asked.clauses for state in states)
    if best.solution.status is Status.INFEASIBLE and not passed:
        best = minimal_supports(first.cable, asked, solver=solver, limits=limits)
    return CutSearch(best, outcomes)
