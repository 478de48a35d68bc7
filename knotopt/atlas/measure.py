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
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from itertools import chain

from knotopt import __version__
from knotopt.atlas.columns import FILES
from knotopt.atlas.programs import SOLVER, Solved, is_asked, solve
from knotopt.atlas.schema import File, KnotRow, Settings
from knotopt.atlas.solvers import PACKAGES, compare_solvers
from knotopt.cable.cable import Cable
from knotopt.cable.cut import outer_cuts
from knotopt.document.columns import Row, names
from knotopt.sim.simulators import MUJOCO
from knotopt.supports.lcf import LcfResult, lcf
from knotopt.supports.minimal import find_backend
from knotopt.supports.selection import GivenSupports
from knotopt.supports.support_set import SupportSet
from knotopt.tables.comparison import path_rows
from knotopt.tables.methods import (
    HEURISTICS,
    JUDGES,
    LAYERED,
    LCF,
    OPENING,
    PROGRAMS,
    TRIED_PROGRAMS,
)

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
    rows: tuple[Row, ...]
    times: tuple[Row, ...]
    requested: dict[str, tuple[Row, ...]] = field(default_factory=dict)
    seconds: float = 0.0


def versions(settings: Settings) -> dict[str, str]:
    """Versions of what the results depend on, in this process."""
    packages = [
        *_PACKAGES,
        *(_PATH_PACKAGES if settings.paths else ()),
        *chain.from_iterable(PACKAGES[solver] for solver in settings.solvers),
        *(_FLIGHT_PACKAGES if settings.physics else ()),
    ]
    there = {package: importlib.metadata.version(package) for package in packages}
    return {"knotopt": __version__, **there}


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
    >>> from knotopt.reading.knot import read_knot
    >>> result = measure_knot(knot_rows([read_knot("9_2")])[0], Settings())
    >>> shown = ("cut", "lcf_robots", "lcf_open", "opening_robots")
    >>> [[row[name] for name in shown] for row in result.rows[:2]]
    [['L+', 19, True, 5], ['L-', 7, False, 6]]
    """
    find_backend(SOLVER)  # its import is no knot's time
    began = time.perf_counter()
    diagram, checked = knot.diagram, is_checked(knot, settings)
    rows, times = [], []
    requested: dict[str, tuple[Row, ...]] = dict.fromkeys(settings.requested, ())
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


def agrees_with_definition(cable: Cable, row: Row, settings: Settings) -> bool:
    """Whether a row says of its sets what the independent checkers find, from the definitions.

    That no smaller set is open they do not look at.

    Parameters
    ----------
    cable : Cable
        The row's.
    row : Row
        Of the atlas.
    settings : Settings
    """
    smallest = all(
        method.is_met(cable, row[f"{method.key}_supports"] or (), settings.r)
        for method in PROGRAMS
        if row[f"{method.key}_supports"] is not None or not method.setting
    )
    return smallest and all(
        judge.is_met(cable, row[f"{method.key}_supports"], settings.r)
        == row[f"{method.key}_open{name}"]
        for method in HEURISTICS
        for judge, name in JUDGES.items()
    )


def _measure_cut(
    knot: KnotRow, cable: Cable, settings: Settings, *, checked: bool
) -> tuple[Row, Row, dict[str, list[Row]]]:
    """The row of the atlas, that of the times, and rows of the files that were asked for."""
    clock = _Clock()
    with clock("lcf"):
        plain = lcf(cable)
        layered = lcf(cable, layered=True)
    solved = {method: solve(plain, settings, method) for method in PROGRAMS}
    usual = {
        method: program for method in TRIED_PROGRAMS if (program := solved[method]) is not None
    }
    keys = knot.keys(cable.cut)
    more: dict[str, list[Row]] = {}
    if settings.paths:
        with clock("paths"):
            more[File.PATHS] = _paths(keys, plain, usual[OPENING])
    if settings.solvers:
        more[File.SOLVERS], more[File.SOLVER_TIMES] = compare_solvers(
            knot, plain.cable, usual, settings, checked=checked
        )
    if settings.physics:
        from knotopt.atlas.flights import fly_sets

        more[File.FLIGHTS], more[File.FLIGHT_TIMES] = fly_sets(knot, plain, usual)
    row: Row = {
        **keys,
        "crossing_number": knot.crossing_number,
        "grid_size": knot.grid_size,
        "crossings": len(cable.crossings),
        "baseline": plain.baseline,
        **LCF.cells(robots=plain.robots, supports=plain.supports),
        **LAYERED.cells(robots=layered.robots, supports=layered.supports),
        "checked": None,
    }
    for judge, name in JUDGES.items():
        if (program := solved[judge]) is not None:
            below = plain.robots < (program.solution.bound or 0)
            row |= LCF.cells(**{f"open{name}": program.allows(plain), f"below{name}": below})
            row |= LAYERED.cells(**{f"open{name}": program.allows(layered)})
    times: Row = {**keys, "lcf_seconds": clock.seconds["lcf"]}
    for method, program in solved.items():
        if program is not None:
            row |= method.cells(**program.cells)
            times |= method.cells(
                seconds=program.seconds, solve_seconds=program.solution.solve_seconds
            )
        elif is_asked(method, settings):
            row |= method.cells(status="refused")
    row, times = _whole(row, File.ATLAS), _whole(times, File.TIMES)
    if checked:
        with clock("check"):
            row["checked"] = agrees_with_definition(cable, row, settings)
    times |= {f"{name}_seconds": clock.seconds.get(name) for name in ("paths", "check")}
    times["worker_mib"] = _peak_mib()
    return row, times, more


def _whole(row: Row, file: File) -> Row:
    """The row in the order of the file's columns, with empty cells where it has none."""
    return {name: row.get(name) for name in names(FILES[file])}


def _paths(keys: Row, plain: LcfResult, opening: Solved) -> list[Row]:
    sets: dict[str, SupportSet] = {LCF.key: plain}
    if opening.supports is not None:
        sets[OPENING.key] = GivenSupports(plain.cable, opening.supports)
    rows = [keys | row for row in path_rows(sets)]
    for row in rows:
        del row["milliseconds"]  # differs from run to run
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
