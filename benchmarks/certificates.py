"""Certificates of the smallest sets (`opening`, all crossing-free cuts) of 249 knots."""

from __future__ import annotations

import time

from benchmarks.registry import Benchmark, Case, Result, each_knot, register
from knotopt.catalogue.knots import shipped_knots
from knotopt.supports.certificate import prove
from knotopt.verify.certificate import check_certificate


def measure(case: Case) -> Result:
    """Time to prove and to check [s], size [bytes], and what was proven."""
    knot = shipped_knots()[case["knot"]]
    began = time.perf_counter()
    certificate = prove(knot.name, knot.diagram)
    proven = time.perf_counter()
    verdict = check_certificate(certificate)
    checked = time.perf_counter()
    return {
        "robots": verdict.robots,
        "cuts": verdict.cuts,
        "every_cut": verdict.every_cut,
        "bytes": len(certificate),
        "prove_seconds": round(proven - began, 4),
        "check_seconds": round(checked - proven, 4),
    }


register(Benchmark("certificates", "prove and check the minima of 249 knots", each_knot, measure))
