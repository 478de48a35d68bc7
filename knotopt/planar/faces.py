"""Faces of a planar diagram, and their colouring like a checkerboard."""

from __future__ import annotations

from dataclasses import dataclass

from knotopt.planar.planar_diagram import PlanarDiagram


@dataclass(frozen=True)
class Faces:
    """The faces of a planar diagram with C >= 1 crossings.

    Corner s of a crossing lies between its sides s and s + 1, counterclockwise; side 0 is the
    edge that comes in below.

    Attributes
    ----------
    of_corner : tuple of (int, int, int, int), length C
        The face in each of the crossing's corners, counted from 0.
    even_is_white : tuple of bool, length C
        Whether corners 0 and 2 of the crossing are white, and 1 and 3 black, or the other way
        round; those of the first crossing are. Faces on both sides of an edge differ in colour.
    """

    of_corner: tuple[tuple[int, int, int, int], ...]
    even_is_white: tuple[bool, ...]


def faces(planar: PlanarDiagram) -> Faces:
    """The faces and their colours.

    Examples
    --------
    >>> trefoil = PlanarDiagram(((0, 4, 1, 3), (2, 0, 3, 5), (4, 2, 5, 1)))
    >>> faces(trefoil).of_corner
    ((0, 1, 2, 3), (0, 3, 2, 4), (0, 4, 2, 1))
    """
    # To the left of the edge that leaves at side s is corner s.
    face = {corner: k for k, corners in enumerate(planar.faces) for corner in corners}
    white: dict[int, bool] = {0: True}
    waiting = [0]
    while waiting:
        c = waiting.pop()
        for side in range(4):
            there, at = planar.other_ends[c, side]
            if there not in white:
                white[there] = white[c] == ((side + at) % 2 == 1)
                waiting.append(there)
    crossings = range(len(planar.crossings))
    return Faces(
        tuple((face[c, 0], face[c, 1], face[c, 2], face[c, 3]) for c in crossings),
        tuple(white[c] for c in crossings),
    )
