"""Cromwell's moves on the numbers of a grid, in place and without any check but their own.

A grid of size n, counted from 0, as lists or arrays (see `compiled`):

    lines = minus, plus, minus_line, plus_line, place, cross_place

`minus[c]` and `plus[c]` are the rows of the two marks of column c, `minus_line[r]` and
`plus_line[r]` the columns of those of row r; `place[c]` and `cross_place[r]` number the segments in
the order of the closed path. Exchanging columns and rows, `transposed`, is a matter of order alone.
What can be done to columns is so done to rows. The moves are those of `diagram.moves`.
"""

from __future__ import annotations

from knotopt.diagram.grid import GridDiagram

Lines = tuple[list[int], list[int], list[int], list[int], list[int], list[int]]


def lines_of(diagram: GridDiagram, widest: int) -> Lines:
    """The numbers of a grid, but for the places, as lists with room for so many lines."""
    room = [0] * (widest - diagram.size)
    minus = [row - 1 for row in diagram.minus] + room
    plus = [row - 1 for row in diagram.plus] + room
    lines = minus, plus, [0] * widest, [0] * widest, [0] * widest, [0] * widest
    invert(lines, diagram.size)
    return lines


def transposed(lines: Lines) -> Lines:
    """The same grid with columns as rows and rows as columns."""
    minus, plus, minus_line, plus_line, place, cross_place = lines
    return plus_line, minus_line, plus, minus, cross_place, place


def trace(lines: Lines, size: int) -> None:
    """Number the segments in the order of the closed path, from column 0 on."""
    plus, minus_line, place, cross_place = lines[1], lines[2], lines[4], lines[5]
    column = 0
    for step in range(size):
        row = plus[column]
        place[column] = 2 * step
        cross_place[row] = 2 * step + 1
        column = minus_line[row]


def invert(lines: Lines, size: int) -> None:
    """Set the marks by row from those by column."""
    minus, plus, minus_line, plus_line = lines[0], lines[1], lines[2], lines[3]
    for column in range(size):
        minus_line[minus[column]] = column
        plus_line[plus[column]] = column


def copy_grid(source: Lines, target: Lines, size: int) -> None:
    """Copy one grid's numbers into another."""
    for k in range(size):
        target[0][k], target[1][k], target[2][k] = source[0][k], source[1][k], source[2][k]
        target[3][k], target[4][k], target[5][k] = source[3][k], source[4][k], source[5][k]


def commute(lines: Lines, size: int, line: int) -> bool:
    """Exchange a column with the next one, cyclically, if their marks do not interleave."""
    minus, plus, minus_line, plus_line, place = lines[0], lines[1], lines[2], lines[3], lines[4]
    left, right = line, line + 1
    if right == size:
        right = 0
    a, b, c, d = minus[left], plus[left], minus[right], plus[right]
    low, high = min(a, b), max(a, b)
    shared = c in (a, b) or d in (a, b)
    if not shared and (low < c < high) != (low < d < high):
        return False
    minus[left], minus[right] = c, a
    plus[left], plus[right] = d, b
    minus_line[a], minus_line[c] = right, left
    plus_line[b], plus_line[d] = right, left
    place[left], place[right] = place[right], place[left]
    return True


def translate(lines: Lines, size: int, columns: int, rows: int) -> None:
    """Move all columns to the right and all rows up, cyclically; the marks by column only."""
    minus, plus, minus_line, plus_line = lines[0], lines[1], lines[2], lines[3]
    for column in range(size):  # the marks by row hold the old ones meanwhile
        minus_line[column], plus_line[column] = minus[column], plus[column]
    for column in range(size):
        to = (column + columns) % size
        minus[to] = (minus_line[column] + rows) % size
        plus[to] = (plus_line[column] + rows) % size


def stabilise(lines: Lines, size: int, column: int, corner: int, of_plus: bool) -> None:
    """Put a 2 x 2 block with three marks in the place of one mark; the marks by column only.

    The corner that stays empty: bit 0 of `corner` for east, bit 1 for north.
    """
    same, other, old_same, old_other = lines[0], lines[1], lines[2], lines[3]
    if of_plus:
        same, other, old_same, old_other = lines[1], lines[0], lines[3], lines[2]
    for k in range(size):
        old_same[k], old_other[k] = same[k], other[k]
    row = same[column]
    east, north = corner & 1, corner >> 1
    kept_column, new_column = column + east, column + 1 - east
    kept_row, new_row = row + north, row + 1 - north
    for k in range(size):
        to = k
        if k == column:
            to = kept_column
        elif k > column:
            to = k + 1
        a, b = old_same[k], old_other[k]
        same[to] = new_row if k == column else (a + 1 if a > row else a)
        other[to] = kept_row if b == row else (b + 1 if b > row else b)
    same[new_column] = kept_row
    other[new_column] = new_row


def destabilise(lines: Lines, size: int, first: int) -> bool:
    """Contract a row whose marks are in neighbouring columns, cyclically; the marks by column only.

    The first such row from `first` on. Without one, nothing is done.
    """
    minus, plus, minus_line, plus_line = lines[0], lines[1], lines[2], lines[3]
    if size <= 2:
        return False
    for k in range(size):
        row = (first + k) % size
        out, into = plus_line[row], minus_line[row]
        gap = abs(out - into)
        if gap == 1 or gap == size - 1:
            minus[into] = minus[out]
            for column in range(size - 1):
                of = column + 1 if column >= out else column
                a, b = minus[of], plus[of]
                minus[column] = a - 1 if a > row else a
                plus[column] = b - 1 if b > row else b
            return True
    return False
