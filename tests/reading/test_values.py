"""Values of Python: tables of pandas are read, and what is no knot is refused in one sentence."""

from __future__ import annotations

from fractions import Fraction
from typing import Any

import numpy as np
import pytest
import snappy

from knotopt.errors import FileFormatError, KnotoptError
from knotopt.reading.knot import read_knot

MATRIX = read_knot("8_19").diagram.matrix


def test_a_table_of_pandas_is_its_array() -> None:
    pandas = pytest.importorskip("pandas")
    expected = read_knot(MATRIX)
    filled = pandas.DataFrame(MATRIX)
    named = pandas.DataFrame(MATRIX, columns=list("ABCDEFG"))
    for table in (filled, named, filled.where(filled != 0), named.where(named != 0)):
        found = read_knot(table)
        assert (found.form, found.diagram) == ("matrix", expected.diagram)
    marks = pandas.DataFrame(expected.diagram.marks, columns=["column", "row"])
    for table in (marks, marks[["row", "column"]]):
        assert read_knot(table).diagram.marks == expected.diagram.marks
    assert read_knot(pandas.Series([4, 6, 2])).form == "DT code"


def test_other_whole_numbers_and_reals() -> None:
    code = [np.int8(4), np.int64(6), np.float32(2)]
    assert read_knot(code).form == "DT code"
    assert read_knot([Fraction(4), Fraction(6), Fraction(2)]).form == "DT code"


@pytest.mark.parametrize(
    ("value", "words"),
    [
        (None, "not as None"),
        (3, "not as int"),
        (np.int64(3), "not as int"),
        (True, "not as bool"),
        (b"3_1", "not as bytes"),
        ({1, 2}, "not as set"),
        (object(), "not as object"),
        (snappy.Manifold("4_1"), r"not as snappy\.Manifold: its method link\(\) may give its link"),
        ([object()], "hold numbers and texts, not object"),
        ([[1j, 2]], "hold numbers and texts, not complex"),
        ({"pd": b"x"}, "hold numbers and texts, not bytes"),
        ([snappy.Manifold("4_1")], r"hold numbers and texts, not snappy\.Manifold"),
    ],
)
def test_what_is_no_knot_is_named(value: Any, words: str) -> None:
    with pytest.raises(FileFormatError, match=words) as caught:
        read_knot(value)
    assert "\n" not in str(caught.value)


def test_lists_that_hold_themselves() -> None:
    endless: list[Any] = []
    endless.append(endless)
    with pytest.raises(KnotoptError, match="hold numbers and texts, not list"):
        read_knot(endless)


def test_an_object_with_a_name_alone() -> None:
    for knot in ({"name": "8_19"}, '{"name": "8_19"}', '{"Name": "8_19"}'):
        found = read_knot(knot)
        assert (found.name, found.form, found.diagram.size) == ("8_19", "name", 7)
    assert read_knot({"name": "mine", "dt": [4, 6, 2]}).form == "DT code"
    with pytest.raises(FileFormatError, match=r"expected a key such as .* found 'name', 'data'"):
        read_knot({"name": "8_19", "data": []})
    with pytest.raises(KnotoptError, match="no knot is named '8_22'"):
        read_knot({"name": "8_22"})
