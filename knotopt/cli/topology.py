"""`knotopt topology`: plans in the space of a rope's topological states."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, Any

import typer

from knotopt.cli.completion import CUTS, among, knot_names
from knotopt.cli.options import JsonOption, PlotOption, check_choice, refuse
from knotopt.cli.printing import print_facts, print_json, print_table, print_written
from knotopt.cli.reading import asked, reading_in_words

if TYPE_CHECKING:
    from knotopt.flight.leader_plan import LeaderFaces
    from knotopt.reading.goal import Goal
    from knotopt.topology.plan import Plan, PlanGraph

MOST_PLANS = 1_000_000  # that can be listed: a gigabyte


def topology(
    goal: Annotated[
        str,
        typer.Argument(
            metavar="KNOT",
            autocompletion=knot_names,
            help="As for the other commands; or the state of a rope: its matrix, or its signed "
            "Gauss code 'U1+ O2+ U3+ O1+ U2+ O3+'; or a file with one.",
        ),
    ],
    cut: Annotated[
        str | None,
        typer.Option(
            metavar="CUT",
            autocompletion=among(CUTS),
            help="Where a knot's diagram is opened: L+ (by default) L- R+ R- B+ B- T+ T-, or "
            "col3+, row5-.",
        ),
    ] = None,
    goals: Annotated[
        str,
        typer.Option(
            metavar="NAME",
            autocompletion=among(("one", "mirror", "orbit")),
            help="one (the state itself), mirror (its mirror image too) or orbit (the reverses "
            "as well).",
        ),
    ] = "one",
    start: Annotated[
        str, typer.Option("--from", metavar="STATE", help="Where plans start, given as KNOT is.")
    ] = "trivial",
    rule: Annotated[
        str,
        typer.Option(
            metavar="NAME",
            autocompletion=among(("paper", "public", "any")),
            help="Which R2 there are: paper (those its parameters tell apart), public (as in the "
            "authors' code) or any.",
        ),
    ] = "paper",
    shortest: Annotated[
        bool, typer.Option("--shortest", help="Only plans with the fewest actions.")
    ] = False,
    plans: Annotated[
        int,
        typer.Option(
            help="How many plans are listed and drawn.", min=0, max=MOST_PLANS, metavar="K"
        ),
    ] = 10,
    plot: PlotOption = None,
    as_json: JsonOption = False,
) -> None:
    """List the ways in which one arm ties a rope: sequences of C, R1 and R2.

    Exit status 1 if there is none. Example: knotopt topology 3_1 --plot plans.png
    """
    from knotopt.flight.leader_plan import laid_plan, leader_faces
    from knotopt.reading.goal import GoalSet, read_goal
    from knotopt.topology.legal import R2Rule
    from knotopt.topology.plan import plan_graph

    check_choice("--goals", goals, GoalSet)
    check_choice("--rule", rule, R2Rule)
    if plot is not None and plans == 0:
        refuse("--plans", "is at least 1 with --plot")
    wanted = read_goal(goal, cut, goals, **asked())
    graph = plan_graph(wanted.states, read_goal(start).states[0], rule, fewest=shortest)
    listed = list(graph.plans(plans))
    flown = _from_start(laid_plan(wanted.states[0]), graph)
    faces = leader_faces(wanted.cable) if wanted.cable is not None else None
    if plot is not None and graph.steps:
        from knotopt.plot.figures import save_figure
        from knotopt.plot.topology import plan_figure

        title = f"{wanted.name}: {len(listed)} of {graph.plan_count} plans"
        save_figure(plan_figure(graph, plans, title), plot)
    if as_json:
        print_json({**_json(wanted, graph, listed, flown, faces), "rule": rule})
    else:
        _show(wanted, graph, listed, flown, faces)
        if plot is not None and graph.steps:
            print_written(plot)
    if not graph.steps:
        raise typer.Exit(1)


def _from_start(flown: Plan, graph: PlanGraph) -> Plan | None:
    """What is left of the flight at the graph's start; None if it does not pass there."""
    from knotopt.topology.plan import Plan

    if graph.start not in flown.states:
        return None
    begun = flown.states.index(graph.start)
    return Plan(flown.actions[begun:], flown.states[begun:])


