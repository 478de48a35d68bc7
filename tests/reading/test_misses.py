"""What is said of contents that are no knot: one sentence that tells where."""

from __future__ import annotations

from pathlib import Path

import pytest

from knotopt.errors import DiagramError, FileFormatError, GridError, KnotoptError, UnknownKnotError
from knotopt.reading.forms import FORMS
from knotopt.reading.goal import read_goal
from knotopt.reading.knot import read_knot

ZERO_ONE = "A,B,C,D,E\n1,0,0,1,0\n0,1,0,0,1\n1,0,1,0,0\n0,1,0,1,0\n0,0,1,0,1\n"
MISSES = [
    ("", FileFormatError, "there is nothing in it"),
    (" \n", FileFormatError, "there is nothing in it"),
    ("[\n1,\n", FileFormatError, r"line 1 opens '\[', which is not closed"),
    ("[1, 2)]", FileFormatError, r"line 1 closes '\)', which is not open"),
    ("{", FileFormatError, "line 1 opens '{'"),
    ("[" * 1000, FileFormatError, r"line 1 opens '\['"),
    ("{}", FileFormatError, "found none"),
    ('{"knot": 3}', FileFormatError, "expected a key such as .* found 'knot'"),
    ('{"grid": 3}', FileFormatError, 'the key "grid" holds no marks of a grid'),
    ('{"matrix": []}', FileFormatError, 'the key "matrix" holds no matrix'),
    ("[]", FileFormatError, "lists, but not those of a grid"),
    ("[null]", FileFormatError, "lists, but not those of a grid"),
    ("[[null, 1], [1, null]]", FileFormatError, "2 rows of 2 numbers, but no matrix"),
    ("no such thing " * 10, FileFormatError, r"no knot in 'no such thing.*\.\.\.'"),
    ("1,-1\n-1,x\n", FileFormatError, "line 2 is '-1,x', expected whole numbers"),
    ("column,row\n\n1,1.5\n", FileFormatError, "line 3 is '1,1.5', expected whole numbers"),
    ("# remark\n1 2 3\n4 5 6\n7 8 x\n", FileFormatError, "line 4 is '7 8 x'"),
    ("1,-1,0\n-1,1\n", GridError, "not square: it has 2 rows, but row 2 has 3 entries"),
    ("0 -1 1\n1 0 -1\n-1 1 1\n", GridError, r"row 1 has three marks \(columns 1, 2, 3\)"),
    ("[[0,-1,1],[1,0,-1],[-1,1,2]]", GridError, "entry 2 at column 3, row 1"),
    ("[[1,1],[1,2],[2,2],[2,3],[3,1]]", GridError, r"row 3 has one mark \(column 2\)"),
    ("[[1,1],[1,2],[2,2],[2,3],[3,1],[3,7]]", GridError, r"mark \[3, 7\] is outside the grid"),
    ("[[5,2],[1,3],[2,4],[3,5],[4,2]]", GridError, r"column 1 has one mark \(row 2\)"),
    ("[[5,2],[1,3],[2,4],[3,6],[4,1]]", GridError, r"pair 4 is \[3, 6\], but 5 pairs have"),
    ("[[5,2],[1,3],[2],[3,5],[4,1]]", GridError, r"pair 3 is \[2\], expected two columns"),
    ("[[2,2],[1,3],[1,3]]", GridError, r"pair 1 is \[2, 2\]: a row joins two different"),
    ("ArcPresentation[{1,2},{2,3},{3}]", GridError, r"pair 3 is \[3\]"),
    ("X,O,.\nO,X,.\n.,.,.\n", GridError, "line 3 has 0 X, expected one"),
    ("X..O\nOX..\n.OX.\n..OX\nX.O.\n", GridError, "lines 1 and 5 have X in column 1"),
    ('{"X": [0,1,2], "O": [1,2,2]}', GridError, "O has 2 2 times, expected once"),
    ('{"X": [0,1,2], "O": [1,0,2]}', GridError, "column 3 has both marks in one place, 2"),
    ('{"X": [0,1,2], "O": [1,2]}', GridError, "X has 3 numbers and O has 2"),
    ('{"X": [0,1,2], "O": [1,2,5]}', GridError, "O has 5 for column 3: expected 0 to 2"),
    ('{"X": [0,1], "O": "10"}', GridError, "O is no list of whole numbers"),
    ("[[0,1,2,3,4],[2,3,4,1,1]]", GridError, "the second list has 1 2 times"),
    ("[[1,5,2,4],[3,1,4,6],[5,3,6,3]]", DiagramError, "edge 2 at crossing 1 occurs once"),
    ("[[1,5,2,4],[3,1,4,6],[5,3,6]]", DiagramError, "crossing 3 has 3 edges"),
    ("[4, 6, 3]", DiagramError, "entry 3 of the DT code is 3"),
    ("[1, -2, 3, -1, 2, -4]", DiagramError, "crossing 3 is visited once, at 3"),
    ("BR[2, {1, 1, 3}]", DiagramError, "letter 3 of the braid word is 3"),
    ("4 6 2\n4 6 8 2\n", FileFormatError, "2 rows of different lengths, 3 and 4 numbers: no grid"),
    (
        "A,B,C,D,E\n1,0,0,1,0\n0,1,0,0,1\n1,0,1,0,0\n0,1,0,1,0\n0,0,1,0,1\n",
        FileFormatError,
        "5 rows of 0 and 1, where a matrix has -1",
    ),
    ("3_1#", UnknownKnotError, "'3_1#' lacks a summand before or behind a sign #"),
    ("3_1 ## 4_1", UnknownKnotError, "lacks a summand"),
    ("T(2,4)", GridError, r"T\(2,4\) is a link of 2 components"),
]


