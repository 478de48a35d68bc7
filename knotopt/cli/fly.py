"""`knotopt fly`: from a knot to a flight, and everything that a swarm needs to fly it."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from knotopt.cli import options
from knotopt.cli.completion import among
from knotopt.cli.fly_printing import show_mission
from knotopt.cli.formulations import WithOption, check_openness, with_loops
from knotopt.cli.printing import print_json, print_written
from knotopt.cli.progress import status_line, track
from knotopt.cli.reading import read
from knotopt.cli.sizes import check_size
from knotopt.flight.limits import ROOM, FlightLimits
from knotopt.flight.request import FLOWN, SCHEDULES, FlightRequest
from knotopt.mission.disturbed import DisturbedFlights
from knotopt.path.world import World
from knotopt.supports.requirements import Requirements

if TYPE_CHECKING:
    from knotopt.flight.record import Disturbance
    from knotopt.mission.mission import Mission
    from knotopt.supports.support_set import SupportSet


FLOWN_TEAM = "flown"
FlownSupportsOption = Annotated[
    str,
    typer.Option(
        metavar="NAME|FILE",
        autocompletion=among(("milp", "lcf", "all", FLOWN_TEAM)),
        help="milp (the provably smallest set), lcf, all (turning points), flown (the smallest "
        "team known to tie the knot or its mirror image, on its own grid), or a .json file such "
        "as solve --json and lcf --json print.",
    ),
]


def fly(
    knot: options.KnotArgument,
    supports: FlownSupportsOption = "milp",
    cut: options.SupportsCutOption = "best",
    formulation: Annotated[
        str | None,
        options.unless_given(
            str(FLOWN.formulation),
            "Of the smallest set: span (the taut cable itself, which is what is flown), opening "
            "(polygons through the grid's crossings) or loops (a support on every loop).",
            metavar="NAME",
            autocompletion=among(("span", "opening")),
        ),
    ] = None,
    with_: WithOption = None,
    r: Annotated[float | None, options.openness_option(FLOWN.openness)] = None,
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
            "pictures, viewer.html. Replaces a former flight there.",
        ),
    ] = None,
    schedule: Annotated[
        str,
        typer.Option(
            autocompletion=among(SCHEDULES),
            help="optimised (the fastest), or fixed: at one pace, as in the paper.",
        ),
    ] = FlightRequest.schedule,
    step: Annotated[
        float | None, options.unless_given(ROOM.step, "Metres per grid step; a flown team's own.")
    ] = None,
    altitude: Annotated[float, typer.Option(help="Of hovering robots [m].")] = ROOM.altitude,
    floor: Annotated[float, typer.Option(help="Lowest that a robot flies [m].")] = ROOM.floor,
    ceiling: Annotated[float, typer.Option(help="Highest that a robot flies [m].")] = ROOM.ceiling,
    speed: Annotated[float, typer.Option(help="Largest, of a robot [m/s].")] = FlightLimits.speed,
    acceleration: Annotated[
        float, typer.Option(help="Largest, of a robot [m/s²].")
    ] = FlightLimits.acceleration,
    separation: Annotated[
        float, typer.Option(help="Of robots at one height [m].")
    ] = FlightLimits.separation,
    downwash: Annotated[
        float, typer.Option(help="Of a robot straight below another [m].")
    ] = FlightLimits.downwash,
    spacing: Annotated[
        float, typer.Option(help="Of robots in single file [m].")
    ] = FlightLimits.spacing,
    slack: Annotated[
        float, typer.Option(help="Cable beyond the farthest that two robots get apart, a share.")
    ] = FlightLimits.slack,
    hover_before: Annotated[
        float, typer.Option(help="Before the flight [s].")
    ] = FlightLimits.hover_before,
    hover_after: Annotated[float, typer.Option(help="After it [s].")] = FlightLimits.hover_after,
    noise: Annotated[
        float | None,
        options.unless_given(
            DisturbedFlights.noise, "With --sim: standard deviation of robots' positions [m]."
        ),
    ] = None,
    wind: Annotated[
        str | None,
        typer.Option(metavar="X,Y", help="With --sim: steady wind [m/s].", show_default=False),
    ] = None,
    gust: Annotated[
        float | None,
        options.unless_given(
            DisturbedFlights.gust, "With --sim: standard deviation of the wind about it [m/s]."
        ),
    ] = None,
    seed: Annotated[
        int | None,
        options.unless_given(
            DisturbedFlights.seed, "With --sim: of the first disturbed flight.", min=0
        ),
    ] = None,
    runs: Annotated[
        int | None,
        options.unless_given(DisturbedFlights.runs, "With --sim: disturbed flights.", min=0),
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
    as_json: options.JsonOption = False,
) -> None:
    """Plan a flight that ties a knot, check it, fly it in simulation, and export it.

    Exit status 1 if a limit is not kept, or the undisturbed flight does not tie the knot.

    Example: knotopt fly 3 --sim --out trefoil
    """
    from knotopt.cable.cable import Cable
    from knotopt.sandwich.known import flown_team
    from knotopt.supports.selection import GivenSupports, equally_small

    options.check_choice("--schedule", schedule, SCHEDULES)
    if supports != "milp":
        for option in options.given(r=r, formulation=formulation, **{"with": with_}):
            options.refuse(f"--{option}", "goes with --supports milp")
    check_openness(formulation or FLOWN.formulation, r)
    requirements = Requirements(
        FLOWN.formulation if formulation is None else formulation,
        FLOWN.openness if r is None else r,
        with_loops=with_loops(with_),
    )
    metres = ROOM.step if step is None else step
    world = World(metres, altitude, floor, ceiling, ROOM.drone_height, ROOM.downwash)
    limits = FlightLimits(
        speed, acceleration, separation, downwash, spacing, slack, hover_before, hover_after
    )
    disturbed = options.given(noise=noise, wind=wind, gust=gust, seed=seed, runs=runs)
    for name in () if sim else disturbed | options.given(tighten=tighten):
        options.refuse(f"--{name}", "goes with --sim")
    if tighten is not None and not 0 < tighten < math.inf:
        options.refuse("--tighten", f"is a distance in metres, not {tighten:g}")
    if wind is not None:
        disturbed["wind"] = _wind(wind)
    disturbances = DisturbedFlights(**disturbed).disturbances()
    _check_surroundings(out, sim=sim)

    if supports == FLOWN_TEAM and cut != "best":
        options.refuse("--cut", "a flown team has its own")
    named = read(knot)
    check_size(named.diagram.size, "fly", **{"--supports milp": supports == "milp"})
    sets: Iterable[SupportSet]
    name, title = named.name, f"{named.name} ({named.source})"
    if supports == FLOWN_TEAM:
        team, name, is_mirrored = flown_team(named.diagram)
        title = f"{name}, the mirror image of {title}" if is_mirrored else title
        sets = [GivenSupports(Cable(team.diagram, team.cut), team.supports)]
        world = replace(world, step=team.step) if step is None else world
    else:
        sets = equally_small(named.diagram, supports, cut, requirements)
    request = FlightRequest(name, Path(supports).name, world, limits, schedule)
    mission = _mission(sets, request, disturbances, tighten, sim=sim)
    _finish(mission, title, out, as_json=as_json)
    if mission.reasons:
        raise typer.Exit(1)


def _wind(text: str) -> tuple[float, float]:
    try:
        x, y = (float(part) for part in text.split(","))
    except ValueError:
        x = y = math.nan
    if not (math.isfinite(x) and math.isfinite(y)):
        options.refuse("--wind", f"is X,Y in m/s, such as 0.3,0; not {text!r}")
    return x, y


def _check_surroundings(out: Path | None, *, sim: bool) -> None:
    """Where nothing can be written or simulated, nothing is planned in vain."""
    from knotopt.files import check_folder
    from knotopt.mission.folder import why_kept
    from knotopt.sim.simulators import MUJOCO

    if out is not None:
        check_folder(out, why_kept)
    if sim:
        MUJOCO.require()


def _mission(
    sets: Iterable[SupportSet],
    request: FlightRequest,
    disturbances: list[Disturbance],
    tighten: float | None,
    *,
    sim: bool,
) -> Mission:
    """The flight by the model of laid cable; or rehearsed, perhaps pulled tight, and flown."""
    from knotopt.mission.fly import fly_disturbed, plan_mission, rehearse_mission

    if not sim:
        with status_line("planning", "planning: "):
            return plan_mission(sets, request)
    with status_line("rehearsing", "rehearsing: "):
        mission = rehearse_mission(sets, request, tighten)
    flights = track(disturbances, "disturbed flights", len(disturbances))
    return fly_disturbed(mission, flights)


def _finish(mission: Mission, title: str, out: Path | None, *, as_json: bool) -> None:
    """Write and print what came of it."""
    from knotopt.mission.content import mission_content

    missing = None if out is None else _write(mission, out)
    if as_json:
        print_json(mission_content(mission) | {"written": None if out is None else str(out)})
        return
    show_mission(mission, title)
    if missing:
        print(missing)
    print_written(out)


def _write(mission: Mission, out: Path) -> str:
    """Write the folder; return what could not be part of it."""
    from knotopt.errors import MissingExtraError
    from knotopt.files import write_folder
    from knotopt.mission.folder import flight_files, flight_pictures, why_kept

    files, missing = flight_files(mission), ""
    try:
        files.update(flight_pictures(mission))
    except MissingExtraError as error:
        missing = f"no pictures: {error}"
    write_folder(out, files, why_kept)
    return missing
