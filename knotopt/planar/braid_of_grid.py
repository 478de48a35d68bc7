"""A braid of which a grid diagram's knot is the closure.

Source: Cromwell, "Embedding knots and links in an open book I", doi:10.1016/0166-8641(94)00087-J.
"""

from __future__ import annotations

from bisect import bisect_left, insort
from collections.abc import Sequence

from knotopt.diagram.grid import GridDiagram
from knotopt.planar.planar_diagram import PlanarDiagram
from knotopt.planar.small_grid import small_grid

Word = tuple[int, ...]


def braid_word(planar: PlanarDiagram) -> tuple[Word, int]:
    """A braid of which a diagram's knot is the closure, read off a small grid, and its strands.

    Examples
    --------
    >>> braid_word(PlanarDiagram(((3, 1, 4, 0), (7, 5, 0, 4), (5, 2, 6, 3), (1, 6, 2, 7))))
    ((-1, 2, -1, 2), 3)
    """
    return braid_of_grid(small_grid(planar))


def braid_of_grid(grid: GridDiagram) -> tuple[Word, int]:
    """A braid of which a grid diagram's knot is the closure, and its number of strands.

    Columns that run down are led round the other way: up from their lower end's row to the top and
    on from the bottom, over all rows. Then all columns run up, side by side, and each row takes its
    strand to another column below those between. Of this, the same with rows for columns, and both
    for the other direction, the word that is shortest when reduced is taken.

    Parameters
    ----------
    grid : GridDiagram

    Returns
    -------
    word : tuple of int
    strands : int

    Examples
    --------
    >>> from knotopt.diagram.families import torus_knot
    >>> braid_of_grid(torus_knot(2, 3)), braid_of_grid(torus_knot(3, -4))
    (((1, 1, 1), 2), ((-1, -2, -1, -2, -1, -2, -1, -2), 3))
    """
    columns_of = [
        {row: column for column, row in enumerate(rows, 1)} for rows in (grid.minus, grid.plus)
    ]
    size = range(1, grid.size + 1)
    # Seen from behind in the diagonal, rows are columns that pass over.
    across = [columns_of[1][row] for row in size], [columns_of[0][row] for row in size]
    braids = []
    for tails, heads in ((grid.minus, grid.plus), across):
        braids.append(_reduced(*_columns_up(tails, heads)))
        word, strands = _reduced(*_columns_up(heads, tails))
        braids.append((word[::-1], strands))  # turned upside down: the knot runs as it did
    return min(braids, key=lambda braid: (len(braid[0]), braid[1]))


def _columns_up(tails: Sequence[int], heads: Sequence[int]) -> tuple[list[int], int]:
    """The braid of columns that run from the row `tails` to the row `heads`, each led upwards."""
    ending = {row: column for column, row in enumerate(heads)}
    starting = {row: column for column, row in enumerate(tails)}
    strands = [column for column, row in enumerate(heads) if row < tails[column]]
    count = len(strands)
    word = []
    for row in range(1, len(heads) + 1):
        before = bisect_left(strands, ending[row])
        del strands[before]
        after = bisect_left(strands, starting[row])
        insort(strands, starting[row])
        # The strand that moves is below: to the right its crossings are negative.
        word += [-1 - place for place in range(before, after)]
        word += range(before, after, -1)
    return word, count


def _reduced(word: Sequence[int], strands: int) -> tuple[Word, int]:
    """The word without letters that cancel, around the closure too, and without lone strands."""
    letters = list(word)
    while True:
        count = len(letters)
        _cancel(letters)
        for lone, shift in ((strands - 1, 0), (1, 1)):  # Markov's move on the last, first strand
            if strands > 1 and sum(abs(letter) == lone for letter in letters) == 1:
                letters = [
                    letter - shift if letter > 0 else letter + shift
                    for letter in letters
                    if abs(letter) != lone
                ]
                strands -= 1
        if len(letters) == count:
            return tuple(letters), strands


def _cancel(letters: list[int]) -> None:
    """Take out a letter and its inverse where all letters between commute with them."""
    start = 0
    while start < len(letters):
        letter = letters[start]
        for step in range(1, len(letters)):
            other = (start + step) % len(letters)
            if letters[other] == -letter:
                for place in sorted((start, other), reverse=True):
                    del letters[place]
                start = -1
                break
            if abs(abs(letters[other]) - abs(letter)) <= 1:
                break
        start += 1
