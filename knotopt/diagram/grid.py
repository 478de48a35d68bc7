"""Grid diagrams: the N x N matrix A of the paper (section II, Definition 2).

Coordinates are [column, row], 1-based, x = column to the right, y = row up. Columns pass over
rows. Source: Wu, Lopez, D'Antonio, Saldaña, "Tying Knots in the Air"; Cromwell, "Embedding knots
and links in an open book I", doi:10.1016/0166-8641(94)00087-J.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from knotopt.arrays import BoolArray
from knotopt.errors import GridError
from knotopt.showing import Shown

Mark = tuple[int, int]  # [column, row], 1-based


@dataclass(frozen=True)
class GridDiagram(Shown):
    """An oriented grid diagram of one knot.

    Every column and every row holds one -1 and one +1. The knot runs along each column from its
    -1 to its +1 (the over-crossing segments) and along each row from its +1 to its -1 (the
    under-crossing segments).

    Parameters
    ----------
    minus, plus : tuple of int, length N
        Row (1-based, upwards) of the -1 and of the +1 in columns 1 ... N.

    Raises
    ------
    GridError
        Not a grid diagram, or the diagram of a link of more than one component.

    Examples
    --------
    >>> trefoil = GridDiagram(minus=(1, 5, 4, 3, 2), plus=(4, 3, 2, 1, 5))
    >>> trefoil.size
    5
    >>> print(trefoil)
     0 -1  0  0  1
     1  0 -1  0  0
     0  1  0 -1  0
     0  0  1  0 -1
    -1  0  0  1  0
    """

    minus: tuple[int, ...]
    plus: tuple[int, ...]

    def __post_init__(self) -> None:
        object.__setattr__(self, "minus", _rows("minus", self.minus))
        object.__setattr__(self, "plus", _rows("plus", self.plus))
        if len(self.minus) != len(self.plus):
            raise GridError(
                f"minus has {len(self.minus)} columns and plus has {len(self.plus)}; "
                "both need one row per column"
            )
        _check_two_per_line([(c, r) for c, r, _ in _entries(self.minus, self.plus)])
        for name, rows in (("-1", self.minus), ("+1", self.plus)):
            columns: list[list[int]] = [[] for _ in rows]
            for column, row in enumerate(rows, 1):
                columns[row - 1].append(column)
            for row, found in enumerate(columns, 1):
                if len(found) != 1:
                    raise GridError(
                        f"row {row} has {len(found)} entries {name}{_where('column', found)}, "
                        "expected exactly one"
                    )
        _check_one_component(self.minus, self.plus)

    @classmethod
    def from_matrix(cls, matrix: Sequence[Sequence[int]] | NDArray[Any]) -> GridDiagram:
        """Grid diagram from the matrix A as printed: the first line is row N, the last is row 1.

        Parameters
        ----------
        matrix : array_like of int, shape (N, N)
            Entries -1, 0, +1; each row and each column has exactly one -1 and one +1.

        Raises
        ------
        GridError
            Naming the first row, column or entry that is wrong.

        Examples
        --------
        >>> GridDiagram.from_matrix([[1, -1], [-1, 1]]).marks
        ((1, 1), (1, 2), (2, 1), (2, 2))
        """
        lines = [list(line) if isinstance(line, Iterable) else [line] for line in matrix]
        size = len(lines)
        if size < 2:
            raise GridError(f"a grid diagram is at least 2 x 2; this matrix has {size} row(s)")
        for i, line in enumerate(lines):
            if len(line) != size:
                raise GridError(
                    f"the matrix is not square: it has {size} rows, "
                    f"but row {size - i} has {len(line)} entries"
                )
            for j, entry in enumerate(line):
                if not isinstance(entry, (int, float, np.number)) or entry not in (-1, 0, 1):
                    raise GridError(
                        f"entry {entry!r} at column {j + 1}, row {size - i}: "
                        "the entries of a grid diagram are -1, 0 and 1"
                    )
        array = np.array(lines, dtype=np.int64)[::-1]  # row 1 first
        _check_two_per_line([(int(c) + 1, int(r) + 1) for r, c in np.argwhere(array)], size)
        for axis, kind in ((1, "row"), (0, "column")):
            unbalanced = np.flatnonzero(array.sum(axis=axis))
            if unbalanced.size:
                raise GridError(
                    f"{kind} {unbalanced[0] + 1} has two entries of the same sign; "
                    "expected one -1 and one +1"
                )
        minus = (array == -1).argmax(axis=0) + 1
        plus = (array == 1).argmax(axis=0) + 1
        return cls(tuple(minus.tolist()), tuple(plus.tolist()))

    @classmethod
    def from_marks(cls, marks: Iterable[Sequence[int]]) -> GridDiagram:
        """Grid diagram from its 2N marks, oriented as the direction "+".

        The direction "+" starts at the lexicographically smallest mark and moves along its
        column first.

        Parameters
        ----------
        marks : iterable of [column, row]
            1-based; two marks in every column and in every row, in any order.

        Raises
        ------
        GridError
            Naming the first mark, row or column that is wrong.

        Examples
        --------
        >>> grid = GridDiagram.from_marks([[1, 1], [1, 2], [2, 1], [2, 2]])
        >>> grid.minus, grid.plus
        ((1, 2), (2, 1))
        """
        pairs = [_mark(position, mark) for position, mark in enumerate(marks, 1)]
        _check_two_per_line(pairs)
        rows, columns = Counter[int](), Counter[int]()  # of a line's two marks, summed
        for c, r in pairs:
            rows[c] += r
            columns[r] += c
        minus, plus = [0] * len(rows), [0] * len(rows)
        for start in sorted(pairs):
            column, row = start
            while not minus[column - 1]:
                minus[column - 1] = row
                row = plus[column - 1] = rows[column] - row
                column = columns[row] - column
        return cls(tuple(minus), tuple(plus))

    @property
    def size(self) -> int:
        """Grid size N; for a smallest diagram of its knot, the arc index."""
        return len(self.minus)

    @cached_property
    def marks(self) -> tuple[Mark, ...]:
        """The 2N turning points [column, row], sorted."""
        return tuple(sorted((c, r) for c, r, _ in _entries(self.minus, self.plus)))

    @property
    def matrix(self) -> NDArray[np.int8]:
        """The matrix A, shape (N, N), as printed: index 0 is row N."""
        matrix = np.zeros((self.size, self.size), dtype=np.int8)
        for c, r, value in _entries(self.minus, self.plus):
            matrix[self.size - r, c - 1] = value
        return matrix

    @cached_property
    def traversal(self) -> tuple[Mark, ...]:
        """The closed path in direction "+": 2N turning points, the first step along a column."""
        column, row = self.marks[0]
        columns = Counter[int]()  # of a row's two marks, summed
        for c, r in self.marks:
            columns[r] += c
        path = []
        for _ in range(self.size):
            path.append((column, row))
            row = self.minus[column - 1] + self.plus[column - 1] - row
            path.append((column, row))
            column = columns[row] - column
        return tuple(path)

    @cached_property
    def crossing_cells(self) -> BoolArray:
        """Where a column crosses a row, shape (N, N), indexed [column - 1, row - 1]."""
        lines = np.arange(1, self.size + 1)
        marks = np.array(self.marks)
        low_row, high_row = marks[0::2, 1], marks[1::2, 1]
        by_row = marks[np.lexsort((marks[:, 0], marks[:, 1])), 0]
        low_column, high_column = by_row[0::2], by_row[1::2]
        column_passes = (low_row[:, None] < lines) & (lines < high_row[:, None])
        row_passes = (low_column < lines[:, None]) & (lines[:, None] < high_column)
        crossed: BoolArray = column_passes & row_passes
        crossed.setflags(write=False)
        return crossed

    @property
    def reversed(self) -> GridDiagram:
        """The same diagram with the knot's orientation reversed (A becomes -A)."""
        return GridDiagram(self.plus, self.minus)

    @property
    def mirrored(self) -> GridDiagram:
        """The knot's mirror image: the rows in reverse order, columns over rows as before."""
        above = self.size + 1
        return GridDiagram(
            tuple(above - row for row in self.minus), tuple(above - row for row in self.plus)
        )

    def __str__(self) -> str:
        return "\n".join(" ".join(f"{int(entry):2d}" for entry in line) for line in self.matrix)


