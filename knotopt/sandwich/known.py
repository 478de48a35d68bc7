"""What is known of a knot, whatever its diagram: how many robots it needs, and how many fly."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import dataclass

from knotopt.catalogue.flown import FlownTeam, flown_teams
from knotopt.diagram.grid import GridDiagram
from knotopt.errors import UnknownKnotError
from knotopt.identify.identify import identify
from knotopt.laid.fewest import FewestRobots, fewest_by_claim


@dataclass(frozen=True)
class KnownOfKnot:
    """What is known of a knot.

    Attributes
    ----------
    needed : FewestRobots
        The least, under the assumptions that it names.
    flown : FlownTeam or None
        The smallest team that is known to tie the knot or its mirror image in simulation.
    """

    needed: FewestRobots
    flown: FlownTeam | None


def known_of_knot(candidates: Collection[str], alexander: Sequence[int] = ()) -> KnownOfKnot:
    """What is known of the knot that has one of these names.

    Parameters
    ----------
    candidates : collection of str
        As for `fewest_by_claim`.
    alexander : sequence of int
        Its Alexander polynomial, constant term first, which decides where there is no name.

    Examples
    --------
    >>> known = known_of_knot(["m3_1"])
    >>> known.needed.robots, known.flown.robots
    (3, 3)
    >>> known_of_knot(["10_165"]).flown is None
    True
    """
    flown = None
    if len(candidates) == 1:
        (name,) = candidates
        flown = flown_teams().get(name.removeprefix("m"))
    return KnownOfKnot(fewest_by_claim(candidates, alexander), flown)


def flown_team(diagram: GridDiagram) -> tuple[FlownTeam, str, bool]:
    """The smallest team that is known to tie the knot of a diagram, or its mirror image.

    Returns
    -------
    FlownTeam
    str
        The knot that it ties.
    bool
        Whether that is the mirror image of the diagram's.

    Raises
    ------
    UnknownKnotError
        There is none.

    Examples
    --------
    >>> from knotopt.diagram.families import torus_knot
    >>> team, knot, is_mirrored = flown_team(torus_knot(2, -5))
    >>> team.robots, knot, is_mirrored
    (3, '5_1', True)
    """
    candidates = identify(diagram).candidates
    team = known_of_knot(candidates).flown if candidates else None
    if team is None:
        what = " or ".join(candidates) or "this knot"
        known = ", ".join(flown_teams())
        raise UnknownKnotError(f"no team is known to tie {what}; there are teams for {known}")
    knot = identify(team.diagram).candidates[0]
    return team, knot, knot not in candidates
