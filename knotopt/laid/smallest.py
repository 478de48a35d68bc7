"""The smallest set of supports that lays the knot, and the test by which others are cut off."""

from __future__ import annotations

from dataclasses import replace

from formulations.backends import DEFAULT
from formulations.loops import LoopsProgram
from formulations.solution import BackendError, Limits, Solution
from formulations.team import Team
from knotopt.cable.cable import Cable
from knotopt.cable.cut import Cut
from knotopt.diagram.grid import GridDiagram
from knotopt.errors import SolverError
from knotopt.laid.cuts import clause
from knotopt.laid.laid import LaidTest
from knotopt.supports.by_size import Clause
from knotopt.supports.minimal import find_backend
from knotopt.supports.support_set import SupportSet


class LaidCuts:
    """Cuts off sets that do not lay the knot, whichever cut of which diagram they are for.

    A `knotopt.supports.by_size.Lacks`.
    """

    def __init__(self) -> None:
        self._tests: dict[tuple[GridDiagram, Cut], LaidTest] = {}

    def __call__(self, chosen: SupportSet) -> Clause | None:
        """The clause that cuts off the set; None if it lays the knot."""
        return clause(self.test(chosen.cable), chosen.supports)

    def test(self, cable: Cable) -> LaidTest:
        """The test of a cable; each is made once."""
        return self._tests.setdefault((cable.diagram, cable.cut), LaidTest(cable))


def smallest_laid(
    cable: Cable, *, solver: str = DEFAULT, limits: Limits | None = None
) -> tuple[Solution, int]:
    """The smallest set of supports of a cable that lays the knot, whatever else becomes of it.

    Such a set may leave loops without a support: what counts is the knot, not the diagram.

    Parameters
    ----------
    cable : Cable
    solver, limits
        As for `minimal_supports`; the time limit is for each solve.

    Returns
    -------
    solution : Solution
        Chosen are the lifting robots, too. Without a proof if a limit struck.
    cut_off : int
        Sets that were cut off on the way, each with others by a row of its own.

    Raises
    ------
    SolverError, MissingExtraError

    Examples
    --------
    >>> from knotopt.catalogue.table1_grids import table1_grids
    >>> solution, cut_off = smallest_laid(Cable(table1_grids()[0].diagram, "T-"))
    >>> solution.chosen, solution.bound
    ((1, 4, 10), 3)
    """
    backend, test = find_backend(solver), LaidTest(cable)
    points, team = len(cable.path), Team()
    while True:
        instance = LoopsProgram(f"laid, cut {cable.cut}", points, team).instance()
        try:
            solution = backend.solve(instance, limits or Limits())
        except BackendError as error:
            raise SolverError(str(error)) from error
        cut = clause(test, solution.chosen[1:-1]) if solution.chosen else None
        if cut is None:
            return solution, len(team.clauses)
        team = replace(team, clauses=(*team.clauses, cut))
