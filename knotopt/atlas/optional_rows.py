"""What an atlas holds on request: files beside `atlas.parquet`, and their columns."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from knotopt.atlas.schema import FLIGHT_TIMES, FLIGHTS, PATHS, SOLVER_TIMES, SOLVERS, about


@dataclass(frozen=True)
class PathRow:
    """One cable path: a row of `paths.parquet`. Lengths in grid steps, empty: nothing to measure.

    Sorted like the atlas, then LCF before the smallest open set, relaxation before program.
    """

    number: int = about("the knot's place in the list, from 1")
    knot: str = about("name")
    cut: str = about("outer cut, L+ ... T-")
    supports: str = about("whose supports: lcf, or opening (turning-point)")
    method: str = about("relaxation (eq. 11-13) or nlp")
    robots: int = about("supports and the two lifting robots")
    status: str = about("what came of it: solved, converged, stopped ...")
    length: float = about("of the path in space [grid steps]")
    stretch: float = about("length over that of the taut string")
    smallest_radius: float = about("of a turn [grid steps]")
    clearance: float | None = about("smallest distance of strands in plan [grid steps]")
    opening: float | None = about("room where a strand threads an active region [grid steps]")
    gap: float | None = about("vertical distance at crossings [grid steps]")
    same_diagram: bool = about("whether the path has the grid's diagram")
    same_knot: bool = about("whether its Alexander polynomial is the grid's")
    smooth: bool = about("whether the spline, not the polyline, was kept")
    blocked: str = about("which limit the program could not meet, in words")


@dataclass(frozen=True)
class SolverRow:
    """One program by one solver: a row of `solvers.parquet`.

    Sorted like the atlas, then `opening` before `span`, then by solver in the order asked for.
    """

    number: int = about("the knot's place in the list, from 1")
    knot: str = about("name")
    cut: str = about("outer cut, L+ ... T-")
    formulation: str = about("whose program: opening (turning-point) or span")
    solver: str = about("name of the solver")
    status: str = about(
        "optimal, feasible, infeasible, unknown, error, or refused: no program for this solver"
    )
    said: str = about("the solver's own words")
    objective: int | None = about("robots of the set it returned")
    bound: int | None = about("no set has fewer robots, it says")
    proven: bool = about("whether it says that its set is smallest, or that there is none")
    rows: int = about("rows of the 0-1 program")
    satisfies: bool | None = about(
        "whether its set satisfies every row; empty without a set, false where status is error"
    )
    meets_definition: bool | None = about(
        "whether the independent checker finds its set open; empty where it was not asked"
    )


@dataclass(frozen=True)
class SolverTimesRow:
    """What differs from run to run: a row of `solver_times.parquet`, one a solver's row."""

    number: int = about("the knot's place in the list, from 1")
    knot: str = about("name")
    cut: str = about("outer cut, L+ ... T-")
    formulation: str = about("whose program: opening (turning-point) or span")
    solver: str = about("name of the solver")
    seconds: float = about("build and solve [s]")
    solve_seconds: float | None = about("the solver alone [s]")


@dataclass(frozen=True)
class FlightRow:
    """One undisturbed flight in simulation: a row of `flights.parquet`. Empty: it was not planned.

    Sorted like the atlas, then LCF's set, the smallest of `opening`, the smallest of `span`.
    """

    number: int = about("the knot's place in the list, from 1")
    knot: str = about("name")
    cut: str = about("outer cut, L+ ... T-")
    supports: str = about("whose supports: lcf, opening (turning-point) or span")
    robots: int = about("supports and the two lifting robots")
    opening_open: bool = about("whether the set is open by `opening`, turning-point")
    span_open: bool | None = about("whether `span` allows the set; empty unless asked for")
    planned: bool = about("whether there is a flight within the usual limits")
    outcome: str | None = about("tied, wrong knot, stuck, or unsound: strands too close to judge")
    verdict: str | None = about("outcome and knot that was tied, in words")
    tied: bool = about("whether the knot was tied, by its Alexander polynomial")
    why: str = about("why there is no plan, or of a flight that failed the first crossing amiss")
    flight_seconds: float | None = about("duration of the plan [s]")
    separation: float | None = about("least of two robots in flight; 1: their limit")
    strand_distance: float | None = about("least of two strands, centre to centre [m]")
    tension: float | None = about("largest [N]")
    cable_length: float | None = about("between the lifting robots [m]")


@dataclass(frozen=True)
class FlightTimesRow:
    """What differs from run to run: a row of `flight_times.parquet`, one a flight's."""

    number: int = about("the knot's place in the list, from 1")
    knot: str = about("name")
    cut: str = about("outer cut, L+ ... T-")
    supports: str = about("whose supports: lcf, opening (turning-point) or span")
    planning_seconds: float = about("planning; 0 where another set of the cut is the same [s]")
    simulation_seconds: float = about("simulating and judging; 0 likewise, or without a plan [s]")


ON_REQUEST: dict[str, type[Any]] = {
    PATHS: PathRow,
    SOLVERS: SolverRow,
    SOLVER_TIMES: SolverTimesRow,
    FLIGHTS: FlightRow,
    FLIGHT_TIMES: FlightTimesRow,
}
"""Files that a run has on request, and the class of their rows."""
