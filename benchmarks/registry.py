"""The registry of benchmarks: each is a frozen spec that names its cases and measures one."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from typing import Any

from knotopt.catalogue.knots import shipped_knots

Case = dict[str, Any]  # what identifies one measurement, as JSON
Result = dict[str, Any]  # what was measured, as JSON


@dataclass(frozen=True)
class Benchmark:
    """One benchmark.

    Attributes
    ----------
    name : str
        Also the name of its file of results.
    about : str
        One line: what is measured and why.
    cases : callable
        `cases(smoke)` gives the cases in order; with `smoke`, a few small ones.
    measure : callable
        Case to result.
    """

    name: str
    about: str
    cases: Callable[[bool], Iterable[Case]]
    measure: Callable[[Case], Result]


BENCHMARKS: dict[str, Benchmark] = {}


def register(benchmark: Benchmark) -> None:
    """Make a benchmark known by its name."""
    if benchmark.name in BENCHMARKS:
        raise ValueError(f"two benchmarks are named {benchmark.name!r}")
    BENCHMARKS[benchmark.name] = benchmark


def each_knot(smoke: bool) -> Iterable[Case]:
    """One case a knot, all 249 or, with `smoke`, the first two."""
    names = list(shipped_knots())
    return ({"knot": name} for name in (names[:2] if smoke else names))
