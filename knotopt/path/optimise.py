"""The path program on a cable: rounds of triangulating and solving, then a smooth curve.

Each round triangulates the plane around the current path and lets the path move as long as every
triangle stays positive, so each accepted round keeps the diagram. Between rounds vertices that the
path no longer needs go, and others come where it bends (`remesh`).
"""

from __future__ import annotations

import logging
import math
import time
from dataclasses import dataclass
from fractions import Fraction

import numpy as np

from formulations.ipopt import PathStatus, Violation, solve
from formulations.path import Bounds, PathProgram, ProgramError, Weights, doubled_areas
from knotopt.arrays import FloatArray, IntArray
from knotopt.cable.cable import Cable
from knotopt.errors import RequirementError
from knotopt.path.curve import Curve
from knotopt.path.heights import height_arcs
from knotopt.path.mesh import Mesh, lay_mesh, robot_times
from knotopt.path.pairs import arc_ends, crossing_corners, robot_turns, strand_pairs
from knotopt.path.remesh import remesh
from knotopt.path.requirements import PathRequirements
from knotopt.path.result import NamedViolation, PathResult, Round, examine, span_name, unmet
from knotopt.path.threads import Threads, find_threads, opening_pairs
from knotopt.path.triangulation import triangulate
from knotopt.supports.regions import Regions
from knotopt.verify.path import PathReport

logger = logging.getLogger(__name__)
SPACING = 0.6  # of the path's vertices where it is nearly straight [grid steps]
FINEST = 0.1  # where it bends [grid steps]
COARSE, COARSE_ROUNDS = 2.0, 1  # the first rounds, in which the path moves far, use larger ones
REACHES = (math.inf, math.inf, 2.0, 1.0, 1.0, 0.5, 0.5, 0.5)
"""How far coordinates may move in each round [grid steps]."""
REPAIR_REACH = 0.5  # the same in repairs
FEASIBLE = 1e-3  # violations of the program below this are tolerances
ROUNDING = 1e-9  # twice the area of triangles whose sign rounding could change
OPENING_NEAR = 0.6  # openings wider than they must be by so much are left to the next round
WORDS = {
    "angle": "angle between strands",
    "spread": "distance of crossings",
    "turn": "angle at a robot",
}
"""Families of constraints whose names need explaining."""
STEEP = 0.25  # share of the largest slope that a segment must have to be watched in a round
FEWEST = 2  # rounds before the length is looked at
SETTLED = 0.02  # change of the length, as a share, at which no further round is needed
REPAIRS = 6  # rounds at most in which limits that the smooth curve misses are tightened
OVERSHOOT = 1.5  # times what is missing, by which a limit is tightened
GENTLEST = 0.6  # share of the largest slope that is asked for at least
LEAST_SPACING = 0.05  # by which bending is scaled [grid steps]
EVENNESS = 0.3  # weight of even spacing
STIFFNESS = 1.5  # weight of lengths near nominal, against bending
SOFT_ROUNDS = 1  # first rounds without it, in which the path shrinks
ITERATIONS = 40  # of IPOPT a round


@dataclass(frozen=True)
class _Limits:
    """What the program asks for: a little more than the path must keep, as it is then smoothed."""

    clearance: float
    opening: float
    gap: float
    slope: float

    @classmethod
    def first(cls, asked: PathRequirements) -> _Limits:
        return cls(
            1.05 * asked.clearance, 1.03 * asked.opening, 1.03 * asked.gap, 0.92 * asked.slope
        )

    def tightened(self, asked: PathRequirements, report: PathReport) -> _Limits:
        """Limits that make up for what the smooth curve lost."""
        return _Limits(
            self.clearance + OVERSHOOT * max(0.0, asked.clearance - report.clearance),
            self.opening + OVERSHOOT * max(0.0, asked.opening - report.opening),
            self.gap + OVERSHOOT * max(0.0, asked.gap - report.gap),
            max(GENTLEST * asked.slope, self.slope * min(1.0, asked.slope / report.steepest)),
        )


