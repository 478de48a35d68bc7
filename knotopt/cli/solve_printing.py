"""What `knotopt solve` prints of its results, as text and as JSON."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from knotopt.cli.printing import print_facts, print_json, print_table
from knotopt.cli.solve_diagrams import diagrams_in_words
from knotopt.cli.solve_laid_printing import laid_facts, laid_json
from knotopt.supports.registry import find_formulation

if TYPE_CHECKING:
    from formulations.solution import Enumeration
    from knotopt.supports.diagram_search import DiagramSearch
    from knotopt.supports.minimal import MinimalSupports
    from knotopt.supports.requirements import Requirements
    from knotopt.supports.search import CutOutcome, CutSearch


def supports_json(name: str, result: MinimalSupports) -> dict[str, Any]:
    """What `--json` says of one cut."""
    solution, asked = result.solution, result.requirements
    return {
        "knot": name,
        "cut": str(result.cable.cut),
        "formulation": str(asked.formulation),
        "with": "loops" if asked.with_loops else "none",
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
        "lcf_closes": [result.lcf.regions.name(k) for k in result.lcf_report.closed_regions],
        "solver": solution.solver,
        "start_accepted": solution.start_accepted,
        "build_seconds": round(solution.build_seconds, 6),
        "solve_seconds": round(solution.solve_seconds, 6),
        "threads": solution.threads,
        "seed": solution.seed,
        "instance": result.instance.hash,
        "disjoint_loops": result.cable.crossings.cell[list(result.disjoint_loops)].tolist(),
        "conflict": [list(group) for group in result.conflict],
    }


def search_json(name: str, search: CutSearch) -> dict[str, Any]:
    """What `--json` says of a search over cuts."""
    cable = search.best.cable
    laid = {} if search.cut_off is None else {"laid": laid_json(search)}
    return (
        supports_json(name, search.best)
        | laid
        | {
            "proven_over_cuts": search.is_proven,
            "status_over_cuts": str(search.status),
            "bound_over_cuts": search.bound,
            "cuts": [
                {
                    "cut": str(each.cut),
                    "robots_after": each.robots,
                    "bound": each.bound,
                    "status": str(each.status),
                }
                for each in search.outcomes
            ],
            "diagrams_tried": 1,
            "grid": [list(mark) for mark in cable.diagram.marks],
            "path": [list(mark) for mark in cable.path],
        }
    )


def show_sets(sets: Enumeration, count: int) -> None:
    """Print all smallest sets, of which at most `count` were looked for."""
    ending = "" if sets.complete else f", and maybe more (--count {count}, --time-limit)"
    plural = "" if len(sets.sets) == 1 else "s"
    print(f"\n{len(sets.sets)} smallest set{plural}{ending}:")
    for each in sets.sets:
        print("  " + (" ".join(f"p{k}" for k in each) or "no supports"))


def show_search(
    title: str,
    search: CutSearch,
    diagram_search: DiagramSearch | None = None,
    cut_off: int = 0,
) -> None:
    """Print the best cut's set; `cut_off` says how many smaller ones were ruled out by hand."""
    from knotopt.cli.drawing import print_supports

    result = search.best
    if not result.found:
        _show_failure(title, search)
        return
    print_supports(title, result)
    print()
    facts = _facts(search, cut_off)
    if search.cut_off is not None:
        facts += laid_facts(search)
    if diagram_search is not None:
        facts.insert(1, ("diagrams", diagrams_in_words(diagram_search)))
    print_facts(facts)
    if len(search.outcomes) > 1:
        cells = (_outcome_cells(outcome, result.robots) for outcome in search.outcomes)
        print_table(("cut", "robots", "bound"), cells)


