"""Grids written in random dialects of every form are read back."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from knotopt.diagram.grid import GridDiagram
from knotopt.errors import KnotoptError
from knotopt.reading.knot import read_knot
from tests.helpers import dialects
from tests.helpers.strategies import diagrams


@pytest.mark.parametrize("form", dialects.FORMS)
@settings(suppress_health_check=[HealthCheck.function_scoped_fixture], max_examples=60)
@given(data=st.data(), diagram=diagrams(3))
def test_every_form_is_read_back(
    tmp_path: Path, form: str, data: st.DataObject, diagram: GridDiagram
) -> None:
    text = data.draw(dialects.FORMS[form](diagram))
    found = read_knot(text)
    assert found.diagram.marks == diagram.marks
    if form in {"matrix", "xo"}:
        assert found.diagram == diagram, "orientation is the matrix's"
    names = st.sampled_from(["knot", "knot.json", "knot.csv", "3_1", "a b.txt"])
    path = tmp_path / data.draw(names)
    path.write_bytes(data.draw(dialects.encoded(text)))
    read = read_knot(path)
    assert (read.diagram, read.name, read.form) == (found.diagram, path.name, found.form)
    over = data.draw(st.sampled_from(["rows", "columns"]))
    turned = read_knot(text, over=over, mirror=over == "rows")
    assert turned.diagram.marks == diagram.marks and not turned.ambiguous


@given(
    diagrams(3),
    st.sampled_from([",", ";", "\t"]),
    st.sampled_from(["none", "letters", "words"]),
    st.sampled_from(["none", "up", "down", "from 0", "letters", "named"]),
    st.sampled_from(["", "0"]),
)
def test_empty_cells_of_a_matrix_are_zeros(
    diagram: GridDiagram, separator: str, header: str, index: str, some: str
) -> None:
    size = diagram.size
    cells = [["" if not cell else str(cell) for cell in line] for line in diagram.matrix.tolist()]
    cells[0] = [cell or some for cell in cells[0]]
    names = [chr(ord("A") + k) if header == "letters" else f"col{k}" for k in range(size)]
    if header != "none":
        cells.insert(0, names)
        if index != "none":
            counts = {"down": range(size, 0, -1), "from 0": range(size), "letters": names}
            firsts = ["row" if index == "named" else ""]
            firsts += map(str, counts.get(index, range(1, size + 1)))
            cells = [[first, *row] for first, row in zip(firsts, cells, strict=True)]
    found = read_knot("\n".join(map(separator.join, cells)))
    assert (found.form, found.diagram) == ("matrix", diagram)


def test_a_spreadsheets_matrix_with_empty_cells() -> None:
    text = ",A,B,C,D,E\n1,1,,,-1,\n2,,1,,,-1\n3,-1,,1,,\n4,,-1,,1,\n5,,,-1,,1\n"
    filled = "1 0 0 -1 0\n0 1 0 0 -1\n-1 0 1 0 0\n0 -1 0 1 0\n0 0 -1 0 1\n"
    assert read_knot(text).diagram == read_knot(filled).diagram
    with pytest.raises(KnotoptError, match=r"row 3 has one mark \(column 3\)"):
        read_knot(text.replace("3,-1,", "3,,"))


@given(diagrams(), st.booleans())
def test_what_show_prints_as_json_is_read(diagram: GridDiagram, is_keyed: bool) -> None:
    marks = [list(mark) for mark in diagram.marks]
    content = {"knot": "mine", "crossings": 3, "grid": marks, "pd_code": []} if is_keyed else marks
    found = read_knot(json.dumps(content))
    assert found.diagram == GridDiagram.from_marks(marks)
    assert found.ambiguous != is_keyed


@given(diagrams())
def test_values_of_python_are_read(diagram: GridDiagram) -> None:
    for value in (diagram, diagram.matrix, diagram.matrix.tolist(), diagram.matrix.astype(float)):
        assert read_knot(value).diagram == diagram
    assert read_knot(diagram.marks).diagram.marks == diagram.marks
    assert read_knot({"X": diagram.minus, "O": diagram.plus}).diagram == diagram
    again = read_knot(read_knot(diagram), mirror=True)
    assert again.diagram == diagram.mirrored
