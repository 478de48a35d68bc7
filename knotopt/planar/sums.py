"""The summands of a knot that its planar diagram shows."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator

from knotopt.planar.planar_diagram import PlanarDiagram


def summands(planar: PlanarDiagram) -> tuple[PlanarDiagram, ...]:
    """Prime diagrams whose connected sum is the diagram, without those of one crossing.

    Two faces with two edges in common make a circle that meets the diagram in two points: each
    side, closed up, is a summand. Here all such circles are used, so a nugatory crossing ends as a
    summand of one crossing, an unknot, and is left out. In an alternating diagram the summands are
    the knot's prime ones (Menasco, doi:10.1016/0040-9383(84)90023-5); in others one of them may be
    an unknot or composite still.

    Returns
    -------
    tuple of PlanarDiagram
        In the order in which the knot runs through their first crossings; for the unknot's circle,
        or when every crossing was nugatory, the one diagram without crossings.

    Examples
    --------
    >>> kinked = PlanarDiagram(((0, 1, 1, 2), (2, 6, 3, 5), (4, 0, 5, 7), (6, 4, 7, 3)))
    >>> [len(summand.crossings) for summand in summands(kinked)]
    [3]
    """
    found = []
    parts = [planar]
    while parts:
        part = parts.pop()
        edges = _edges_in_common(part)
        if edges:
            parts += reversed([*_cut(part, edges)])
        elif len(part.crossings) > 1:
            found.append(part)
    return tuple(found) or (PlanarDiagram(()),)


def _edges_in_common(planar: PlanarDiagram) -> list[int]:
    """Edges, two or more and in order, that lie between the same two faces; none in a prime one."""
    faces = defaultdict[int, list[int]](list)  # of an edge, to its left and to its right
    for number, face in enumerate(planar.faces):
        for crossing, side in face:
            faces[planar.crossings[crossing][side]].append(number)
    between = defaultdict[tuple[int, ...], list[int]](list)
    for edge in sorted(faces):
        between[tuple(sorted(faces[edge]))].append(edge)
    return next((edges for edges in between.values() if len(edges) > 1), [])


def _cut(planar: PlanarDiagram, edges: list[int]) -> Iterator[PlanarDiagram]:
    """The parts of the knot between these edges, each closed up along the faces they share."""
    count = 2 * len(planar.crossings)
    for first, last in zip(edges, [*edges[1:], edges[0] + count], strict=True):
        # The two edges become edge 0; those between them keep their order.
        number = {(edge % count): edge - first for edge in range(first, last)} | {last % count: 0}
        yield PlanarDiagram(
            tuple(
                (number[a], number[b], number[c], number[d])
                for a, b, c, d in planar.crossings
                if a in number and b in number and c in number and d in number
            )
        )
