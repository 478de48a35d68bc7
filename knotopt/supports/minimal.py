"""The provably smallest set of supports of one cable: compile, solve, check by the definition."""

from __future__ import annotations

from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cached_property

from formulations.backends import DEFAULT, get_backend
from formulations.canonical import Program, at_once, lexicographically_first, widest
from formulations.infeasible import Group, conflict
from formulations.instance import Instance
from formulations.solution import (
    Backend,
    BackendError,
    Enumeration,
    Enumerator,
    Feature,
    Limits,
    MissingSolverError,
    Solution,
    Status,
)
from formulations.timing import Deadline
from knotopt.cable.cable import Cable
from knotopt.errors import MissingExtraError, RequirementError, SolverError
from knotopt.supports.lcf import LcfResult, lcf
from knotopt.supports.loops import LOOPS, disjoint_loops
from knotopt.supports.registry import find_formulation
from knotopt.supports.requirements import Requirements
from knotopt.supports.support_set import SupportSet
from knotopt.supports.team import compile_team
from knotopt.verify.definition import OpeningReport

SMALLEST = 1e-9  # squared openness that any opening at all exceeds [grid steps^2]


@dataclass(frozen=True, repr=False)
class MinimalSupports(SupportSet):
    """The smallest set of supports found on one cable, and how sure that is.

    Attributes
    ----------
    lcf : LcfResult
        LCF on the same cable, which gave the regions and the first guess.
    requirements : Requirements
    program : Program
        The formulation's program of this cable, for any openness.
    instance : Instance
        The 0-1 program that was solved; its decisions are the turning points.
    solution : Solution
        The solver's answer: status, bound, gap, times, versions. Objective and bound count robots.
    found : bool
        Whether there is a set; without one `supports` is empty.
    supports : tuple of int
        1-based on the path, without p_1 and p_n.
    canonical : bool
        Whether, among all sets as small, this one is known to have the largest smallest opening
        (openings of 1 grid step and more count as 1) and to be the lexicographically first of
        those.
    conflict : tuple of (family, origin)
        If there is no such set: what cannot be met together.
    conflict_is_smallest : bool
        Whether each of these can be left out to make the others possible.
    """

    lcf: LcfResult
    requirements: Requirements
    program: Program
    instance: Instance
    solution: Solution
    found: bool
    supports: tuple[int, ...]
    canonical: bool
    conflict: tuple[Group, ...] = ()
    conflict_is_smallest: bool = False

    @property
    def cable(self) -> Cable:
        """The cable the supports belong to."""
        return self.lcf.cable

    @property
    def in_words(self) -> str:
        """Formulation, robots, and whether a smaller set is excluded."""
        asked = f"{self.requirements.formulation}, "
        if not self.found:
            return f"{asked}cut {self.cable.cut}, no set found: {self.solution.status}"
        return f"{asked}{super().in_words}, {self.solution.status}"

    @property
    def is_proven(self) -> bool:
        """Whether the set is open by the definition and no smaller one is.

        With `max_robots`: whether no set of so many robots has a larger opening.
        """
        if not self.found or not self.report.is_open:
            return False
        if self.requirements.max_robots is not None:
            return self.canonical
        return self.solution.status is Status.OPTIMAL

    @cached_property
    def report(self) -> OpeningReport:
        """The set examined by the definition, in exact arithmetic, without the program's rows."""
        return self._examine(self.supports)

    @cached_property
    def lcf_report(self) -> OpeningReport:
        """LCF's own set examined in the same way."""
        return self._examine(self.lcf.supports)

    @property
    def disjoint_loops(self) -> tuple[int, ...]:
        """Where every loop must hold a support: as many loops as possible of which no two have a
        turning point in common, as indices into the cable's crossings. Each needs its own.
        """
        asked = self.requirements
        if asked.with_loops or asked.formulation == LOOPS.name:
            return disjoint_loops(self.cable)
        return ()

    @property
    def smallest_opening(self) -> float | None:
        """Smallest distance of a threading point from a span [grid steps]; None without any."""
        squared = self.report.smallest_opening_squared
        return None if squared is None or not self.found else float(squared) ** 0.5

    def _examine(self, supports: tuple[int, ...]) -> OpeningReport:
        cable, asked = self.cable, self.requirements
        openness = asked.openness if asked.max_robots is None else Fraction(1, 10**6)
        check = find_formulation(asked.formulation).checker(with_loops=asked.with_loops)
        return check(cable.path, cable.diagram.size, supports, openness, asked.threading)


