"""What the diagram says of sets of supports, beside what became of them in stored flights.

Nothing is flown here. A set without a plan counts as one that did not tie.
"""

from __future__ import annotations

from collections.abc import Iterable
from functools import cache
from itertools import islice

from benchmarks.registry import Benchmark, Case, Result, register
from benchmarks.results import RESULTS, load
from knotopt.cable.cable import Cable
from knotopt.laid.heuristics import monotone_windings, self_crossings_over
from knotopt.laid.laid import LaidTest
from knotopt.reading.knot import read_knot
from knotopt.supports.loops import loop_stretches

SOURCES = ("physics_subsets", "physics", "physics_optimal", "physics_knots", "physics_fewest")


def cases(smoke: bool) -> Iterable[Case]:
    """Every set that was flown, or for which no plan was found, and whether it tied undisturbed."""
    there = [source for source in SOURCES if (RESULTS / f"{source}.jsonl").exists()]
    for source in there[:1] if smoke else there:
        for number, row in enumerate(islice(load(source)[1], 3 if smoke else None)):
            if "supports" in row and "cut" in row:
                about = {"source": source, "number": number, "row": row["row"], "cut": row["cut"]}
                yield {**about, "supports": row["supports"], "tied": row.get("tied", False)}


def measure(case: Case) -> Result:
    """Whether each test calls the set one that ties."""
    test, supports = _test(case["row"], case["cut"]), tuple(case["supports"])
    stretches = loop_stretches(test.cable)
    return {
        "loops": all(any(a <= k <= b for k in supports) for a, b, _ in stretches),
        "laid": test.laid(supports).is_knot,
        "A": self_crossings_over(test, supports),
        "C": monotone_windings(test, supports),
    }


@cache
def _test(row: str, cut: str) -> LaidTest:
    return LaidTest(Cable(read_knot(row).diagram, cut))


register(
    Benchmark(
        "heuristics_flown",
        "tests laid, A and C, and loops, of sets whose flights are stored",
        cases,
        measure,
    )
)
