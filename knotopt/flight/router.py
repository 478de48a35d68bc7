"""The way of the leader over one span: through gates in laid cable, in the order of its word.

Every letter has a layer of gates that it may take, before them is the layer of the start and after
them that of the goal. A chain has one gate of each layer. Between the gates of two layers the way
is the shortest one on a lattice, so the best chain is found by dynamic programming from layer to
layer. Lengths are in grid steps, in plan.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
import shapely

from knotopt.arrays import FloatArray, IntArray
from knotopt.flight.gates import (
    Crossed,
    Gate,
    RouteShape,
    all_in_order,
    are_in_order,
    possible_gates,
)
from knotopt.flight.lattice import HIDDEN, Lattice, ShortestWays, build_lattice
from knotopt.flight.layout import Letter
from knotopt.flight.obstacles import Obstacles, nearest


@dataclass(frozen=True, eq=False)
class Way:
    """A route over one span in plan: `points` from robot to robot, through `gates`."""

    points: FloatArray
    gates: tuple[Gate, ...]


@dataclass(frozen=True)
class Layer:
    """The gates that one letter may take; none at the start and the goal, which are single points.

    Attributes
    ----------
    gates : list of Gate
    enters, leaves : list of int
        Node of the lattice that is seen from where each gate's straight run begins, and ends.
    """

    gates: list[Gate]
    enters: list[int]
    leaves: list[int]


@dataclass(frozen=True, eq=False)
class Link:
    """From one layer to the next: the shortest ways, and which of them are the best.

    Attributes
    ----------
    ways : ShortestWays
        From every gate of the layer to every gate of the next.
    best : int array, shape (gates of the next layer,)
        For each gate of the next layer, the gate to come from.
    """

    ways: ShortestWays
    best: IntArray


class Router:
    """Finds ways over one span, past cable that is laid already.

    Parameters
    ----------
    laid : sequence of float arrays, shape (m, 2)
        Spans 1, 2, ... in plan, as they lie.
    robots : float array, shape (k, 2)
        Hovering robots.
    start, goal : float arrays, shape (2,)
    shape : RouteShape
    barriers : sequence of float arrays, shape (m, 2)
        Other cable that is not to be crossed, such as the leader's own.
    """

    def __init__(
        self,
        laid: Sequence[FloatArray],
        robots: FloatArray,
        start: FloatArray,
        goal: FloatArray,
        shape: RouteShape,
        barriers: Sequence[FloatArray] = (),
    ) -> None:
        self.start, self.goal, self.shape = start, goal, shape
        lines = tuple(shapely.LineString(points) for points in laid)
        cable = shapely.union_all([*lines, *(shapely.LineString(points) for points in barriers)])
        others = robots[nearest(robots, np.stack((start, goal))) > 1e-6]
        posts = np.concatenate((robots, goal[None]))
        self.obstacles = Obstacles(lines, cable, others, posts, shape.clear)
        self.lattice: Lattice = build_lattice(self.obstacles, start, goal)

    def find(self, word: Sequence[Letter], crossed: Crossed) -> Way | None:
        """The shortest way with these letters, or None if there is none.

        Parameters
        ----------
        word : sequence of Letter
        crossed : Crossed
            Crossings that the laid spans have already; a letter keeps its place among them.

        Notes
        -----
        O(n g (V log V + g)) for n letters with at most g gates each and V nodes of the lattice. The
        best chain is sought with neighbouring letters in order along a span that both cross; if
        letters that are no neighbours are not, None is returned although another chain may do.
        """
        layers = self._layers(word, crossed)
        if layers is None:
            return None
        links, length = self._linked(layers)
        if not np.isfinite(length):
            return None
        chain = _best_chain(links)
        gates = tuple(layer.gates[k] for layer, k in zip(layers[1:-1], chain[1:-1], strict=True))
        if not all_in_order(gates, self.shape.apart):
            return None
        return Way(self._points(links, chain, gates), gates)

    def _layers(self, word: Sequence[Letter], crossed: Crossed) -> list[Layer] | None:
        """Start, a layer for every letter, goal; None if a letter has no gate or an end no node."""
        every = [possible_gates(x, crossed, self.obstacles, self.shape.run) for x in word]
        if not all(every):
            return None
        seen_from = self.lattice.seen_from
        first, last = seen_from(self.start), seen_from(self.goal)
        if HIDDEN in (first, last):
            return None
        inner = [
            Layer(
                gates,
                [seen_from(gate.entry) for gate in gates],
                [seen_from(gate.exit) for gate in gates],
            )
            for gates in every
        ]
        return [Layer([], [], [first]), *inner, Layer([], [last], [])]

    def _linked(self, layers: Sequence[Layer]) -> tuple[list[Link], float]:
        """The links between layers, and the weighted length of the shortest chain to the goal."""
        links = []
        length = np.zeros(1)  # of the shortest chain to each gate of a layer
        for before, after in pairwise(layers):
            ways = self.lattice.shortest_ways(before.leaves, after.enters)
            total = length[:, None] + self._step_costs(ways, before.gates, after.gates)
            links.append(Link(ways, np.argmin(total, axis=0)))
            length = total.min(axis=0)
        return links, float(length[0])

    def _step_costs(
        self, ways: ShortestWays, before: Sequence[Gate], after: Sequence[Gate]
    ) -> FloatArray:
        """Of going from gates of one layer to gates of the next; short straight runs cost more."""
        costs = ways.lengths
        if before and after:
            costs = np.where(are_in_order(before, after, self.shape.apart), costs, np.inf)
        if after:
            costs = costs + [2 * (self.shape.run - gate.run) for gate in after]
        return costs

    def _points(
        self, links: Sequence[Link], chain: Sequence[int], gates: Sequence[Gate]
    ) -> FloatArray:
        """The way through a chain's gates, its detours between them pulled straight."""
        begins = [self.start, *(gate.exit for gate in gates)]
        ends = [*(gate.entry for gate in gates), self.goal]
        points: list[FloatArray] = []
        for k, (link, begin, end) in enumerate(zip(links, begins, ends, strict=True)):
            nodes = self.lattice.nodes[link.ways.nodes(chain[k], chain[k + 1])]
            piece = np.concatenate(([begin], nodes, [end]))
            points.append(self.obstacles.pulled_straight(piece))
            if k < len(gates):
                points.append(np.array([gates[k].place]))
        return np.concatenate(points)


def _best_chain(links: Sequence[Link]) -> list[int]:
    """The number of the gate in every layer on the shortest chain, followed back from the goal."""
    chain = [0]
    for link in reversed(links):
        chain.append(int(link.best[chain[-1]]))
    return chain[::-1]
