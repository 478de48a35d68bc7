"""`knotopt path`: a cable's path, by the program or by the paper's relaxation."""

from __future__ import annotations

from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from knotopt.cli import options
from knotopt.cli.completion import among
from knotopt.cli.formulations import FormulationOption, WithOption, check_openness, with_loops
from knotopt.cli.printing import print_facts, print_json, print_note, print_table, print_written
from knotopt.cli.reading import read
from knotopt.cli.sizes import check_size
from knotopt.path.requirements import PathRequirements
from knotopt.path.world import World
from knotopt.supports.requirements import Requirements

if TYPE_CHECKING:
    from knotopt.path.result import PathResult

METHODS = ("nlp", "relaxation", "both")
SAMPLES = 0.05  # between the rows of a curve's file [grid steps]


def path(
    knot: options.KnotArgument,
    supports: options.SupportsOption = "milp",
    method: Annotated[
        str,
        typer.Option(
            metavar="NAME",
            autocompletion=among(METHODS),
            help="nlp (the program), relaxation (the paper's springs), or both.",
        ),
    ] = "nlp",
    cut: options.SupportsCutOption = "best",
    formulation: FormulationOption = Requirements.formulation,
    with_: WithOption = None,
    r: options.OpennessOption = None,
    clearance: Annotated[
        float, typer.Option(help="Smallest distance of strands in plan [grid steps].")
    ] = PathRequirements.clearance,
    opening: Annotated[
        float, typer.Option(help="Room where a strand threads an active region [grid steps].")
    ] = PathRequirements.opening,
    gap: Annotated[
        float | None,
        options.unless_given(
            PathRequirements.gap,
            "Vertical distance at crossings [grid steps]. With --step it is what a drone and its "
            "downwash need.",
        ),
    ] = None,
    slope: Annotated[
        float, typer.Option(help="Steepest rise, height over length in plan.")
    ] = PathRequirements.slope,
    bending: Annotated[
        float, typer.Option(help="Weight of bending against length [grid steps].")
    ] = PathRequirements.bending,
    step: Annotated[
        float | None, typer.Option(help="Metres per grid step: adds lengths in metres.")
    ] = None,
    altitude: Annotated[
        float | None, options.unless_given(World.altitude, "With --step: of hovering robots [m].")
    ] = None,
    floor: Annotated[
        float | None, options.unless_given(World.floor, "With --step: the cable's lowest [m].")
    ] = None,
    ceiling: Annotated[
        float | None, options.unless_given(World.ceiling, "With --step: the cable's highest [m].")
    ] = None,
    drone_height: Annotated[
        float | None,
        options.unless_given(World.drone_height, "With --step: height of a drone [m]."),
    ] = None,
    downwash: Annotated[
        float | None,
        options.unless_given(World.downwash, "With --step: how far below a drone it reaches [m]."),
    ] = None,
    time_limit: options.TimeLimitOption = None,
    plot: options.PlotOption = None,
    out: Annotated[
        Path | None,
        typer.Option(
            metavar="FILE.csv",
            help="Write the curve by arc length: s,x,y,z,tx,ty,tz,curvature (in metres with "
            "--step); not with --method both.",
        ),
    ] = None,
    as_json: options.JsonOption = False,
) -> None:
    """Find the path of a cable held by its robots, and check it independently.

    Example: knotopt path 9 --supports lcf --method both --plot path.png
    """
    from knotopt.path.optimise import optimise_path
    from knotopt.path.relaxation import relaxed_path
    from knotopt.supports.selection import choose_supports

    options.check_choice("--method", method, METHODS)
    options.check_suffix(out, "curves are", (".csv",))
    if out is not None and method == "both":
        options.refuse("--out", "writes one curve: give --method nlp or relaxation")
    if supports != "milp":
        given = {"--r": r, "--with": with_, "--formulation": formulation}
        for option, value in given.items():
            if value not in (None, Requirements.formulation):
                options.refuse(option, "goes with --supports milp")
    height = {"drone_height": drone_height, "downwash": downwash}
    room = options.given(altitude=altitude, floor=floor, ceiling=ceiling, **height)
    world = _world(step, room, gap)
    asked = PathRequirements(
        clearance, opening, slope=slope, bending=bending, **options.given(gap=gap)
    )
    if world is not None:
        asked = world.requirements(asked)
    check_openness(formulation, r)
    of_the_set = Requirements(formulation, r, with_loops=with_loops(with_))
    limits = options.solver_limits(time_limit)
    named = read(knot)
    check_size(named.diagram.size, "path", **{f"--formulation {formulation}": supports == "milp"})
    chosen = choose_supports(named.diagram, supports, cut, of_the_set)
    results: list[PathResult] = []
    if method != "nlp":
        results.append(relaxed_path(chosen.cable, chosen.supports, asked))
    if method != "relaxation":
        results.append(optimise_path(chosen.cable, chosen.supports, asked, seconds=limits.seconds))
    title = f"{named.name}, cut {chosen.cable.cut}: {chosen.robots} robots ({supports})"
    written = _write(results, title, world, plot, out)
    if as_json:
        content = [_json(named.name, result, supports, world) for result in results]
        print_json(content if len(content) > 1 else content[0])
    else:
        _show(results, title, supports, world)
        print_written(*written)
    if results[-1].blocked:
        raise typer.Exit(1)


