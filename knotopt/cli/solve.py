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
    if count is not None and not every:
        raise typer.BadParameter("goes with --all", param_hint="--count")
    _check_options(cut, diagrams, {"--plot": plot, "--export": export, "--all": every})
    if cut in ("best", "all") and (forbid or force):
        raise typer.BadParameter(
            "turning points are numbered along one cable: give --cut L+ or another",
            param_hint="--forbid, --force",
        )
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
        sets = all_minimal(result, count=count or 1000, solver=solver, limits=limits)
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
            _show_sets(sets, count or 1000)
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
        "status_over_cuts": str(search.status),
        "bound_over_cuts": search.bound,
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

        asked = result.requirements
        title = f"{name}, cut {result.cable.cut}: {result.robots} robots"
        title += f" ({asked.formulation}{_asked(asked)})"
        taut = asked.formulation == "span"
        figure = supports_figure(result.lcf.regions, result.supports, title, taut=taut)
        save_figure(figure, plot)
        written.append(plot)
    if export is not None:
        from formulations.export import FORMATS
        from knotopt.files import write_atomically

        write_atomically(export, FORMATS[export.suffix.lower()](result.instance))
        written.append(export)
    return written


def _show_sets(sets: Enumeration, count: int) -> None:
    ending = "" if sets.complete else f", and maybe more (--count {count}, --time-limit)"
    plural = "" if len(sets.sets) == 1 else "s"
    print(f"\n{len(sets.sets)} smallest set{plural}{ending}:")
    for each in sets.sets:
        print("  " + (" ".join(f"p{k}" for k in each) or "no supports"))


def _show(title: str, search: CutSearch, tried: DiagramSearch | None) -> None:
    from knotopt.cli.drawing import LEADER, SUPPORT, TAIL, draw_text
    from knotopt.supports.support_set import format_supports

    result = search.best
    cable, asked, solution = result.cable, result.requirements, result.solution
    if not result.found:
        _show_failure(title, search)
        return
    print(draw_text(cable, result.supports))
    print(
        f"\n{SUPPORT} support robot  {TAIL} lifting robot p1  {LEADER} lifting robot pn, the leader"
    )
    print(
        f"\n{title}, cut {cable.cut}: {result.robots} robots instead of {result.baseline} "
        f"({result.reduction_percent} % fewer)"
    )
    print(f"supports: {format_supports(result.placed_supports) or 'none'}\n")
    closed = ", ".join(result.lcf.regions[k].name for k in result.lcf_report.closed_regions)
    milliseconds = 1e3 * (solution.build_seconds + solution.solve_seconds)
    start = {True: "accepted", False: "not accepted", None: "none given or taken"}
    clearance = "no region is threaded"
    if result.smallest_opening is not None:
        clearance = f"{result.smallest_opening:.3f} grid steps: the smallest opening"
    facts = [
        ("formulation", f"{asked.formulation}, threading {asked.threading}{_asked(asked)}"),
        ("proven", _proof(search)),
        ("bound", f"{_bound(search)}, on this cut {solution.status} ({solution.raw_status})"),
        ("checked", "open by the definition" if result.report.is_open else "NOT open"),
        ("clearance", clearance),
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
        cells = (_outcome_cells(outcome, result.robots) for outcome in search.outcomes)
        print_table(("cut", "robots", "bound"), cells)


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
    if search.is_proven and result.robots == 2:
        return "the two lifting robots are enough"
    if search.is_proven:
        return f"no set of {result.robots - 1} robots is open {scope}"
    return "no: stopped at a limit"


def _bound(search: CutSearch) -> str:
    return "none known" if search.bound is None else f"{search.bound} robots"


def _show_failure(title: str, search: CutSearch) -> None:
    from formulations.solution import Status

    result, cut = search.best, search.best.cable.cut
    if search.status is not Status.INFEASIBLE:
        print(f"{title}: no set found on {len(search.outcomes)} cuts; the solver stopped early")
        return
    where = f"cut {cut}" if len(search.outcomes) == 1 else f"any of {len(search.outcomes)} cuts"
    print(f"{title}: no set of supports does what is asked on {where}.")
    smallest = ", while any one of them can be left out" if result.conflict_is_smallest else ""
    print(f"On cut {cut} these cannot be met together{smallest}:")
    for family, origin in result.conflict:
        print(f"  {family}: {origin}")


def _show_cuts(name: str, results: list[MinimalSupports], *, as_json: bool) -> None:
    from knotopt.supports.support_set import format_supports

    if as_json:
        print_json([supports_json(name, result) for result in results])
        return
    asked = results[0].requirements
    print(f"{name}: {asked.formulation}, threading {asked.threading}{_asked(asked)}")
    print_table(
        ("cut", "robots", "bound", "status", "LCF", "open", "clearance", "supports"),
        (
            (
                result.cable.cut,
                result.robots if result.found else "none",
                "-" if result.solution.bound is None else result.solution.bound,
                result.solution.status,
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


def _outcome_cells(outcome: CutOutcome, best: int) -> tuple[str, str, str]:
    robots = "unknown" if outcome.robots is None else str(outcome.robots)
    if outcome.status == "infeasible":
        robots = "none"
    elif outcome.robots is None and outcome.bound is not None and outcome.bound >= best:
        robots = "not fewer"
    return str(outcome.cut), robots, "-" if outcome.bound is None else str(outcome.bound)
