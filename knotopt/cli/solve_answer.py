"""What `knotopt solve KNOT` says where no formulation is named: needed, to lay, flown, safe."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

from knotopt.cli.identify import candidates_in_words
from knotopt.cli.printing import print_facts, print_json, print_note, print_written
from knotopt.cli.progress import status_line
from knotopt.cli.reading import read
from knotopt.cli.sizes import check_size

if TYPE_CHECKING:
    from collections.abc import Sequence

    from formulations.solution import Limits
    from knotopt.catalogue.flown import FlownTeam
    from knotopt.sandwich.answer import Answer
    from knotopt.supports.minimal import MinimalSupports


def answer_knot(
    knot: str,
    *,
    budget: str | None,
    seed: int,
    solver: str,
    limits: Limits,
    plot: Path | None,
    as_json: bool,
) -> None:
    """Print the answer, and draw the loops of the diagram asked about."""
    from knotopt.sandwich.answer import BUDGET, answer
    from knotopt.search.budget import Budget

    spent = BUDGET if budget is None else Budget.parse(budget)
    named = read(knot)
    check_size(named.diagram.size, "solve")
    with status_line("searching diagrams"):
        found = answer(named, budget=spent, seed=seed, solver=solver, limits=limits)
    written = []
    if plot is not None:
        from knotopt.plot.figures import save_figure, smallest_figure

        laid = found.laid
        title = f"{named.name}, cut {laid.cable.cut}: {laid.robots} robots hold every loop"
        save_figure(smallest_figure(laid, title), plot)
        written.append(plot)
    if as_json:
        print_json(_json(found))
        return
    _show(found)
    print_written(*written)


def _json(found: Answer) -> dict[str, Any]:
    """What `--json` says; each set of supports is on the grid that stands beside it."""
    needed, flown = found.known.needed, found.known.flown
    return {
        "knot": found.named.name,
        "identified": list(found.identified.candidates),
        "up_to_mirror_image": found.identified.up_to_mirror,
        "settled": found.is_settled,
        "needed": {
            "robots": needed.robots,
            "why": needed.why,
            "standing": str(needed.standing),
            "assumptions": list(needed.assumptions),
            "against": needed.against,
        },
        "diagram": {**_set_json(found.laid), "loops": _loops(found.laid)},
        "flown": None
        if flown is None
        else {
            "robots": flown.robots,
            "cut": flown.cut,
            "supports": list(flown.supports),
            "grid": [list(mark) for mark in flown.marks],
            "step": flown.step,
            "tied": flown.tied,
            "flights": flown.flights,
            "noise": flown.noise,
        },
        "safe": _safe_json(found),
        "lcf": {"robots": found.lcf.robots, "cut": str(found.lcf.cable.cut)},
        "every_corner": found.baseline,
    }


def _safe_json(found: Answer) -> dict[str, Any] | None:
    if found.safe is None or found.safe_search is None:
        return None
    return {
        **_set_json(found.safe),
        "openness": float(found.safe.requirements.openness),
        "grids_looked_at": found.safe_search.grids.looked,
        "grids_solved": found.safe_search.walk.solved,
        "seed": found.seed,
    }


def _set_json(result: MinimalSupports) -> dict[str, Any]:
    return {
        "robots": result.robots,
        "proven": result.is_proven,
        "cut": str(result.cable.cut),
        "supports": list(result.supports),
        "grid": [list(mark) for mark in result.cable.diagram.marks],
    }


def _loops(result: MinimalSupports) -> list[list[int]]:
    """The [column, row] of the crossings whose loops have no turning point in common."""
    places: list[list[int]] = result.cable.crossings.cell[list(result.disjoint_loops)].tolist()
    return places


def _show(found: Answer) -> None:
    """Print the answer, its numbers below each other."""
    print(f"{_heading(found)} ({found.named.source}): {_in_a_line(found)}\n")
    needed, team = found.known.needed, found.known.flown
    if found.is_unknot:
        return
    print_facts(
        [
            ("needed", _counted(needed.robots, f"{needed.why}; {needed.standing}")),
            ("this diagram", _counted(found.laid.robots, _laid(found))),
            ("flown", _counted(team.robots if team else None, _flown(team, found.identified.name))),
            ("safe", _counted(found.safe.robots if found.safe else None, _safe(found))),
            ("LCF", _counted(found.lcf.robots, f"the heuristic, cut {found.lcf.cable.cut}")),
            ("every corner", _counted(found.baseline, "a robot at every turning point")),
        ]
    )
    if needed.assumptions:
        print_note("assumed: " + "; ".join(needed.assumptions))
    if needed.against:
        print_note("outside the assumptions: " + needed.against)


def _heading(found: Answer) -> str:
    """What was asked for, and which knots it may be: `T(2,3) = 3_1`, `3_1 or its mirror image`."""
    from knotopt.reading.identification import name_given

    name, names = found.named.name, candidates_in_words(found.identified)
    if name in found.identified.candidates:
        return name_given(found.named, found.identified) or names
    if not names and found.named.source == "torus knot":
        return name
    return f"{name} = {names or 'not named by the tables'}"


def _in_a_line(found: Answer) -> str:
    needed = found.known.needed.robots
    if found.is_unknot:
        return "2 robots: nothing to hold open"
    if found.is_settled:
        return f"{needed} robots are needed, and {needed} fly: settled"
    if found.known.flown is not None:
        return f"{needed} robots are needed, {found.known.flown.robots} fly"
    return f"{needed} robots are needed; no team that flies is known"


def _counted(robots: int | None, words: str) -> str:
    return f"{'-' if robots is None else robots:>2}  {words}"


def _laid(found: Answer) -> str:
    loops = _named_places(_loops(found.laid))
    if not loops:
        return "it has no loop to hold"
    of = "the loop at" if len(_loops(found.laid)) == 1 else "loops without a common corner at"
    return (
        f"hold every loop of it, cut {found.laid.cable.cut}; no fewer: {of} {loops}; "
        "no bound for flights"
    )


def _flown(team: FlownTeam | None, name: str | None) -> str:
    if team is None:
        return "knotopt knows of no team; `knotopt fly --sim` tries one"
    return (
        f"tie it or its mirror image in {team.tied} of {team.flights} simulated flights with noise "
        f"of {1000 * team.noise:g} mm: `knotopt fly {name} --supports flown --sim`"
    )


def _safe(found: Answer) -> str:
    if found.safe is None or found.safe_search is None:
        return "not looked for: the diagram is too large for span"
    size, openness = found.safe.cable.diagram.size, float(found.safe.requirements.openness)
    return (
        f"keep every loop and threaded region open (span with loops, r {openness:g}), "
        f"best of {found.safe_search.walk.solved} grids solved, {size} x {size}"
    )


def _named_places(places: Sequence[Sequence[int]]) -> str:
    return " ".join(f"[{column},{row}]" for column, row in places)
