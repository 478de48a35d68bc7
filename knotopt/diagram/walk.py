"""Walks over grid diagrams by commutations, on bare lists.

`minus` and `plus` hold the row of each column's -1 and +1 as in `GridDiagram`, but counted from 0,
and are changed in place: the moves on `GridDiagram` validate the whole diagram every time, a step
here costs O(1), a sixth of a microsecond.
"""

from __future__ import annotations

import random

from knotopt.diagram.grid import GridDiagram

DRAWN_AT_ONCE = 64  # pairs of lines; a walk that finds a contraction ends after 50 as a rule

Lists = tuple[list[int], list[int]]  # minus and plus, rows counted from 0


def lists_of(diagram: GridDiagram) -> Lists:
    """The rows of the -1s and +1s, counted from 0."""
    return [row - 1 for row in diagram.minus], [row - 1 for row in diagram.plus]


def diagram_of(lists: Lists) -> GridDiagram:
    """The grid diagram of these rows."""
    minus, plus = lists
    return GridDiagram(tuple(row + 1 for row in minus), tuple(row + 1 for row in plus))


def contract(lists: Lists) -> None:
    """Contract lines whose two marks are neighbours (cyclically), until there is none.

    That is destabilisation, as `moves.destabilise_row`; the 2 x 2 grid is left.
    """
    minus, plus = lists
    while len(minus) > 2:
        size = len(minus)
        near = (1, size - 1)
        for column in range(size):
            if abs(minus[column] - plus[column]) in near:
                low, kept = minus[column], plus[column]
                plus[plus.index(low)] = kept  # the row that is left takes the other's +1
                break
        else:
            columns = columns_of(lists)
            for low in range(size):
                column, into = columns[1][low], columns[0][low]
                if abs(column - into) in near:
                    minus[into] = minus[column]
                    break
            else:
                return
        del minus[column], plus[column]
        for rows in lists:
            rows[:] = [row - (row > low) for row in rows]


def columns_of(lists: Lists) -> Lists:
    """The column of each row's -1 and +1."""
    minus, plus = lists
    columns = [0] * len(minus), [0] * len(minus)
    for column, (low, high) in enumerate(zip(minus, plus, strict=True)):
        columns[0][low] = column
        columns[1][high] = column
    return columns


def walk(
    lists: Lists, steps: int, generator: random.Random, *, past_contractions: bool = False
) -> bool:
    """Try random commutations, cyclic ones too; whether the walk stopped at a contraction.

    Parameters
    ----------
    lists : Lists
    steps : int
        Pairs of neighbouring lines tried; those that do not commute count too.
    generator : random.Random
    past_contractions : bool
        Take all steps; otherwise stop as soon as a line can be contracted.
    """
    size = len(lists[0])
    near = set() if past_contractions else {1, -1, size - 1, 1 - size}
    columns = columns_of(lists)
    neighbours = [
        (*along, *across, line, (line + 1) % size)
        for along, across in ((lists, columns), (columns, lists))
        for line in range(size)
    ]
    for start in range(0, steps, DRAWN_AT_ONCE):
        drawn = generator.choices(neighbours, k=min(DRAWN_AT_ONCE, steps - start))
        for minus, plus, minus_across, plus_across, left, right in drawn:
            a, b, c, d = minus[left], plus[left], minus[right], plus[right]
            # Interleaved, unless the -1 of one and the +1 of the other are in one line across.
            if a < b:
                if (a < c < b) != (a < d < b) and a != d and b != c:
                    continue
            elif (b < c < a) != (b < d < a) and a != d and b != c:
                continue
            minus[left], minus[right], plus[left], plus[right] = c, a, d, b
            minus_across[a] = plus_across[b] = right
            minus_across[c] = plus_across[d] = left
            # The exchange changed the spread of these four lines only.
            if (
                right - plus_across[a] in near
                or right - minus_across[b] in near
                or left - plus_across[c] in near
                or left - minus_across[d] in near
            ):
                return True
    return False
