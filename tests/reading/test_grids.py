"""Reading grid diagrams from files."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from hypothesis import HealthCheck, given, settings

from knotopt.diagram.families import torus_knot
from knotopt.diagram.grid import GridDiagram
from knotopt.errors import FileFormatError
from knotopt.files import write_atomically
from knotopt.reading.knot import read_knot
from tests.helpers.strategies import diagrams


def csv_of(lines: object) -> str:
    return "".join(",".join(map(str, line)) + "\n" for line in lines)  # type: ignore[attr-defined]


@settings(suppress_health_check=[HealthCheck.function_scoped_fixture], max_examples=30)
@given(diagrams())
def test_every_form_is_read_back(tmp_path: Path, diagram: GridDiagram) -> None:
    matrix, marks = diagram.matrix.tolist(), [list(mark) for mark in diagram.marks]
    oriented = GridDiagram.from_marks(marks)
    forms = {
        "matrix.json": (json.dumps(matrix), diagram),
        "key.json": (json.dumps({"matrix": matrix, "comment": "any"}), diagram),
        "marks.json": (json.dumps(marks), oriented),
        "grid.json": (json.dumps({"grid": marks}), oriented),
        "matrix.csv": (csv_of(matrix), diagram),
        "marks.csv": (csv_of(marks), oriented),
        "header.csv": ("\ufeffcolumn,row\n\n" + csv_of(marks), oriented),
    }
    for name, (text, expected) in forms.items():
        path = tmp_path / name
        path.write_text(text, encoding="utf-8")
        assert read_knot(path).diagram == expected, name
        assert read_knot(str(path)).diagram == expected


@pytest.mark.parametrize(
    ("name", "text", "message"),
    [
        ("a.txt", "", r"a.txt: expected a .json or .csv file"),
        ("a.json", "{", r"a.json: line 1 is not JSON"),
        ("a.json", "[\n1,\n", r"a.json: line 3 is not JSON"),
        (
            "a.json",
            '{"knot": "3_1"}',
            r"""expected either the key "grid" or "matrix", found 'knot'""",
        ),
        ("a.json", '{"grid": [], "matrix": []}', "found 'grid', 'matrix'"),
        ("a.json", "{}", "found none"),
        ("a.json", "3", "expected a list of lists"),
        ("a.json", '{"grid": 3}', r'expected a list of lists.*\(key "grid"\)'),
        ("a.json", "[[1, 0], [0, 1], [1, 1], [0, 0]]", r"a.json: mark \[1, 0\] is outside"),
        ("a.json", "[]", "no marks"),
        ("a.json", '{"matrix": []}', "at least 2 x 2"),
        ("a.json", "[" * 100_000, "not the JSON of a grid diagram"),
        ("a.json", "[[" + "1" * 5000 + "]]", "not the JSON of a grid diagram"),
        ("a.csv", "1" * 200_000, "not the CSV of a grid diagram"),
        ("a.csv", "1,-1\n-1,x\n", "a.csv: line 2 is '-1,x', expected integers"),
        ("a.csv", "column,row\n1,1.5\n", "line 2"),
        ("a.csv", "1,-1,0\n-1,1\n", "not square"),
        ("a.csv", "", "no marks"),
    ],
)
def test_bad_files(tmp_path: Path, name: str, text: str, message: str) -> None:
    path = tmp_path / name
    path.write_text(text)
    with pytest.raises(FileFormatError, match=message):
        read_knot(path)


def test_unreadable_files(tmp_path: Path) -> None:
    with pytest.raises(FileFormatError, match=r"cannot read .*none.json: No such file"):
        read_knot(tmp_path / "none.json")
    (tmp_path / "dir.json").mkdir()
    with pytest.raises(FileFormatError, match="Is a directory"):
        read_knot(tmp_path / "dir.json")
    (tmp_path / "bytes.csv").write_bytes(b"\xff\xfe1")
    with pytest.raises(FileFormatError, match=r"not UTF-8 text \(byte 0\)"):
        read_knot(tmp_path / "bytes.csv")


def test_torus_knot_survives_the_round_trip_by_file(tmp_path: Path) -> None:
    write_atomically(tmp_path / "t.json", json.dumps({"grid": torus_knot(3, 5).marks}))
    assert read_knot(tmp_path / "t.json").diagram == torus_knot(3, 5)
