"""Where the states, lines and labels of a drawing of plans go. Lengths are in inches."""

from __future__ import annotations

from collections import defaultdict
from dataclasses import dataclass
from functools import lru_cache
from itertools import combinations, pairwise

import numpy as np
from matplotlib.font_manager import FontProperties
from matplotlib.textpath import TextPath

from knotopt.arrays import FloatArray
from knotopt.plot.layers import Vertex, layered
from knotopt.topology.actions import Action
from knotopt.topology.plan import PlanGraph
from knotopt.topology.state import RopeState

FONT = 6.0  # of labels [points]
LINE = 0.1  # of text, in height
AIR = 0.12  # between frames, and between labels and frames
LABELLED_SIDE, BARE_SIDE = 0.7, 0.56  # of the frames, with labels at the lines and without
BARE_GAP = 0.4  # between columns, without labels
MOST_LABELLED = 40  # pairs of states joined, for their actions to be written at the lines
SHARES = np.linspace(0, 1, 61)  # of a line, where its label may go

Pair = tuple[RopeState, RopeState]
Joined = dict[Pair, list[Action]]


@dataclass(frozen=True)
class Label:
    """Actions written one above the other, in a box about a place."""

    actions: list[Action]
    x: float
    y: float

    @property
    def width(self) -> float:
        """Of the box."""
        return max(text_width(str(action)) for action in self.actions) + 0.04

    @property
    def height(self) -> float:
        """Of the box."""
        return LINE * len(self.actions)

    def overlap(self, other: Label) -> float:
        """Area that two boxes share."""
        wide = (self.width + other.width) / 2 - abs(self.x - other.x)
        high = (self.height + other.height) / 2 - abs(self.y - other.y)
        return max(0.0, wide) * max(0.0, high)

    def covered(self, points: FloatArray) -> int:
        """How many points, shape (k, 2), lie in the box."""
        away = np.abs(points - (self.x, self.y))
        return int((2 * away < (self.width, self.height)).all(axis=1).sum())


@dataclass(frozen=True)
class Layout:
    """A drawing of plans.

    Attributes
    ----------
    side : float
        Of the states' square frames.
    place : dict from state to (x, y)
        Middles of the frames.
    columns : dict from int to float
        x of the states with that many crossings.
    lines : dict from pair of states to float array, shape (k, 2)
        From frame to frame.
    labels : list of Label
        Empty if they are left out.
    """

    side: float
    place: dict[RopeState, tuple[float, float]]
    columns: dict[int, float]
    lines: dict[Pair, FloatArray]
    labels: list[Label]

    @property
    def extent(self) -> tuple[FloatArray, FloatArray]:
        """Lower left and upper right corner of what is drawn."""
        middles = np.array(list(self.place.values()))
        corners = [middles - self.side / 2, middles + self.side / 2, *self.lines.values()]
        for label in self.labels:
            half = np.array((label.width, label.height)) / 2
            corners.append(np.array((label.x, label.y)) + np.outer((-1, 1), half))
        points = np.concatenate(corners)
        return points.min(axis=0), points.max(axis=0)


def joined_states(graph: PlanGraph, plans: int | None) -> Joined:
    """The actions from one state to another, on the first plans or on all."""
    joined: Joined = defaultdict(list)
    for before, after, action in graph.to_networkx().edges(data="action"):
        joined[before, after].append(action)
    if plans is None:
        return dict(joined)
    steps = {
        step
        for plan in graph.plans(plans)
        for step in zip(plan.states[:-1], plan.actions, plan.states[1:], strict=True)
    }
    kept = {(s, t): [a for a in joined[s, t] if (s, a, t) in steps] for s, t in joined}
    return {pair: actions for pair, actions in kept.items() if actions}


def laid_out(start: RopeState, joined: Joined) -> Layout:
    """States in columns by their numbers of crossings, plans running from left to right."""
    is_labelled = len(joined) <= MOST_LABELLED
    side = LABELLED_SIDE if is_labelled else BARE_SIDE
    states = sorted({start}.union(*joined), key=lambda state: (state.crossings, state.code))
    layers: dict[int, list[Vertex]] = defaultdict(list)
    for state in states:
        layers[state.crossings].append(state)
    chains: dict[Pair, list[Vertex]] = {}  # each line, with where it passes columns between
    for before, after in joined:
        bends = [(before, after, n) for n in layers if before.crossings < n < after.crossings]
        for bend in bends:
            layers[bend[-1]].append(bend)
        chains[before, after] = [before, *bends, after]
    room = {
        vertex: side + AIR if isinstance(vertex, RopeState) else side / 3
        for layer in layers.values()
        for vertex in layer
    }
    hops = [hop for chain in chains.values() for hop in pairwise(chain)]
    up = layered(list(layers.values()), hops, room)

    columns: dict[int, float] = {}
    x = 0.0
    for number, layer in layers.items():
        columns[number] = x
        x += side + BARE_GAP
        if is_labelled:
            starting = [a for pair, actions in joined.items() if pair[0] in layer for a in actions]
            width = max((text_width(str(action)) for action in starting), default=0.0)
            hopping = [(up[a], up[b]) for a, b in hops if a in layer]
            tangles = sum((a - c) * (b - d) < 0 for (a, b), (c, d) in combinations(hopping, 2))
            x += width * (1 + min(tangles, 2)) + 2 * AIR - BARE_GAP
    where = {v: (columns[number], up[v]) for number, layer in layers.items() for v in layer}
    lines = {}
    for pair, chain in chains.items():
        sides = [(where[v][0] + end * side / 2, where[v][1]) for v in chain for end in (-1, 1)]
        lines[pair] = np.array(sides[1:-1])
    labels = _labels(lines, joined) if is_labelled else []
    return Layout(side, {state: where[state] for state in states}, columns, lines, labels)


def _labels(lines: dict[Pair, FloatArray], joined: Joined) -> list[Label]:
    """A label on the first piece of each line, off the labels before it and other lines."""
    along = {
        pair: np.concatenate([a + SHARES[:, None] * (b - a) for a, b in pairwise(line)])
        for pair, line in lines.items()
    }
    labels: list[Label] = []
    for pair, actions in joined.items():
        start, end = lines[pair][:2]
        others = np.concatenate([np.empty((0, 2)), *(along[p] for p in along if p != pair)])
        half = Label(actions, 0, 0).width / 2 / (end[0] - start[0])
        shares = half + SHARES * (1 - 2 * half)
        candidates = [Label(actions, *(start + s * (end - start)).tolist()) for s in shares]
        costs = [
            (
                sum(label.overlap(other) for other in labels),
                label.covered(others) // 3,
                abs(share - 0.5),
            )
            for label, share in zip(candidates, shares, strict=True)
        ]
        labels.append(candidates[costs.index(min(costs))])
    return labels


@lru_cache(maxsize=1024)
def text_width(text: str, font: float = FONT) -> float:
    """Of a text in a font of a size [points]."""
    path = TextPath((0, 0), text, prop=FontProperties(family="DejaVu Sans", size=font))
    return float(path.get_extents().width) / 72
