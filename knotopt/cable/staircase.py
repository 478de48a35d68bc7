"""Staircases: diagonal runs of crossings, along which one strand can become a straight span.

Paper, section IV.A and Fig. 7: in the baseline every corner of the two interlaced staircases holds
a robot; the reduced cable is a straight span that one strand winds around.
"""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass
from itertools import pairwise
from typing import Literal

from knotopt.cable.cable import Cable


@dataclass(frozen=True)
class Staircase:
    """A maximal diagonal run of crossings.

    Attributes
    ----------
    crossings : tuple of int
        Indices into `cable.crossings`, by increasing column; neighbours are one column and one
        row apart.
    direction : "rising" or "falling"
    is_twist : bool
        Whether the run is (part of) a twist region: consecutive crossings are joined by two arcs
        of the cable, so two strands wind around each other, as in Fig. 7.
    """

    crossings: tuple[int, ...]
    direction: Literal["rising", "falling"]
    is_twist: bool

    def __len__(self) -> int:
        return len(self.crossings)


def find_staircases(cable: Cable, min_length: int = 3) -> tuple[Staircase, ...]:
    """Every maximal diagonal run of at least `min_length` crossings, longest first.

    Examples
    --------
    >>> from knotopt.diagram.families import torus_knot
    >>> find_staircases(Cable(torus_knot(2, 5), "L+"))
    (Staircase(crossings=(4, 3, 2, 1), direction='falling', is_twist=True),)
    """
    at = {(c.column, c.row): i for i, c in enumerate(cable.crossings)}
    _, index, _ = cable.visits
    joined = Counter(map(frozenset, pairwise(index.tolist())))
    found = []
    directions: dict[int, Literal["rising", "falling"]] = {1: "rising", -1: "falling"}
    for step, direction in directions.items():
        for column, row in sorted(at):
            if (column - 1, row - step) in at:
                continue
            run = [at[column, row]]
            while (column + len(run), row + step * len(run)) in at:
                run.append(at[column + len(run), row + step * len(run)])
            if len(run) >= min_length:
                twist = all(joined[frozenset(pair)] >= 2 for pair in pairwise(run))
                found.append(Staircase(tuple(run), direction, twist))
    return tuple(sorted(found, key=lambda staircase: -len(staircase)))
