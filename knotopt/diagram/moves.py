"""Moves between grid diagrams: symmetries of the square and Cromwell's moves.

Cromwell's theorem (doi:10.1016/0166-8641(94)00087-J): two grid diagrams are of the same knot if and
only if torus translations, commutations, stabilisations and destabilisations turn one into the
other. Every function here returns a new diagram; the knot's orientation is carried along.
"""

from __future__ import annotations

from enum import StrEnum
from typing import Literal

import numpy as np

from knotopt.diagram.grid import GridDiagram
from knotopt.errors import MoveError

Corner = Literal["NE", "NW", "SE", "SW"]


class Symmetry(StrEnum):
    """The eight symmetries of the square.

    Columns pass over rows before and after, so a symmetry that exchanges columns and rows also
    exchanges over and under. The knot type is kept by four of them; the other four give the
    mirror image (`mirrors`).
    """

    IDENTITY = "identity"
    HALF_TURN = "half-turn"
    TRANSPOSE = "transpose"
    ANTITRANSPOSE = "antitranspose"
    FLIP_COLUMNS = "flip-columns"
    FLIP_ROWS = "flip-rows"
    QUARTER_TURN = "quarter-turn"
    QUARTER_TURN_BACK = "quarter-turn-back"

    @property
    def mirrors(self) -> bool:
        """Whether the result is the mirror image of the knot."""
        _, flip_columns, flip_rows = _STEPS[self]
        return flip_columns != flip_rows


# Each symmetry as steps: exchange columns and rows, then flip the columns, then flip the rows.
_STEPS = {
    Symmetry.IDENTITY: (False, False, False),
    Symmetry.HALF_TURN: (False, True, True),
    Symmetry.TRANSPOSE: (True, False, False),
    Symmetry.ANTITRANSPOSE: (True, True, True),
    Symmetry.FLIP_COLUMNS: (False, True, False),
    Symmetry.FLIP_ROWS: (False, False, True),
    Symmetry.QUARTER_TURN: (True, True, False),
    Symmetry.QUARTER_TURN_BACK: (True, False, True),
}


def transform(diagram: GridDiagram, symmetry: Symmetry) -> GridDiagram:
    """The diagram's image under a symmetry of the square.

    Examples
    --------
    >>> grid = GridDiagram((1, 5, 4, 3, 2), (4, 3, 2, 1, 5))
    >>> transform(transform(grid, Symmetry.QUARTER_TURN), Symmetry.QUARTER_TURN_BACK) == grid
    True
    """
    exchange, flip_columns, flip_rows = _STEPS[Symmetry(symmetry)]
    minus, plus, size = diagram.minus, diagram.plus, diagram.size
    if exchange:
        # The knot runs along columns from -1 to +1; to run along the new ones it swaps the signs.
        minus, plus = _inverse(plus), _inverse(minus)
    if flip_columns:
        minus, plus = minus[::-1], plus[::-1]
    if flip_rows:
        minus = tuple(size + 1 - row for row in minus)
        plus = tuple(size + 1 - row for row in plus)
    return GridDiagram(minus, plus)


def translate(diagram: GridDiagram, columns: int = 0, rows: int = 0) -> GridDiagram:
    """Torus translation: columns move right and rows up, cyclically.

    Examples
    --------
    >>> grid = GridDiagram((1, 5, 4, 3, 2), (4, 3, 2, 1, 5))
    >>> translate(grid, columns=1, rows=2)
    GridDiagram(minus=(4, 3, 2, 1, 5), plus=(2, 1, 5, 4, 3))
    """
    size = diagram.size
    shift = -columns % size

    def moved(line: tuple[int, ...]) -> tuple[int, ...]:
        return tuple((row - 1 + rows) % size + 1 for row in line[shift:] + line[:shift])

    return GridDiagram(moved(diagram.minus), moved(diagram.plus))


def can_commute_columns(diagram: GridDiagram, column: int) -> bool:
    """Whether `column` and the next one (cyclically) can be exchanged.

    They can if, on the circle of rows, the marks of one do not separate those of the other:
    their segments are nested or disjoint. A shared row is allowed.
    """
    _check_line(diagram, column, "column")
    left, right = column - 1, column % diagram.size
    low, high = sorted((diagram.minus[left], diagram.plus[left]))
    other = (diagram.minus[right], diagram.plus[right])
    if low in other or high in other:
        return True
    return (low < other[0] < high) == (low < other[1] < high)


def commute_columns(diagram: GridDiagram, column: int) -> GridDiagram:
    """Commutation: exchange `column` with the next one to the right (column N with column 1).

    Raises
    ------
    MoveError
        The two columns' marks are interleaved: exchanging them would pass strands through each
        other.

    Examples
    --------
    >>> commute_columns(GridDiagram((1, 3, 2), (2, 1, 3)), 1)
    GridDiagram(minus=(3, 1, 2), plus=(1, 2, 3))
    """
    return _commute(diagram, column, "columns")


def commute_rows(diagram: GridDiagram, row: int) -> GridDiagram:
    """Commutation: exchange `row` with the next one up (row N with row 1).

    Raises
    ------
    MoveError
        The two rows' marks are interleaved.
    """
    _check_line(diagram, row, "row")
    return _transposed(_commute(_transposed(diagram), row, "rows"))


