"""`knotopt solve`: the provably smallest set of supports."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from formulations.backends import DEFAULT
from formulations.solution import Limits
from knotopt.cli import options
from knotopt.cli.formulations import (
    ThreadingOption,
    WhichFormulationOption,
    WithOption,
    check_openness,
    with_loops,
)
from knotopt.cli.printing import print_json, print_written
from knotopt.cli.progress import logged_bar, status_line, track
from knotopt.cli.reading import read
from knotopt.cli.sizes import check_size
from knotopt.cli.solve_answer import answer_knot
from knotopt.cli.solve_diagrams import (
    BudgetOption,
    DiagramsOption,
    check_out,
    front_json,
    search_diagrams,
    show_front,
)
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
from knotopt.supports.registry import FORMULATIONS
from knotopt.supports.requirements import Requirements

if TYPE_CHECKING:
    from formulations.solution import Enumeration
    from knotopt.diagram.grid import GridDiagram
    from knotopt.supports.diagram_search import DiagramSearch
    from knotopt.supports.minimal import MinimalSupports
    from knotopt.supports.search import CutSearch

_OF_THE_ANSWER = {
    *("knot", "over", "mirror", "read_as", "budget", "seed", "solver", "time_limit", "threads"),
    *("plot", "as_json", "verbose", "log"),
}
"""The parameters that go with the answer over all formulations."""
LOOPS = "loops"  # what diagrams are searched for unless another formulation is named
MOST_SETS = 1000  # that --all lists, unless another number is given


def solve(
    context: typer.Context,
    knot: options.KnotArgument,
    formulation: WhichFormulationOption = None,
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
    diagrams: DiagramsOption = False,
    budget: BudgetOption = None,
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
    laid: Annotated[
        bool,
        typer.Option(
            "--laid",
            help="The cable laid in straight spans must be the knot, by invariants; sets that fail "
            "are cut off.",
        ),
    ] = False,
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
            "out of budget, goes on where it stopped. With --diagrams: keep the search, to go on "
            "with it.",
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
    """Say how many robots a knot takes; with --formulation, find the smallest set that it asks for.

    Without a formulation: the least for the knot, to lay its diagram, flown, and safe. With one,
    the set is proven to be the smallest. --diagrams and --laid are about formulation loops unless
    another is named.

    Example: knotopt solve '7 Var2' --formulation span --plot supports.png
    """
    from formulations.export import FORMATS
    from knotopt.supports.minimal import all_minimal

    if formulation is None and not (diagrams or laid):
        _refuse_others(context, "goes with --formulation " + ", ".join(FORMULATIONS))
        limits = options.solver_limits(time_limit, gap, threads, seed)
        answer_knot(
            knot,
            budget=budget,
            seed=seed,
            solver=solver,
            limits=limits,
            plot=plot,
            as_json=as_json,
        )
        return
    named_or_loops = LOOPS if formulation is None else formulation
    check_openness(named_or_loops, r)
    asked = Requirements(
        named_or_loops,
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
    about_others = {"--all": every, "--diagrams": diagrams, "--max-robots": max_robots}
    if laid:
        _refuse_any(about_others | {"--cut all": cut == "all"}, "does not go with --laid")
    options.check_suffix(export, "programs are", FORMATS)
    check_out(budget, out, diagrams=diagrams, flown=verify_physics)
    flights = FlightOptions(noise, trials, physics_budget, max_cut, None if diagrams else out)
    (flights.tests if verify_physics else flights.check_unused)()
    named = read(knot)
    check_size(named.diagram.size, "solve", **{f"--formulation {asked.formulation}": True})
    if verify_physics:
        if cut == "all":
            options.refuse("--cut", "with --verify-physics, give --cut best or a cut's name")
        _refuse_any(about_others, "does not go with --verify-physics")
        flown = fly_sets(named, asked, cut, flights, laid=laid, solver=solver, limits=limits)
        tied = flown.status == "tied"
        written = _write(named.name, flown.result, plot if tied else None, export)
        show_flown(named, flown, written, as_json=as_json)
        raise typer.Exit(0 if tied else 1)
    if cut == "all":
        results = _each_cut(named.diagram, asked, solver, limits)
        show_cuts(named.name, results, as_json=as_json)
        return
    solving: dict[str, Any] = {"solver": solver, "limits": limits}
    found = search_diagrams(named, asked, budget, out, **solving) if diagrams else None
    search = (
        found.best if found else (_laid if laid else _search)(named.diagram, asked, cut, **solving)
    )
    result, sets = search.best, None
    if every and result.found:
        sets = all_minimal(result, count=count or MOST_SETS, solver=solver, limits=limits)
    written = _write(named.name, result, plot, export)
    if as_json:
        print_json(_answer_json(named.name, search, found, sets))
    else:
        _show(f"{named.name} ({named.source})", search, found, sets, count)
        print_written(*written)
    if not result.found:
        raise typer.Exit(1)


def _refuse_others(context: typer.Context, why: str) -> None:
    """Refuse the first option that is given and does not go with the answer."""
    for parameter in context.command.params:
        source = context.get_parameter_source(parameter.name or "")
        is_given = source is not None and source.name == "COMMANDLINE"
        if is_given and parameter.name not in _OF_THE_ANSWER:
            options.refuse(parameter.opts[0], why)


def _answer_json(
    name: str, search: CutSearch, found: DiagramSearch | None, sets: Enumeration | None
) -> dict[str, Any]:
    """What `--json` says."""
    content = search_json(name, search)
    if found is not None:
        content |= front_json(found)
    if sets is not None:
        content["minimal_sets"] = [list(each) for each in sets.sets]
        content["minimal_sets_complete"] = sets.complete
    return content


def _show(
    title: str,
    search: CutSearch,
    found: DiagramSearch | None,
    sets: Enumeration | None,
    count: int | None,
) -> None:
    """Print the front over diagrams, the best set, and all smallest ones, as far as asked for."""
    if found is not None:
        show_front(title, found)
    show_search(title, search, found)
    if sets is not None:
        show_sets(sets, count or MOST_SETS)


def _check_options(
    cut: str, diagrams: bool, about_one_cut: dict[str, Any], *, numbers: bool
) -> None:
    """Options that exclude each other are refused."""
    if cut == "all":
        _refuse_any(about_one_cut, "is about one cut: give --cut best or a cut's name")
    if diagrams and numbers:
        options.refuse("--forbid, --force", "does not go with --diagrams")
    if diagrams and cut != "best":
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
    diagram: GridDiagram, asked: Requirements, cut: str, *, solver: str, limits: Limits
) -> CutSearch:
    """The best cut; progress is shown and logged."""
    from knotopt.cable.cut import Cut, crossing_free_cuts
    from knotopt.supports.search import best_supports

    cuts = (Cut.parse(cut, diagram.size),) if cut != "best" else crossing_free_cuts(diagram)
    with logged_bar("cuts", len(cuts)) as show:
        return best_supports(
            diagram,
            asked,
            cuts=cuts,
            solver=solver,
            limits=limits,
            progress=lambda done: show(done, cuts[done - 1]),
        )


def _each_cut(
    diagram: GridDiagram, asked: Requirements, solver: str, limits: Limits
) -> list[MinimalSupports]:
    """Every cut by itself; progress is shown."""
    from knotopt.cable.cut import crossing_free_cuts
    from knotopt.supports.search import supports_by_cut

    cuts = crossing_free_cuts(diagram)
    found = supports_by_cut(diagram, asked, cuts=cuts, solver=solver, limits=limits)
    return list(track(found, "cuts", len(cuts), lambda result: result.cable.cut))


def _laid(
    diagram: GridDiagram, asked: Requirements, cut: str, *, solver: str, limits: Limits
) -> CutSearch:
    """The best cut, of sets that lay the knot."""
    from knotopt.cable.cut import Cut
    from knotopt.laid.smallest import LaidCuts
    from knotopt.supports.by_size import sets_in_order

    cuts = None if cut == "best" else [Cut.parse(cut, diagram.size)]
    lacks = LaidCuts()
    with status_line("solving"):
        return next(
            sets_in_order(diagram, asked, cuts=cuts, lacks=lacks, solver=solver, limits=limits)
        )


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
