"""Time to read the topological state off a polyline, by its number of points and crossings."""

from __future__ import annotations

import time
from collections.abc import Iterable
from statistics import median

import numpy as np

from benchmarks.registry import Benchmark, Case, Result, register
from knotopt.arrays import FloatArray
from knotopt.topology.extract import extract_state
from knotopt.verify.crossings import curve_crossings

REPEATS = 50
SEEDS = range(5)


def cases(smoke: bool) -> Iterable[Case]:
    """Straight ropes, smooth curves and random points in a box, 16 to 1,024 points."""
    for points in (16, 64) if smoke else (16, 32, 64, 128, 256, 512, 1024):
        yield {"curve": "straight", "points": points, "seed": None}
        for seed in SEEDS[:1] if smoke else SEEDS:
            yield {"curve": "smooth", "points": points, "seed": seed}
            if points <= 128:
                yield {"curve": "random", "points": points, "seed": seed}


def measure(case: Case) -> Result:
    """Crossings, or why there is no state, and the time of one extraction [s].

    Random points have about a quarter of all pairs of segments crossing, far more than a rope.
    """
    points = curve_of(case)
    seconds = []
    for _ in range(REPEATS):
        start = time.perf_counter()
        found = extract_state(points)
        seconds.append(time.perf_counter() - start)
    if found.state is not None and found.state.crossings != len(curve_crossings(points)):
        raise AssertionError(f"the verifier finds other crossings on {case}")
    return {
        "crossings": None if found.state is None else found.state.crossings,
        "ambiguous": [str(ambiguity) for ambiguity in found.ambiguous],
        "seconds": round(min(seconds), 6),
        "seconds_median": round(median(seconds), 6),
        "repeats": REPEATS,
    }


def curve_of(case: Case) -> FloatArray:
    """The polyline of a kind, number of points and seed."""
    count = case["points"]
    t = np.linspace(0, 1, count)[:, None]
    if case["curve"] == "straight":
        return np.hstack((t, 2 * t, 0 * t))
    rng = np.random.default_rng(case["seed"])
    if case["curve"] == "random":
        return rng.uniform(size=(count, 3))
    curve = np.zeros((count, 3))
    for k in range(1, 13):
        curve += rng.normal(size=3) / k * np.cos(np.pi * k * t + rng.uniform(0, 2 * np.pi, 3))
    return curve


register(
    Benchmark(
        "topology_extraction",
        "a rope's state from a polyline of 16 to 1,024 points",
        cases,
        measure,
    )
)