def _entries(minus: Sequence[int], plus: Sequence[int]) -> list[tuple[int, int, int]]:
    """(column, row, entry) of every non-zero entry."""
    return [
        (c, row, value)
        for c, (low, high) in enumerate(zip(minus, plus, strict=True), 1)
        for row, value in ((low, -1), (high, 1))
    ]


def _rows(name: str, rows: Any) -> tuple[int, ...]:
    """The rows as a tuple of int, whatever sequence or array of integers they came in."""
    listed = list(rows) if isinstance(rows, Iterable) else [rows]
    for column, row in enumerate(listed, 1):
        if not _is_integer(row):
            raise GridError(f"{name} is {row!r} in column {column}, expected a row number")
    return tuple(int(row) for row in listed)


def _is_integer(value: Any) -> bool:
    return isinstance(value, (int, np.integer)) and not isinstance(value, bool)


def _where(kind: str, places: Sequence[int]) -> str:
    plural = "s" if len(places) > 1 else ""
    return f" ({kind}{plural} {', '.join(map(str, places))})" if places else ""


def _mark(position: int, mark: Any) -> Mark:
    entries = tuple(mark) if isinstance(mark, Iterable) and not isinstance(mark, str) else (mark,)
    if len(entries) != 2 or not all(map(_is_integer, entries)):
        raise GridError(f"mark {position} is {mark!r}, expected [column, row] of two integers")
    return int(entries[0]), int(entries[1])


