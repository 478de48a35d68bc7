"""The provably smallest set of supports of one cable: compile, solve, check by the definition."""

from __future__ import annotations

from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cached_property

from formulations.backends import DEFAULT, get_backend
from formulations.canonical import Program, lexicographically_first, widest
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
from knotopt.supports.opening import compile_opening
from knotopt.supports.regions import Regions
from knotopt.supports.requirements import Formulation, Requirements
from knotopt.supports.span import compile_span
from knotopt.supports.support_set import SupportSet
from knotopt.supports.team import compile_team
from knotopt.verify.opening import OpeningReport, check_opening
from knotopt.verify.regions import DefinedRegion
from knotopt.verify.span import check_span

SMALLEST = 1e-9  # squared openness that any opening at all exceeds [grid steps^2]


@dataclass(frozen=True)
class MinimalSupports(SupportSet):
    """The smallest set of supports found on one cable, and how sure that is.

    Attributes
    ----------
    lcf : LcfResult
        LCF on the same cable, which gave the regions and the first guess.
    requirements : Requirements
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
        and to be the lexicographically first of those.
    conflict : tuple of (family, origin)
        If there is no such set: a smallest collection of what cannot be met together.
    """

    lcf: LcfResult
    requirements: Requirements
    instance: Instance
    solution: Solution
    found: bool
    supports: tuple[int, ...]
    canonical: bool
    conflict: tuple[Group, ...] = ()

    @property
    def cable(self) -> Cable:
        """The cable the supports belong to."""
        return self.lcf.cable

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
    def smallest_opening(self) -> float | None:
        """Smallest distance of a threading point from a span [grid steps]; None without any."""
        squared = self.report.smallest_opening_squared
        return None if squared is None or not self.found else float(squared) ** 0.5

    def _examine(self, supports: tuple[int, ...]) -> OpeningReport:
        cable, asked = self.cable, self.requirements
        openness = asked.openness if asked.max_robots is None else Fraction(1, 10**6)
        check = check_span if asked.formulation is Formulation.SPAN else check_opening
        regions = defined_regions(self.lcf.regions)
        return check(cable.path, cable.diagram.size, supports, openness, asked.threading, regions)


def minimal_supports(
    cable: Cable,
    requirements: Requirements | None = None,
    *,
    solver: str = DEFAULT,
    limits: Limits | None = None,
    canonical: bool = True,
    better_than: int | None = None,
) -> MinimalSupports:
    """The smallest set of supports that meets the requirements, proven unless a limit strikes.

    Parameters
    ----------
    cable : Cable
    requirements : Requirements, optional
        By default formulation `opening` with r = 0.5.
    solver : str
        "cp-sat", "highs", "scip", "maxsat" or "exhaustive".
    limits : Limits, optional
        Time, gap, threads, seed; the time is shared by all solves of this call.
    canonical : bool
        Whether to go on to the one set that has the largest smallest opening and is first among
        those.
    better_than : int, optional
        Only sets of fewer robots are of interest; without one the status is INFEASIBLE.

    Raises
    ------
    SolverError, MissingExtraError
        No such solver, or it is not installed, or it cannot take this instance.
    RequirementError
        A requirement that does not fit this cable.

    Examples
    --------
    >>> from knotopt.catalogue.lookup import find_knot
    >>> best = minimal_supports(Cable(find_knot("5").diagram, "L+"))
    >>> best.robots, best.lcf.robots, best.lcf_report.is_open, best.report.is_open
    (6, 5, False, True)
    >>> best.solution.status, best.solution.bound, best.placed_supports
    (<Status.OPTIMAL: 'optimal'>, 6, ((5, 5, 2), (6, 7, 2), (7, 7, 7), (8, 2, 7)))
    """
    asked = requirements or Requirements()
    limits = limits or Limits()
    deadline = Deadline(limits)
    backend = find_backend(solver)
    seeded = lcf(cable)
    program = compile_program(seeded, asked)
    try:
        if asked.max_robots is not None:
            return _widest(program, seeded, asked, backend, deadline)
        level = float(asked.openness**2)
        instance = program.instance(level)
        if better_than is None:
            solution = backend.solve(instance, limits)
        elif (packed := instance.packing_bound()) >= better_than:
            words = f"{packed} robots at least, by rows that share no point"
            solution = Solution(Status.INFEASIBLE, words, bound=packed)
        else:
            instance = instance.with_rows([instance.at_most(better_than - 1)])
            solution = backend.solve(instance, limits)
        chosen, sure = solution.chosen, False
        if solution.status is Status.OPTIMAL and chosen is not None and canonical:
            size = len(chosen)
            wide = widest(program, backend, deadline.left(), level, size)
            if wide is not None:
                level, chosen = wide
                at_level = program.instance(level)
                chosen, sure = lexicographically_first(
                    at_level, backend, deadline.left(), size, chosen
                )
        result = _result(seeded, asked, instance, solution, chosen, canonical=sure)
        if solution.status is Status.INFEASIBLE and better_than is None:
            found = conflict(instance, backend, deadline.left())
            result = replace(result, conflict=found)
    except BackendError as error:
        raise SolverError(str(error)) from error
    return result


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
        raise RequirementError("all smallest sets can be listed only once the smallest is proven")
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
    """The formulation's program for LCF's cable, regions and first guess."""
    regions = seeded.regions
    team = compile_team(regions, requirements)
    start = (1, *seeded.supports, len(seeded.cable.path))
    compiled = compile_span if requirements.formulation is Formulation.SPAN else compile_opening
    return compiled(regions, requirements.threading, team, start)