def _facts(search: CutSearch, cut_off: int) -> list[tuple[str, str]]:
    """Of the best cut's set: what was asked, what is proven, how it compares, how it was found."""
    result = search.best
    requirements, solution = result.requirements, result.solution
    rules = find_formulation(requirements.formulation)
    closed = ", ".join(result.lcf.regions.name(k) for k in result.lcf_report.closed_regions)
    milliseconds = 1e3 * (solution.build_seconds + solution.solve_seconds)
    start = {True: "accepted", False: "not accepted", None: "none given or taken"}
    clearance = "no region is threaded"
    if result.smallest_opening is not None:
        clearance = f"{result.smallest_opening:.3f} grid steps: the smallest opening"
    bound = "none known" if search.bound is None else f"{search.bound} robots"
    first = "largest smallest opening, then first" if rules.has_openness else "first on the path"
    equals = first if result.canonical else "any of them"
    lcf = f"{result.lcf.robots} robots, "
    lcf += rules.adjective if result.lcf_report.is_open else f"not {rules.adjective}"
    if closed:
        lcf += f": closes {closed}" if rules.has_openness else f": none on {closed}"
    facts = [
        ("formulation", in_words(requirements)),
        ("meaning", rules.meaning),
        ("proven", _proof(search) + (f" but for {cut_off} cut off" if cut_off else "")),
        ("bound", f"{bound}, on this cut {solution.status} ({solution.raw_status})"),
        ("loops", _disjoint_loops(result)),
        (
            "checked",
            f"{rules.adjective} by the definition"
            if result.report.is_open
            else f"NOT {rules.adjective}",
        ),
        ("clearance", clearance if rules.has_openness else ""),
        ("among equals", equals),
        ("LCF, same cut", lcf),
        ("solver", f"{solution.solver}, {milliseconds:.1f} ms, seed {solution.seed}"),
        ("LCF as start", start[solution.start_accepted]),
        ("instance", result.instance.hash[:16]),
    ]
    return [(name, words) for name, words in facts if words]


def _disjoint_loops(result: MinimalSupports) -> str:
    """Of formulation `loops`: those that prove how many robots are needed."""
    if find_formulation(result.requirements.formulation).has_openness:
        return ""
    loops = result.disjoint_loops
    places = result.cable.crossings.cell.tolist()
    names = " ".join("c{}[{},{}]".format(index + 1, *places[index]) for index in loops)
    if len(loops) < 2:
        return names and f"{names} needs a support"
    return f"{names}: no two share a turning point, so each needs a support of its own"


def in_words(asked: Requirements) -> str:
    """All that is asked."""
    threading = f", threading {asked.threading}"
    if asked.reach is None and not find_formulation(asked.formulation).has_openness:
        threading = ""
    return asked.words + threading + asked_in_words(asked)


def asked_in_words(asked: Requirements) -> str:
    """What is asked beyond formulation and threading, to follow them."""
    wishes = []
    if asked.max_robots is not None:
        wishes = [f"at most {asked.max_robots} robots"]
    elif find_formulation(asked.formulation).has_openness:
        wishes = [f"r {float(asked.openness):g}"]
    for name in ("separation", "payload", "reach"):
        if getattr(asked, name) is not None:
            wishes.append(f"{name} {getattr(asked, name):g}")
    wishes += [f"p{k} forced" for k in asked.forced] + [f"p{k} forbidden" for k in asked.forbidden]
    return "".join(f", {wish}" for wish in wishes)


def _proof(search: CutSearch) -> str:
    result = search.best
    scope = f"over {len(search.outcomes)} cuts" if len(search.outcomes) > 1 else "on this cut"
    rules = find_formulation(result.requirements.formulation)
    if result.requirements.max_robots is not None and rules.has_openness:
        return f"no larger opening {scope}" if search.is_proven else "no"
    if not search.is_proven:
        return "no: stopped at a limit"
    if result.robots == 2:
        return "the two lifting robots are enough"
    laid = "" if search.cut_off is None else " and lays the knot"
    return f"no set of {result.robots - 1} robots is {rules.adjective}{laid} {scope}"


def _show_failure(title: str, search: CutSearch) -> None:
    from formulations.solution import Status

    result, cut = search.best, search.best.cable.cut
    if search.status is not Status.INFEASIBLE:
        print(f"{title}: no set found on {len(search.outcomes)} cuts; the solver stopped early")
        return
    where = f"cut {cut}" if len(search.outcomes) == 1 else f"any of {len(search.outcomes)} cuts"
    print(f"{title}: no set of supports does what is asked on {where}.")
    if not result.conflict:  # sets there were, but none lays the knot
        return
    smallest = ", while any one of them can be left out" if result.conflict_is_smallest else ""
    print(f"On cut {cut} these cannot be met together{smallest}:")
    for family, origin in result.conflict:
        print(f"  {family}: {origin}")


def show_cuts(name: str, results: list[MinimalSupports], *, as_json: bool) -> None:
    """Print the smallest set of each cut by itself, a line for each."""
    from knotopt.supports.support_set import format_supports

    if as_json:
        print_json([supports_json(name, result) for result in results])
        return
    asked = results[0].requirements
    print(f"{name}: {in_words(asked)}")
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


def _outcome_cells(outcome: CutOutcome, best: int) -> tuple[str, str, str]:
    robots = "unknown" if outcome.robots is None else str(outcome.robots)
    if outcome.status == "infeasible":
        robots = "none"
    elif outcome.robots is None and outcome.bound is not None and outcome.bound >= best:
        robots = "not fewer"
    return str(outcome.cut), robots, "-" if outcome.bound is None else str(outcome.bound)
