"""Formulation `opening`: the smallest set of points that keeps polygons open.

Points 1 ... n lie along a path; a polygon's boundary runs along stretches of it. Where the
boundary between two consecutive polygon nodes u and w is cut short, the chord must not close on
anything: if it does, u and w must not both be selected with nothing between them,

    x_u + x_w - 1 <= sum of x_v, v strictly between u and w.

A node that is always there (an apex) counts as 1. As u, w and all between follow each other on the
path, every such row forbids certain pairs of consecutive robots.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np

from formulations.arrays import FloatArray, IntArray
from formulations.instance import Instance, Row
from formulations.team import Team


@dataclass(frozen=True, eq=False)
class OpeningProgram:
    """`opening` for any openness.

    Attributes
    ----------
    name : str
    points : int
        n; the decisions are x_1 ... x_n.
    stretches : int array, shape (S, 4)
        u, first, last, w: the points u and w (0 where the end is an apex) and the points between,
        first ... last (none if first > last).
    margins : float array, shape (S,)
        The row counts if the openness exceeds the margin (both squared).
    origin : callable
        Index of a stretch to what it comes from, in words.
    at_least : tuple of (points, how many, origin)
        Cardinality rows, whatever the openness.
    team : Team
    start : tuple of int or None
    """

    name: str
    points: int
    stretches: IntArray
    margins: FloatArray
    origin: Callable[[int], str]
    at_least: tuple[tuple[tuple[int, ...], int, str], ...]
    team: Team = field(default_factory=Team)
    start: tuple[int, ...] | None = None

    @property
    def levels(self) -> FloatArray:
        """Distinct squared margins above 0, ascending: the openness matters only between them."""
        return np.unique(self.margins[self.margins > 0])

    def instance(self, openness_squared: float) -> Instance:
        """The 0-1 program for one openness."""
        rows = list(self.team.rows(self.points))
        # Opening: no chord of a polygon closes on a threading point.
        for index in self._needed(openness_squared).tolist():
            u, first, last, w = self.stretches[index].tolist()
            literals = (*(-end for end in (u, w) if end), *range(first, last + 1))
            rows.append(Row(literals, 1, "opening", self.origin(index)))
        # Area: a loop with fewer than 2 robots, a pocket with none, collapses.
        for points, count, origin in self.at_least:
            rows.append(Row(points, count, "area", origin))
        definitions, reach = self.team.reach_rows(self.points + 1)
        helpers = range(self.points + 1, self.points + 1 + len(definitions))
        return Instance(
            name=self.name,
            variables=(
                *(f"x{k}" for k in range(1, self.points + 1)),
                *(f"z{helper}" for helper in helpers),
            ),
            decisions=self.points,
            objective=(1,) * self.points + (0,) * len(definitions),
            rows=(*rows, *reach),
            definitions=tuple(definitions),
            start=self.start,
        )

    def _needed(self, openness_squared: float) -> IntArray:
        """Rows that count and that no other one implies.

        A row whose left (right) end is an apex holds for every earlier u (later w), so it implies
        the rows with the same w whose u comes before its first point.
        """
        active = np.flatnonzero(self.margins < openness_squared)
        u, first, last, w = self.stretches[active].T
        size = self.points + 2
        # earliest[w]: the latest first point of rows "apex ... w"; latest[u] the mirror image.
        apex_left, apex_right = (u == 0) & (w > 0), (w == 0) & (u > 0)
        earliest = np.zeros(size, dtype=np.int64)
        np.maximum.at(earliest, w[apex_left], first[apex_left])
        latest = np.full(size, size)
        np.minimum.at(latest, u[apex_right], last[apex_right])
        implied = (u > 0) & (w > 0) & ((earliest[w] > u) | (latest[u] < w))
        implied |= apex_left & (first < earliest[w])
        implied |= apex_right & (last > latest[u])
        # Rows "apex ... apex" imply every row whose points between contain theirs.
        both = (u == 0) & (w == 0)
        inner = np.zeros(size, dtype=np.int64)  # inner[b]: latest a with a row a..b' for b' <= b
        np.maximum.at(inner, last[both], first[both])
        inner = np.maximum.accumulate(inner)
        shorter = np.concatenate(([0], inner[:-1]))  # rows that end earlier
        contains = inner[np.clip(last, 0, size - 1)] >= first
        longer = (inner[last] > first) | (shorter[last] >= first)
        implied |= (first <= last) & np.where(both, longer, contains)
        needed: IntArray = active[~implied]
        return needed
