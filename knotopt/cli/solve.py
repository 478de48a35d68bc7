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
    print_facts,
    print_json,
    print_table,
    print_written,
    solver_limits,
    track,
)

if TYPE_CHECKING:
    from formulations.solution import Enumeration, Limits
    from knotopt.diagram.grid import GridDiagram
    from knotopt.supports.minimal import MinimalSupports
    from knotopt.supports.requirements import Requirements
    from knotopt.supports.search import CutOutcome, CutSearch, DiagramSearch


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
    count: Annotated[int, typer.Option(help="With --all: how many at most.", min=1)] = 1000,
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
    _check_options(cut, diagrams, {"--plot": plot, "--export": export, "--all": every})
    _check_outputs(plot, export)
    if cut == "all":
        cuts = crossing_free_cuts(named.diagram)
        found = supports_by_cut(named.diagram, asked, cuts=cuts, solver=solver, limits=limits)
        _show_cuts(named.name, list(track(found, "cuts", len(cuts))), as_json=as_json)
        return
    search, tried = _search(named.diagram, asked, cut, diagrams, solver, limits)
    result = search.best
    sets = None
    if every and result.found:
        sets = all_minimal(result, count=count, solver=solver, limits=limits)
    written = _write(named.name, result, plot, export)
    if as_json:
        content = _search_json(named.name, search, tried)
        if sets is not None:
            content["minimal_sets"] = [list(each) for each in sets.sets]
            content["minimal_sets_complete"] = sets.complete
        print_json(content)
    else:
        _show(f"{named.name} ({named.source})", search, tried)
        if sets is not None:
            _show_sets(sets)
        for path in written:
            print_written(path)
    if not result.found:
        raise typer.Exit(1)


def supports_json(name: str, result: MinimalSupports) -> dict[str, Any]:
    """What `--json` says of one cut."""
    solution, asked = result.solution, result.requirements
    return {
        "knot": name,
        "cut": str(result.cable.cut),
        "formulation": str(asked.formulation),
        "threading": str(asked.threading),
        "openness": None if asked.max_robots is not None else float(asked.openness),
        "robots_before": result.baseline,
        "robots_after": result.robots if result.found else None,
        "status": str(solution.status),
        "raw_status": solution.raw_status,
        "bound": solution.bound,
        "gap": solution.gap,
        "proven": result.is_proven,
        "supports": [list(support) for support in result.placed_supports],
        "smallest_opening": result.smallest_opening,
        "canonical": result.canonical,
        "checked_open": result.report.is_open if result.found else None,
        "lcf_robots": result.lcf.robots,
        "lcf_open": result.lcf_report.is_open,
        "lcf_closes": [result.lcf.regions[k].name for k in result.lcf_report.closed_regions],
        "solver": solution.solver,
        "start_accepted": solution.start_accepted,
        "build_seconds": round(solution.build_seconds, 6),
        "solve_seconds": round(solution.solve_seconds, 6),
        "threads": solution.threads,
        "seed": solution.seed,
        "instance": result.instance.hash,
        "conflict": [list(group) for group in result.conflict],
    }


def _search_json(name: str, search: CutSearch, tried: DiagramSearch | None) -> dict[str, Any]:
    cable = search.best.cable
    return supports_json(name, search.best) | {
        "proven_over_cuts": search.is_proven,
        "cuts": [_outcome_json(outcome) for outcome in search.outcomes],
        "diagrams_tried": tried.tried if tried else 1,
        "grid": [list(mark) for mark in cable.diagram.marks],
        "path": [list(mark) for mark in cable.path],
    }


def _check_options(cut: str, diagrams: int, about_one_cut: dict[str, Any]) -> None:
    if cut == "all":
        for option, value in about_one_cut.items():
            if value:
                raise typer.BadParameter(
                    "is about one cut: give --cut best or a cut's name", param_hint=option
                )
    if diagrams > 1 and cut != "best":
        raise typer.BadParameter("goes with --cut best", param_hint="--diagrams")


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

        title = f"{name}, cut {result.cable.cut}: {result.robots} robots"
        figure = supports_figure(result.lcf.regions, result.supports, title, taut=True)
        save_figure(figure, plot)
        written.append(plot)
    if export is not None:
        from formulations.export import FORMATS
        from knotopt.files import write_atomically

        write_atomically(export, FORMATS[export.suffix.lower()](result.instance))
        written.append(export)
    return written


def _show_sets(sets: Enumeration) -> None:
    ending = "" if sets.complete else ", and there are more (--count)"
    print(f"\n{len(sets.sets)} smallest sets{ending}:")
    for each in sets.sets:
        print("  " + " ".join(f"p{k}" for k in each))