@pytest.mark.parametrize(("text", "error", "message"), MISSES)
def test_misses(tmp_path: Path, text: str, error: type[Exception], message: str) -> None:
    with pytest.raises(error, match=message) as caught:
        read_knot(text)
    assert "\n" not in str(caught.value)
    path = tmp_path / "knot.any"
    path.write_text(text)
    with pytest.raises(FileFormatError, match=rf"knot\.any: .*{message}"):
        read_knot(path)


@pytest.mark.parametrize("form", [form.name for form in FORMS])
def test_a_form_that_is_asked_for_is_the_only_one(form: str) -> None:
    with pytest.raises(KnotoptError):
        read_knot('{"a": [1, {"b": 2}]}', form=form)
    with pytest.raises(KnotoptError):
        read_knot("no knot at all; nothing", form=form)


def test_words_of_options() -> None:
    with pytest.raises(FileFormatError, match="no form is named 'knot'; name, matrix, "):
        read_knot("3_1", form="knot")
    with pytest.raises(FileFormatError, match="passes over is 'left', not columns or rows"):
        read_knot("3_1", over="left")
    with pytest.raises(FileFormatError, match=r"read as matrix \(matrix\): it is of the form name"):
        read_knot("3_1", form="matrix")
    with pytest.raises(FileFormatError, match=r"cannot be read as curve \(curve in space\)$"):
        read_knot("a knot", form="curve")


@pytest.mark.parametrize(
    "knot", ["3_1", "7 var1", "[4, 6, 2]", "O1+U2+O3+U1+O2+U3+", "BR[2,{1,1,1}]"]
)
def test_who_passes_over_is_asked_of_written_grids_only(knot: str) -> None:
    for over in ("rows", "columns"):
        with pytest.raises(FileFormatError, match=f"over {over} is about grids in writing"):
            read_knot(knot, over=over)
    with pytest.raises(FileFormatError, match="over rows is about grids in writing"):
        read_knot(read_knot(knot).diagram, over="rows")
    with pytest.raises(FileFormatError, match="this is read as: rope's state"):
        read_goal("O1+ U2+ O3+ U1+ O2+ U3+", over="rows")
