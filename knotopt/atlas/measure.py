"""One item of an atlas: everything that is measured of one knot, on its eight outer cuts.

Which sets are open is read off the rows of the 0-1 programs, which are there anyway; of one knot
in so many all of it is examined again by the independent checkers, from the definitions.
"""

from __future__ import annotations

import hashlib
import importlib.metadata
import resource
import sys
import time
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import asdict, dataclass, field, replace
from typing import Any

from knotopt import __version__
from knotopt.atlas.optional_rows import PathRow
from knotopt.atlas.programs import SOLVER, Solved, solve, try_span
from knotopt.atlas.schema import (
    FLIGHT_TIMES,
    FLIGHTS,
    PATHS,
    SOLVER_TIMES,
    SOLVERS,
    AtlasRow,
    KnotRow,
    Settings,
    TimesRow,
)
from knotopt.atlas.solvers import PACKAGES, compare_solvers
from knotopt.cable.cable import Cable
from knotopt.cable.cut import outer_cuts
from knotopt.path.measures import both_methods, measure
from knotopt.sim.simulators import MUJOCO
from knotopt.supports.lcf import LcfResult, lcf
from knotopt.supports.minimal import find_backend
from knotopt.supports.selection import GivenSupports
from knotopt.supports.support_set import SupportSet
from knotopt.supports.threading import Threading
from knotopt.verify.opening import check_opening
from knotopt.verify.span import check_span

_PACKAGES = ("numpy", "ortools")
_PATH_PACKAGES = ("scipy", "shapely", "casadi", "pythoncdt")
_FLIGHT_PACKAGES = ("mujoco", "scipy", "shapely")


@dataclass(frozen=True)
class KnotResult:
    """What came of one knot: a row a cut, in the order of the outer cuts.

    `requested` has the rows of the files that were asked for, by the file's name; `seconds` is what
    all of it took [s].
    """

    number: int
    versions: dict[str, str]
    rows: tuple[AtlasRow, ...]
    times: tuple[TimesRow, ...]
    requested: dict[str, tuple[Any, ...]] = field(default_factory=dict)
    seconds: float = 0.0


def versions(settings: Settings) -> dict[str, str]:
    """Versions of what the results depend on, in this process."""
    packages = [*_PACKAGES]
    if settings.paths:
        packages += _PATH_PACKAGES
    for solver in settings.solvers:
        packages += PACKAGES[solver]
    if settings.physics:
        packages += _FLIGHT_PACKAGES
    return {
        "knotopt": __version__,
        **{package: importlib.metadata.version(package) for package in packages},
    }


def check_installed(settings: Settings) -> None:
    """Whether this process has what the settings ask for.

    Raises
    ------
    SolverError
        A solver that does not exist.
    MissingExtraError
        A solver or the simulation is not installed; the message is the line that installs it.
    """
    for solver in settings.solvers:
        find_backend(solver)
    if settings.physics:
        MUJOCO.require()


def is_checked(knot: KnotRow, settings: Settings) -> bool:
    """Whether the knot is one of those whose sets are examined by the definitions.

    It depends on the knot's name and the seed alone, not on the list.
    """
    if settings.check == 0:
        return False
    digest = hashlib.sha256(f"{settings.seed} {knot.knot}".encode()).digest()
    return int.from_bytes(digest[:8]) % settings.check == 0


def measure_knot(knot: KnotRow, settings: Settings) -> KnotResult:
    """The rows of one knot.

    Parameters
    ----------
    knot : KnotRow
    settings : Settings

    Raises
    ------
    KeyboardInterrupt
        Ctrl-C, also where the solver caught it: nothing half-solved becomes a row.

    Examples
    --------
    >>> from knotopt.atlas.knot_list import knot_rows
    >>> from knotopt.catalogue.lookup import find_knot
    >>> result = measure_knot(knot_rows([find_knot("9_2")])[0], Settings())
    >>> [(row.cut, row.lcf_robots, row.lcf_open, row.opening_robots) for row in result.rows[:2]]
    [('L+', 19, True, 5), ('L-', 7, False, 6)]
    """
    find_backend(SOLVER)  # its import is no knot's time
    began = time.perf_counter()
    diagram, checked = knot.diagram, is_checked(knot, settings)
    rows, times = [], []
    requested: dict[str, tuple[Any, ...]] = dict.fromkeys(settings.requested, ())
    for cut in outer_cuts(diagram):
        row, spent, more = _measure_cut(knot, Cable(diagram, cut), settings, checked=checked)
        rows.append(row)
        times.append(spent)
        for name, found in more.items():
            requested[name] += tuple(found)
    return KnotResult(
        knot.number,
        versions(settings),
        tuple(rows),
        tuple(times),
        requested,
        time.perf_counter() - began,
    )


