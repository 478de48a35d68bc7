"""`python -m benchmarks.best_grids laid|safe`: search the catalogue's stored grids anew.

A call that is interrupted is gone on with by the next one. What is found depends on the seed and on
the runs and grids solved, which are stored with it; for safe sets these depend on the machine.
"""

from __future__ import annotations

import json
import signal
from collections.abc import Iterator
from dataclasses import replace
from enum import StrEnum
from pathlib import Path
from typing import Annotated, Any

import typer
from rich.progress import track

import knotopt.catalogue
from knotopt.cable.cut import outer_cuts
from knotopt.catalogue.knots import PrimeKnot, shipped_knots
from knotopt.files import resumable_lines
from knotopt.search.budget import Budget
from knotopt.search.found import FoundGrid
from knotopt.search.run import counted, run
from knotopt.search.search import GridSearch
from knotopt.supports.diagram_search import Walk, find_diagram
from knotopt.supports.requirements import Requirements
from knotopt.supports.search import best_supports

TEAMS = (3, 4)
LEAST_RUNS = 8
"""Runs that are made in any case, for a smaller grid or one that is laid from an outer cut."""

SECONDS = {"0.5": 0.6, "0.25": 0.2}
"""By openness r, how long a safe set is searched for, for each crossing of the knot."""

SEED = 0
"""Of every search."""

FOLDER = Path(knotopt.catalogue.__path__[0])


class Kind(StrEnum):
    """Grids that few robots lay, or that have small safe sets."""

    LAID = "laid"
    SAFE = "safe"


def main(
    kind: Kind,
    out: Annotated[Path, typer.Option(help="Folder in which they are written.")] = FOLDER,
    most_runs: Annotated[int, typer.Option(help="Of one knot, for laid.")] = 60,
) -> None:
    """Search the best grids of all knots of the catalogue."""
    signal.signal(signal.SIGINT, signal.SIG_DFL)  # a search would end early, and count as done
    header = json.dumps([kind, most_runs])
    with resumable_lines(out / f"{kind}_grids.json", header, _listed) as lines:
        done = {json.loads(line)["knot"] for line in lines.done}
        left = [knot for name, knot in shipped_knots().items() if name not in done]
        for knot in track(left):
            found = laid_grids(knot, most_runs) if kind is Kind.LAID else safe_grids(knot)
            lines.write("\n".join(map(json.dumps, found)))


def laid_grids(knot: PrimeKnot, most_runs: int) -> Iterator[dict[str, Any]]:
    """For at most three and at most four robots the grid with the fewest crossings."""
    search = GridSearch(knot.diagram, SEED)
    while not _is_done(search, knot.crossing_number) and len(search.runs) < most_runs:
        search = replace(search, runs=(*search.runs, run(knot.diagram, len(search.runs), SEED)))
    for robots in TEAMS:
        best = _best(search, robots)
        made = {"seed": SEED, "runs": len(search.runs)}
        yield _entry(knot, f"best{robots}", best.robots, best, made)


def safe_grids(knot: PrimeKnot) -> Iterator[dict[str, Any]]:
    """For each openness the grid with the smallest safe set: `span` with loops."""
    known: tuple[GridSearch, Walk | None] | None = None
    for openness, seconds in SECONDS.items():
        asked = Requirements("span", openness)
        budget = Budget(seconds=seconds * knot.crossing_number)
        found = find_diagram(knot.diagram, asked, budget, SEED, known=known)
        best, walk = found.best.best, found.walk
        made = {"seed": SEED, "runs": len(found.grids.runs), "solved": walk.solved}
        grid = counted(best.cable.diagram)
        yield _entry(knot, f"safe{openness}", best.robots, grid, made)
        # A set that is open at the larger r is so at the smaller one: go on from its grid.
        known = found.grids, Walk(walk.best, best.robots, walk.best, best.robots, started=99)


def _entry(
    knot: PrimeKnot, name: str, robots: int, grid: FoundGrid, made: dict[str, int]
) -> dict[str, Any]:
    """A line of the catalogue's file."""
    rows = {"minus": grid.diagram.minus, "plus": grid.diagram.plus}
    return {"knot": knot.name, "name": name, "robots": robots} | made | rows


def _is_done(search: GridSearch, crossing_number: int) -> bool:
    """Whether so few robots as any team has lay a diagram with as few crossings as there can be."""
    reached = any(
        found.robots <= min(TEAMS) and found.crossings == crossing_number for found in search.found
    )
    return reached and len(search.runs) >= LEAST_RUNS


def _best(search: GridSearch, robots: int) -> FoundGrid:
    """The best for at most so many robots; of equal ones the first laid from an outer cut."""
    found = [each for each in search.found if each.robots <= robots]
    least = min(map(_order, found))
    equal = [each for each in found if _order(each) == least]
    return next((each for each in equal if _outer_robots(each) == each.robots), equal[0])


def _order(found: FoundGrid) -> tuple[int, int, int]:
    return found.crossings, found.size, found.robots


def _outer_robots(found: FoundGrid) -> int:
    cuts = outer_cuts(found.diagram)
    return best_supports(found.diagram, Requirements("loops"), cuts=cuts).best.robots


def _listed(lines: list[str]) -> str:
    return "[\n" + ",\n".join(lines) + "\n]\n"


if __name__ == "__main__":
    typer.run(main)
