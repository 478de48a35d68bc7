"""Connected sums of grid diagrams, and back to the summands.

Read as an arc presentation, a grid diagram has its rows as points of an axis and its columns as
pages that open along it, each with one arc. The sum of two is made by putting one above the other
and joining the pages at the lowest point of the one with those at the highest of the other, so that
arc indices add up to a1 + a2 - 2 (Cromwell, "Embedding knots and links in an open book I",
doi:10.1016/0166-8641(94)00087-J).

Back, a sphere about a piece of the axis that only two pages leave splits the knot. Every grid
diagram of a composite knot comes to one with such a piece by commutations and destabilisations
(Dynnikov, "Arc-presentations of links: monotonic simplification", doi:10.4064/fm190-0-3); here a
random walk looks for it.
"""

from __future__ import annotations

import random
from collections.abc import Iterator, Sequence
from functools import reduce

from knotopt.diagram.grid import GridDiagram
from knotopt.diagram.simplify import SMALLEST_KNOTTED, simplify
from knotopt.diagram.walk import Lists, columns_of, lists_of, walk
from knotopt.errors import GridError


def connected_sum(grids: Sequence[GridDiagram]) -> GridDiagram:
    """Connected sum of oriented knots, of size a1 + a2 + ... - 2 (k - 1).

    With summands at their arc indices it is at its own.

    Parameters
    ----------
    grids : sequence of GridDiagram
        One or more. Their orientations agree along the sum, which matters for knots that are not
        invertible.

    Raises
    ------
    GridError
        There is no summand.

    Examples
    --------
    >>> from knotopt.diagram.families import torus_knot
    >>> connected_sum([torus_knot(2, 3), torus_knot(2, 3), torus_knot(2, -5)]).size
    13
    """
    if not grids:
        raise GridError("a connected sum needs at least one grid diagram")
    return reduce(_sum, grids)


def _sum(above: GridDiagram, below: GridDiagram) -> GridDiagram:
    """The rows of one above those of the other, without its lowest and the other's highest."""
    top, shift = below.size, below.size - 2
    up, down = above.minus.index(1), above.plus.index(1)  # columns from and to the lowest row
    from_below, to_below = below.plus.index(top), below.minus.index(top)
    upper = [(low + shift, high + shift) for low, high in zip(above.minus, above.plus, strict=True)]
    lower = list(zip(below.minus, below.plus, strict=True))
    columns = [
        (below.minus[from_below], above.plus[up] + shift),
        *_between(upper, up, down),
        *_between(lower, from_below, to_below),
        (above.minus[down] + shift, below.plus[to_below]),
        *_between(upper, down, up),
        *_between(lower, to_below, from_below),
    ]
    minus, plus = zip(*columns, strict=True)
    return GridDiagram(minus, plus)


def _between(columns: list[tuple[int, int]], first: int, last: int) -> list[tuple[int, int]]:
    """The columns after the first and before the last, cyclically."""
    size = len(columns)
    return [columns[(first + step) % size] for step in range(1, (last - first) % size)]


def split_sum(grid: GridDiagram, *, patience: int = 300, seed: int = 0) -> tuple[GridDiagram, ...]:
    """Simplified diagrams of the knot's summands, as far as a walk finds them.

    Parameters
    ----------
    grid : GridDiagram
    patience : int
        Diagrams looked at, for each row of the grid, before it is taken to be prime.
    seed : int

    Returns
    -------
    tuple of GridDiagram
        Their connected sum is the knot. One, if the knot is prime or no sphere was found.

    Examples
    --------
    >>> from knotopt.diagram.families import torus_knot
    >>> granny = connected_sum([torus_knot(2, 3), torus_knot(2, 3)])
    >>> [summand.size for summand in split_sum(granny)]
    [5, 5]
    """
    return _split(simplify(grid, seed=seed), patience, random.Random(seed))


def _split(simple: GridDiagram, patience: int, generator: random.Random) -> tuple[GridDiagram, ...]:
    lists = lists_of(simple)
    for _ in range(patience * simple.size):
        for found in _splittings(lists):
            first, second = (simplify(each) for each in found)
            if min(first.size, second.size) > 2:
                return *_split(first, patience, generator), *_split(second, patience, generator)
        walk(lists, simple.size, generator, past_contractions=True)
    return (simple,)


def _splittings(lists: Lists) -> Iterator[tuple[GridDiagram, GridDiagram]]:
    """Both sides of each row interval, and each column interval, that two lines leave."""
    of_minus, of_plus = columns_of(lists)
    least = SMALLEST_KNOTTED - 1  # rows of a summand: one more is added
    for rows, columns in ((lists, (of_minus, of_plus)), ((of_plus, of_minus), lists[::-1])):
        size = len(rows[0])
        # Bit c of the mask below row r: column c has one of its marks there, the other above.
        masks = [0]
        for low, high in zip(*columns, strict=True):
            masks.append(masks[-1] ^ (1 << low) ^ (1 << high))
        for start in range(size):
            for stop in range(start + least, min(size, start + size - least) + 1):
                if (masks[start] ^ masks[stop]).bit_count() == 2:
                    inside = list(range(start, stop))
                    outside = [*range(stop, size), *range(start)]
                    yield _closed(rows, inside), _closed(rows, outside)


def _closed(lists: Lists, rows: Sequence[int]) -> GridDiagram:
    """The part of the knot in these rows; its ends, in two columns, meet in a row above them."""
    rank = {row: number for number, row in enumerate(rows, 1)}
    above = len(rows) + 1
    columns = [
        (rank.get(low, above), rank.get(high, above))
        for low, high in zip(*lists, strict=True)
        if low in rank or high in rank
    ]
    minus, plus = zip(*columns, strict=True)
    return GridDiagram(minus, plus)