def stabilise(diagram: GridDiagram, column: int, row: int, corner: Corner) -> GridDiagram:
    """Stabilisation: put a 2 x 2 block with three marks in place of the mark at [column, row].

    Parameters
    ----------
    corner : "NE", "NW", "SE" or "SW"
        The corner of the block that stays empty.

    Raises
    ------
    MoveError
        There is no mark at [column, row].

    Examples
    --------
    >>> stabilise(GridDiagram((1, 2), (2, 1)), 1, 2, "NE")
    GridDiagram(minus=(2, 1, 3), plus=(3, 2, 1))
    """
    if (column, row) not in diagram.marks:
        raise MoveError(f"there is no mark at [{column}, {row}] to stabilise")
    if corner not in ("NE", "NW", "SE", "SW"):
        raise MoveError(f"corner {corner!r}: expected NE, NW, SE or SW")
    north, east = corner[0] == "N", corner[1] == "E"
    # The block's column that keeps the old column's other mark, and its row likewise.
    kept_column, new_column = (column + 1, column) if east else (column, column + 1)
    kept_row, new_row = (row + 1, row) if north else (row, row + 1)
    is_minus = diagram.minus[column - 1] == row
    marked, opposite = [0] * (diagram.size + 1), [0] * (diagram.size + 1)
    same, other = (diagram.minus, diagram.plus) if is_minus else (diagram.plus, diagram.minus)
    for c, (a, b) in enumerate(zip(same, other, strict=True), 1):
        to_column = kept_column if c == column else c + (c > column)
        marked[to_column - 1] = new_row if (c, a) == (column, row) else a + (a > row)
        opposite[to_column - 1] = b + (b > row)
    for c, line in enumerate(opposite):
        if line == row:  # the row's other mark stays in the row that the block keeps
            opposite[c] = kept_row
    marked[new_column - 1] = kept_row
    opposite[new_column - 1] = new_row
    minus, plus = (marked, opposite) if is_minus else (opposite, marked)
    return GridDiagram(tuple(minus), tuple(plus))


def can_destabilise_row(diagram: GridDiagram, row: int) -> bool:
    """Whether the two marks of `row` are in neighbouring columns (cyclically) and N > 2."""
    _check_line(diagram, row, "row")
    gap = abs(diagram.minus.index(row) - diagram.plus.index(row))
    return diagram.size > 2 and gap in (1, diagram.size - 1)


def destabilise_row(diagram: GridDiagram, row: int) -> GridDiagram:
    """Destabilisation: contract a row whose two marks are in neighbouring columns.

    The row disappears and its two columns become one. (This is Cromwell's destabilisation of a
    2 x 2 block with three marks, together with the commutations that bring the block about.)

    Raises
    ------
    MoveError
        The marks are not in neighbouring columns, or the grid is the 2 x 2 one.

    Examples
    --------
    >>> destabilise_row(GridDiagram((1, 2, 3), (2, 3, 1)), 2)
    GridDiagram(minus=(1, 2), plus=(2, 1))
    """
    if not can_destabilise_row(diagram, row):
        raise MoveError(
            f"row {row} cannot be contracted: its marks are in columns "
            f"{diagram.minus.index(row) + 1} and {diagram.plus.index(row) + 1}, "
            f"not neighbours in a grid larger than 2 x 2"
        )
    out, into = diagram.plus.index(row), diagram.minus.index(row)
    # The knot comes up column `out` from minus[out] and leaves by column `into` to plus[into].
    minus, plus = list(diagram.minus), list(diagram.plus)
    minus[into] = minus[out]
    del minus[out], plus[out]
    return GridDiagram(*(tuple(r - (r > row) for r in rows) for rows in (minus, plus)))


def can_destabilise_column(diagram: GridDiagram, column: int) -> bool:
    """Whether the two marks of `column` are in neighbouring rows (cyclically) and N > 2."""
    _check_line(diagram, column, "column")
    gap = abs(diagram.minus[column - 1] - diagram.plus[column - 1])
    return diagram.size > 2 and gap in (1, diagram.size - 1)


def destabilise_column(diagram: GridDiagram, column: int) -> GridDiagram:
    """Destabilisation: contract a column whose two marks are in neighbouring rows.

    Raises
    ------
    MoveError
        The marks are not in neighbouring rows, or the grid is the 2 x 2 one.
    """
    if not can_destabilise_column(diagram, column):
        raise MoveError(
            f"column {column} cannot be contracted: its marks are in rows "
            f"{diagram.minus[column - 1]} and {diagram.plus[column - 1]}, "
            f"not neighbours in a grid larger than 2 x 2"
        )
    return _transposed(destabilise_row(_transposed(diagram), column))


def _inverse(rows: tuple[int, ...]) -> tuple[int, ...]:
    """The column of each row, from the row of each column."""
    return tuple((np.argsort(rows) + 1).tolist())


def _transposed(diagram: GridDiagram) -> GridDiagram:
    return transform(diagram, Symmetry.TRANSPOSE)


def _commute(diagram: GridDiagram, column: int, kind: str) -> GridDiagram:
    """Exchange a column with the next one; `kind` names both to the reader."""
    if not can_commute_columns(diagram, column):
        after = column % diagram.size + 1
        raise MoveError(f"{kind} {column} and {after} do not commute: their marks interleave")
    left, right = column - 1, column % diagram.size
    minus, plus = list(diagram.minus), list(diagram.plus)
    for line in (minus, plus):
        line[left], line[right] = line[right], line[left]
    return GridDiagram(tuple(minus), tuple(plus))


def _check_line(diagram: GridDiagram, line: int, kind: str) -> None:
    if not 1 <= line <= diagram.size:
        raise MoveError(f"{kind} {line} is outside the grid of size {diagram.size}")