def minimal_supports(
    cable: Cable,
    requirements: Requirements | None = None,
    *,
    solver: str = DEFAULT,
    limits: Limits | None = None,
    canonical: bool = True,
    explain: bool = True,
    better_than: int | None = None,
) -> MinimalSupports:
    """The smallest set of supports that meets the requirements, proven unless a limit strikes.

    Parameters
    ----------
    cable : Cable
    requirements : Requirements, optional
        By default formulation `opening` with r = 0.5.
    solver : str
        "cp-sat", "highs", "scip", "maxsat" or "exhaustive". Where the program gives its smallest
        set without a solver (`loops`, if the team asks for nothing else), the default leaves it to
        it.
    limits : Limits, optional
        Time, gap, threads, seed; the time is shared by all solves of this call. It is not looked at
        while the program is compiled.
    canonical : bool
        Whether to go on to the one set that has the largest smallest opening and is first among
        those.
    explain : bool
        Whether to look for a smallest conflict if there is no set.
    better_than : int, optional
        Only sets of fewer robots are of interest; without one the status is INFEASIBLE, and the
        bound says no more than `better_than`. Not with `max_robots`.

    Raises
    ------
    SolverError, MissingExtraError
        No such solver, or it is not installed, or it cannot take this instance.
    RequirementError
        A requirement that does not fit this cable.

    Examples
    --------
    >>> from knotopt.reading.knot import read_knot
    >>> best = minimal_supports(Cable(read_knot("5").diagram, "L+"))
    >>> best.robots, best.lcf.robots, best.lcf_report.is_open, best.report.is_open
    (6, 5, False, True)
    >>> best.solution.status, best.solution.bound, best.placed_supports
    (<Status.OPTIMAL: 'optimal'>, 6, ((5, 5, 2), (6, 7, 2), (7, 7, 7), (8, 2, 7)))
    """
    asked = requirements or Requirements()
    limits = limits or Limits()
    deadline = Deadline(limits)
    backend = find_backend(solver)
    for feature, value in ((Feature.GAP, limits.gap > 0), (Feature.THREADS, limits.threads > 1)):
        if value and feature not in backend.features:
            raise SolverError(f"solver {solver} cannot be given {feature.phrase}")
    seeded = lcf(cable)
    program = compile_program(seeded, asked)
    try:
        if asked.max_robots is not None:
            result = _widest(program, seeded, asked, backend, deadline)
        else:
            instance = program.instance(float(asked.openness**2))
            known = at_once(program) if solver == DEFAULT else None
            if known is not None:
                known = replace(known, threads=limits.threads, seed=limits.seed)
                solution = _if_better(known, better_than)
            else:
                solution = _solve(instance, backend, deadline, better_than)
            result = _result(
                seeded,
                asked,
                program,
                instance,
                solution,
                solution.chosen,
                canonical=known is not None,
            )
            if canonical and result.found and known is None:
                result = canonical_supports(result, solver=solver, limits=deadline.left())
        if explain and result.solution.status is Status.INFEASIBLE:
            groups, sure = conflict(result.instance, backend, deadline.left())
            result = replace(result, conflict=groups, conflict_is_smallest=sure)
    except BackendError as error:
        raise SolverError(str(error)) from error
    return result


def canonical_supports(
    result: MinimalSupports, *, solver: str = DEFAULT, limits: Limits | None = None
) -> MinimalSupports:
    """The canonical one among the sets as small as a proven result's; others stay as they are.

    If a limit strikes, the set may be any as small, and `canonical` says that it is not known to be
    the one.
    """
    asked = result.requirements
    if result.solution.status is not Status.OPTIMAL or asked.max_robots is not None:
        return result
    deadline = Deadline(limits or Limits())
    backend = find_backend(solver)
    level, size = float(asked.openness**2), result.robots
    wide, sure = widest(result.program, backend, deadline.left(), level, size)
    if wide is None:
        return result
    chosen, is_first = lexicographically_first(
        result.program.instance(wide[0]), backend, deadline.left(), size, wide[1]
    )
    return replace(result, supports=chosen[1:-1], canonical=sure and is_first)


