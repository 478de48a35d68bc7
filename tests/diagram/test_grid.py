"""Grid diagrams: construction, round trips, and errors that say what is wrong and where."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given

from knotopt.diagram.grid import GridDiagram
from knotopt.errors import GridError, KnotoptError
from tests.helpers.strategies import diagrams

TREFOIL = GridDiagram(minus=(1, 5, 4, 3, 2), plus=(4, 3, 2, 1, 5))


@given(diagrams(max_size=12))
def test_round_trips(diagram: GridDiagram) -> None:
    assert GridDiagram.from_matrix(diagram.matrix) == diagram
    assert GridDiagram.from_matrix(diagram.matrix.tolist()) == diagram
    from_marks = GridDiagram.from_marks(reversed(diagram.marks))
    assert from_marks in (diagram, diagram.reversed)
    assert (diagram.reversed.matrix == -diagram.matrix).all()


@given(diagrams(max_size=12))
def test_traversal_starts_at_the_smallest_mark_along_its_column(diagram: GridDiagram) -> None:
    path = diagram.traversal
    assert sorted(path) == list(diagram.marks)
    assert path[0] == diagram.marks[0] and path[1][0] == path[0][0]
    for k, (here, after) in enumerate(zip(path, path[1:] + path[:1], strict=True)):
        assert here[k % 2] == after[k % 2]
    # A diagram from marks runs along its columns from -1 to +1 in this direction.
    oriented = GridDiagram.from_marks(diagram.marks)
    assert oriented.minus[path[0][0] - 1] == path[0][1]


def test_the_matrix_is_printed_with_the_top_row_first() -> None:
    assert str(TREFOIL).splitlines()[0].split() == ["0", "-1", "0", "0", "1"]
    assert TREFOIL.matrix[0, 1] == -1 and TREFOIL.minus[1] == 5


@pytest.mark.parametrize(
    ("matrix", "message"),
    [
        ([[1, -1, 0], [-1, 1]], "not square: it has 2 rows, but row 2 has 3 entries"),
        ([[1, 2], [-1, 1]], "entry 2 at column 2, row 2"),
        ([[1, -1], [-1, 0.5]], "entry 0.5 at column 2, row 1"),
        ([[1]], "at least 2 x 2"),
        ([], "at least 2 x 2"),
        ([5, 6], "not square"),
        (
            [[0, 1, 0, -1], [1, -1, 1, 0], [0, 0, -1, 1], [-1, 0, 0, 0]],
            r"row 1 has one mark \(column 1\), expected two",
        ),
        (
            [[0, -1, 1, 0], [1, -1, 0, 1], [-1, 0, 0, 0], [0, 1, -1, 0]],
            "row 2 has one mark",
        ),
        (
            [[0, 1, -1], [1, -1, 1], [-1, 0, 0]],
            "row 1 has one mark",
        ),
        ([[1, 0, -1], [1, -1, 0], [0, 1, -1]], "column 1 has two entries of the same sign"),
        ([[1, 1, 0], [-1, 0, 1], [0, -1, -1]], "row 1 has two entries of the same sign"),
        ([[0, 0], [1, -1]], r"column 1 has one mark \(row 1\)"),
    ],
)
def test_bad_matrix(matrix: list[list[int]], message: str) -> None:
    with pytest.raises(GridError, match=message):
        GridDiagram.from_matrix(matrix)


@pytest.mark.parametrize(
    ("marks", "message"),
    [
        (
            [[1, 4], [1, 1], [2, 4], [2, 2], [3, 4], [3, 2], [4, 1], [4, 3]],
            r"row 3 has one mark \(column 4\)",
        ),
        (
            [[1, 1], [1, 2], [2, 1], [2, 3], [3, 3], [3, 4], [4, 4], [5, 2]],
            r"column 4 has one mark \(row 4\), expected two",
        ),
        ([[1, 1], [1, 2], [2, 1], [2, 1]], r"mark \[2, 1\] occurs twice"),
        ([[0, 1], [0, 2], [1, 1], [1, 2]], r"mark \[0, 1\] is outside the grid"),
        ([[1, 1], [1, 2], [2, 1], [2, "2"]], r"mark 4 is \[2, '2'\], expected \[column, row\]"),
        ([[1, 1, 1]], r"mark 1 is \[1, 1, 1\]"),
        ([7], "mark 1 is 7"),
        ([[True, 1]], "mark 1 is"),
        ([], "no marks"),
        (
            [[1, 1], [1, 2], [2, 1], [2, 2], [4, 4], [4, 5], [5, 4], [5, 5]],
            "row 3 has no marks, expected two",
        ),
        ([[1, 1], [1, 2], [2, 1], [2, 10**9]], r"mark \[2, 1000000000\] is outside .*: 4 marks"),
        ([[1, 4]], "1 mark: a grid diagram has"),
    ],
)
def test_bad_marks(marks: list[list[int]], message: str) -> None:
    with pytest.raises(GridError, match=message):
        GridDiagram.from_marks(marks)


def test_three_marks_in_a_row_are_named() -> None:
    marks = [[1, 1], [1, 4], [2, 4], [2, 2], [3, 4], [3, 3], [4, 1], [4, 3]]
    with pytest.raises(GridError, match=r"row 2 has one mark \(column 2\), expected two"):
        GridDiagram.from_marks(marks)
    marks = [[1, 1], [1, 2], [2, 1], [2, 3], [3, 1], [3, 3]]
    with pytest.raises(GridError, match=r"row 1 has three marks \(columns 1, 2, 3\), expected two"):
        GridDiagram.from_marks(marks)


def test_a_link_is_counted() -> None:
    def blocks(count: int) -> list[list[int]]:
        return [[2 * k + c, 2 * k + r] for k in range(count) for c in (1, 2) for r in (1, 2)]

    for count in (2, 3):
        with pytest.raises(GridError, match=f"a link of {count} components, a knot has 1"):
            GridDiagram.from_marks(blocks(count))
    matrix = np.kron(np.eye(3, dtype=int), [[1, -1], [-1, 1]])
    with pytest.raises(GridError, match="a link of 3 components"):
        GridDiagram.from_matrix(matrix)


def test_bad_columns() -> None:
    with pytest.raises(GridError, match="minus has 2 columns and plus has 3"):
        GridDiagram((1, 2), (2, 1, 3))
    with pytest.raises(GridError, match=r"row 1 has 2 entries -1 \(columns 1, 2\)"):
        GridDiagram((1, 1, 2), (2, 3, 3))
    assert issubclass(GridError, KnotoptError)
