"""Shortest ways in plan that cross no laid cable and keep away from robots, on a lattice."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
import shapely
from scipy.sparse import csr_array
from scipy.sparse.csgraph import dijkstra

from knotopt.arrays import BoolArray, FloatArray, IntArray
from knotopt.flight.obstacles import NEAR, Obstacles, nearest

SPACING = 0.2  # between nodes [grid steps]
MARGIN = 2.5  # free room around everything [grid steps]
STEPS = ((1, 0), (0, 1), (1, 1), (1, -1), (2, 1), (1, 2), (2, -1), (1, -2))
SEEN = 24  # nearest nodes that are looked at from a point
HIDDEN = -1  # stands for the node of a point that sees none


@dataclass(frozen=True, eq=False)
class ShortestWays:
    """From some nodes to others.

    Attributes
    ----------
    lengths : float array, shape (S, T)
        Weighted; infinite where there is no way.
    trees : int array, shape (S, V)
        For each source the node before every node on the shortest way to it.
    sources, targets : int arrays, shapes (S,) and (T,)
    """

    lengths: FloatArray
    trees: IntArray
    sources: IntArray
    targets: IntArray

    def nodes(self, source: int, target: int) -> list[int]:
        """The nodes on the way from one source to one target, both by their numbers."""
        chain = [int(self.targets[target])]
        while chain[-1] != self.sources[source]:
            chain.append(int(self.trees[source, chain[-1]]))
        return chain[::-1]


@dataclass(frozen=True, eq=False)
class Lattice:
    """Nodes in plan, shape (V, 2) [grid steps], and the weighted edges between them."""

    obstacles: Obstacles
    nodes: FloatArray
    edges: csr_array

    def seen_from(self, point: FloatArray) -> int:
        """The nearest node that is seen from a point, or `HIDDEN`."""
        apart = np.linalg.norm(self.nodes - point, axis=1)
        order = np.argsort(apart)[:SEEN]
        free = nearest(self.nodes[order], self.obstacles.robots) >= self.obstacles.clear
        for node in order[free]:
            sight = shapely.LineString([point, self.nodes[node]])
            if apart[node] < 1e-9 or not self.obstacles.blocks(sight, point):
                return int(node)
        return HIDDEN

    def shortest_ways(self, sources: Sequence[int], targets: Sequence[int]) -> ShortestWays:
        """From every source to every target, either of which may be `HIDDEN`.

        Notes
        -----
        O(S V log V), by Dijkstra's algorithm.
        """
        begin, end = np.array(sources), np.array(targets)
        apart, trees = dijkstra(
            self.edges, directed=False, indices=np.maximum(begin, 0), return_predecessors=True
        )
        apart[begin == HIDDEN] = np.inf
        lengths = apart[:, end]
        lengths[:, end == HIDDEN] = np.inf
        return ShortestWays(lengths, trees, begin, end)


def build_lattice(obstacles: Obstacles, start: FloatArray, goal: FloatArray) -> Lattice:
    """A lattice about all obstacles and both ends of a way, shape (2,) each.

    An edge costs its length, up to four times of it near cable, and more near robots.
    """
    every = [start[None], goal[None], obstacles.robots]
    every += [shapely.get_coordinates(line) for line in obstacles.laid]
    low, high = (bound(np.concatenate(every), axis=0) for bound in (np.min, np.max))
    low, high = low - MARGIN, high + MARGIN
    counts = np.ceil((high - low) / SPACING).astype(int) + 1
    grid = np.stack(np.meshgrid(*map(np.arange, counts), indexing="ij"), axis=-1)
    nodes = low + SPACING * grid.reshape(-1, 2)
    from_cable = np.full(len(nodes), NEAR)
    if not obstacles.cable.is_empty:
        from_cable = shapely.distance(shapely.points(nodes), obstacles.cable)
    from_robots = nearest(nodes, obstacles.robots)
    weight = 1 + 3 * np.clip(1 - from_cable / NEAR, 0, 1)
    weight += 2 * (nearest(nodes, obstacles.posts) < obstacles.clear)
    is_free = from_robots >= obstacles.clear
    rows, columns, costs = [], [], []
    for here, there, length in _neighbours(counts, is_free):
        ends = np.stack((nodes[here], nodes[there]), axis=1)
        is_open = ~_shut(obstacles, ends, length, from_cable[here], from_robots[here])
        rows.append(here[is_open])
        columns.append(there[is_open])
        costs.append((length * (weight[here] + weight[there]) / 2)[is_open])
    edges = csr_array(
        (np.concatenate(costs), (np.concatenate(rows), np.concatenate(columns))),
        shape=(len(nodes), len(nodes)),
    )
    return Lattice(obstacles, nodes, edges)


def _neighbours(counts: IntArray, is_free: BoolArray) -> Iterator[tuple[IntArray, IntArray, float]]:
    """Pairs of free nodes that are a step apart, and the step's length, for each of `STEPS`."""
    index = np.arange(counts.prod()).reshape(tuple(counts))
    nx, ny = counts
    for dx, dy in STEPS:
        here = index[: nx - dx, max(0, -dy) : ny - max(0, dy)].ravel()
        there = index[dx:, max(0, dy) : ny + min(0, dy)].ravel()
        both = is_free[here] & is_free[there]
        yield here[both], there[both], SPACING * float(np.hypot(dx, dy))


def _shut(
    obstacles: Obstacles,
    ends: FloatArray,
    length: float,
    from_cable: FloatArray,
    from_robots: FloatArray,
) -> BoolArray:
    """Which edges cable crosses or a robot is too near to; distances are those of their starts."""
    shut = np.zeros(len(ends), dtype=bool)
    close = from_cable < 2 * length
    shut[close] = shapely.intersects(shapely.linestrings(ends[close]), obstacles.cable)
    close = from_robots < obstacles.clear + length
    robots = shapely.multipoints(obstacles.robots)
    shut[close] |= shapely.distance(shapely.linestrings(ends[close]), robots) < obstacles.clear
    return shut
