"""Names of knots from grid diagrams that were moved about, and where they are not found."""

from __future__ import annotations

import random
import time
from collections.abc import Iterable

from benchmarks.registry import Benchmark, Case, Result, register
from knotopt.catalogue.knotinfo import knotinfo_knots
from knotopt.catalogue.knots import shipped_knots
from knotopt.diagram.simplify import stirred
from knotopt.identify.identify import identify

EVERY = 60  # of the knots above 10 crossings, one in so many
TIMES = 2  # that a diagram is moved about


def cases(smoke: bool) -> Iterable[Case]:
    """All knots of the catalogue and some of 11 to 13 crossings, or their mirror images."""
    names = [*shipped_knots()]
    names = names[:2] if smoke else names + [*knotinfo_knots()][len(names) :: EVERY]
    return ({"knot": name, "mirrored": bool(k % 2)} for k, name in enumerate(names))


def measure(case: Case) -> Result:
    """What the diagram is taken for, and the processor's time [s]."""
    knot = knotinfo_knots()[case["knot"]]
    generator = random.Random(case["knot"])
    diagram = knot.diagram.mirrored if case["mirrored"] else knot.diagram
    for _ in range(TIMES):
        diagram = stirred(diagram, generator)
    start = time.process_time()
    found = identify(diagram)
    seconds = round(time.process_time() - start, 4)
    is_other = case["mirrored"] and not knot.is_amphicheiral
    name = f"m{knot.name}" if is_other else knot.name
    return {
        "named": found.name == name,
        "wrong": name not in found.candidates,
        "candidates": list(found.candidates),
        "by": list(found.by),
        "proven": found.proven,
        "seconds": seconds,
    }


register(
    Benchmark(
        "identified",
        "names of knots from diagrams that were moved about, by invariants",
        cases,
        measure,
    )
)