def find_backend(solver: str) -> Backend:
    """The solver of that name; errors are this package's."""
    try:
        return get_backend(solver)
    except MissingSolverError as error:
        raise MissingExtraError(error.package, error.extra, f"solver {solver}") from error
    except BackendError as error:
        raise SolverError(str(error)) from error


def defined_regions(regions: Regions) -> list[DefinedRegion]:
    """The regions as the checkers take them."""
    cells = [tuple(cell) for cell in regions.cable.cells.tolist()]
    found = []
    for region in regions:
        walk = list(range(region.intervals[0][0], region.intervals[0][1] + 1))
        for low, high in region.intervals[1:]:
            later = range(low, high + 1)
            walk += later if cells[low] == cells[walk[-1]] else reversed(later)
        apexes = frozenset(cells[regions.cable.crossings[k].first] for k in region.apexes)
        columns, rows = region.interior.nonzero()
        interior = zip((columns + 1).tolist(), (rows + 1).tolist(), strict=True)
        found.append(
            DefinedRegion(
                str(region.kind), apexes, tuple(walk), frozenset(interior), region.threaded_by
            )
        )
    return found


def _widest(
    program: Program,
    seeded: LcfResult,
    asked: Requirements,
    backend: Backend,
    deadline: Deadline,
) -> MinimalSupports:
    """At most so many robots: maximise the smallest opening, then use as few as that allows."""
    assert asked.max_robots is not None
    instance = program.instance(SMALLEST)
    wide = widest(program, backend, deadline.left(), SMALLEST, asked.max_robots)
    sure = False
    if wide is None:
        solution = backend.solve(instance, deadline.left())
        result = _result(seeded, asked, instance, solution, solution.chosen, canonical=False)
        if solution.status is Status.INFEASIBLE:
            found = conflict(instance, backend, deadline.left())
            result = replace(result, conflict=found)
        return result
    level, chosen = wide
    instance = program.instance(level)
    solution = backend.solve(instance, deadline.left())
    if solution.status is Status.OPTIMAL and solution.chosen is not None:
        chosen, sure = lexicographically_first(
            instance, backend, deadline.left(), len(solution.chosen), solution.chosen
        )
    return _result(seeded, asked, instance, solution, chosen, canonical=sure)


def _result(
    seeded: LcfResult,
    asked: Requirements,
    instance: Instance,
    solution: Solution,
    chosen: tuple[int, ...] | None,
    *,
    canonical: bool,
) -> MinimalSupports:
    found = chosen is not None
    supports = chosen[1:-1] if chosen is not None else ()
    return MinimalSupports(seeded, asked, instance, solution, found, supports, canonical)
