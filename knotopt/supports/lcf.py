"""The Loop Consistency Filter (section III.A.3): which turning points carry a support robot."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np

from knotopt.arrays import IntArray
from knotopt.cable.cable import Cable
from knotopt.cable.cut import Cut, outer_cuts
from knotopt.diagram.grid import GridDiagram
from knotopt.supports.regions import Regions
from knotopt.supports.support_set import SupportSet

_ENTRIES_AT_ONCE = 1 << 20  # bounds the memory of arrays of active regions by turning points


@dataclass(frozen=True, repr=False)
class LcfResult(SupportSet):
    """Supports that LCF selects on one cable.

    Attributes
    ----------
    regions : Regions
    layered : bool
        Whether points inside another active region were dropped.
    selected : tuple of tuple of int
        For each region, the turning points it selects (1-based), going round its boundary; none
        for a passive one.
    supports : tuple of int
        Turning points that carry a support robot (1-based on the path), without p_1 and p_n.
    """

    regions: Regions
    layered: bool
    selected: tuple[tuple[int, ...], ...]
    supports: tuple[int, ...]

    @property
    def cable(self) -> Cable:
        """The cable the supports belong to."""
        return self.regions.cable


def lcf(cable: Cable, *, layered: bool = False) -> LcfResult:
    """Supports of a cable by the Loop Consistency Filter.

    No guarantee: the set need neither keep every active region open nor be smallest.

    Parameters
    ----------
    cable : Cable
    layered : bool
        Also drop a point that lies in the interior of another active region.

    Notes
    -----
    O(R N^2) for R < 2C regions of C crossings; C grows as N^2 / 9 on random grids.

    References
    ----------
    Wu, Lopez, D'Antonio, Saldaña, "Tying Knots in the Air", section III.A.

    Examples
    --------
    >>> from knotopt.diagram.grid import GridDiagram
    >>> trefoil = GridDiagram.from_matrix([[0, -1, 0, 0, 1], [1, 0, -1, 0, 0],
    ...     [0, 1, 0, -1, 0], [0, 0, 1, 0, -1], [-1, 0, 0, 1, 0]])
    >>> result = lcf(Cable(trefoil, "L+"))
    >>> result.robots, result.placed_supports
    (5, ((3, 3, 2), (4, 5, 2), (6, 2, 5)))
    """
    regions = Regions(cable)
    selected: list[tuple[int, ...]] = [()] * len(regions)
    chosen = np.zeros(len(cable.path), dtype=bool)
    batch = max(1, _ENTRIES_AT_ONCE // len(cable.path))
    for low in range(0, len(regions.active), batch):
        active = regions.active[low : low + batch]
        extremal = _extremal_points(regions, active)
        walked, crossed, total = _boundary_walk(regions, active)
        for position, region in enumerate(active.tolist()):
            points = sorted(set(extremal[position]), key=walked[position].__getitem__)
            kept = _prune(points, crossed[position], int(total[position]))
            selected[region] = tuple(point + 1 for point in kept)
            chosen[kept] = True
    if layered:
        chosen &= ~regions.inside[regions.active].any(axis=0)
    chosen[[0, -1]] = False
    return LcfResult(
        regions, layered, tuple(selected), tuple((np.flatnonzero(chosen) + 1).tolist())
    )


def lcf_by_cut(
    diagram: GridDiagram, *, layered: bool = False, cuts: Iterable[Cut] | None = None
) -> dict[Cut, LcfResult]:
    """LCF on each of the given cuts; by default the eight outer ones, L+ first.

    Raises
    ------
    CutError
        A cut's segment carries crossings.
    """
    chosen = outer_cuts(diagram) if cuts is None else cuts
    return {cut: lcf(Cable(diagram, cut), layered=layered) for cut in chosen}


def best_cut(diagram: GridDiagram, *, layered: bool = False) -> LcfResult:
    """LCF on the outer cut with the fewest robots; ties in the order L+ L- R+ R- B+ B- T+ T-."""
    results = (lcf(Cable(diagram, cut), layered=layered) for cut in outer_cuts(diagram))
    return min(results, key=lambda result: result.robots)


def _extremal_points(regions: Regions, active: IntArray) -> list[list[int]]:
    """Turning points with max x, min x, max y, min y of B(l) (eq. 10); ties: first on the path."""
    on = regions.on_boundary(active)
    column, row = regions.cable.points.T
    # 0 lies outside the 1-based grid on one side, and -size - 1, of what is reversed, on the other.
    outside = -regions.cable.diagram.size - 1
    extremes = [np.where(on, c, outside).argmax(axis=1) for c in (column, -column, row, -row)]
    points: list[list[int]] = np.stack(extremes, axis=1).tolist()
    return points


def _boundary_walk(regions: Regions, active: IntArray) -> tuple[IntArray, IntArray, IntArray]:
    """Each turning point's place on a walk round each active boundary from its start.

    Returns
    -------
    walked : (A, n), distance to each turning point of B(l) [grid steps]
    crossed : (A, n), crossings met before it, the region's own not counted
    total : (A,), crossings met on the whole way round
    """
    cable, boundaries = regions.cable, regions.boundaries
    visits = cable.visits[0]
    before = np.searchsorted(visits, cable.times)
    a0, a1 = np.searchsorted(visits, boundaries.a[active]).T[..., None]
    b0, b1 = np.searchsorted(visits, boundaries.b[active]).T[..., None]
    crossed_a = a1 - a0 - 1  # strictly between the apexes at either end
    crossed_b = np.where(boundaries.is_pocket[active, None], b1 - b0 - 1, 0)
    in_a = cable.times <= boundaries.a[active, 1:]
    forward = boundaries.b_forward[active, None]
    crossed = np.where(
        in_a, before - a0 - 1, crossed_a + np.where(forward, before - b0 - 1, b1 - before)
    )
    walked = boundaries.position(active[:, None], cable.times)
    return walked, crossed, (crossed_a + crossed_b)[:, 0]


def _prune(points: list[int], crossed: IntArray, total: int) -> list[int]:
    """Drop each point whose two boundary stretches to its selected neighbours meet no crossing."""
    kept = list(points)
    index = 0
    while index < len(kept) and len(kept) > 2:
        here, after = kept[index], kept[(index + 1) % len(kept)]
        before = kept[index - 1]
        to_before = crossed[here] - crossed[before] + (total if index == 0 else 0)
        to_after = crossed[after] - crossed[here] + (total if index == len(kept) - 1 else 0)
        if to_before == 0 and to_after == 0:
            kept.pop(index)
        else:
            index += 1
    return kept
