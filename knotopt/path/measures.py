"""The measures by which paths are compared, for tables and files."""

from __future__ import annotations

import math
from dataclasses import dataclass

from formulations.ipopt import PathStatus
from knotopt.path.optimise import optimise_path
from knotopt.path.relaxation import relaxed_path
from knotopt.path.requirements import PathRequirements
from knotopt.path.result import PathResult
from knotopt.supports.support_set import SupportSet

HEADS = (
    "supports",
    "cut",
    "robots",
    "method",
    "status",
    "length",
    "/ taut",
    "radius",
    "clearance",
    "opening",
    "gap",
    "same knot",
    "ms",
)
NOTE = """\
Paths of the relaxation (eq. 11-13 of the paper) and of the program on the same supports. Lengths \
are in grid steps, in space; "/ taut" divides by the taut string, the shortest curve that passes \
the robots on the same sides; then the smallest turning radius, distance of strands in plan \
(between points whose way along the cable is four times the clearance asked for, or longer), room \
where a strand threads an active region, and vertical distance at crossings. "Same knot": \
yes if the path has the grid's diagram, "knot" if only its Alexander polynomial is the grid's, no \
if neither. Everything is measured on the finished curve by code that shares nothing with what \
made it."""


@dataclass(frozen=True)
class PathMeasures:
    """One path; the fields are columns of CSV files and keys of JSON.

    Lengths in grid steps; None where there is nothing to measure, or another diagram.
    """

    supports: str
    cut: str
    robots: int
    method: str
    status: str
    length: float
    stretch: float
    smallest_radius: float
    clearance: float | None
    opening: float | None
    gap: float | None
    same_diagram: bool
    same_knot: bool
    smooth: bool
    blocked: str
    milliseconds: float


def measure(result: PathResult, supports: str) -> PathMeasures:
    """The measures of a path; `supports` says whose supports they are."""
    report = result.report

    def known(value: float) -> float | None:
        return round(value, 4) if math.isfinite(value) else None

    return PathMeasures(
        supports,
        str(result.cable.cut),
        len(result.supports) + 2,
        result.method,
        status_word(result),
        round(result.curve.length, 4),
        round(result.stretch, 4),
        round(report.smallest_radius, 4),
        known(report.clearance),
        known(report.opening),
        known(report.gap),
        report.same_diagram,
        report.same_knot,
        result.curve.is_smooth,
        result.blocked,
        round(1e3 * result.seconds, 1),
    )


def status_word(result: PathResult) -> str:
    """What came of a path; the relaxation solves nothing, it converges or not."""
    if result.method == "nlp":
        return str(result.status)
    words = {PathStatus.SOLVED: "converged", PathStatus.STOPPED: "not converged"}
    return words.get(result.status, str(result.status))


def both_methods(
    chosen: SupportSet, requirements: PathRequirements | None = None
) -> tuple[PathResult, PathResult]:
    """The relaxation's and the program's path on the same supports."""
    cable, supports = chosen.cable, chosen.supports
    return (
        relaxed_path(cable, supports, requirements),
        optimise_path(cable, supports, requirements),
    )


def display(row: PathMeasures) -> list[str]:
    """The cells of a row under `HEADS`."""

    def length(value: float | None, digits: int = 3) -> str:
        return "-" if value is None else f"{value:.{digits}f}"

    same = "yes" if row.same_diagram else "knot" if row.same_knot else "no"
    return [
        row.supports,
        row.cut,
        str(row.robots),
        row.method,
        row.status,
        length(row.length, 2),
        length(row.stretch),
        length(row.smallest_radius),
        length(row.clearance),
        length(row.opening),
        length(row.gap),
        same,
        f"{row.milliseconds:.0f}",
    ]