def _check_two_per_line(marks: Sequence[Mark], size: int | None = None) -> None:
    """Every column and row from 1 to N has two marks, in two different places."""
    if size is None and len(marks) < 4:
        raise GridError(
            f"{len(marks) or 'no'} mark{'s' * (len(marks) != 1)}: "
            "a grid diagram has two in every column and every row, at least 4"
        )
    seen = set()
    for mark in marks:
        if mark in seen:
            raise GridError(f"mark [{mark[0]}, {mark[1]}] occurs twice")
        seen.add(mark)
    size = size or max(map(max, marks))
    near = min(marks, key=min)
    if min(near) < 1:
        raise GridError(
            f"mark [{near[0]}, {near[1]}] is outside the grid: columns and rows are counted from 1"
        )
    if size > len(marks):
        far = max(marks, key=max)
        raise GridError(
            f"mark [{far[0]}, {far[1]}] is outside the grid: "
            f"{len(marks)} marks make a grid of size {len(marks) // 2}"
        )
    empty = None
    for axis, kind, across in ((1, "row", "column"), (0, "column", "row")):
        places: list[list[int]] = [[] for _ in range(size + 1)]
        for mark in marks:
            places[mark[axis]].append(mark[1 - axis])
        for line in range(1, size + 1):
            count = len(places[line])
            if count == 0:
                empty = empty or f"{kind} {line} has no marks, expected two"
            elif count != 2:
                word = {1: "one mark", 3: "three marks"}.get(count, f"{count} marks")
                raise GridError(
                    f"{kind} {line} has {word}{_where(across, sorted(places[line]))}, expected two"
                )
    if empty:  # said last: a line with a wrong mark tells more than one without any
        raise GridError(empty)


def _check_one_component(minus: Sequence[int], plus: Sequence[int]) -> None:
    after = {row: plus[c] for c, row in enumerate(minus)}  # the row of a -1 to that of the next
    components = 0
    while after:
        components += 1
        row, following = after.popitem()
        while following != row:
            following = after.pop(following)
    if components != 1:
        raise GridError(f"this grid is a link of {components} components, a knot has 1")
