"""Planar diagrams without what Reidemeister's first two moves take off at once.

What is seen of a curve in space has many loops, and strands that lie on others without being tied.
"""

from __future__ import annotations

from knotopt.planar.gauss import from_visits
from knotopt.planar.planar_diagram import PlanarDiagram


def loosened(diagram: PlanarDiagram) -> PlanarDiagram:
    """The diagram without loops (R1) and bigons of one strand over another (R2), till none is left.

    Two crossings that follow one another on both of their strands, one strand over at both, bound
    such a bigon: no other part of the knot meets the two arcs, so all of it lies on one side.

    Notes
    -----
    O(C) a round; a round takes off all it finds.

    Examples
    --------
    >>> from knotopt.planar.gauss import from_gauss
    >>> loosened(from_gauss([1, -2, 3, -1, 2, -3, -4, 4])).signs
    (1, 1, 1)
    """
    visits = list(diagram.visits)
    while off := _spare(visits):
        visits = [visit for visit in visits if visit[0] not in off]
    left = sorted({crossing for crossing, _ in visits})
    if len(left) == len(diagram.crossings):
        return diagram
    number = {crossing: place for place, crossing in enumerate(left)}
    return from_visits(
        [number[crossing] for crossing, _ in visits],
        [over for _, over in visits],
        [diagram.signs[crossing] for crossing in left],
    )


def _spare(visits: list[tuple[int, bool]]) -> set[int]:
    """Crossings of loops and bigons that have none in common."""
    off: set[int] = set()
    followed: dict[frozenset[int], bool] = {}  # of two crossings in a row: whether over at both
    for (first, over), (second, over_too) in zip(visits, visits[1:] + visits[:1], strict=True):
        pair = frozenset((first, second))
        if off & pair:
            continue
        if first == second:
            off.add(first)
        elif over == over_too and followed.setdefault(pair, over) != over:
            off |= pair
    return off
