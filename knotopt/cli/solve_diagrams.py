"""`knotopt solve --diagrams`: other grid diagrams of the knot, and the best of them."""

from __future__ import annotations

import json
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from knotopt.cli.options import check_suffix, refuse, run_header, unless_given
from knotopt.cli.printing import print_table
from knotopt.cli.progress import status_line
from knotopt.errors import OutputError

if TYPE_CHECKING:
    from formulations.solution import Limits
    from knotopt.reading.record import NamedDiagram
    from knotopt.supports.diagram_search import DiagramSearch
    from knotopt.supports.diagram_search_file import Known
    from knotopt.supports.requirements import Requirements

DiagramsOption = Annotated[
    bool,
    typer.Option(
        "--diagrams",
        help="Search other grid diagrams of the knot: the fewest robots that lay one, against "
        "crossings and grid size; then the best for what is asked.",
    ),
]
BudgetOption = Annotated[
    str | None,
    unless_given(
        "2s",
        "With --diagrams: seconds (5s), or a number of grids to look at (2000000), which gives "
        "the same every time.",
        metavar="S|N",
    ),
]


def search_diagrams(
    named: NamedDiagram,
    asked: Requirements,
    budget: str | None,
    out: Path | None,
    *,
    solver: str,
    limits: Limits,
) -> DiagramSearch:
    """Search diagrams; with a file, go on from what it holds, and keep there what is found."""
    from knotopt.search.budget import Budget
    from knotopt.supports.diagram_search import find_diagram

    spent = None if budget is None else Budget.parse(budget)
    check_suffix(out, "searches are", (".json",))
    header = run_header("solve", ["diagrams", repr(asked), limits.seed], [named])
    known = None if out is None else _known(out, header)
    with status_line("searching diagrams"):
        found = find_diagram(
            named.diagram, asked, spent, limits.seed, known=known, solver=solver, limits=limits
        )
    if out is not None:
        _write(out, header, found)
    return found


def check_out(budget: str | None, out: Path | None, *, diagrams: bool, flown: bool) -> None:
    """Options without what they go with are refused."""
    if budget is not None and not diagrams:
        refuse("--budget", "goes with --diagrams")
    if out is not None and not (diagrams or flown):
        refuse("--out", "goes with --verify-physics or --diagrams")


def front_json(found: DiagramSearch) -> dict[str, Any]:
    """What `--json` says of the search beside the best."""
    return {
        "diagrams_tried": found.grids.looked,
        "diagrams_solved": found.walk.solved,
        "front": [
            {
                "robots": each.robots,
                "crossings": each.crossings,
                "size": each.size,
                "grid": [list(mark) for mark in each.diagram.marks],
            }
            for each in found.grids.front
        ],
    }


def show_front(title: str, found: DiagramSearch) -> None:
    """Print the fewest robots that lay a diagram, against crossings and size."""
    print(f"{title}: fewest robots that lay a diagram, its crossings, its grid size")
    print_table(("robots", "crossings", "grid"), (each.counts for each in found.grids.front))
    print()


def diagrams_in_words(found: DiagramSearch) -> str:
    """How the diagram was found."""
    return (
        f"best of {found.walk.solved} solved, from {found.grids.looked} looked at, "
        f"seed {found.grids.seed}; others may do better"
    )


def _known(out: Path, header: str) -> Known | None:
    """What an earlier search left in the file."""
    from knotopt.supports.diagram_search_file import from_json

    if not out.exists():
        return None
    try:
        content = json.loads(out.read_text("utf-8"))
        if content["search"] == header:
            return from_json(content)
    except OSError as error:
        raise OutputError(f"cannot read {out}: {error.strerror}") from error
    except (ValueError, KeyError, TypeError) as error:
        raise OutputError(f"{out} holds no search over diagrams") from error
    raise OutputError(f"{out} holds another search: give another name, or remove the file")


def _write(out: Path, header: str, found: DiagramSearch) -> None:
    from knotopt.files import write_atomically
    from knotopt.supports.diagram_search_file import to_json

    content = {"search": header, **to_json(found.grids, found.walk)}
    write_atomically(out, json.dumps(content) + "\n")
