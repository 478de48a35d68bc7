"""Places for the vertices of a layered directed graph: few edges cross, and edges are short."""

from __future__ import annotations

from collections.abc import Hashable, Iterable, Mapping, Sequence
from itertools import accumulate, pairwise
from statistics import mean

SWEEPS = 24  # that order the layers
MOST_SWEEPS = 1000  # that place the vertices
SETTLED = 1e-5  # of a vertex's room: moves that no longer count
SPRING = 0.01  # that draws a vertex to the middle line, against 1 of an edge

Vertex = Hashable
Edge = tuple[Vertex, Vertex]


def layered(
    layers: Sequence[Sequence[Vertex]], edges: Iterable[Edge], room: Mapping[Vertex, float]
) -> dict[Vertex, float]:
    """How far up each vertex lies in its layer.

    Parameters
    ----------
    layers : sequence of sequences of vertices
        In the order to start from; the same input gives the same places.
    edges : iterable of pairs of vertices
        Each from a layer to the next one.
    room : mapping from vertex to float
        Height that it takes up.

    Returns
    -------
    dict from vertex to float
        Of its middle.

    Notes
    -----
    The order in the layers is by barycentres and exchanges of neighbours, layer after layer forth
    and back (Sugiyama, Tagawa and Toda, doi:10.1109/TSMC.1981.4308636); the places in this order
    make the sum of squares of the edges' rises least.
    """
    near: dict[Vertex, list[Vertex]] = {v: [] for layer in layers for v in layer}
    for a, b in edges:
        near[a].append(b)
        near[b].append(a)
    order = [list(layer) for layer in layers]
    best = [list(layer) for layer in order]
    fewest = _crossings(best, near)
    for sweep in range(SWEEPS):
        numbers = range(len(order))
        for fixed, moved in pairwise(numbers if sweep % 2 == 0 else reversed(numbers)):
            place = {v: k for k, v in enumerate(order[fixed])}
            beside = {v: [place[u] for u in near[v] if u in place] for v in order[moved]}
            old = {v: k for k, v in enumerate(order[moved])}
            order[moved].sort(key=lambda v: mean(beside[v]) if beside[v] else old[v])
            _exchange(order[moved], beside)
        crossings = _crossings(order, near)
        if crossings < fewest:
            best, fewest = [list(layer) for layer in order], crossings
    return _places(best, near, room)


def _exchange(layer: list[Vertex], beside: Mapping[Vertex, list[int]]) -> None:
    """Exchange neighbours in a layer while that saves crossings of edges to the layer beside it."""
    improved = True
    while improved:
        improved = False
        for k in range(len(layer) - 1):
            low, high = layer[k], layer[k + 1]
            crossed = sum(a > b for a in beside[low] for b in beside[high])
            if crossed > sum(a < b for a in beside[low] for b in beside[high]):
                layer[k], layer[k + 1] = high, low
                improved = True


def _crossings(order: list[list[Vertex]], near: Mapping[Vertex, list[Vertex]]) -> int:
    total = 0
    for left, right in pairwise(order):
        place = {v: k for k, v in enumerate(right)}
        ends = [sorted(place[u] for u in near[v] if u in place) for v in left]
        for k, lower in enumerate(ends):
            total += sum(a > b for upper in ends[k + 1 :] for a in lower for b in upper)
    return total


def _places(
    order: list[list[Vertex]], near: Mapping[Vertex, list[Vertex]], room: Mapping[Vertex, float]
) -> dict[Vertex, float]:
    """Layer after layer is placed at its best, given the others: isotonic regression."""
    above: dict[Vertex, float] = {}  # the first of its layer, at least
    place: dict[Vertex, float] = {}
    for layer in order:
        steps = [(room[a] + room[b]) / 2 for a, b in pairwise(layer)]
        above |= dict(zip(layer, accumulate(steps, initial=0.0), strict=True))
        place |= {vertex: above[vertex] - above[layer[-1]] / 2 for vertex in layer}
    for sweep in range(MOST_SWEEPS):
        moved = 0.0
        for layer in order if sweep % 2 == 0 else reversed(order):
            weights = [len(near[v]) + SPRING for v in layer]
            wanted = [
                sum(place[u] for u in near[v]) / weight - above[v]
                for v, weight in zip(layer, weights, strict=True)
            ]
            for v, x in zip(layer, _rising(wanted, weights), strict=True):
                moved = max(moved, abs(x + above[v] - place[v]))
                place[v] = x + above[v]
        if moved < SETTLED * max(room.values()):
            break
    return place


def _rising(values: list[float], weights: list[float]) -> list[float]:
    """The sequence that nowhere falls with the least weighted sum of squares from `values`."""
    pools: list[tuple[float, float, int]] = []  # mean, weight, number of values
    for value, weight in zip(values, weights, strict=True):
        pools.append((value, weight, 1))
        while len(pools) > 1 and pools[-2][0] >= pools[-1][0]:
            (a, v, m), (b, w, n) = pools[-2:]
            pools[-2:] = [((a * v + b * w) / (v + w), v + w, m + n)]
    return [value for value, _, count in pools for _ in range(count)]
