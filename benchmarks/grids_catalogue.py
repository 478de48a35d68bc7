"""Grid diagrams of all knots of KnotInfo, from its PD codes and from its braid words."""

from __future__ import annotations

import json
import time
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from functools import cache

from benchmarks.registry import Benchmark, Case, Result, register
from knotopt.cable.alexander import alexander_polynomial
from knotopt.cable.cable import Cable
from knotopt.catalogue.knotinfo import knotinfo_knots
from knotopt.catalogue.knots import PrimeKnot
from knotopt.diagram.grid import GridDiagram
from knotopt.diagram.simplify import simplify
from knotopt.planar.braid_grid import braid_grid
from knotopt.planar.from_grid import planar_diagram
from knotopt.planar.planar_diagram import PlanarDiagram
from knotopt.planar.signature import signature
from knotopt.planar.small_grid import small_grid

AT_A_TIME = 100  # knots of one case


@dataclass(frozen=True)
class Coded:
    """A knot with the codes that grids are made from."""

    knot: PrimeKnot
    planar: PlanarDiagram
    word: tuple[int, ...]


def cases(smoke: bool) -> Iterable[Case]:
    """Knots of one crossing number, alternating or not, up to a hundred in KnotInfo's order."""
    if smoke:
        return [{"crossings": 8, "alternating": False, "first": 1}]
    return [
        {"crossings": crossings, "alternating": alternating, "first": first}
        for (crossings, alternating), knots in coded_knots().items()
        for first in range(1, len(knots) + 1, AT_A_TIME)
    ]


def measure(case: Case) -> Result:
    """Grids above the arc index, by name with their sizes, and the processor's time a grid [ms].

    Each grid's Alexander polynomial and signature have to be KnotInfo's; of a knot that is not its
    own mirror image the signature mostly tells which it is.
    """
    knots = coded_knots()[case["crossings"], case["alternating"]]
    some = knots[case["first"] - 1 :][:AT_A_TIME]
    return {
        "knots": len(some),
        "planar": _drawn(some, lambda coded: small_grid(coded.planar)),
        "braid": _drawn(some, lambda coded: simplify(braid_grid(coded.word))),
    }


def _drawn(knots: Iterable[Coded], draw: Callable[[Coded], GridDiagram]) -> Result:
    larger: dict[str, int] = {}
    milliseconds = []
    for coded in knots:
        start = time.process_time()
        grid = draw(coded)
        milliseconds.append(round(1e3 * (time.process_time() - start), 2))
        knot = coded.knot
        found = alexander_polynomial(Cable(grid, "L+")), signature(planar_diagram(grid))
        if found != (knot.alexander, knot.signature):
            raise AssertionError(f"the grid of {knot.name} is of another knot")
        if grid.size > knot.arc_index:
            larger[knot.name] = grid.size
    return {"larger": larger, "milliseconds": milliseconds}


@cache
def coded_knots() -> dict[tuple[int, bool], list[Coded]]:
    """All prime knots of KnotInfo, by crossing number and whether they alternate."""
    from database_knotinfo import link_list

    groups: dict[tuple[int, bool], list[Coded]] = {}
    knots = knotinfo_knots()
    for row in link_list():
        knot = knots.get(row["name"])
        if knot is None or not knot.crossing_number:  # the head of the table, and the unknot
            continue
        edges = json.loads(row["pd_notation"])
        planar = PlanarDiagram(tuple((a - 1, b - 1, c - 1, d - 1) for a, b, c, d in edges))
        word = json.loads(row["braid_notation"])
        if isinstance(word[0], list):  # one with the fewest strands, one with the fewest letters
            word = min(word, key=len)
        key = knot.crossing_number, knot.alternating
        groups.setdefault(key, []).append(Coded(knot, planar, tuple(word)))
    return groups


register(
    Benchmark(
        "grids_catalogue",
        "grid diagrams of 12,965 knots from PD codes and braid words",
        cases,
        measure,
    )
)
