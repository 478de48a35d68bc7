"""`knotopt solve`: the provably smallest set of supports."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from formulations.backends import DEFAULT
from formulations.solution import Limits
from knotopt.cli import options
from knotopt.cli.formulations import (
    FormulationOption,
    ThreadingOption,
    WithOption,
    check_openness,
    with_loops,
)
from knotopt.cli.printing import print_json, print_written
from knotopt.cli.progress import logged_bar, track
from knotopt.cli.solve_flown import (
    FlightOptions,
    MaxCutOption,
    NoiseOption,
    PhysicsBudgetOption,
    TrialsOption,
    fly_sets,
)
from knotopt.cli.solve_flown_printing import show_flown
from knotopt.cli.solve_printing import (
    asked_in_words,
    search_json,
    show_cuts,
    show_search,
    show_sets,
)
from knotopt.supports.requirements import Requirements

if TYPE_CHECKING:
    from knotopt.diagram.grid import GridDiagram
    from knotopt.supports.minimal import MinimalSupports
    from knotopt.supports.search import CutSearch, DiagramSearch

MOST_SETS = 1000  # that --all lists, unless another number is given


def solve(
    knot: options.KnotArgument,
    formulation: FormulationOption = Requirements.formulation,
    threading: ThreadingOption = None,
    with_: WithOption = None,
    r: options.OpennessOption = None,
    cut: Annotated[
        str, options.cut_option("best (of the crossing-free cuts), all (each by itself)")
    ] = "best",
    solver: options.SolverOption = DEFAULT,
    every: Annotated[
        bool, typer.Option("--all", help="List all smallest sets, not one of them.")
    ] = False,
    count: Annotated[
        int | None, options.unless_given(MOST_SETS, "With --all: how many at most.", min=1)
    ] = None,
    diagrams: Annotated[
        int,
        typer.Option(
            help="Also search so many diagrams of the knot, by translations and commutations.",
            min=1,
        ),
    ] = 1,
    separation: Annotated[
        float | None, typer.Option(help="Smallest distance of two robots [grid steps].")
    ] = None,
    payload: Annotated[
        float | None, typer.Option(help="Longest span between robots [grid steps].")
    ] = None,
    reach: Annotated[
        float | None,
        typer.Option(
            help="Farthest that a helping robot may be from where a region is threaded "
            "[grid steps]."
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
            help="At most so many robots; the smallest opening is maximised instead.", metavar="K"
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
    noise: NoiseOption = None,
    trials: TrialsOption = None,
    physics_budget: PhysicsBudgetOption = None,
    max_cut: MaxCutOption = None,
    out: Annotated[
        Path | None,
        typer.Option(
            help="With --verify-physics: write the answer as JSON; a run that is interrupted, or "
            "out of budget, goes on where it stopped.",
            metavar="FILE",
        ),
    ] = None,
    time_limit: options.TimeLimitOption = None,
    gap: Annotated[float, typer.Option(help="Relative gap that is good enough.")] = Limits.gap,
    threads: Annotated[int, typer.Option(help="Threads of the solver.")] = Limits.threads,
    seed: Annotated[int, typer.Option(help="Seed of solver and diagram search.")] = Limits.seed,
    export: Annotated[
        Path | None,
        typer.Option(
            help="Write the program that was solved: .json, .mps, .opb or .wcnf.", metavar="FILE"
        ),
    ] = None,
    plot: options.PlotOption = None,
    as_json: options.JsonOption = False,
) -> None:
    """Find the smallest set of supports, with proof that none is smaller.

    Example: knotopt solve '7 Var2' --formulation span --plot supports.png
    """
    from formulations.export import FORMATS
    from knotopt.cable.cut import crossing_free_cuts
    from knotopt.catalogue.lookup import find_knot
    from knotopt.supports.minimal import all_minimal
    from knotopt.supports.search import supports_by_cut

    named = find_knot(knot)
    check_openness(formulation, r)
    asked = Requirements(
        formulation,
        r,
        threading,
        with_loops=with_loops(with_),
        separation=separation,
        payload=payload,
        reach=reach,
        forbidden=tuple(forbid or ()),
        forced=tuple(force or ()),
        max_robots=max_robots,
    )
    limits = options.solver_limits(time_limit, gap, threads, seed)
    if count is not None and not every:
        options.refuse("--count", "goes with --all")
    about_one_cut = {"--plot": plot, "--export": export, "--all": every}
    _check_options(cut, diagrams, about_one_cut, numbers=bool(forbid or force))
    options.check_suffix(export, "programs are", FORMATS)
    flights = FlightOptions(noise, trials, physics_budget, max_cut, out)
    if verify_physics:
        if cut == "all":
            options.refuse("--cut", "with --verify-physics, give --cut best or a cut's name")
        others = {"--all": every, "--diagrams": diagrams > 1, "--max-robots": max_robots}
        _refuse_any(others, "does not go with --verify-physics")
        flown = fly_sets(named, asked, cut, flights, solver=solver, limits=limits)
        tied = flown.status == "tied"
        written = _write(named.name, flown.result, plot if tied else None, export)
        show_flown(named, flown, written, as_json=as_json)
        raise typer.Exit(0 if tied else 1)
    flights.check_unused()
    if cut == "all":
        cuts = crossing_free_cuts(named.diagram)
        found = supports_by_cut(named.diagram, asked, cuts=cuts, solver=solver, limits=limits)
        results = track(found, "cuts", len(cuts), lambda result: result.cable.cut)
        show_cuts(named.name, list(results), as_json=as_json)
        return
    search, diagram_search = _search(named.diagram, asked, cut, diagrams, solver, limits)
    result, sets = search.best, None
    if every and result.found:
        sets = all_minimal(result, count=count or MOST_SETS, solver=solver, limits=limits)
    written = _write(named.name, result, plot, export)
    if as_json:
        content = search_json(named.name, search, diagram_search)
        if sets is not None:
            content["minimal_sets"] = [list(each) for each in sets.sets]
            content["minimal_sets_complete"] = sets.complete
        print_json(content)
    else:
        show_search(f"{named.name} ({named.source})", search, diagram_search)
        if sets is not None:
            show_sets(sets, count or MOST_SETS)
        print_written(*written)
    if not result.found:
        raise typer.Exit(1)


def _check_options(
    cut: str, diagrams: int, about_one_cut: dict[str, Any], *, numbers: bool
) -> None:
    """Options that exclude each other are refused."""
    if cut == "all":
        _refuse_any(about_one_cut, "is about one cut: give --cut best or a cut's name")
    if diagrams > 1 and cut != "best":
        options.refuse("--diagrams", "goes with --cut best")
    if cut in ("best", "all") and numbers:
        why = "turning points are numbered along one cable: give --cut L+ or another"
        options.refuse("--forbid, --force", why)


def _refuse_any(given: dict[str, Any], why: str) -> None:
    """Refuse the first of the options that is given."""
    for option, value in given.items():
        if value:
            options.refuse(option, why)


def _search(
    diagram: GridDiagram, asked: Requirements, cut: str, diagrams: int, solver: str, limits: Limits
) -> tuple[CutSearch, DiagramSearch | None]:
    """The best cut, perhaps of several diagrams; progress is shown and logged."""
    from knotopt.cable.cut import Cut, crossing_free_cuts
    from knotopt.supports.search import best_diagram, best_supports

    solving: dict[str, Any] = {"solver": solver, "limits": limits}
    if diagrams > 1:
        with logged_bar("diagrams", diagrams) as show:
            found = best_diagram(
                diagram, asked, budget=diagrams, seed=limits.seed, progress=show, **solving
            )
        return found.best, found
    cuts = (Cut.parse(cut, diagram.size),) if cut != "best" else crossing_free_cuts(diagram)
    with logged_bar("cuts", len(cuts)) as show:
        search = best_supports(
            diagram,
            asked,
            cuts=cuts,
            progress=lambda done: show(done, cuts[done - 1]),
            **solving,
        )
    return search, None


def _write(
    name: str, result: MinimalSupports, plot: Path | None, export: Path | None
) -> list[Path]:
    """Write the picture (if there is a set) and the program; return what was written."""
    written = []
    if plot is not None and result.found:
        from knotopt.plot.figures import save_figure, smallest_figure

        asked = result.requirements
        title = f"{name}, cut {result.cable.cut}: {result.robots} robots"
        title += f" ({asked.words}{asked_in_words(asked)})"
        save_figure(smallest_figure(result, title), plot)
        written.append(plot)
    if export is not None:
        from formulations.export import FORMATS
        from knotopt.files import write_atomically

        write_atomically(export, FORMATS[export.suffix.lower()](result.instance))
        written.append(export)
    return written