def optimise_path(
    cable: Cable,
    supports: tuple[int, ...],
    requirements: PathRequirements | None = None,
    *,
    seconds: float | None = None,
) -> PathResult:
    """The shortest smooth path with the cable's diagram that meets the requirements.

    A local optimum, started from the grid path; robots stay at their turning points at height 0.
    Every round keeps the diagram by construction, and the curve that comes out is examined by
    independent code before it is called solved.

    Parameters
    ----------
    cable : Cable
    supports : tuple of int
        Turning points with a support robot (1-based).
    requirements : PathRequirements, optional
    seconds : float, optional
        Wall time after which no further round begins and IPOPT stops [s].

    Raises
    ------
    RequirementError
        A support that is no turning point between the ends.

    Notes
    -----
    A round takes time about linear in the path's vertices, whose number grows like the length of
    the cable.

    Examples
    --------
    >>> from knotopt.reading.knot import read_knot
    >>> result = optimise_path(Cable(read_knot("3").diagram, "L+"), (3, 4, 6))
    >>> result.status, result.report.same_diagram, result.report.same_knot
    (<PathStatus.SOLVED: 'solved'>, True, True)
    >>> result.stretch < 1.2
    True
    """
    asked = requirements or PathRequirements()
    if seconds is not None and not seconds > 0:
        raise RequirementError(f"the time limit must be positive, not {seconds} s")
    began = time.perf_counter()
    mesh = lay_mesh(cable, supports)
    threads = find_threads(Regions(cable), robot_times(cable, supports))
    heights = height_arcs(mesh.times, mesh.robots, mesh.over, mesh.under, 1.05 * asked.gap)
    mesh = mesh.moved(mesh.positions, heights)
    limits = _Limits.first(asked)
    rounds: list[Round] = []
    best: _Fitted | None = None
    repairs, checking = 0, 0.0
    while True:
        left = math.inf if seconds is None else seconds - (time.perf_counter() - began)
        mesh, status, record = _round(mesh, threads, asked, limits, len(rounds), repairs, left)
        rounds.append(record)
        logger.debug(
            "round %d: %s, %d iterations, length %.3f",
            len(rounds),
            record.raw_status,
            record.iterations,
            record.length,
        )
        stuck = not any(each.is_solved for each in rounds[-2:]) and len(rounds) >= FEWEST
        over = stuck or (seconds is not None and time.perf_counter() - began > seconds)
        if not over and not _settled(rounds):
            continue
        since = time.perf_counter()
        fitted = _fit(mesh, asked)
        if best is None or fitted.excess <= best.excess:
            best = fitted
        checking += time.perf_counter() - since
        if not fitted.missed or over or repairs == REPAIRS:
            break
        repairs += 1
        limits = limits.tightened(asked, fitted.report)
    if best.missed:
        polyline = _fit(mesh, asked, is_smooth=False)
        best = polyline if polyline.excess < best.excess else best
    # The program's own limits are tighter than what is asked, so its word is not the last one.
    expected = PathStatus.INFEASIBLE if best.missed else PathStatus.SOLVED
    if status is not expected:
        status = PathStatus.STOPPED
    reasons = [*best.missed]
    logger.info(
        "path by the program: %s after %d rounds in %.2f s",
        status,
        len(rounds),
        time.perf_counter() - began,
    )
    if status is PathStatus.INFEASIBLE:
        reasons += [
            f"no way is found for the {WORDS.get(each.family, each.family)} at {each.where}"
            for each in record.violations
            if each.amount > FEASIBLE
        ]
    return PathResult(
        cable,
        mesh.supports,
        asked,
        "nlp",
        status,
        record.raw_status,
        best.curve,
        best.times,
        best.report,
        time.perf_counter() - began - checking,
        tuple(rounds),
        blocked="; ".join(reasons),
    )


@dataclass(frozen=True, eq=False)
class _Fitted:
    """A curve through a mesh's places, and what it does not meet.

    `excess` is by how much limits are missed, as shares: inf for another diagram, 0 if none is.
    """

    curve: Curve
    times: FloatArray
    report: PathReport
    missed: list[str]
    excess: float


def _fit(mesh: Mesh, asked: PathRequirements, *, is_smooth: bool = True) -> _Fitted:
    curve = Curve(mesh.points, is_smooth)
    found = examine(mesh.cable, mesh.supports, curve, asked)
    missed = unmet(found, asked, curve, mesh.times, mesh.cable)
    excess = math.inf if missed else 0.0
    if missed and found.same_diagram:
        least = (
            (found.clearance, asked.clearance),
            (found.opening, asked.opening),
            (found.gap, asked.gap),
            (asked.slope, found.steepest),
        )
        excess = 1e-9 + sum(max(0.0, 1 - value / limit) for value, limit in least)
    return _Fitted(curve, mesh.times, found, missed, excess)


def _settled(rounds: list[Round]) -> bool:
    """Whether the path hardly changes any more, or has had its share of rounds."""
    if len(rounds) < FEWEST:
        return False
    before, after = rounds[-2].length, rounds[-1].length
    settled = rounds[-1].accepted and abs(before - after) < SETTLED * after
    return settled or len(rounds) >= len(REACHES)


