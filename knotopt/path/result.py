"""What comes of planning a path, whatever the method."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property

import numpy as np

from formulations.ipopt import PathStatus
from knotopt.arrays import FloatArray
from knotopt.cable.cable import Cable
from knotopt.path.curve import Curve, length_along
from knotopt.path.mesh import robot_times
from knotopt.path.requirements import PathRequirements
from knotopt.path.taut import taut_length
from knotopt.showing import ShownShort, plural
from knotopt.verify.path import PathReport, check_path

FINE = 0.005  # between the points of a curve that are examined [grid steps]
TOLERANCE = 2e-3  # by which a length may miss its limit, that of the sampling [grid steps]
SHARE = 0.02  # of a limit by which it may be missed, if that is less (of a slope: in any case)


@dataclass(frozen=True)
class NamedViolation:
    """The worst violation of a family of constraints, and where on the cable that is.

    `amount` is as in `formulations.ipopt.PathSolution`; negative ones are margins.
    """

    family: str
    amount: float
    where: str


@dataclass(frozen=True)
class Round:
    """One round of the program: a triangulation and a solve.

    Attributes
    ----------
    raw_status : str
    accepted : bool
        Whether every triangle kept its orientation, and every crossing its upper strand, so that
        the new path has the same diagram.
    is_solved : bool
        Whether it was accepted and IPOPT came to a local optimum.
    iterations : int
    vertices, triangles, pairs : int
        Of the path, constrained triangles, and distances constrained.
    length : float
        Of the path in space afterwards [grid steps].
    mesh_seconds, build_seconds, solve_seconds : float
        To triangulate and find pairs, to build the CasADi functions, and in IPOPT [s].
    violations : tuple of NamedViolation
        The worst of each family.
    """

    raw_status: str
    accepted: bool
    is_solved: bool
    iterations: int
    vertices: int
    triangles: int
    pairs: int
    length: float
    mesh_seconds: float
    build_seconds: float
    solve_seconds: float
    violations: tuple[NamedViolation, ...]


@dataclass(frozen=True, eq=False, repr=False)
class PathResult(ShownShort):
    """A path of a cable with its supports, and what is known of it.

    Attributes
    ----------
    cable : Cable
    supports : tuple of int
        Turning points with a support robot (1-based).
    requirements : PathRequirements
    method : str
        "nlp" or "relaxation".
    status : PathStatus
        SOLVED says that the method ended well and that, checked independently, the path has the
        grid's diagram and meets every limit (the program) or simply converged (the relaxation).
    raw_status : str
        The method's own words.
    report : PathReport
        The path examined by code that shares nothing with what made it.
    curve : Curve
        The path [grid steps]; heights are above the robots'.
    times : float array, shape (m,)
        Time on the grid path of each of the curve's points.
    seconds : float
        To find the path, without the check [s].
    rounds : tuple of Round
        Of the program.
    steps : int
        Of the relaxation.
    blocked : str
        What could not be met, if anything, and between which places.
    """

    cable: Cable
    supports: tuple[int, ...]
    requirements: PathRequirements
    method: str
    status: PathStatus
    raw_status: str
    curve: Curve
    times: FloatArray
    report: PathReport
    seconds: float
    rounds: tuple[Round, ...] = field(default=())
    steps: int = 0
    blocked: str = ""

    @property
    def in_words(self) -> str:
        """Method, status, length and robots."""
        length = f"{self.curve.length:.2f} grid steps"
        robots = plural(len(self.supports) + 2, "robot")
        return f"{self.method} {self.status}, cut {self.cable.cut}, {length}, {robots}"

    @property
    def robots(self) -> FloatArray:
        """Where the robots hold the cable, shape (R, 3) [grid steps]."""
        return robot_points(self.cable, self.supports)

    @cached_property
    def taut_length(self) -> float:
        """Length of the taut string through the robots [grid steps], a lower bound."""
        return taut_length(self.cable, self.supports)

    @property
    def stretch(self) -> float:
        """Length over the taut string's: how much longer than necessary, at most."""
        return self.curve.length / self.taut_length


def robot_points(cable: Cable, supports: tuple[int, ...]) -> FloatArray:
    """Where the robots hold a cable, shape (R, 3) [grid steps]; they hover at height 0."""
    cells = cable.cells[robot_times(cable, supports)]
    return np.column_stack((cells, np.zeros(len(cells))))


def examine(
    cable: Cable, supports: tuple[int, ...], curve: Curve, requirements: PathRequirements
) -> PathReport:
    """A curve examined as a path of a cable: diagram, knot, distances, heights."""
    return check_path(
        curve.sample(FINE),
        cable.path,
        robot_points(cable, supports),
        requirements.neighbourhood,
    )


def unmet(
    report: PathReport,
    requirements: PathRequirements,
    curve: Curve,
    times: FloatArray,
    cable: Cable,
) -> list[str]:
    """In words, what a path does not meet, with the places between which that is.

    Parameters
    ----------
    report : PathReport
    requirements : PathRequirements
    curve : Curve
    times : float array, shape (m,)
        Time on the grid of each of the curve's points, to name places by.
    cable : Cable
    """
    if not report.same_diagram:
        return ["the diagram is not the grid's"]
    found = [] if report.same_knot else ["the knot is not the grid's"]
    asked = requirements
    along = length_along(curve.points[:, :2])
    if report.clearance < least(asked.clearance):
        first, second = (
            span_name(cable, float(np.interp(place, along, times))) for place in report.closest
        )
        found.append(
            f"clearance {report.clearance:.3g} < {asked.clearance:g} between {first} and {second}"
        )
    if report.opening < least(asked.opening):
        found.append(f"opening {report.opening:.3g} < {asked.opening:g} in {report.narrowest}")
    if report.gap < least(asked.gap):
        found.append(f"gap {report.gap:.3g} < {asked.gap:g} at crossing c{report.tightest + 1}")
    if report.steepest > asked.slope * (1 + SHARE):
        found.append(f"slope {report.steepest:.3g} > {asked.slope:g}")
    if report.lowest < asked.floor - TOLERANCE or report.highest > asked.ceiling + TOLERANCE:
        found.append(
            f"heights {report.lowest:.3f} to {report.highest:.3f} "
            f"outside {asked.floor:g} to {asked.ceiling:g}"
        )
    if report.robots_off > 2 * TOLERANCE:
        found.append(f"a robot is {report.robots_off:.3f} away from the cable")
    return found


def least(limit: float) -> float:
    """What still counts as keeping a lower limit of a length [grid steps]."""
    return limit - min(TOLERANCE, SHARE * limit)


def span_name(cable: Cable, time: float) -> str:
    """Where on the cable a time is, in words.

    Examples
    --------
    >>> from knotopt.diagram.families import torus_knot
    >>> cable = Cable(torus_knot(2, 3), "L+")
    >>> span_name(cable, 3.0), span_name(cable, 4.5)
    ('p2', 'p2-p3')
    """
    index = int(np.searchsorted(cable.times, time + 0.25))
    if abs(cable.times[index - 1] - time) <= 0.25:
        return f"p{index}"
    return f"p{index}-p{index + 1}"
