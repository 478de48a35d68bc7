"""Section: what the numbers assume, and what they do not say."""

from __future__ import annotations

import numpy as np

from knotopt.atlas.report.results import Results
from knotopt.document.model import Section


def assumptions_section(results: Results) -> Section:
    """The definitions behind the words, and how sure the numbers are."""
    r = results.manifest.settings.openness
    items = [
        "Robots count the two lifting robots at the cable's ends. The baseline has one at each of "
        "the 2N turning points.",
        f"Open, with r = {r} grid steps: through each region that a later strand threads, the "
        "polygon of the robots on its boundary must leave an opening. No edge of the polygon may "
        "come closer than r to a turning point where the region is threaded, or shut it out; a "
        "loop needs 2 robots, a pocket 1. Only turning points can carry robots.",
        "`opening` is the smallest number of robots of such a set. It assumes that crossings stay "
        "where the grid drew them; a real cable is straight between two robots, and its crossings "
        "move.",
        "Threading, turning-point: every later turning point inside a region threads it (the "
        "paper's reading, and what is meant where nothing else is said). Over-under: only where "
        "the strand is over the boundary on one side and under it on the other.",
        _span(results),
        "`loops` is the smallest number of robots with a support on every loop of the cable: what "
        "runs between a crossing's two visits. Where a loop has none, both visits lie on one "
        "straight span, and the crossing is not there once the cable is laid. So it is the fewest "
        "robots that lay this diagram with straight spans, and no bound for flights of the knot. "
        "`safe` is `span` with a support on every loop, too.",
        "LCF is the Loop Consistency Filter, a heuristic; layered is its variant that also drops "
        "points inside other regions. Neither promises an open set or a smallest one. The paper "
        "leaves details of LCF open: this is one reading of it.",
        "A smallest number is of one grid diagram, and of the eight cuts at its outermost "
        "segments; best cut means the best of these. It is no invariant of the knot: another "
        "diagram of the same knot can need fewer robots, or more.",
        "None of this says that a set flies. Robots are points on a grid; their downwash, the "
        "cable's sag and the leader's way are the matter of flights.",
        _proofs(results),
    ]
    return Section("What the numbers assume", (tuple(items),))


def _span(results: Results) -> str:
    words = (
        "`span` is the smallest number of robots of a taut cable: straight spans between "
        "consecutive robots, whose crossings must still be there (threading over-under). It "
        "assumes straight spans and robots at grid points, and does not see what the cable does "
        "while the leader is between regions. LCF was not made for it."
    )
    settings = results.manifest.settings
    if not settings.span:
        return f"{words} This run was not asked for it."
    if "span_robots" in results.methods:
        return words
    refused = int(np.isnan(results.cuts("span_robots")).sum())
    return f"{words} It is left out here: {refused:,} cuts are too large for it."


def _proofs(results: Results) -> str:
    proven, checked = results.proven, results.cuts("checked")
    looked = int((~np.isnan(checked)).sum())
    words = (
        f"Smallest means proven by the solver, with a bound equal to the number of robots: "
        f"{int(proven.sum()):,} of {proven.size:,} cuts (`opening`, turning-point)."
    )
    if not looked:
        return f"{words} No set of this run was examined by the definitions."
    wrong = int((checked == 0).sum())
    return (
        f"{words} That the sets are open, and LCF's open or not, was examined by independent "
        f"checkers from the definitions on {looked:,} cuts: {wrong:,} contradictions."
    )
