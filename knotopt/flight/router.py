"""The way of the leader over one span: through gates in laid cable, in the order of its word.

A gate is a place where a laid span is crossed at a right angle, with a straight run before and
after it. Gates are chosen together, by dynamic programming over candidates for each letter; between
gates the way is the shortest one on a lattice that crosses no laid cable and keeps away from
hovering robots. Lengths are in grid steps, in plan.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
import shapely
from scipy.sparse import csr_array
from scipy.sparse.csgraph import dijkstra

from knotopt.arrays import FloatArray, IntArray
from knotopt.flight.layout import Letter

LATTICE = 0.2  # between nodes
MARGIN = 2.5  # free room around everything
PLACES = 0.2  # between candidates along a span
NEAR = 0.4  # laid cable: closer than this costs more
STEPS = ((1, 0), (0, 1), (1, 1), (1, -1), (2, 1), (1, 2), (2, -1), (1, -2))


@dataclass(frozen=True)
class RouteShape:
    """How generously a route goes through gates and past robots [grid steps].

    Parameters
    ----------
    run : float
        Straight run before and after each crossing.
    apart : float
        Between two crossings of one span, along it.
    clear : float
        From hovering robots.
    """

    run: float = 0.6
    apart: float = 0.8
    clear: float = 0.4


@dataclass(frozen=True)
class Gate:
    """Where a route crosses a laid span.

    Attributes
    ----------
    letter : Letter
    place, heading : tuple of float
        Where, and the unit vector of flight there.
    run : float
        Straight run before and after.
    along : float
        Arc length of the place on the older span, in plan.
    """

    letter: Letter
    place: tuple[float, float]
    heading: tuple[float, float]
    run: float
    along: float

    @property
    def entry(self) -> FloatArray:
        """Where the straight run begins."""
        return np.array(self.place) - self.run * np.array(self.heading)

    @property
    def exit(self) -> FloatArray:
        """Where the straight run ends."""
        return np.array(self.place) + self.run * np.array(self.heading)


@dataclass(frozen=True, eq=False)
class Way:
    """A route over one span in plan: `points` from robot to robot, through `gates`."""

    points: FloatArray
    gates: tuple[Gate, ...]


Crossed = Mapping[int, Sequence[tuple[float | None, float]]]
"""For each span, its crossings so far: time on the grid, if any, arc length along the span."""


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
        self.laid = [shapely.LineString(points) for points in laid]
        every_cable = [*self.laid, *(shapely.LineString(points) for points in barriers)]
        self._has_cable = bool(every_cable)
        self.start, self.goal, self.shape = start, goal, shape
        ends = np.stack((start, goal))
        others = robots[[bool(np.hypot(*(ends - robot).T).min() > 1e-6) for robot in robots]]
        self.robots = others.reshape(-1, 2)
        self._posts = np.concatenate((robots, goal[None]))  # what gates keep away from
        self._union = shapely.union_all(every_cable)
        every = np.concatenate([ends, self.robots, *laid])
        low, high = every.min(axis=0) - MARGIN, every.max(axis=0) + MARGIN
        counts = np.ceil((high - low) / LATTICE).astype(int) + 1
        self._low, self._counts = low, counts
        grid = np.stack(np.meshgrid(*map(np.arange, counts), indexing="ij"), axis=-1)
        self.nodes = low + LATTICE * grid.reshape(-1, 2)
        self._graph = self._lattice()

    def _lattice(self) -> csr_array:
        """Lattice edges that cross no laid cable, with costs."""
        points = shapely.points(self.nodes)
        near = (
            shapely.distance(points, self._union) if self._has_cable else np.full(len(points), NEAR)
        )
        weight = 1 + 3 * np.clip(1 - near / NEAR, 0, 1)
        weight += 2 * (_nearest(self.nodes, self._posts) < self.shape.clear)
        apart = _nearest(self.nodes, self.robots)
        blocked, posts = apart < self.shape.clear, shapely.multipoints(self.robots)
        rows, columns, costs = [], [], []
        index = np.arange(len(self.nodes)).reshape(tuple(self._counts))
        for dx, dy in STEPS:
            nx, ny = self._counts
            here = index[: nx - dx, max(0, -dy) : ny - max(0, dy)].ravel()
            there = index[dx:, max(0, dy) : ny + min(0, dy)].ravel()
            free = ~blocked[here] & ~blocked[there]
            here, there = here[free], there[free]
            length = LATTICE * np.hypot(dx, dy)
            ends = np.stack((self.nodes[here], self.nodes[there]), axis=1)
            shut = np.zeros(len(here), dtype=bool)
            if self._has_cable:
                close = near[here] < 2 * length
                shut[close] = shapely.intersects(shapely.linestrings(ends[close]), self._union)
            if len(self.robots):
                close = apart[here] < self.shape.clear + length
                lines = shapely.linestrings(ends[close])
                shut[close] |= shapely.distance(lines, posts) < self.shape.clear
            here, there = here[~shut], there[~shut]
            rows.append(here)
            columns.append(there)
            costs.append(length * (weight[here] + weight[there]) / 2)
        size = len(self.nodes)
        return csr_array(
            (np.concatenate(costs), (np.concatenate(rows), np.concatenate(columns))),
            shape=(size, size),
        )

    def _attach(self, point: FloatArray) -> int:
        """The nearest lattice node that is seen from a point, or -1."""
        apart = np.linalg.norm(self.nodes - point, axis=1)
        order = np.argsort(apart)[:24]
        free = _nearest(self.nodes[order], self.robots) >= self.shape.clear
        for node in order[free]:
            sight = shapely.LineString([point, self.nodes[node]])
            if apart[node] < 1e-9 or not self._blocks(sight, point):
                return int(node)
        return -1

    def _blocks(self, sight: shapely.LineString, end: FloatArray) -> bool:
        """Whether laid cable crosses a line, other than where the line starts at its robot."""
        if not sight.intersects(self._union):
            return False
        met = sight.intersection(self._union)
        return bool(shapely.hausdorff_distance(met, shapely.Point(end)) > 1e-6)

    def candidates(self, letter: Letter, crossed: Crossed) -> list[Gate]:
        """Gates for a letter: places on its span between that span's neighbouring crossings."""
        line = self.laid[letter.older - 1]
        first = letter.rank
        others = [(t, a) for t, a in crossed.get(letter.older, ()) if t is not None]
        before = [a for t, a in others if first is not None and t < first]
        after = [a for t, a in others if first is not None and t > first]
        low = max(before, default=0.0)
        high = min(after, default=line.length)
        found = []
        for along in np.arange(PLACES, line.length, PLACES).tolist():
            if not low < along < high:
                continue
            ends = (max(along - 0.05, 0), min(along + 0.05, line.length))
            a, b = (np.array(line.interpolate(end).coords[0]) for end in ends)
            ahead = (b - a) / np.hypot(*(b - a))
            heading = letter.sense * np.array([-ahead[1], ahead[0]])
            place = np.array(line.interpolate(along).coords[0])
            for run in (self.shape.run, 0.7 * self.shape.run, 0.5 * self.shape.run):
                gate = Gate(
                    letter, (place[0], place[1]), (heading[0], heading[1]), run, float(along)
                )
                if self._is_free(gate):
                    found.append(gate)
                    break
        return found

    def _is_free(self, gate: Gate) -> bool:
        """Whether a gate's run meets no other cable and no robot."""
        ends = np.stack((gate.entry, np.array(gate.place), gate.exit))
        if _nearest(ends, self._posts).min() < self.shape.clear:
            return False
        share = 0.02 / gate.run
        halves = [
            shapely.LineString([ends[1] + share * (ends[k] - ends[1]), ends[k]]) for k in (0, 2)
        ]
        return not any(half.intersects(self._union) for half in halves)

    def find(self, word: Sequence[Letter], crossed: Crossed) -> Way | None:
        """The shortest way with these letters, or None if there is none.

        Parameters
        ----------
        word : sequence of Letter
        crossed : Crossed
            Crossings that the laid spans have already; a letter keeps its place among them.
        """
        layers = [self.candidates(letter, crossed) for letter in word]
        if not all(layers):
            return None
        first = self._attach(self.start)
        last = self._attach(self.goal)
        if first < 0 or last < 0:
            return None
        leaves = [[first]]
        enters = []
        for layer in layers:
            enters.append([self._attach(gate.entry) for gate in layer])
            leaves.append([self._attach(gate.exit) for gate in layer])
        enters.append([last])
        cost = np.zeros(1)
        choice: list[IntArray] = []
        trees: list[IntArray] = []
        for k, entering in enumerate(enters):
            sources = np.array(leaves[k])
            apart, tree = dijkstra(
                self._graph,
                directed=False,
                indices=np.maximum(sources, 0),
                return_predecessors=True,
            )
            apart[sources < 0] = np.inf
            move = apart[:, entering]
            move[:, np.array(entering) < 0] = np.inf
            if 0 < k < len(enters) - 1:
                move = move + self._penalty(layers[k - 1], layers[k])
            if k < len(layers):
                move = move + [2 * (self.shape.run - gate.run) for gate in layers[k]]
            total = cost[:, None] + move
            choice.append(np.argmin(total, axis=0))
            cost = total.min(axis=0)
            trees.append(tree)
        if not np.isfinite(cost[0]):
            return None
        way = self._trace(layers, enters, leaves, choice, trees)
        return way if self._keeps_order(way.gates) else None

    def _keeps_order(self, gates: Sequence[Gate]) -> bool:
        """Whether gates of one span that do not follow each other are apart and in order, too."""
        for k, gate in enumerate(gates):
            for other in gates[:k]:
                if gate.letter.older == other.letter.older and np.isinf(
                    self._penalty([other], [gate])[0, 0]
                ):
                    return False
        return True

    def _penalty(self, before: list[Gate], after: list[Gate]) -> FloatArray:
        """Infinite for gates of one span too near each other, or in the wrong order."""
        penalty = np.zeros((len(before), len(after)))
        if before[0].letter.older == after[0].letter.older:
            a = np.array([gate.along for gate in before])
            b = np.array([gate.along for gate in after])
            ahead = b[None] - a[:, None]
            times = before[0].letter.rank, after[0].letter.rank
            if times[0] is not None and times[1] is not None:
                ahead *= np.sign(times[1] - times[0])
            else:
                ahead = np.abs(ahead)
            penalty[ahead < self.shape.apart - 1e-9] = np.inf
        return penalty

    def _trace(
        self,
        layers: list[list[Gate]],
        enters: list[list[int]],
        leaves: list[list[int]],
        choice: list[IntArray],
        trees: list[IntArray],
    ) -> Way:
        picked: list[int] = [0]
        for k in range(len(enters) - 1, -1, -1):
            picked.insert(0, int(choice[k][picked[0]]))
        gates = tuple(layer[picked[k + 1]] for k, layer in enumerate(layers))
        points: list[FloatArray] = []
        begin = self.start
        for k in range(len(enters)):
            source, node = leaves[k][picked[k]], enters[k][picked[k + 1]]
            chain = [node]
            while chain[-1] != source:
                chain.append(int(trees[k][picked[k], chain[-1]]))
            end = gates[k].entry if k < len(gates) else self.goal
            piece = np.concatenate(([begin], self.nodes[chain[::-1]], [end]))
            points.append(self._pull(piece))
            if k < len(gates):
                points.append(np.array([gates[k].place]))
                begin = gates[k].exit
        return Way(np.concatenate(points), gates)

    def _pull(self, points: FloatArray) -> FloatArray:
        """A piece between gates with its detours pulled straight."""
        kept = [0]
        while kept[-1] < len(points) - 1:
            i = kept[-1]
            best = i + 1
            for j in range(i + 2, len(points)):
                if self._sees(points[i : j + 1]):
                    best = j
            kept.append(best)
        return points[kept]

    def _sees(self, piece: FloatArray) -> bool:
        """Whether a piece may be replaced by the straight line between its ends."""
        line = shapely.LineString(piece[[0, -1]])
        if len(self.robots):
            robots = shapely.points(self.robots)
            if shapely.distance(line, robots).min() < self.shape.clear:
                return False
        if not self._has_cable:
            return True
        ends = [shapely.distance(shapely.Point(end), self._union) for end in (piece[0], piece[-1])]
        inner = shapely.distance(shapely.points(piece[1:-1]), self._union).min()
        if self._blocks(line, piece[0]) and self._blocks(line, piece[-1]):
            return False
        room = min(NEAR, float(inner), *map(float, ends)) - 0.05
        middle = shapely.LineString([piece[0] + s * (piece[-1] - piece[0]) for s in (0.02, 0.98)])
        return not middle.intersects(self._union) and bool(
            room <= 0 or line.distance(self._union) >= room
        )


def _nearest(points: FloatArray, robots: FloatArray) -> FloatArray:
    """Distance of each point from the nearest robot."""
    if not len(robots):
        return np.full(len(points), np.inf)
    apart: FloatArray = np.linalg.norm(points[:, None] - robots[None], axis=2).min(axis=1)
    return apart
