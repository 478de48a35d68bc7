"""A grid diagram of a braid's closure: each crossing's upper strand is a column.

Source: Cromwell, "Embedding knots and links in an open book I", doi:10.1016/0166-8641(94)00087-J,
for grid diagrams as closed braids about the axis of their rows.
"""

from __future__ import annotations

from collections.abc import Sequence

from knotopt.diagram.grid import GridDiagram
from knotopt.planar.braid import from_braid


def braid_grid(word: Sequence[int], strands: int | None = None) -> GridDiagram:
    """A grid diagram of the closure, of at most as many columns as letters and strands together.

    The strands are rows that run to the right. At each letter the strand above moves in a column
    to a new row, just past that of the other one. At the end the strands move to the rows that they
    began in, if they are not there: those that go up from the uppermost on, those that go down from
    the lowest on, so that none passes another. The rows lead back behind all columns.

    Parameters
    ----------
    word : sequence of int
        Letters as in `from_braid`: +i or -i, where a positive letter is a positive crossing.
    strands : int, optional
        As many as the letters need, if not given.

    Raises
    ------
    DiagramError
        Naming the first letter that is wrong, or how many components the closure has.

    Examples
    --------
    >>> print(braid_grid([1, 1, 1]))
    -1  0  0  1  0
     0 -1  0  0  1
     1  0 -1  0  0
     0  1  0 -1  0
     0  0  1  0 -1
    """
    count = len(from_braid(word, strands).crossings)  # complains of what is no braid, or no knot
    if not count:
        return GridDiagram((1, 2), (2, 1))
    size = max(map(abs, word)) + 1
    first = list(range(size))
    here = list(first)  # of each strand, upwards: its row, named by a number
    order = list(first)  # the rows, upwards
    moves = []  # of each column: from row, to row
    for letter in word:
        low = abs(letter) - 1
        # In a positive crossing of strands to the right the one above goes down.
        under, over = (here[low], here[low + 1]) if letter > 0 else (here[low + 1], here[low])
        new = len(order)
        order.insert(order.index(under) + (letter < 0), new)
        moves.append((over, new))
        here[low], here[low + 1] = (new, under) if letter > 0 else (under, new)
    place = {row: number for number, row in enumerate(order, 1)}
    up = [ends for ends in zip(here, first, strict=True) if place[ends[0]] < place[ends[1]]]
    down = [ends for ends in zip(here, first, strict=True) if place[ends[0]] > place[ends[1]]]
    moves += up[::-1] + down
    minus, plus = zip(*((place[start], place[end]) for start, end in moves), strict=True)
    return GridDiagram(minus, plus)
