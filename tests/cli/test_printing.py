"""Tables in terminals of any width: no column vanishes, no number breaks."""

from __future__ import annotations

import io
import re
import sys
from collections.abc import Sequence
from contextlib import redirect_stdout

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from knotopt.cli import printing
from knotopt.cli.printing import print_table

WORDS = st.lists(st.text("abcdefg", min_size=1, max_size=9), min_size=1, max_size=6).map(" ".join)
NUMBERS = st.floats(0, 99_999).map(lambda value: f"{value:.3f}")


@st.composite
def tables(draw: st.DrawFn) -> tuple[list[str], list[list[str]]]:
    kinds = draw(st.lists(st.sampled_from([WORDS, NUMBERS]), min_size=1, max_size=14))
    heads = [f"h{number}" for number in range(len(kinds))]
    rows = draw(st.integers(1, 5))
    return heads, [[draw(kind) for kind in kinds] for _ in range(rows)]


def printed(
    capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
    width: int,
    table: tuple[Sequence[str], Sequence[Sequence[object]]],
) -> str:
    monkeypatch.setenv("COLUMNS", str(width))
    monkeypatch.setattr(type(sys.stdout), "isatty", lambda _: True, raising=False)
    print_table(*table)
    return capsys.readouterr().out


@settings(deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(table=tables(), width=st.integers(40, 150))
def test_no_column_vanishes_and_no_number_breaks(
    table: tuple[list[str], list[list[str]]],
    width: int,
    capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    out = printed(capsys, monkeypatch, width, table)
    text = re.sub(r"\x1b\[[0-9;]*m", "", out)
    assert max(map(len, text.split("\n"))) <= width
    found = text.split()
    for word in [*table[0], *(word for row in table[1] for cell in row for word in cell.split())]:
        assert word in found


def test_a_wide_row_stands_in_a_column_of_its_own(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    heads = ("method", "status", "length", "/ taut", "radius", "clearance", "opening", "gap", "ms")
    cells = ("nlp", "solved", "15.53", "1.136", "0.133", "0.218", "0.260", "0.310", "40")
    lines = printed(capsys, monkeypatch, 60, (heads, [cells])).split("\n")
    assert [tuple(line.rsplit(maxsplit=1)) for line in lines if line.strip()] == [
        (f" {head}", cell) for head, cell in zip(heads, cells, strict=True)
    ]


def test_a_pipe_has_a_row_in_one_line(capsys: pytest.CaptureFixture[str]) -> None:
    print_table(("what", "n"), [("word " * 100, 1)])
    assert len([line for line in capsys.readouterr().out.split("\n") if line.strip()]) == 3


@given(table=tables())
def test_into_a_pipe_it_is_the_table_that_rich_makes(
    table: tuple[list[str], list[list[str]]],
) -> None:
    columns = [[head, *cells] for head, *cells in zip(table[0], *table[1], strict=True)]
    rich = io.StringIO()
    with redirect_stdout(rich):
        printing._print_grid(columns, 10_000)
    assert printing._unbroken(columns) + "\n" == rich.getvalue()
