"""`python -m benchmarks.best_grids`: search the catalogue's best grids anew, and write them.

Ctrl-C keeps what is there; a later call goes on.
"""

from __future__ import annotations

import json
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import Annotated, Any

import typer
from rich.progress import track

import knotopt.catalogue
from knotopt.cable.cut import outer_cuts
from knotopt.catalogue.knots import PrimeKnot, shipped_knots
from knotopt.files import resumable_lines
from knotopt.search.found import FoundGrid
from knotopt.search.run import run
from knotopt.search.search import GridSearch
from knotopt.supports.requirements import Requirements
from knotopt.supports.search import best_supports

TEAMS = (3, 4)
LEAST_RUNS = 8
"""Runs that are made in any case, for a smaller grid or one that is laid from an outer cut."""

SEED = 0
"""Of every search."""


def main(
    out: Annotated[Path, typer.Option(help="Where they are written.")] = Path(
        knotopt.catalogue.__path__[0], "best_grids.json"
    ),
    most_runs: Annotated[int, typer.Option(help="Of one knot.")] = 60,
) -> None:
    """Search the grids for three and for four robots with the fewest crossings."""
    with resumable_lines(out, json.dumps(["best grids", most_runs]), _listed) as lines:
        done = {json.loads(line)["knot"] for line in lines.done}
        left = [knot for name, knot in shipped_knots().items() if name not in done]
        for knot in track(left):
            lines.write("\n".join(json.dumps(entry) for entry in entries_of(knot, most_runs)))


def entries_of(knot: PrimeKnot, most_runs: int) -> Iterator[dict[str, Any]]:
    """For each team the best grid found, as the catalogue's file has it."""
    search = GridSearch(knot.diagram, SEED)
    while not _is_done(search, knot.crossing_number) and len(search.runs) < most_runs:
        search = replace(search, runs=(*search.runs, run(knot.diagram, len(search.runs), SEED)))
    for robots in TEAMS:
        best = _best(search, robots)
        yield {
            "knot": knot.name,
            "kind": f"best{robots}",
            "robots": best.robots,
            "crossings": best.crossings,
            "seed": SEED,
            "runs": len(search.runs),
            "minus": best.diagram.minus,
            "plus": best.diagram.plus,
        }


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
