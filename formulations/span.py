"""Formulation `span`: the smallest set of points for a taut path whose crossings move.

Binary y_uw says "u and w are consecutive robots": a unit flow from point 1 to point n along the
path, x_k the flow through k. Some spans are forbidden; some must not occur together.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from itertools import pairwise, product

import numpy as np

from formulations.arrays import BoolArray, FloatArray, IntArray
from formulations.instance import Instance, Row
from formulations.team import Team

Span = tuple[int, int]


@dataclass(frozen=True, eq=False)
class Conflict:
    """Spans that must not occur together: one of `left`, one of `right`, one of `middle`.

    The spans of a list cover the same place on the path, so a path uses one of them at most.

    Attributes
    ----------
    left, right : int arrays, shapes (L, 2) and (R, 2)
        Spans (u, w).
    middle : int array, shape (M, 2), or None for pairs
    margins : float array, shape (L, R) or (M, L, R)
        They conflict if the openness exceeds the margin (both squared).
    origin : str
    """

    left: IntArray
    right: IntArray
    middle: IntArray | None
    margins: FloatArray
    origin: str


@dataclass(frozen=True, eq=False)
class SpanProgram:
    """`span` for any openness.

    Attributes
    ----------
    name : str
    points : int
        n; the decisions are x_1 ... x_n.
    forbidden : float array, shape (n + 1, n + 1)
        Span (u, w) is forbidden if the openness exceeds entry [u, w] (both squared).
    conflicts : tuple of Conflict
    team : Team
    start : tuple of int or None
    """

    name: str
    points: int
    forbidden: FloatArray
    conflicts: tuple[Conflict, ...]
    team: Team = field(default_factory=Team)
    start: tuple[int, ...] | None = None

    @property
    def levels(self) -> FloatArray:
        """Distinct squared margins in (0, 1), ascending: the openness matters only there."""
        every = np.concatenate(
            [self.forbidden.ravel(), *(conflict.margins.ravel() for conflict in self.conflicts)]
        )
        return np.unique(every[(every > 0) & (every < 1)])

    def instance(self, openness_squared: float) -> Instance:
        """The 0-1 program for one openness."""
        u, w = np.triu_indices(self.points, k=1)
        u, w = u + 1, w + 1
        allowed = self.forbidden[u, w] >= openness_squared
        u, w = u[allowed], w[allowed]
        variable = np.zeros_like(self.forbidden, dtype=np.int64)  # of a span; 0 if forbidden
        variable[u, w] = np.arange(self.points + 1, self.points + 1 + len(u))
        rows = [*self.team.rows(self.points), *self._flow(variable)]
        # Crossings: the spans that meet there keep it, and keep it clear of threading points.
        for conflict in self.conflicts:
            rows.extend(_conflict_rows(conflict, variable, openness_squared))
        spans = list(zip(u.tolist(), w.tolist(), strict=True))
        definitions = [(a, b, *range(-a - 1, -b, -1)) for a, b in spans]
        reach, reach_rows = self.team.reach_rows(self.points + 1 + len(spans))
        return Instance(
            name=self.name,
            variables=(
                *(f"x{k}" for k in range(1, self.points + 1)),
                *(f"y{a}_{b}" for a, b in spans),
                *(f"z{j}" for j in range(len(reach))),
            ),
            decisions=self.points,
            objective=(1,) * self.points + (0,) * (len(spans) + len(reach)),
            rows=(*rows, *reach_rows),
            definitions=(*definitions, *reach),
            start=self.start,
        )

    def excluded(self, chosen: Sequence[int], openness_squared: float) -> list[tuple[Span, ...]]:
        """Spans of a path through the chosen points that must not occur, or not together."""
        spans = list(pairwise(chosen))
        found: list[tuple[Span, ...]] = [
            (span,) for span in spans if self.forbidden[span] < openness_squared
        ]
        for conflict in self.conflicts:
            rows = [
                {span: row for row, span in enumerate(map(tuple, side.tolist()))}
                for side in (conflict.left, conflict.right)
            ]
            lefts, rights = ([span for span in spans if span in row] for row in rows)
            middles: list[tuple[Span, ...]] = [()]
            if conflict.middle is not None:
                number = {span: m for m, span in enumerate(map(tuple, conflict.middle.tolist()))}
                middles = [(span,) for span in spans if span in number]
            for middle, left, right in product(middles, lefts, rights):
                place = (*(number[span] for span in middle), rows[0][left], rows[1][right])
                if conflict.margins[place] < openness_squared:
                    found.append((left, right, *middle))
        return found

    def _flow(self, variable: IntArray) -> Iterator[Row]:
        """Flow: exactly one span leaves (reaches) a robot, none where there is no robot."""
        for k in range(1, self.points + 1):
            for end, spans, is_end in (
                ("leaves", variable[k], k == self.points),
                ("reaches", variable[:, k], k == 1),
            ):
                if is_end:
                    continue
                used = spans[spans > 0].tolist()
                origin = f"one span {end} p{k}"
                yield Row((-k, *used), 1, "flow", origin)
                if used:
                    yield Row((k, *(-y for y in used)), len(used), "flow", origin)


def _conflict_rows(
    conflict: Conflict, variable: IntArray, openness_squared: float
) -> Iterator[Row]:
    """The fewest rows: lefts that conflict with the same rights share one.

    As a path has one span of each list at most, sum(lefts) + sum(rights) <= 1 says for all pairs
    at once what y_left + y_right <= 1 says for one; with a middle span the bound is 2.
    """
    left = variable[conflict.left[:, 0], conflict.left[:, 1]]
    right = variable[conflict.right[:, 0], conflict.right[:, 1]]
    bad = conflict.margins < openness_squared
    bad = bad[..., left > 0, :][..., right > 0]
    left, right = left[left > 0], right[right > 0]
    if conflict.middle is None:
        yield from _stars(bad, left, right, (), conflict.origin)
        return
    middle = variable[conflict.middle[:, 0], conflict.middle[:, 1]]
    for y, table in zip(middle.tolist(), bad, strict=True):
        if y:
            yield from _stars(table, left, right, (y,), conflict.origin)


def _stars(
    bad: BoolArray, left: IntArray, right: IntArray, middle: tuple[int, ...], origin: str
) -> Iterator[Row]:
    patterns, which = np.unique(bad, axis=0, return_inverse=True)
    for number, pattern in enumerate(patterns):
        if not pattern.any():
            continue
        spans = [*left[which.ravel() == number].tolist(), *right[pattern].tolist(), *middle]
        allowed = 1 + len(middle)
        yield Row(tuple(-y for y in spans), len(spans) - allowed, "crossing", origin)
