"""`knotopt fly`: from a knot to a flight, and everything that a swarm needs to fly it."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from knotopt.cli.fly_report import show_flight
from knotopt.cli.options import (
    JsonOption,
    KnotArgument,
    OpennessOption,
    SupportsCutOption,
    SupportsOption,
)
from knotopt.cli.printing import print_json, print_written
from knotopt.cli.progress import track

if TYPE_CHECKING:
    from knotopt.flight.plan import FlightPlan
    from knotopt.flight.record import Disturbance
    from knotopt.mission.alternatives import Asked
    from knotopt.mission.result import FlightResult
    from knotopt.supports.support_set import SupportSet

RUNS = 5
NOISE = 0.01  # [m]


def fly(
    knot: KnotArgument,
    supports: SupportsOption = "milp",
    cut: SupportsCutOption = "best",
    formulation: Annotated[
        str | None,
        typer.Option(
            help="Of the smallest set: span (the taut cable itself, which is what is flown; the "
            "default) or opening (polygons through the grid's crossings).",
            show_default=False,
        ),
    ] = None,
    r: OpennessOption = None,
    sim: Annotated[
        bool,
        typer.Option(
            "--sim/--no-sim",
            help="Rehearse the flight in physics while it is planned, then fly it, undisturbed and "
            "disturbed; seconds to minutes. Without, cable is taken to hang straight in plan.",
        ),
    ] = False,
    out: Annotated[
        Path | None,
        typer.Option(
            metavar="DIR",
            help="Write the flight: plan, waypoints, polynomials, Crazyswarm2's yaml and script, "
            "pictures, report.html. Replaces a former flight there.",
        ),
    ] = None,
    schedule: Annotated[
        str, typer.Option(help="optimised (the fastest), or fixed: at one pace, as in the paper.")
    ] = "optimised",
    step: Annotated[float, typer.Option(help="Metres per grid step.")] = 0.5,
    altitude: Annotated[float, typer.Option(help="Of hovering robots [m].")] = 2.2,
    floor: Annotated[float, typer.Option(help="Lowest that a robot flies [m].")] = 0.2,
    ceiling: Annotated[float, typer.Option(help="Highest that a robot flies [m].")] = 3.2,
    speed: Annotated[float, typer.Option(help="Largest, of a robot [m/s].")] = 0.6,
    acceleration: Annotated[float, typer.Option(help="Largest, of a robot [m/s²].")] = 1.5,
    separation: Annotated[float, typer.Option(help="Of robots at one height [m].")] = 0.2,
    downwash: Annotated[float, typer.Option(help="Of a robot straight below another [m].")] = 0.33,
    spacing: Annotated[float, typer.Option(help="Of robots in single file [m].")] = 0.3,
    slack: Annotated[
        float, typer.Option(help="Cable beyond the farthest that two robots get apart, a share.")
    ] = 0.1,
    hover_before: Annotated[float, typer.Option(help="Before the flight [s].")] = 2.0,
    hover_after: Annotated[float, typer.Option(help="After it [s].")] = 3.0,
    noise: Annotated[
        float | None,
        typer.Option(
            help="With --sim: standard deviation of robots' positions [m]; 0.01.",
            show_default=False,
        ),
    ] = None,
    wind: Annotated[
        str | None,
        typer.Option(metavar="X,Y", help="With --sim: steady wind [m/s].", show_default=False),
    ] = None,
    gust: Annotated[
        float | None,
        typer.Option(
            help="With --sim: standard deviation of the wind about it [m/s].", show_default=False
        ),
    ] = None,
    seed: Annotated[
        int | None,
        typer.Option(
            help="With --sim: of the first disturbed flight; 1.", min=0, show_default=False
        ),
    ] = None,
    runs: Annotated[
        int | None,
        typer.Option(help="With --sim: disturbed flights; 5.", min=0, show_default=False),
    ] = None,
    tighten: Annotated[
        float | None,
        typer.Option(
            metavar="METRES",
            help="With --sim: when the knot is laid, pull its ends apart, that far at most; the "
            "supports give way.",
            show_default=False,
        ),
    ] = None,
    as_json: JsonOption = False,
) -> None:
    """Plan a flight that ties a knot, check it, fly it in simulation, and export it.

    Exit status 1 if a limit is not kept, or the undisturbed flight does not tie the knot.

    Example: knotopt fly 3 --sim --out trefoil
    """
    from knotopt.api import FLOWN
    from knotopt.catalogue.lookup import find_knot
    from knotopt.files import check_folder
    from knotopt.flight.limits import ROOM, FlightLimits
    from knotopt.flight.planner import SCHEDULES
    from knotopt.mission.folder import why_kept
    from knotopt.path.world import World
    from knotopt.supports.requirements import Requirements
    from knotopt.supports.selection import equally_small

    if schedule not in SCHEDULES:
        raise typer.BadParameter(f"is one of {', '.join(SCHEDULES)}", param_hint="--schedule")
    if supports != "milp" and (r is not None or formulation is not None):
        raise typer.BadParameter(
            "goes with --supports milp", param_hint="--formulation" if r is None else "--r"
        )
    requirements = Requirements(
        formulation or FLOWN.formulation, FLOWN.openness if r is None else r
    )
    world = World(step, altitude, floor, ceiling, ROOM.drone_height, ROOM.downwash)
    limits = FlightLimits(
        speed, acceleration, separation, downwash, spacing, slack, hover_before, hover_after
    )
    disturbances = _disturbances(noise, wind, gust, seed, runs, tighten, sim=sim)
    if out is not None:
        check_folder(out, why_kept)
    if sim:
        _check_physics()

    named = find_knot(knot)
    sets = equally_small(named.diagram, supports, cut, requirements)
    asked = (Path(supports).name, world, limits, schedule)
    if sim:
        result = _flown(named.name, sets, asked, disturbances, tighten)
    else:
        result = _planned(named.name, sets, asked)
    missing = None if out is None else _write(result, out)
    if as_json:
        print_json({**result.content(), "written": None if out is None else str(out)})
    else:
        show_flight(result, f"{named.name} ({named.source})")
        if missing:
            print(missing)
        if out is not None:
            print_written(out)
    if result.reasons:
        raise typer.Exit(1)


def _disturbances(
    noise: float | None,
    wind: str | None,
    gust: float | None,
    seed: int | None,
    runs: int | None,
    tighten: float | None,
    *,
    sim: bool,
) -> list[Disturbance]:
    """Of the disturbed flights, with consecutive seeds; refuses what goes with --sim only."""
    from knotopt.flight.record import Disturbance

    given = {"noise": noise, "wind": wind, "gust": gust, "seed": seed, "runs": runs}
    for name, value in (given | {"tighten": tighten}).items():
        if value is not None and not sim:
            raise typer.BadParameter("goes with --sim", param_hint=f"--{name}")
    usual = Disturbance(
        NOISE if noise is None else noise, (0.0, 0.0) if wind is None else _wind(wind), gust or 0.0
    )
    first = 1 if seed is None else seed
    return [replace(usual, seed=first + k) for k in range(RUNS if runs is None else runs)]


def _wind(text: str) -> tuple[float, float]:
    try:
        x, y = (float(part) for part in text.split(","))
    except ValueError:
        x = y = math.nan
    if not (math.isfinite(x) and math.isfinite(y)):
        raise typer.BadParameter(f"is X,Y in m/s, such as 0.3,0; not {text!r}", param_hint="--wind")
    return x, y


def _check_physics() -> None:
    """Without MuJoCo nothing is planned in vain."""
    from knotopt.errors import MissingExtraError

    try:
        import mujoco  # noqa: F401
    except ImportError as error:
        raise MissingExtraError("mujoco", "sim", "--sim") from error


def _planned(name: str, sets: Iterable[SupportSet], asked: Asked) -> FlightResult:
    """The flight by the model of laid cable."""
    from knotopt.flight.planner import plan_flight
    from knotopt.mission.alternatives import plan_first

    with _progress("planning"):
        plan = plan_first(name, sets, asked)
        steady = None
        if plan.schedule != "fixed":
            flown = (plan.cable, plan.supports, *asked[:-1])
            steady = plan_flight(name, *flown, "fixed").duration
        return _result(plan, steady)


def _flown(
    name: str,
    sets: Iterable[SupportSet],
    asked: Asked,
    disturbances: list[Disturbance],
    tighten: float | None,
) -> FlightResult:
    """The flight rehearsed, perhaps pulled tight, then flown undisturbed and disturbed."""
    from knotopt.mission.alternatives import rehearse_first
    from knotopt.mission.result import UNDISTURBED, examined, flown_content
    from knotopt.sim.trials import fly_trial, wilson_interval

    with _progress("rehearsing") as tell:
        rehearsal = rehearse_first(name, sets, asked, tighten, tell)
        plan = rehearsal.plan
        result = _result(plan, None if plan.schedule == "fixed" else rehearsal.steady)
    contents, failed = [], None
    for disturbance in track(disturbances, "disturbed flights", len(disturbances)):
        trial = fly_trial(plan, disturbance)
        flown = examined(f"seed {disturbance.seed}", plan, trial.record, trial.verdict)
        contents.append(flown_content(flown))
        if failed is None and not flown.is_tied:
            failed = flown
    tied = sum(each["outcome"] == "tied" for each in contents)
    return replace(
        result,
        rehearsal=rehearsal,
        flown=examined(UNDISTURBED, plan, rehearsal.record, rehearsal.verdict),
        failed=failed,
        disturbed=tuple(contents),
        interval=wilson_interval(tied, len(contents)) if contents else None,
    )


def _result(plan: FlightPlan, steady: float | None) -> FlightResult:
    from knotopt.export.crazyswarm import export_files
    from knotopt.flight.examine import examine_plan
    from knotopt.mission.result import FlightResult

    exports, fit = export_files(plan)
    return FlightResult(plan, examine_plan(plan), exports, fit, steady)


def _write(result: FlightResult, out: Path) -> str:
    """Write the folder; return what could not be part of it."""
    from knotopt.errors import MissingExtraError
    from knotopt.files import write_folder
    from knotopt.mission.folder import flight_files, flight_pictures, why_kept

    files, missing = flight_files(result), ""
    try:
        files.update(flight_pictures(result))
    except MissingExtraError as error:
        missing = f"no pictures: {error}"
    write_folder(out, files, why_kept)
    return missing


@contextmanager
def _progress(what: str) -> Iterator[Callable[[str], None]]:
    """Say on the error stream what is being done, if somebody looks."""
    from rich.console import Console
    from rich.markup import escape

    console = Console(stderr=True)
    if not console.is_terminal:
        yield lambda _: None
        return
    with console.status(what) as status:
        yield lambda text: status.update(f"{what}: {escape(text)}")
