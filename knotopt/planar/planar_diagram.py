"""Planar diagrams of knots: the crossings and which edges meet there (PD codes).

Source: the Knot Atlas, "Planar Diagrams" (KnotTheory's `PD[X[1,5,2,4], ...]`); KnotInfo's
`pd_notation` is the same, counted from 1.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import cached_property

from knotopt.errors import DiagramError

Crossing = tuple[int, int, int, int]


@dataclass(frozen=True)
class PlanarDiagram:
    """An oriented planar diagram of one knot; without crossings, a circle.

    Parameters
    ----------
    crossings : tuple of (i, j, k, l)
        A crossing each: the edge that comes in below, then the others counterclockwise. Edges are
        numbered 0 ... 2n - 1 in the order in which the knot runs through them, so that k = i + 1
        modulo 2n.

    Raises
    ------
    DiagramError
        Naming the first crossing that is wrong: edges that do not occur twice, that are no knot,
        or a code that cannot be drawn in the plane.

    Examples
    --------
    >>> trefoil = PlanarDiagram(((0, 4, 1, 3), (2, 0, 3, 5), (4, 2, 5, 1)))
    >>> trefoil.signs, trefoil.writhe
    ((1, 1, 1), 3)
    """

    crossings: tuple[Crossing, ...]

    def __post_init__(self) -> None:
        crossings = tuple(_crossing(c, x) for c, x in enumerate(self.crossings, 1))
        object.__setattr__(self, "crossings", crossings)
        _check_edges(crossings)
        _check_planar(crossings)

    @cached_property
    def signs(self) -> tuple[int, ...]:
        """Of each crossing: +1 where the strand above passes from left to right over that below."""
        edges = 2 * len(self.crossings)
        return tuple(
            1 if (west == under_out if edges == 2 else east == (west + 1) % edges) else -1
            for _, east, under_out, west in self.crossings
        )

    @property
    def writhe(self) -> int:
        """Sum of the signs."""
        return sum(self.signs)


def _crossing(number: int, edges: Iterable[int]) -> Crossing:
    crossing = tuple(int(edge) for edge in edges)
    if len(crossing) != 4:
        raise DiagramError(f"crossing {number} has {len(crossing)} edges, expected four")
    return crossing


def _check_edges(crossings: Sequence[Crossing]) -> None:
    edges = 2 * len(crossings)
    counts = Counter(edge for crossing in crossings for edge in crossing)
    for number, crossing in enumerate(crossings, 1):
        for edge in crossing:
            if not 0 <= edge < edges:
                raise DiagramError(
                    f"edge {edge} at crossing {number}: {len(crossings)} crossings have the edges "
                    f"0 to {edges - 1}"
                )
            if counts[edge] != 2:
                raise DiagramError(
                    f"edge {edge} at crossing {number} occurs {counts[edge]} times, expected twice"
                )
        under_in, right, under_out, left = crossing
        if under_out != (under_in + 1) % edges or 1 not in {
            (right - left) % edges,
            (left - right) % edges,
        }:
            raise DiagramError(
                f"crossing {number} is {list(crossing)}: its strands do not run on to the next "
                "edge, so this is no knot numbered along itself"
            )


def _check_planar(crossings: Sequence[Crossing]) -> None:
    """A code drawn on a surface of genus g has 2 - 2g faces more than it has crossings."""
    place = {}  # of an edge at a crossing: the edge's other end
    ends: dict[int, tuple[int, int]] = {}
    for c, crossing in enumerate(crossings):
        for side, edge in enumerate(crossing):
            if edge in ends:
                place[c, side], place[ends[edge]] = ends[edge], (c, side)
            else:
                ends[edge] = (c, side)
    faces, left = 0, set(place)
    while left:
        faces += 1
        start = here = next(iter(left))
        while True:
            left.discard(here)
            c, side = place[here]
            here = (c, (side + 1) % 4)
            if here == start:
                break
    if crossings and faces != len(crossings) + 2:
        raise DiagramError(
            f"the code is of a diagram on a surface of genus {(len(crossings) + 2 - faces) // 2}, "
            "which cannot be drawn in the plane (a virtual knot)"
        )