def _world(step: float | None, room: dict[str, float], gap: float | None) -> World | None:
    """The world that the options describe, if any."""
    if step is not None and gap is not None:
        options.refuse(
            "--gap", "is in grid steps; with --step it follows from --drone-height and --downwash"
        )
    if step is None and room:
        options.refuse("--" + next(iter(room)).replace("_", "-"), "goes with --step")
    return None if step is None else World(step, **room)


def _write(
    results: list[PathResult], title: str, world: World | None, plot: Path | None, out: Path | None
) -> list[Path]:
    """Write the picture and the curve; return what was written."""
    written = []
    if plot is not None:
        from knotopt.plot.figures import save_figure
        from knotopt.plot.path_figures import path_figure

        save_figure(path_figure(results, title), plot)
        written.append(plot)
    if out is not None:
        from knotopt.files import write_atomically

        write_atomically(out, _curve_csv(results[0], world))
        written.append(out)
    return written


def _show(results: list[PathResult], title: str, supports: str, world: World | None) -> None:
    from knotopt.path.measures import HEADS, NOTE, display, measure

    print(title)
    print_table(HEADS[3:], [display(measure(result, supports))[3:] for result in results])
    for result in results:
        _show_one(result, world)
    print_note(NOTE)


def _show_one(result: PathResult, world: World | None) -> None:
    report = result.report
    facts: list[tuple[str, Any]] = [
        ("method", f"{result.method}: {result.raw_status}"),
        ("taut string", f"{result.taut_length:.2f} grid steps, a lower bound"),
        ("curve", "C2 spline" if result.curve.is_smooth else "polyline"),
        ("heights", f"{report.lowest:.2f} to {report.highest:.2f}, slope {report.steepest:.2f}"),
    ]
    if result.rounds:
        solving = 1e3 * sum(each.solve_seconds for each in result.rounds)
        iterations = sum(each.iterations for each in result.rounds)
        words = f"{len(result.rounds)} rounds, {iterations} iterations, {solving:.0f} ms in IPOPT"
        facts.append(("solver", words))
    if result.blocked:
        facts.append(("not met", result.blocked))
    if world is not None:
        metres = world.measures(result)
        facts += [(name.replace("_", " "), f"{value:.3f} m") for name, value in metres.items()]
    print_facts(facts)
    print()


def _json(name: str, result: PathResult, supports: str, world: World | None) -> dict[str, Any]:
    from knotopt.path.measures import measure
    from knotopt.supports.support_set import place

    report = result.report
    return {
        "knot": name,
        **asdict(measure(result, supports)),
        "raw_status": result.raw_status,
        "taut_length": round(result.taut_length, 6),
        "lowest": round(report.lowest, 6),
        "highest": round(report.highest, 6),
        "steepest": round(report.steepest, 6),
        "requirements": asdict(result.requirements),
        "chosen_by": supports,
        "supports": [list(each) for each in place(result.cable, result.supports)],
        "path": [list(mark) for mark in result.cable.path],
        "grid": [list(mark) for mark in result.cable.diagram.marks],
        "rounds": [asdict(each) for each in result.rounds],
        "steps": result.steps,
        "metres": None if world is None else world.measures(result),
        "points": result.curve.points.round(6).tolist(),
    }


def _curve_csv(result: PathResult, world: World | None) -> str:
    """The curve by arc length, about every 0.05 grid steps."""
    import numpy as np

    curve = result.curve if world is None else world.curve(result)
    count = int(np.ceil(result.curve.length / SAMPLES)) + 1
    s = np.linspace(0, curve.length, count)
    columns = np.column_stack((s, curve.position(s), curve.tangent(s), curve.curvature(s)))
    lines = ["s,x,y,z,tx,ty,tz,curvature"]
    lines += [",".join(f"{value:.6f}" for value in row) for row in columns.tolist()]
    return "\n".join([*lines, ""])
