"""Grids written in random dialects of every form are read back."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from knotopt.diagram.grid import GridDiagram
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