def _show(
    goal: Goal, graph: PlanGraph, listed: list[Plan], flown: Plan | None, faces: LeaderFaces | None
) -> None:
    state = goal.states[0]
    canonical = state.canonical()
    where = f", cut {goal.cable.cut}" if goal.cable is not None else ""
    facts: list[tuple[str, Any]] = [
        ("goal", f"{goal.name} ({goal.source}){where}"),
        *([("read as", reading_in_words(goal.form, goal.notes))] if goal.notes else []),
        ("state", state),
        ("crossings", state.crossings),
        ("canonical", "this state" if canonical == state else canonical),
    ]
    facts += [("or", image) for image in goal.states[1:]]
    if graph.start.crossings:
        facts.append(("from", graph.start))
    facts += [("plans", _plans_words(graph)), ("flown", _flown_words(graph, flown))]
    if faces is not None:
        facts.append(("LCF", _lcf_words(faces)))
    print_facts(facts)
    rows: list[tuple[Any, ...]] = [(number, *_row(plan)) for number, plan in enumerate(listed, 1)]
    if flown is not None:
        rows.append(("flown", *_row(flown)))
    if rows:
        print_table(("plan", "length", "actions"), rows)
    if len(listed) < graph.plan_count:
        print(f"{len(listed)} of {graph.plan_count} plans are listed; --plans lists more.")


def _row(plan: Plan) -> tuple[int, str]:
    return len(plan), " ".join(map(str, plan.actions))


def _plans_words(graph: PlanGraph) -> str:
    if not graph.steps:
        return "none: the start is on no way to the goal"
    counts = [f"{count} of {length} actions" for length, count in graph.counts.items()]
    total = f"{graph.plan_count}: {', '.join(counts)}" if len(counts) > 1 else counts[0]
    return f"{total}; {len(graph.states)} states, {graph.action_count} edges"


def _flown_words(graph: PlanGraph, flown: Plan | None) -> str:
    if flown is None:
        return "the flight does not pass the start"
    fewest = min(graph.counts)
    if len(flown) == fewest:
        return f"{len(flown)} actions, no plan has fewer"
    return f"{len(flown)} actions; with R2, {fewest} do"


def _lcf_words(faces: LeaderFaces) -> str:
    active, inner = faces.is_active, faces.inner
    return (
        f"{active.sum()} of {len(active)} regions active, {(active & faces.is_entered).sum()} "
        f"entered by the leader; inner faces it "
        f"enters: {inner.sum()}, in active regions: {(inner & faces.kept_open).sum()}"
    )


def _json(
    goal: Goal, graph: PlanGraph, listed: list[Plan], flown: Plan | None, faces: LeaderFaces | None
) -> dict[str, Any]:
    state = goal.states[0]
    number = {each: index for index, each in enumerate(graph.states)}
    return {
        "goal": goal.name,
        "source": goal.source,
        "form": goal.form,
        "notes": list(goal.notes),
        "cut": None if goal.cable is None else str(goal.cable.cut),
        "state": str(state),
        "matrix": state.matrix.tolist(),
        "crossings": state.crossings,
        "canonical": str(state.canonical()),
        "is_canonical": state == state.canonical(),
        "goals": [str(each) for each in goal.states],
        "from": str(graph.start),
        "plan_count": graph.plan_count,
        "plans_by_length": {str(length): count for length, count in graph.counts.items()},
        "plans": [
            {
                "actions": list(map(str, plan.actions)),
                "states": [number[each] for each in plan.states],
            }
            for plan in listed
        ],
        "flown": None
        if flown is None
        else {
            "actions": [str(action) for action in flown.actions],
            "states": [str(each) for each in flown.states],
            "is_shortest": len(flown) == min(graph.counts),
        },
        "states": [
            {
                "state": str(each),
                "crossings": each.crossings,
                "depth": graph.depth[each],
                "goal": each in graph.goals,
            }
            for each in graph.states
        ],
        "steps": [
            [number[each], str(action), number[after]]
            for each, steps in graph.steps.items()
            for action, after in steps
        ],
        "lcf": None if faces is None else _lcf_json(faces),
    }


def _lcf_json(faces: LeaderFaces) -> dict[str, Any]:
    return {
        "actions": [
            {"inner": bool(inner), "in_active_region": bool(kept)}
            for inner, kept in zip(faces.inner, faces.kept_open, strict=True)
        ],
        "regions": [
            {
                "region": region.name,
                "active": region.is_active,
                "closed_by": int(closing),
                "entered_by": [int(action) + 1 for action in inside.nonzero()[0]],
            }
            for region, closing, inside in zip(
                faces.regions, faces.closing, faces.inside, strict=True
            )
        ],
    }
