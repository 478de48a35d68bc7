"""What most users ask, one call each: how many robots, which supports, which flight."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path

from formulations.backends import DEFAULT
from formulations.solution import Limits
from knotopt.cable.cable import Cable
from knotopt.cable.cut import Cut
from knotopt.diagram.grid import GridDiagram
from knotopt.errors import RequirementError
from knotopt.flight.limits import ROOM, FlightLimits
from knotopt.flight.plan import FlightPlan
from knotopt.flight.request import FLOWN, FlightRequest
from knotopt.mission.alternatives import plan_first, rehearse_first
from knotopt.path.world import World
from knotopt.reading.knot import read_knot
from knotopt.reading.record import NamedDiagram
from knotopt.sandwich.answer import BUDGET, Answer, answer
from knotopt.search.budget import Budget
from knotopt.supports.minimal import MinimalSupports, minimal_supports
from knotopt.supports.requirements import Requirements
from knotopt.supports.search import best_supports
from knotopt.supports.selection import equally_small
from knotopt.supports.support_set import SupportSet

read = read_knot
"""Any knot: see `knotopt.reading.knot.read_knot`."""


def count_robots(knot: str | GridDiagram, *, budget: Budget | None = None, seed: int = 0) -> Answer:
    """How many robots a knot takes, as `knotopt solve KNOT` says it.

    Parameters
    ----------
    knot : str or GridDiagram
        As for `solve`.
    budget : Budget, optional
        Of the search for a grid on which the safe set is small; by default two seconds.
    seed : int
        Of that search.

    Raises
    ------
    KnotoptError
        No such knot.

    Examples
    --------
    >>> found = count_robots("4_1", budget=Budget(grids=1000))
    >>> found.known.needed.robots, found.known.flown.robots, found.is_settled
    (4, 4, True)
    """
    return answer(_named(knot), budget=budget or BUDGET, seed=seed)


def solve(
    knot: str | GridDiagram,
    requirements: Requirements | None = None,
    *,
    cut: str = "best",
    solver: str = DEFAULT,
    limits: Limits | None = None,
) -> MinimalSupports:
    """The smallest set of supports of a knot, as `knotopt solve` finds it.

    Parameters
    ----------
    knot : str or GridDiagram
        A name, a row of Table I, T(p,q), a code, or a file, as `read` reads them.
    requirements : Requirements, optional
        By default formulation `opening` with an openness of half a grid step.
    cut : str
        "best" of the crossing-free cuts, or a cut's name.
    solver : str
        A name of `formulations.backends.BACKENDS`.
    limits : Limits, optional
        Of time and gap.

    Returns
    -------
    MinimalSupports
        On the best cut; `is_proven` is about this cut alone. `found` is false where no set meets
        the requirements. `best_supports` says what is known of every cut.

    Raises
    ------
    KnotoptError
        No such knot, cut or solver, or requirements without meaning.

    Examples
    --------
    >>> found = solve("9")
    >>> found.robots, str(found.cable.cut), found.supports, found.report.is_open
    (5, 'L+', (9, 10, 11), True)
    >>> solve("9", Requirements("span", 0.25), cut="L-").robots
    10
    """
    diagram = _named(knot).diagram
    if cut == "best":
        return best_supports(diagram, requirements, solver=solver, limits=limits).best
    cable = Cable(diagram, Cut.parse(cut, diagram.size))
    return minimal_supports(cable, requirements, solver=solver, limits=limits)


def plan(
    knot: str | GridDiagram,
    supports: str | SupportSet = "milp",
    *,
    cut: str = "best",
    requirements: Requirements | None = None,
    world: World = ROOM,
    limits: FlightLimits | None = None,
    schedule: str = "optimised",
    physics: bool = False,
    tighten: float | None = None,
) -> FlightPlan:
    """A flight that ties a knot, as `knotopt fly` plans it.

    Parameters
    ----------
    knot : str or GridDiagram
        As for `solve`.
    supports : str or SupportSet
        "milp" (the smallest set), "lcf", "all", a `.json` file with a set, or a result such as
        that of `solve` or `lcf`, whose cut then counts.
    cut : str
        A cut's name, or "best": where its flight fails, other cuts with sets as small are tried.
    requirements : Requirements, optional
        Of the smallest set; by default `span` with loops and an openness of a quarter of a grid
        step.
    world : World
        Metres, heights.
    limits : FlightLimits, optional
        Of the robots, the file and the cable.
    schedule : str
        "optimised", or "fixed": one pace throughout, as in the paper.
    physics : bool
        Whether the flight is rehearsed in simulation (extra `sim`); else laid cable is modelled.
    tighten : float, optional
        Pull the knot tight after it, in simulation: how far apart the ends get at most [m].

    Raises
    ------
    KnotoptError
        No such knot or cut, supports without a flight, or limits that no flight keeps.

    Examples
    --------
    >>> flight = plan("3", "lcf", schedule="fixed")
    >>> flight.name, flight.positions.shape[1:], [each.name for each in flight.crossings]
    ('3_1', (5, 3), ['span 4 over span 1', 'span 4 under span 1', 'span 4 over span 2'])
    """
    named = _named(knot)
    sets: Iterable[SupportSet]
    if isinstance(supports, SupportSet):
        sets, how = [supports], "given"
        if supports.cable.diagram != named.diagram:
            raise RequirementError("the supports are of another diagram than the knot's")
        if isinstance(supports, MinimalSupports) and not supports.found:
            raise RequirementError("there is no set of supports to fly: none was found")
    else:
        sets = equally_small(named.diagram, supports, cut, requirements or FLOWN)
        how = Path(supports).name
    request = FlightRequest(named.name, how, world, limits or FlightLimits(), schedule)
    if physics:
        return rehearse_first(sets, request, tighten).plan
    if tighten is not None:
        raise RequirementError("a knot is pulled tight in simulation: it takes physics=True")
    return plan_first(sets, request)


def _named(knot: str | GridDiagram) -> NamedDiagram:
    return read(knot)
