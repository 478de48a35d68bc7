"""Planar diagrams of knots: the crossings and which edges meet there (PD codes).

Source: the Knot Atlas, "Planar Diagrams" (KnotTheory's `PD[X[1,5,2,4], ...]`); KnotInfo's
`pd_notation` is the same, counted from 1.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Hashable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import TypeVar

from knotopt.errors import DiagramError

Crossing = tuple[int, int, int, int]
End = tuple[int, int]
"""Where an edge meets a crossing: the crossing and its side, from 0."""
T = TypeVar("T")


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
        # A code drawn on a surface of genus g has 2 - 2g faces more than it has crossings.
        if crossings and (missing := len(crossings) + 2 - len(self.faces)):
            raise DiagramError(
                f"the code is of a diagram on a surface of genus {missing // 2}, "
                "which cannot be drawn in the plane (a virtual knot)"
            )

    @classmethod
    def from_edges(cls, crossings: Iterable[Iterable[Hashable]]) -> PlanarDiagram:
        """The diagram of a PD code whose edges are named in any way.

        Parameters
        ----------
        crossings : iterable of four edges each
            The edges at each crossing counterclockwise, from either end of the strand below. An
            edge is named by anything, the same at its two ends.

        Returns
        -------
        PlanarDiagram
            Crossings in the same order. Edges are numbered from the smallest, if they are numbers,
            in the direction in which the first crossing's first edge comes in; a code that is
            numbered along the knot keeps its numbers, but for where they begin.

        Raises
        ------
        DiagramError
            Naming the crossing or edge that is wrong, or how many components the link has.

        Examples
        --------
        >>> PlanarDiagram.from_edges([[1, 5, 2, 4], [3, 1, 4, 6], [5, 3, 6, 2]]).crossings
        ((0, 4, 1, 3), (2, 0, 3, 5), (4, 2, 5, 1))
        >>> PlanarDiagram.from_edges(["aebd", "dfca", "ecfb"]).crossings
        ((0, 4, 1, 3), (2, 0, 3, 5), (4, 2, 5, 1))
        """
        named = [_four(number, edges) for number, edges in enumerate(crossings, 1)]
        if not named:
            return cls(())
        walk = _walk(named)
        names = [named[crossing][side] for crossing, side in walk]
        numbers = [name for name in names if isinstance(name, int)]
        first = names.index(min(numbers)) if len(numbers) == len(names) else 0
        edge = {name: (place - first) % len(names) for place, name in enumerate(names)}
        below = dict(entry for entry in walk if entry[1] % 2 == 0)
        return cls(
            tuple(
                (edge[x[s]], edge[x[s - 3]], edge[x[s - 2]], edge[x[s - 1]])
                for x, s in ((x, below[c]) for c, x in enumerate(named))
            )
        )

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

    @cached_property
    def visits(self) -> tuple[tuple[int, bool], ...]:
        """Crossing (from 0) that each edge leads to, and whether the knot passes over there."""
        visits = [(0, False)] * (2 * len(self.crossings))
        for c, ((under, east, _, west), sign) in enumerate(
            zip(self.crossings, self.signs, strict=True)
        ):
            visits[under] = (c, False)
            visits[west if sign > 0 else east] = (c, True)
        return tuple(visits)

    @cached_property
    def other_ends(self) -> Mapping[End, End]:
        """Of each edge's end at a crossing, as (crossing, side) from 0: the edge's other end."""
        return _other_ends(self.crossings)

    @cached_property
    def faces(self) -> tuple[tuple[End, ...], ...]:
        """Around each face, counterclockwise, its edges as (crossing, side) where each begins.

        ``crossings[crossing][side]`` is the edge, and the face lies to its left. A circle without
        crossings has none listed.
        """
        left = dict.fromkeys((c, side) for c in range(len(self.crossings)) for side in range(4))
        faces = []
        while left:
            here = next(iter(left))
            face = []
            while here in left:
                del left[here]
                face.append(here)
                crossing, side = self.other_ends[here]
                here = (crossing, (side - 1) % 4)
            faces.append(tuple(face))
        return tuple(faces)

    @property
    def mirrored(self) -> PlanarDiagram:
        """The mirror image: reflected in a line of the plane, with the same numbers."""
        return PlanarDiagram(tuple((a, d, c, b) for a, b, c, d in self.crossings))

    @property
    def pd_code(self) -> tuple[Crossing, ...]:
        """The crossings with edges counted from 1, as KnotTheory, KnotInfo and SnapPy read them."""
        return tuple((a + 1, b + 1, c + 1, d + 1) for a, b, c, d in self.crossings)

    def __str__(self) -> str:
        return f"PD[{', '.join(f'X[{a},{b},{c},{d}]' for a, b, c, d in self.pd_code)}]"


def _crossing(number: int, edges: Iterable[int]) -> Crossing:
    a, b, c, d = _four(number, edges)
    return int(a), int(b), int(c), int(d)


def _four(number: int, edges: Iterable[T]) -> tuple[T, T, T, T]:
    four = tuple(edges)
    if len(four) != 4:
        raise DiagramError(f"crossing {number} has {len(four)} edges, expected four")
    return four


def _check_edges(crossings: Sequence[Crossing]) -> None:
    edges = 2 * len(crossings)
    for number, crossing in enumerate(crossings, 1):
        for edge in crossing:
            if not 0 <= edge < edges:
                raise DiagramError(
                    f"edge {edge} at crossing {number}: {len(crossings)} crossings have the edges "
                    f"0 to {edges - 1}"
                )
    _check_twice(crossings)
    for number, (under_in, right, under_out, left) in enumerate(crossings, 1):
        if under_out != (under_in + 1) % edges or 1 not in {
            (right - left) % edges,
            (left - right) % edges,
        }:
            raise DiagramError(
                f"crossing {number} is {[under_in, right, under_out, left]}: its strands do not "
                "run on to the next edge, so this is no knot numbered along itself"
            )


def _check_twice(crossings: Sequence[Sequence[Hashable]]) -> None:
    counts = Counter(edge for crossing in crossings for edge in crossing)
    for number, crossing in enumerate(crossings, 1):
        for edge in crossing:
            if counts[edge] != 2:
                times = "once" if counts[edge] == 1 else f"{counts[edge]} times"
                raise DiagramError(
                    f"edge {edge} at crossing {number} occurs {times}, expected twice"
                )


def _other_ends(crossings: Sequence[Sequence[Hashable]]) -> dict[End, End]:
    """Of each edge's end at a crossing, (crossing, side): the edge's other end."""
    other = {}
    open_ends: dict[Hashable, End] = {}
    for c, crossing in enumerate(crossings):
        for side, edge in enumerate(crossing):
            if edge in open_ends:
                end = open_ends.pop(edge)
                other[c, side], other[end] = end, (c, side)
            else:
                open_ends[edge] = (c, side)
    return other


def _walk(crossings: Sequence[Sequence[Hashable]]) -> list[End]:
    """Where the knot comes into crossings, in order, from the first crossing's first edge on."""
    _check_twice(crossings)
    other = _other_ends(crossings)
    left = dict.fromkeys((c, side) for c in range(len(crossings)) for side in (0, 1))
    walks: list[list[End]] = []
    while left:
        here = start = next(iter(left))
        walks.append([])
        while True:
            walks[-1].append(here)
            crossing, side = here
            left.pop((crossing, side % 2))
            here = other[crossing, (side + 2) % 4]
            if here == start:
                break
    if len(walks) > 1:
        raise DiagramError(f"this code is a link of {len(walks)} components, a knot has 1")
    return walks[0]