def all_minimal(
    result: MinimalSupports,
    *,
    count: int = 1000,
    solver: str = DEFAULT,
    limits: Limits | None = None,
) -> Enumeration:
    """Every set of supports as small as the result's, `count` at most, each without p_1 and p_n.

    Raises
    ------
    SolverError
        The solver cannot enumerate; the message names those that can.
    RequirementError
        The result is no proven optimum.
    """
    if not result.is_proven or not result.found or result.requirements.max_robots is not None:
        raise RequirementError(
            "all smallest sets can be listed only once the smallest is proven, "
            "and not with a largest number of robots"
        )
    backend = find_backend(solver)
    if Feature.ENUMERATION not in backend.features:
        raise SolverError(f"solver {solver} cannot list all sets; cp-sat and exhaustive can")
    enumerator: Enumerator = backend  # type: ignore[assignment]
    instance = result.instance
    smallest = instance.with_rows([instance.at_most(result.robots)])
    try:
        every = enumerator.enumerate(smallest, limits or Limits(), count)
    except BackendError as error:
        raise SolverError(str(error)) from error
    return replace(every, sets=tuple(chosen[1:-1] for chosen in every.sets))


def compile_program(seeded: LcfResult, requirements: Requirements) -> Program:
    """The formulation's program for LCF's cable, regions and first guess.

    Raises
    ------
    RequirementError
        A point that the cable does not have, or a region too large for `span`.
    """
    team = compile_team(seeded.regions, requirements)
    start = (1, *seeded.supports, len(seeded.cable.path))
    compiler = find_formulation(requirements.formulation).compile
    program: Program = compiler(seeded.regions, requirements.threading, team, start)
    return program


def find_backend(solver: str) -> Backend:
    """The solver of that name.

    Raises
    ------
    SolverError, MissingExtraError
        There is none, or it is not installed.
    """
    try:
        return get_backend(solver)
    except MissingSolverError as error:
        raise MissingExtraError(error.package, error.extra, f"solver {solver}") from error
    except BackendError as error:
        raise SolverError(str(error)) from error


def _at_hand(solution: Solution, instance: Instance) -> Solution:
    """If the solver stopped without a set: LCF's or all turning points, if that does."""
    if solution.status is not Status.UNKNOWN:
        return solution
    every = tuple(range(1, instance.decisions + 1))
    for chosen, words in ((instance.start or (), "LCF's set"), (every, "all turning points")):
        if not instance.violated(instance.complete(chosen)):
            return replace(
                solution,
                status=Status.FEASIBLE,
                raw_status=f"{solution.raw_status}; {words}",
                chosen=chosen,
                objective=len(chosen),
            )
    return solution


def _if_better(known: Solution, better_than: int | None) -> Solution:
    """A smallest set that is known, if it has fewer than `better_than` robots."""
    if better_than is None or known.bound is None or known.bound < better_than:
        return known
    return replace(known, status=Status.INFEASIBLE, chosen=None, objective=None)


def _solve(
    instance: Instance, backend: Backend, deadline: Deadline, better_than: int | None
) -> Solution:
    """The smallest set, or the smallest of fewer than `better_than` robots."""
    if better_than is None:
        return _at_hand(backend.solve(instance, deadline.left()), instance)
    if (packed := instance.packing_bound()) >= better_than:
        words = f"{packed} robots at least, by rows that share no point"
        return Solution(Status.INFEASIBLE, words, bound=packed)
    instance = instance.with_rows([instance.at_most(better_than - 1)])
    solution = _at_hand(backend.solve(instance, deadline.left()), instance)
    # What is proven of the sets asked for holds for all sets up to their size only.
    bound = None if solution.bound is None else min(solution.bound, better_than)
    return replace(solution, bound=bound)


def _widest(
    program: Program,
    seeded: LcfResult,
    asked: Requirements,
    backend: Backend,
    deadline: Deadline,
) -> MinimalSupports:
    """At most so many robots: maximise the smallest opening, then use as few as that allows."""
    assert asked.max_robots is not None
    wide, sure = widest(program, backend, deadline.left(), SMALLEST, asked.max_robots)
    level, chosen = (SMALLEST, None) if wide is None else wide
    instance = program.instance(level)
    solution = backend.solve(instance, deadline.left())
    if solution.status is Status.OPTIMAL and solution.chosen is not None:
        chosen, is_first = lexicographically_first(
            instance, backend, deadline.left(), len(solution.chosen), solution.chosen
        )
        sure = sure and is_first
    elif chosen is not None:
        sure = False
    return _result(seeded, asked, program, instance, solution, chosen, canonical=sure)


def _result(
    seeded: LcfResult,
    asked: Requirements,
    program: Program,
    instance: Instance,
    solution: Solution,
    chosen: tuple[int, ...] | None,
    *,
    canonical: bool = False,
) -> MinimalSupports:
    found, supports = chosen is not None, (chosen or ())[1:-1]
    return MinimalSupports(
        seeded, asked, program, instance, solution, found, supports, found and canonical
    )
