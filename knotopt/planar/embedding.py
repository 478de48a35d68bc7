"""Closed curves in the plane from the order of their crossings: which way each crossing turns.

A curve that crosses itself transversally at each of its double points is drawn from its Gauss word
by embedding a graph: each crossing is a wheel, whose rim is met by the two passes in turn. A wheel
is 3-connected, so that every planar embedding has its spokes in that order or in the reverse one
(Whitney, doi:10.2307/2371086), and the embedding is the curve.

The parts of a curve that are not linked with the rest, crossings of one connected component of the
interlacement graph, can each be reflected by themselves, and in no other way is the curve drawn
otherwise on the sphere: for one part, a prime curve, up to mirror image (Dowker and Thistlethwaite,
"Classification of knot projections", doi:10.1016/0166-8641(83)90004-4).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import networkx as nx

from knotopt.errors import DiagramError


def handedness(visits: Sequence[int]) -> list[int]:
    """How a closed curve crosses itself in the plane, from its Gauss word.

    Parameters
    ----------
    visits : sequence of int, length 2C
        Index (from 0) of the crossing at each visit; each twice.

    Returns
    -------
    list of +1 or -1, length C
        Of each crossing: +1 where the second visit passes from the right to the left of the first.

    Raises
    ------
    DiagramError
        No closed curve in the plane has this word: the message names a crossing or visit.
    """
    _check_parity(visits)
    planar, embedding = nx.check_planarity(_graph(visits, closed=True))
    if not planar:
        raise DiagramError(_where_it_ends(visits))
    hands = []
    for crossing in range(len(visits) // 2):
        hub, first_in, second_in, *_ = _wheel(crossing)
        spokes = list(embedding.neighbors_cw_order(hub))
        before = spokes[spokes.index(first_in) - 1]
        hands.append(1 if before == second_in else -1)
    return hands


def parts(visits: Sequence[int]) -> list[list[int]]:
    """Crossings that can only be reflected together, each part in the order of first visits.

    Parameters
    ----------
    visits : sequence of int, length 2C
        Index (from 0) of the crossing at each visit; each twice.

    Examples
    --------
    Two trefoils, one after the other, and a crossing within the second:

    >>> parts([0, 1, 2, 0, 1, 2, 3, 4, 5, 3, 6, 6, 4, 5])
    [[0, 1, 2], [3, 4, 5], [6]]
    """
    # Parts with a crossing that still waits for its second visit, the latest begun last. One begun
    # after the first visit of a crossing that is now met again is interlaced with that crossing.
    waiting: list[_Part] = []
    first: dict[int, int] = {}
    done = []
    for visit, crossing in enumerate(visits):
        if crossing not in first:
            first[crossing] = visit
            waiting.append(_Part(visit, [crossing], 1))
            continue
        while waiting[-1].begun > first[crossing]:
            last = waiting.pop()
            waiting[-1].crossings += last.crossings
            waiting[-1].open += last.open
        waiting[-1].open -= 1
        if not waiting[-1].open:
            done.append(waiting.pop())
    done.sort(key=lambda part: part.begun)
    return [sorted(part.crossings, key=first.__getitem__) for part in done]


@dataclass
class _Part:
    """Crossings found to be one part: first visit, and how many wait for their second."""

    begun: int
    crossings: list[int]
    open: int


def _wheel(crossing: int) -> range:
    """A crossing's nodes: hub; first visit in, second in, first out, second out."""
    return range(5 * crossing, 5 * crossing + 5)


def _graph(visits: Sequence[int], closed: bool) -> nx.Graph:
    """The curve, or the path through its first visits, as a graph with a wheel at each crossing."""
    graph = nx.Graph()
    last = {crossing: visit for visit, crossing in enumerate(visits)}
    met: set[int] = set()
    ends = []  # where the curve comes in and goes out at each visit
    for visit, crossing in enumerate(visits):
        hub, first_in, second_in, first_out, second_out = _wheel(crossing)
        if crossing in met:
            ends.append((second_in, second_out))
            continue
        met.add(crossing)
        ends.append((first_in, first_out))
        if last[crossing] > visit:
            nx.add_cycle(graph, (first_in, second_in, first_out, second_out))
            nx.add_star(graph, (hub, first_in, second_in, first_out, second_out))
        else:
            graph.add_edge(first_in, first_out)
    for (_, out), (into, _) in zip(ends, ends[1:] + ends[:1] * closed, strict=False):
        graph.add_edge(out, into)
    return graph


def _check_parity(visits: Sequence[int]) -> None:
    """Gauss's condition: between the two visits of a crossing lies an even number of others."""
    first: dict[int, int] = {}
    for visit, crossing in enumerate(visits):
        before = first.setdefault(crossing, visit)
        if before != visit and (visit - before) % 2 == 0:
            raise DiagramError(
                f"visits {before + 1} and {visit + 1} are of one crossing with an odd number of "
                "visits between them, so the code cannot be drawn in the plane (a virtual knot)"
            )


def _where_it_ends(visits: Sequence[int]) -> str:
    """A sentence that names the first visit that the curve cannot be led to in the plane."""
    drawn, beyond = 1, len(visits) + 1  # visits that can be reached; that cannot
    while beyond - drawn > 1:
        middle = (drawn + beyond) // 2
        if nx.check_planarity(_graph(visits[:middle], closed=False))[0]:
            drawn = middle
        else:
            beyond = middle
    place = (
        f"visit {beyond} is cut off from visit {drawn}"
        if beyond <= len(visits)
        else f"visit 1 is cut off from the last one, {drawn}"
    )
    return f"{place}: the code cannot be drawn in the plane (a virtual knot)"
