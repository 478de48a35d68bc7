"""`knotopt solve`: the provably smallest set of supports."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from knotopt.cli.output import (
    FormulationOption,
    JsonOption,
    KnotArgument,
    OpennessOption,
    PlotOption,
    SolverOption,
    ThreadingOption,
    TimeLimitOption,
    print_json,
    print_written,
    solver_limits,
    track,
)
from knotopt.cli.solve_report import asked_in_words, search_json, show_cuts, show_search, show_sets

if TYPE_CHECKING:
    from formulations.solution import Limits
    from knotopt.diagram.grid import GridDiagram
    from knotopt.supports.minimal import MinimalSupports
    from knotopt.supports.requirements import Requirements
    from knotopt.supports.search import CutSearch, DiagramSearch


def solve(
    knot: KnotArgument,
    formulation: FormulationOption = "opening",
    threading: ThreadingOption = None,
    r: OpennessOption = None,
    cut: Annotated[
        str,
        typer.Option(
            help="best (of the crossing-free cuts), all (each by itself), "
            "or one: L+ L- R+ R- B+ B- T+ T-, col3+, row5-."
        ),
    ] = "best",
    solver: SolverOption = "cp-sat",
    every: Annotated[
        bool, typer.Option("--all", help="List all smallest sets, not one of them.")
    ] = False,
    count: Annotated[
        int | None,
        typer.Option(help="With --all: how many at most; 1000 by default.", min=1),
    ] = None,
    diagrams: Annotated[
        int,
        typer.Option(
            help="Also search so many diagrams of the knot, by translations and commutations.",
            min=1,
        ),
    ] = 1,
    separation: Annotated[
        float | None,
        typer.Option(help="Smallest distance of two robots [grid steps].", show_default=False),
    ] = None,
    payload: Annotated[
        float | None,
        typer.Option(help="Longest span between robots [grid steps].", show_default=False),
    ] = None,
    reach: Annotated[
        float | None,
        typer.Option(
            help="Farthest that a helping robot may be from where a region is threaded "
            "[grid steps].",
            show_default=False,
        ),
    ] = None,
    forbid: Annotated[
        list[int] | None,
        typer.Option(help="A turning point without robot (can be repeated).", metavar="K"),
    ] = None,
    force: Annotated[
        list[int] | None,
        typer.Option(help="A turning point with a robot (can be repeated).", metavar="K"),
    ] = None,
    max_robots: Annotated[
        int | None,
        typer.Option(
            help="At most so many robots; the smallest opening is maximised instead.",
            metavar="K",
            show_default=False,
        ),
    ] = None,
    verify_physics: Annotated[
        bool,
        typer.Option(
            "--verify-physics",
            help="Fly the set in simulation; while it does not tie the knot, cut it off and solve "
            "again.",
        ),
    ] = False,
    noise: Annotated[
        float | None,
        typer.Option(
            help="Of the robots' positions in disturbed flights [m]; 0.01 by default.", metavar="M"
        ),
    ] = None,
    trials: Annotated[
        int | None,
        typer.Option(
            help="Disturbed flights that a set must tie in, beside the undisturbed one; 3 by "
            "default.",
        ),
    ] = None,
    physics_budget: Annotated[
        float | None,
        typer.Option(help="Fly no further set after so many seconds.", metavar="S"),
    ] = None,
    max_cut: Annotated[
        int | None,
        typer.Option(
            help="Fly no further set once so many are cut off; 20 unless a budget is given."
        ),
    ] = None,
    out: Annotated[
        Path | None,
        typer.Option(
            help="With --verify-physics: write the answer as JSON; a run that is interrupted, or "
            "out of budget, goes on where it stopped.",
            metavar="FILE",
        ),
    ] = None,
    time_limit: TimeLimitOption = None,
    gap: Annotated[float, typer.Option(help="Relative gap that is good enough.")] = 0.0,
    threads: Annotated[int, typer.Option(help="Threads of the solver.")] = 1,
    seed: Annotated[int, typer.Option(help="Seed of solver and diagram search.")] = 0,
    export: Annotated[
        Path | None,
        typer.Option(
            help="Write the program that was solved: .json, .mps, .opb or .wcnf.", metavar="FILE"
        ),
    ] = None,
    plot: PlotOption = None,
    as_json: JsonOption = False,
) -> None:
    """Find the smallest set of supports, with proof that none is smaller.

    Example: knotopt solve '7 Var2' --formulation span --plot supports.png
    """
    from knotopt.cable.cut import crossing_free_cuts
    from knotopt.catalogue.lookup import find_knot
    from knotopt.cli.solve_flown import FlightTests, fly_sets, show_flown
    from knotopt.supports.minimal import all_minimal
    from knotopt.supports.requirements import Requirements
    from knotopt.supports.search import supports_by_cut

    named = find_knot(knot)
    asked = Requirements(
        formulation,
        r,
        threading,
        separation=separation,
        payload=payload,
        reach=reach,
        forbidden=tuple(forbid or ()),
        forced=tuple(force or ()),
        max_robots=max_robots,
    )
    limits = solver_limits(time_limit, gap, threads, seed)
    if count is not None and not every:
        raise typer.BadParameter("goes with --all", param_hint="--count")
    _check_options(cut, diagrams, {"--plot": plot, "--export": export, "--all": every})
    if cut in ("best", "all") and (forbid or force):
        raise typer.BadParameter(
            "turning points are numbered along one cable: give --cut L+ or another",
            param_hint="--forbid, --force",
        )
    _check_outputs(plot, export)
    tests = FlightTests(noise, trials, physics_budget, max_cut, out)
    if verify_physics:
        others = {"--all": every, "--diagrams": diagrams > 1, "--max-robots": max_robots}
        _check_verification(cut, others)
        flown = fly_sets(named, asked, cut, tests, solver=solver, limits=limits)
        tied = flown.status == "tied"
        written = _write(named.name, flown.result, plot if tied else None, export)
        show_flown(named, flown, written, as_json=as_json)
        raise typer.Exit(0 if tied else 1)
    tests.check_unused()
    if cut == "all":
        cuts = crossing_free_cuts(named.diagram)
        found = supports_by_cut(named.diagram, asked, cuts=cuts, solver=solver, limits=limits)
        show_cuts(named.name, list(track(found, "cuts", len(cuts))), as_json=as_json)
        return
    search, tried = _search(named.diagram, asked, cut, diagrams, solver, limits)
    result = search.best
    sets = None
    if every and result.found:
        sets = all_minimal(result, count=count or 1000, solver=solver, limits=limits)
    written = _write(named.name, result, plot, export)
    if as_json:
        content = search_json(named.name, search, tried)
        if sets is not None:
            content["minimal_sets"] = [list(each) for each in sets.sets]
            content["minimal_sets_complete"] = sets.complete
        print_json(content)
    else:
        show_search(f"{named.name} ({named.source})", search, tried)
        if sets is not None:
            show_sets(sets, count or 1000)
        for path in written:
            print_written(path)
    if not result.found:
        raise typer.Exit(1)


def _check_options(cut: str, diagrams: int, about_one_cut: dict[str, Any]) -> None:
    if cut == "all":
        for option, value in about_one_cut.items():
            if value:
                raise typer.BadParameter(
                    "is about one cut: give --cut best or a cut's name", param_hint=option
                )
    if diagrams > 1 and cut != "best":
        raise typer.BadParameter("goes with --cut best", param_hint="--diagrams")


def _check_verification(cut: str, others: dict[str, Any]) -> None:
    if cut == "all":
        raise typer.BadParameter(
            "with --verify-physics, give --cut best or a cut's name", param_hint="--cut"
        )
    for option, value in others.items():
        if value:
            raise typer.BadParameter("does not go with --verify-physics", param_hint=option)


def _check_outputs(plot: Path | None, export: Path | None) -> None:
    """Wrong file names are refused before anything is solved."""
    from formulations.export import FORMATS
    from knotopt.errors import OutputError

    if plot is not None:
        from knotopt.plot.figures import check_format

        check_format(plot)
    if export is not None and export.suffix.lower() not in FORMATS:
        raise OutputError(f"{export}: programs are written as {', '.join(FORMATS)}")


def _search(
    diagram: GridDiagram,
    asked: Requirements,
    cut: str,
    diagrams: int,
    solver: str,
    limits: Limits,
) -> tuple[CutSearch, DiagramSearch | None]:
    from rich.console import Console
    from rich.progress import Progress

    from knotopt.cable.cut import Cut, crossing_free_cuts
    from knotopt.supports.search import best_diagram, best_supports

    free = crossing_free_cuts(diagram)
    cuts = free if cut == "best" else (Cut.parse(cut, diagram.size),)
    console = Console(stderr=True)
    with Progress(console=console, transient=True, disable=not console.is_terminal) as bar:
        if diagrams == 1:
            task = bar.add_task("cuts", total=len(cuts))
            search = best_supports(
                diagram,
                asked,
                cuts=cuts,
                solver=solver,
                limits=limits,
                progress=lambda done: bar.update(task, completed=done),
            )
            return search, None
        task = bar.add_task("diagrams", total=diagrams)
        tried = best_diagram(
            diagram,
            asked,
            budget=diagrams,
            seed=limits.seed,
            solver=solver,
            limits=limits,
            progress=lambda done: bar.update(task, completed=done),
        )
    return tried.best, tried


def _write(
    name: str, result: MinimalSupports, plot: Path | None, export: Path | None
) -> list[Path]:
    """Write the picture (if there is a set) and the program; return what was written."""
    written = []
    if plot is not None and result.found:
        from knotopt.plot.figures import save_figure, supports_figure
        from knotopt.supports.registry import find_formulation

        asked = result.requirements
        title = f"{name}, cut {result.cable.cut}: {result.robots} robots"
        title += f" ({asked.formulation}{asked_in_words(asked)})"
        taut = find_formulation(asked.formulation).is_taut
        figure = supports_figure(result.lcf.regions, result.supports, title, taut=taut)
        save_figure(figure, plot)
        written.append(plot)
    if export is not None:
        from formulations.export import FORMATS
        from knotopt.files import write_atomically

        write_atomically(export, FORMATS[export.suffix.lower()](result.instance))
        written.append(export)
    return written