def agrees_with_definition(cable: Cable, row: AtlasRow, settings: Settings) -> bool:
    """Whether a row says of its sets what the independent checkers find, from the definitions.

    That no smaller set is open they do not look at.

    Parameters
    ----------
    cable : Cable
        The row's.
    row : AtlasRow
    settings : Settings
    """
    size = cable.diagram.size

    def is_open(supports: tuple[int, ...] | None, mode: Threading) -> bool:
        return check_opening(cable.path, size, supports or (), settings.r, mode).is_open

    turning, over_under = Threading.TURNING_POINT, Threading.OVER_UNDER
    found = [
        is_open(row.opening_supports, turning),
        is_open(row.over_under_supports, over_under),
        is_open(row.lcf_supports, turning) == row.lcf_open,
        is_open(row.lcf_supports, over_under) == row.lcf_open_over_under,
        is_open(row.layered_supports, turning) == row.layered_open,
        is_open(row.layered_supports, over_under) == row.layered_open_over_under,
    ]
    if row.span_supports is not None:
        found.append(
            check_span(cable.path, size, row.span_supports, settings.r, over_under).is_open
        )
    return all(found)


def _measure_cut(
    knot: KnotRow, cable: Cable, settings: Settings, *, checked: bool
) -> tuple[AtlasRow, TimesRow, dict[str, Sequence[Any]]]:
    clock = _Clock()
    with clock("lcf"):
        plain = lcf(cable)
        layered = lcf(cable, layered=True)
    opening = solve(plain, settings, "opening")
    over_under = solve(plain, settings, "opening", Threading.OVER_UNDER)
    span = try_span(plain, settings)
    more: dict[str, Sequence[Any]] = {}
    if settings.paths:
        with clock("paths"):
            more[PATHS] = _paths(knot, plain, opening)
    programs = {"opening": opening, **({"span": span} if span else {})}
    if settings.solvers:
        more[SOLVERS], more[SOLVER_TIMES] = compare_solvers(
            knot, plain.cable, programs, settings, checked=checked
        )
    if settings.physics:
        from knotopt.atlas.flights import fly_sets

        more[FLIGHTS], more[FLIGHT_TIMES] = fly_sets(knot, plain, programs)
    row = AtlasRow(
        number=knot.number,
        knot=knot.knot,
        crossing_number=knot.crossing_number,
        grid_size=knot.grid_size,
        crossings=len(cable.crossings),
        cut=str(cable.cut),
        baseline=plain.baseline,
        lcf_robots=plain.robots,
        lcf_supports=plain.supports,
        lcf_open=opening.allows(plain),
        lcf_open_over_under=over_under.allows(plain),
        lcf_below=plain.robots < (opening.solution.bound or 0),
        lcf_below_over_under=plain.robots < (over_under.solution.bound or 0),
        layered_robots=layered.robots,
        layered_supports=layered.supports,
        layered_open=opening.allows(layered),
        layered_open_over_under=over_under.allows(layered),
        **_columns("opening", opening),
        **_columns("over_under", over_under),
        **_columns("span", span, status="refused" if settings.span else None),
        checked=None,
    )
    if checked:
        with clock("check"):
            row = replace(row, checked=agrees_with_definition(cable, row, settings))
    spent = TimesRow(
        number=knot.number,
        knot=knot.knot,
        cut=row.cut,
        lcf_seconds=clock.seconds["lcf"],
        opening_seconds=opening.seconds,
        opening_solve_seconds=opening.solution.solve_seconds,
        over_under_seconds=over_under.seconds,
        over_under_solve_seconds=over_under.solution.solve_seconds,
        span_seconds=span.seconds if span else None,
        span_solve_seconds=span.solution.solve_seconds if span else None,
        paths_seconds=clock.seconds.get("paths"),
        check_seconds=clock.seconds.get("check"),
        worker_mib=_peak_mib(),
    )
    return row, spent, more


def _columns(prefix: str, solved: Solved | None, status: str | None = None) -> dict[str, Any]:
    """The columns of one program; without it empty ones, but for the status."""
    cells: dict[str, Any] = dict.fromkeys(
        ("robots", "bound", "status", "supports", "rows", "instance")
    )
    cells["status"] = status
    if solved is not None:
        solution = solved.solution
        cells = {
            "robots": solution.objective,
            "bound": solution.bound,
            "status": str(solution.status),
            "supports": solved.supports,
            "rows": len(solved.instance.rows),
            "instance": solved.instance.hash[:16],
        }
    return {f"{prefix}_{name}": value for name, value in cells.items()}


def _paths(knot: KnotRow, plain: LcfResult, opening: Solved) -> list[PathRow]:
    sets: list[tuple[str, SupportSet]] = [("lcf", plain)]
    if opening.supports is not None:
        sets.append(("opening", GivenSupports(plain.cable, opening.supports)))
    rows = []
    for name, chosen in sets:
        for path in both_methods(chosen):
            cells = asdict(measure(path, name))
            del cells["milliseconds"]  # differs from run to run
            rows.append(PathRow(number=knot.number, knot=knot.knot, **cells))
    return rows


class _Clock:
    """Seconds spent on each of several things."""

    def __init__(self) -> None:
        self.seconds: dict[str, float] = {}

    @contextmanager
    def __call__(self, name: str) -> Iterator[None]:
        began = time.perf_counter()
        yield
        self.seconds[name] = time.perf_counter() - began


def _peak_mib() -> float:
    """Largest resident memory of this process so far [MiB]."""
    unit = 1024 if sys.platform == "darwin" else 1  # bytes there, KiB elsewhere
    return round(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024 / unit, 1)