def _show(title: str, search: CutSearch, tried: DiagramSearch | None) -> None:
    from knotopt.cli.drawing import LEADER, SUPPORT, TAIL, draw_text
    from knotopt.supports.support_set import format_supports

    result = search.best
    cable, asked, solution = result.cable, result.requirements, result.solution
    if not result.found:
        _show_failure(title, result)
        return
    print(draw_text(cable, result.supports))
    print(
        f"\n{SUPPORT} support robot  {TAIL} lifting robot p1  {LEADER} lifting robot pn, the leader"
    )
    print(
        f"\n{title}, cut {cable.cut}: {result.robots} robots instead of {result.baseline} "
        f"({result.reduction_percent} % fewer)"
    )
    print(f"supports: {format_supports(result.placed_supports)}\n")
    closed = ", ".join(result.lcf.regions[k].name for k in result.lcf_report.closed_regions)
    milliseconds = 1e3 * (solution.build_seconds + solution.solve_seconds)
    start = {True: "accepted", False: "not accepted", None: "none given or taken"}
    opening = "no region is threaded"
    if result.smallest_opening is not None:
        opening = f"{result.smallest_opening:.3f} grid steps"
    facts = [
        ("formulation", f"{asked.formulation}, threading {asked.threading}{_asked(asked)}"),
        ("proven", _proof(search)),
        ("bound", f"{solution.bound} robots, status {solution.status} ({solution.raw_status})"),
        ("checked", "open by the definition" if result.report.is_open else "NOT open"),
        ("opening", f"{opening} at the least"),
        (
            "among equals",
            "largest smallest opening, then first" if result.canonical else "any of them",
        ),
        (
            "LCF, same cut",
            f"{result.lcf.robots} robots, " + (f"not open: closes {closed}" if closed else "open"),
        ),
        ("solver", f"{solution.solver}, {milliseconds:.1f} ms, seed {solution.seed}"),
        ("LCF as start", start[solution.start_accepted]),
        ("instance", result.instance.hash[:16]),
    ]
    if tried is not None:
        facts.insert(
            1,
            (
                "diagrams",
                f"best of {tried.tried} found by translations and commutations, "
                f"seed {tried.seed}; others may do better",
            ),
        )
    print_facts(facts)
    if len(search.outcomes) > 1:
        print_table(("cut", "robots", "bound"), map(_outcome_cells, search.outcomes))


def _asked(asked: Requirements) -> str:
    wishes = [f"r {float(asked.openness):g}"]
    if asked.max_robots is not None:
        wishes = [f"at most {asked.max_robots} robots"]
    for name in ("separation", "payload", "reach"):
        if getattr(asked, name) is not None:
            wishes.append(f"{name} {getattr(asked, name):g}")
    wishes += [f"p{k} forced" for k in asked.forced] + [f"p{k} forbidden" for k in asked.forbidden]
    return ", " + ", ".join(wishes)


def _proof(search: CutSearch) -> str:
    result = search.best
    scope = f"over {len(search.outcomes)} cuts" if len(search.outcomes) > 1 else "on this cut"
    if result.requirements.max_robots is not None:
        return f"no larger opening {scope}" if search.is_proven else "no"
    if search.is_proven:
        return f"no set of {result.robots - 1} robots is open {scope}"
    return "no: stopped early"


def _show_failure(title: str, result: MinimalSupports) -> None:
    from formulations.solution import Status

    solution = result.solution
    if solution.status is not Status.INFEASIBLE:
        print(f"{title}, cut {result.cable.cut}: no set found ({solution.raw_status})")
        return
    print(f"{title}, cut {result.cable.cut}: no set of supports does what is asked.")
    print("These cannot be met together, while any one of them can be left out:")
    for family, origin in result.conflict:
        print(f"  {family}: {origin}")


def _show_cuts(name: str, results: list[MinimalSupports], *, as_json: bool) -> None:
    from knotopt.supports.support_set import format_supports

    if as_json:
        print_json([supports_json(name, result) for result in results])
        return
    print_table(
        ("cut", "robots", "bound", "proven", "LCF", "open", "opening", "supports"),
        (
            (
                result.cable.cut,
                result.robots if result.found else "none",
                "-" if result.solution.bound is None else result.solution.bound,
                result.is_proven,
                result.lcf.robots,
                result.lcf_report.is_open,
                "-" if result.smallest_opening is None else f"{result.smallest_opening:.3f}",
                format_supports(result.placed_supports),
            )
            for result in results
        ),
    )


def _outcome_json(outcome: CutOutcome) -> dict[str, Any]:
    return {
        "cut": str(outcome.cut),
        "robots_after": outcome.robots,
        "bound": outcome.bound,
        "status": str(outcome.status),
    }


def _outcome_cells(outcome: CutOutcome) -> tuple[str, str, str]:
    robots = "not fewer" if outcome.robots is None else str(outcome.robots)
    if outcome.status == "infeasible":
        robots = "none"
    return str(outcome.cut), robots, "-" if outcome.bound is None else str(outcome.bound)
