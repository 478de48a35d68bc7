"""Every file of an atlas, and its columns. Robots count the two lifting ones.

Columns that begin with `opening_` are of formulation `opening` with threading by turning points,
with `over_under_` of the same with strands that change between over and under, with `span_` of
formulation `span` without loops, with `safe_` of `span` with loops (both empty unless asked for),
with `loops_` of `loops` alone. "Open" is by `opening` in the mode named.
"""

from __future__ import annotations

from knotopt.atlas.schema import File
from knotopt.document.columns import Column
from knotopt.tables.methods import LAYERED, LCF, PROGRAMS, TRIED_PROGRAMS, columns_of

NUMBER = Column("number", int, "the knot's place in the list, from 1")
KNOT = Column("knot", str, "name; of a grid from a file, the file's name")
CUT = Column("cut", str, "outer cut, L+ ... T-")
CROSSING_NUMBER = Column("crossing_number", int, "of the knot, where a table says it", True)
GRID_SIZE = Column("grid_size", int, "N; of a smallest diagram the arc index")
ROBOTS = Column("robots", int, "supports and the two lifting robots")
CUT_KEYS = (NUMBER, KNOT, CUT)
"""What says which knot and cut a row is of."""

_USUAL = " or ".join(method.key for method in TRIED_PROGRAMS)
_SOLVER_KEYS = (
    *CUT_KEYS,
    Column("formulation", str, f"whose program: {_USUAL}, in its usual mode of threading"),
    Column("solver", str, "name of the solver"),
)
_FLIGHT_KEYS = (*CUT_KEYS, Column("supports", str, f"whose supports: lcf, or of {_USUAL}"))

FLOWN = (
    Column("planned", bool, "whether there is a flight within the usual limits"),
    Column("outcome", str, "tied, wrong knot, stuck, or unsound: strands too close to judge", True),
    Column("verdict", str, "outcome and knot that was tied, in words", True),
    Column("tied", bool, "whether the knot was tied, by its Alexander polynomial"),
    Column("why", str, "why there is no plan, or of a flight that failed the first crossing amiss"),
    Column("flight_seconds", float, "duration of the plan [s]", True),
    Column("separation", float, "least of two robots in flight; 1: their limit", True),
    Column("strand_distance", float, "least of two strands, centre to centre [m]", True),
    Column("tension", float, "largest [N]", True),
    Column("cable_length", float, "between the lifting robots [m]", True),
)
"""What came of one set in simulation; empty: it was not planned."""

FILES: dict[str, tuple[Column, ...]] = {
    File.KNOTS: (
        NUMBER,
        KNOT,
        Column("source", str, "where the diagram comes from, in words"),
        GRID_SIZE,
        Column("minus", tuple[int, ...], "row of the -1 in columns 1 ... N"),
        Column("plus", tuple[int, ...], "row of the +1 in columns 1 ... N"),
        CROSSING_NUMBER,
        Column("arc_index", int, "of the knot, where a table says it", True),
        Column("alternating", bool, "whether the knot is, where a table says it", True),
        Column("determinant", int, "of the knot, where a table says it", True),
        Column("signature", int, "of the knot in KnotInfo's sign, where a table says it", True),
    ),
    File.ATLAS: (
        NUMBER,
        KNOT,
        CROSSING_NUMBER,
        GRID_SIZE,
        Column("crossings", int, "of the diagram"),
        CUT,
        Column("baseline", int, "robots at all 2N turning points"),
        *LCF.columns(
            *("robots", "supports", "open", "open_over_under", "below", "below_over_under")
        ),
        *LAYERED.columns("robots", "supports", "open", "open_over_under"),
        *columns_of(PROGRAMS, "robots", "bound", "status", "supports", "rows", "instance"),
        Column(
            "checked", bool, "whether the checkers find the sets as said; empty: not asked", True
        ),
    ),
    File.TIMES: (
        *CUT_KEYS,
        Column("lcf_seconds", float, "LCF and its layered set [s]"),
        *columns_of(PROGRAMS, "seconds", "solve_seconds"),
        Column("paths_seconds", float, "four paths and their checks [s]", True),
        Column("check_seconds", float, "the independent checkers [s]", True),
        Column("worker_mib", float, "largest memory of the worker's process so far [MiB]"),
    ),
    # LCF before the smallest open set, relaxation before program.
    File.PATHS: (
        *CUT_KEYS,
        Column("supports", str, "whose supports: lcf, or opening (turning-point)"),
        Column("method", str, "relaxation (eq. 11-13) or nlp"),
        ROBOTS,
        Column("status", str, "what came of it: solved, converged, stopped ..."),
        Column("length", float, "of the path in space [grid steps]"),
        Column("stretch", float, "length over that of the taut string"),
        Column("smallest_radius", float, "of a turn [grid steps]"),
        Column("clearance", float, "smallest distance of strands in plan [grid steps]", True),
        Column("opening", float, "room where a strand threads an active region [grid steps]", True),
        Column("gap", float, "vertical distance at crossings [grid steps]", True),
        Column("same_diagram", bool, "whether the path has the grid's diagram"),
        Column("same_knot", bool, "whether its Alexander polynomial is the grid's"),
        Column("smooth", bool, "whether the spline, not the polyline, was kept"),
        Column("blocked", str, "which limit the program could not meet, in words"),
    ),
    # One program by one solver, the solvers in the order asked for.
    File.SOLVERS: (
        *_SOLVER_KEYS,
        Column("status", str, "as of the atlas; refused: it does not take this program"),
        Column("said", str, "the solver's own words"),
        Column("objective", int, "robots of the set it returned", True),
        Column("bound", int, "no set has fewer robots, it says", True),
        Column("proven", bool, "whether it says that its set is smallest, or that there is none"),
        Column("rows", int, "rows of the 0-1 program"),
        Column("satisfies", bool, "whether its set satisfies every row; false: error", True),
        Column(
            "meets_definition", bool, "whether the checker finds it open; empty: not asked", True
        ),
    ),
    File.SOLVER_TIMES: (
        *_SOLVER_KEYS,
        Column("seconds", float, "build and solve [s]"),
        Column("solve_seconds", float, "the solver alone [s]", True),
    ),
    # LCF's set, then the smallest ones, each flown once and undisturbed.
    File.FLIGHTS: (
        *_FLIGHT_KEYS,
        ROBOTS,
        *columns_of(TRIED_PROGRAMS, "open"),
        *FLOWN,
    ),
    File.FLIGHT_TIMES: (
        *_FLIGHT_KEYS,
        Column("planning_seconds", float, "0 where another set of the cut is the same [s]"),
        Column("simulation_seconds", float, "with judging; 0 likewise, or without a plan [s]"),
    ),
}
"""Columns of each file, by its name. Rows are sorted by `number`, then by cut, then in the order in
which keys are listed in the meanings."""
