"""Formulation `loops`, compiled from a cable: a support on every loop.

A straight span cannot cross itself: a crossing whose two visits t1 < t2 lie on one span does not
exist once the cable is laid. So each needs a support at a turning point v, t1 < t(v) < t2. A set
that has them lays the grid's own diagram, and no smaller one does; of other diagrams of the knot,
and of flights that tie it without laying this one, it says nothing.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np

from formulations.loops import LoopsProgram, disjoint
from formulations.team import Stretch, Team
from knotopt.cable.cable import Cable
from knotopt.errors import CertificateError
from knotopt.supports.formulation import Claim, Formulation
from knotopt.supports.proofs import by_counting, by_refutation
from knotopt.supports.regions import Regions
from knotopt.supports.threading import Threading


def compile_loops(
    regions: Regions,
    mode: Threading = Threading.TURNING_POINT,
    team: Team | None = None,
    start: tuple[int, ...] | None = None,
) -> LoopsProgram:
    """The program `loops` of a cable.

    Parameters
    ----------
    regions : Regions
    mode : Threading
        Of no account here but for what the team asks.
    team : Team, optional
    start : tuple of int, optional
        Turning points (1-based) of a first guess.

    Examples
    --------
    >>> from knotopt.diagram.families import torus_knot
    >>> program = compile_loops(Regions(Cable(torus_knot(2, 3), "L+")))
    >>> [tuple(stretch) for stretch in program.team.stretches]
    [(3, 5, 'loop c1'), (4, 8, 'loop c2'), (5, 9, 'loop c3')]
    """
    cable = regions.cable
    return LoopsProgram(
        name=f"loops, {mode}, cut {cable.cut}",
        points=len(cable.path),
        team=replace(team or Team(), stretches=loop_stretches(cable)),
        start=start,
    )


def loop_stretches(cable: Cable) -> tuple[Stretch, ...]:
    """Of each crossing, in order, the turning points (1-based) between its two visits."""
    crossings = cable.crossings  # whose times are no turning point's
    first = np.searchsorted(cable.times, crossings.first) + 1
    last = np.searchsorted(cable.times, crossings.second)
    ends = zip(first.tolist(), last.tolist(), strict=True)
    return tuple(Stretch(*each, f"loop c{number}") for number, each in enumerate(ends, 1))


def disjoint_loops(cable: Cable) -> tuple[int, ...]:
    """As many loops as possible of which no two have a turning point in common.

    Each of them needs a support of its own, and so many supports suffice for all loops.

    Returns
    -------
    tuple of int
        Indices into `cable.crossings`, in the order in which the loops close.

    Examples
    --------
    >>> from knotopt.diagram.families import torus_knot
    >>> disjoint_loops(Cable(torus_knot(2, 3), "L+"))
    (0,)
    """
    return tuple(disjoint([(first, last) for first, last, _ in loop_stretches(cable)]))


def by_disjoint_loops(claim: Claim[LoopsProgram]) -> dict[str, Any]:
    """Loops, by their crossings' [column, row]: no two with a turning point in common, so that each
    needs a support of its own.

    Raises
    ------
    CertificateError
        There are fewer of them than the claim needs.
    """
    found = disjoint_loops(claim.cable)
    if len(found) < claim.robots - 2:
        raise CertificateError(f"no more than {len(found)} loops share no turning point")
    return {"loops": claim.cable.crossings.cell[list(found)].tolist()}


LOOPS = Formulation(
    name="loops",
    words="a support on every loop",
    compile=compile_loops,
    threading=(Threading.TURNING_POINT, Threading.OVER_UNDER),
    proofs={
        "disjoint loops": by_disjoint_loops,
        "refutation": by_refutation,
        "count": by_counting,
    },
    is_taut=True,
    has_openness=False,
    adjective="piercing",
    meaning="the fewest robots that lay this diagram with straight spans, the leader following "
    "the grid; no bound for flights of the knot",
)
