"""The smallest grid diagram that is found for a planar diagram's knot."""

from __future__ import annotations

from itertools import pairwise

from knotopt.diagram.grid import GridDiagram
from knotopt.diagram.simplify import simplify
from knotopt.diagram.sums import connected_sum
from knotopt.planar.grid_drawing import draw_grid
from knotopt.planar.planar_diagram import PlanarDiagram
from knotopt.planar.sums import summands


def small_grid(planar: PlanarDiagram, *, seed: int = 0) -> GridDiagram:
    """A grid diagram of the same knot, as small as drawing and simplifying make it.

    Each summand that the diagram shows is drawn and, unless that is known to be its arc index,
    simplified.

    Parameters
    ----------
    planar : PlanarDiagram
    seed : int
        Of the simplification; the same seed gives the same grid.

    Examples
    --------
    >>> small_grid(PlanarDiagram(((0, 4, 1, 3), (2, 0, 3, 5), (4, 2, 5, 1)))).size
    5
    """
    return connected_sum(
        [
            simplify(draw_grid(part), smallest=_least_size(part), seed=seed)
            for part in summands(planar)
        ]
    )


def _least_size(prime: PlanarDiagram) -> int:
    """What the size of the knot's grid diagrams cannot be below.

    Of a reduced alternating diagram with c crossings the arc index is c + 2: not less by Morton and
    Beltrami, "Arc index and the Kauffman polynomial", Math. Proc. Cambridge Philos. Soc. 123 (1998)
    41-48, nor more, as `draw_grid` shows.
    """
    alternates = all(over != over_next for (_, over), (_, over_next) in pairwise(prime.visits))
    return len(prime.crossings) + 2 if alternates else 2