def _round(
    mesh: Mesh,
    threads: Threads,
    asked: PathRequirements,
    limits: _Limits,
    number: int,
    repairs: int,
    seconds: float,
) -> tuple[Mesh, PathStatus, Round]:
    """One round: the path afterwards, or as it was if a triangle flipped; and its record."""
    began = time.perf_counter()
    reach = REACHES[min(number, len(REACHES) - 1)] if not repairs else REPAIR_REACH
    # What a repair mends depends on the vertices that the curve goes through: they mostly stay.
    if number and repairs % 3 == 0:
        coarse = COARSE if number < COARSE_ROUNDS else 1.0
        mesh = remesh(mesh, threads.witness, coarse * SPACING, coarse * FINEST)
    triangles = triangulate(mesh.positions, mesh.segments)
    stiffness = STIFFNESS if number >= SOFT_ROUNDS else 0.0
    problem = _compile(mesh, triangles, threads, asked, limits, reach, stiffness)
    meshed = time.perf_counter()
    try:
        found = solve(
            problem, iterations=ITERATIONS, seconds=None if math.isinf(seconds) else seconds
        )
    except ProgramError as error:
        raise RequirementError(str(error)) from error
    feasible = all(each.amount < FEASIBLE for each in found.violations)
    accepted = (
        (found.status is PathStatus.SOLVED or (found.status is PathStatus.STOPPED and feasible))
        and _all_positive(found.positions, triangles)
        and bool((found.heights[mesh.over] > found.heights[mesh.under]).all())
    )
    if accepted:
        mesh = mesh.moved(found.positions, found.heights)
    length = float(np.linalg.norm(np.diff(mesh.points, axis=0), axis=1).sum())
    record = Round(
        found.raw_status,
        accepted,
        accepted and found.status is PathStatus.SOLVED,
        found.iterations,
        len(mesh.positions),
        len(problem.triangles),
        len(problem.strand_pairs) + len(problem.opening_pairs),
        length,
        meshed - began,
        found.build_seconds,
        found.solve_seconds,
        tuple(_named(mesh, problem, each) for each in found.violations),
    )
    return mesh, found.status, record


def _all_positive(positions: FloatArray, triangles: IntArray) -> bool:
    """Whether every triangle runs counterclockwise; where rounding could tell, exactly."""
    areas = doubled_areas(positions, triangles)
    for triangle in triangles[np.abs(areas) < ROUNDING]:
        (ax, ay), (bx, by), (cx, cy) = ([Fraction(x) for x in positions[v]] for v in triangle)
        if (bx - ax) * (cy - ay) <= (by - ay) * (cx - ax):
            return False
    return bool((areas > -ROUNDING).all())


def _compile(
    mesh: Mesh,
    triangles: IntArray,
    threads: Threads,
    asked: PathRequirements,
    limits: _Limits,
    reach: float,
    stiffness: float,
) -> PathProgram:
    """The program of a round, without constraints that nothing within reach could violate."""
    held = mesh.held
    moving = triangles[~held[triangles].all(axis=1)]
    if math.isfinite(reach):
        # No triangle flips as long as each vertex moves less than half its smallest altitude.
        corners = mesh.positions[moving]
        longest = np.linalg.norm(corners - np.roll(corners, 1, axis=1), axis=2).max(axis=1)
        altitude = doubled_areas(mesh.positions, moving) / longest
        moving = moving[altitude <= 2 * math.sqrt(2) * reach]
    pairs, distances = strand_pairs(mesh, triangles, limits.clearance, asked.neighbourhood)
    openings = opening_pairs(mesh, threads, limits.opening + OPENING_NEAR)
    slopes = np.abs(np.diff(mesh.heights)) / mesh.lengths
    return PathProgram(
        positions=mesh.positions,
        held=held,
        chain=mesh.chain,
        heights=mesh.heights,
        held_heights=np.isin(np.arange(len(mesh.chain)), mesh.robots),
        spacing=np.maximum(mesh.lengths, LEAST_SPACING),
        triangles=moving,
        strand_pairs=pairs,
        strand_distances=distances,
        opening_pairs=openings[~held[openings].all(axis=1)],
        corners=crossing_corners(mesh),
        turns=robot_turns(mesh),
        arcs=arc_ends(mesh),
        crossings=np.stack((mesh.over, mesh.under), axis=1),
        steep=np.flatnonzero(slopes > STEEP * asked.slope),
        bounds=Bounds(
            limits.clearance,
            asked.crossing_angle,
            limits.opening,
            limits.gap,
            limits.slope,
            asked.floor,
            asked.ceiling,
        ),
        weights=Weights(asked.bending, EVENNESS, stiffness),
        reach=reach,
    )


def _named(mesh: Mesh, problem: PathProgram, violation: Violation) -> NamedViolation:
    """A violation with the places on the cable that it is about."""
    family, index = violation.family, violation.index
    vertices = {
        "diagram": problem.triangles,
        "clearance": problem.strand_pairs,
        "opening": problem.opening_pairs,
        "angle": problem.corners[:, :1],
        "turn": problem.turns[:, :1],
        "spread": problem.arcs,
    }
    if family in vertices:
        places = [np.flatnonzero(mesh.chain == vertex)[:1] for vertex in vertices[family][index]]
        times = [mesh.times[place[0]] for place in places if len(place)]  # not the frame's
    else:
        place = problem.crossings[index] if family == "gap" else problem.steep[[index]]
        times = mesh.times[place].tolist()
    names = dict.fromkeys(span_name(mesh.cable, time) for time in times)
    return NamedViolation(family, violation.amount, " and ".join(names))
