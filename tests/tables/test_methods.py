"""The methods that are compared, and a new one, which appears wherever they do."""

from __future__ import annotations

import subprocess
import sys
from itertools import product

import pytest

from knotopt.atlas.columns import FILES
from knotopt.atlas.schema import File
from knotopt.document.columns import check_rows, names
from knotopt.supports.registry import FORMULATIONS
from knotopt.tables import comparison, table1
from knotopt.tables.methods import HEURISTICS, LCF, OPENING, PROGRAMS, SPAN, USUAL_PROGRAMS

NEW = """
from dataclasses import replace
from knotopt.supports.registry import FORMULATIONS
from knotopt.tables import methods
from knotopt.verify.registry import DEFINITIONS

FORMULATIONS["rooms"] = replace(FORMULATIONS["opening"], name="rooms")
DEFINITIONS["rooms"] = replace(DEFINITIONS["opening"], name="rooms")
rooms = methods.SmallestSet("rooms", "rooms", "`rooms`", formulation="rooms")
methods.PROGRAMS += (rooms,)
methods.USUAL_PROGRAMS += (rooms,)

from knotopt.atlas.columns import FILES
from knotopt.atlas.knot_list import knot_rows
from knotopt.atlas.measure import measure_knot
from knotopt.atlas.schema import File, Settings
from knotopt.reading.knot import read_knot
from knotopt.document.columns import check_rows
from knotopt.tables import comparison, table1

found = read_knot("3")
table = comparison.comparison_table([comparison.compare("3_1", found.diagram)]).document.tables[0]
print(dict(zip(table.heads, table.rows[0]))["rooms"])
table = table1.tabulated([next(table1.compute_table1())]).document.tables[0]
print(dict(zip(table.heads, table.rows[0]))["rooms"])
result = measure_knot(knot_rows([found])[0], Settings(check=1))
check_rows(FILES[File.ATLAS], result.rows)
print({(row["rooms_robots"], row["opening_robots"], row["checked"]) for row in result.rows})
"""


def test_a_new_formulation_appears_in_every_table() -> None:
    run = subprocess.run([sys.executable, "-c", NEW], capture_output=True, text=True, check=False)
    assert run.returncode == 0, run.stderr
    assert run.stdout.splitlines() == ["5", "5 (5)", "{(5, 5, True)}"]


def test_every_formulation_is_in_the_tables_and_those_that_go_with_loops_twice() -> None:
    usual = [(method.formulation, method.with_loops) for method in USUAL_PROGRAMS]
    assert usual == [("opening", False), ("span", False), ("span", True), ("loops", False)]
    assert {name for name, _ in usual} == {*FORMULATIONS}
    keys = [method.key for method in (*HEURISTICS, *PROGRAMS)]
    assert len(keys) == len({*keys})


def test_columns_are_the_same_wherever_they_stand() -> None:
    told: dict[str, str] = {}
    tables = (comparison.COLUMNS, table1.COLUMNS, FILES[File.ATLAS], FILES[File.FLIGHTS])
    for method, columns in product((*HEURISTICS, *USUAL_PROGRAMS), tables):
        for column in columns:
            if column.name.startswith(f"{method.key}_"):
                assert told.setdefault(column.name, column.meaning) == column.meaning
    assert {"lcf_open", "opening_robots", "span_supports", "opening_open"} < {*told}


def test_columns_and_cells() -> None:
    robots, seconds = SPAN.columns("robots", "seconds")
    assert (robots.name, robots.kind, robots.optional) == ("span_robots", int, True)
    assert (
        seconds.meaning == "compile, build and solve, `span` without loops [s]" and seconds.optional
    )
    assert not OPENING.columns("seconds")[0].optional
    assert LCF.cells(robots=5, open=False) == {"lcf_robots": 5, "lcf_open": False}
    with pytest.raises(KeyError):
        LCF.columns("bound")


def test_units_are_said_of_times() -> None:
    for column in FILES[File.TIMES]:
        assert column.kind is not float or column.meaning.endswith(("[s]", "[MiB]"))


def test_rows_have_the_columns_of_their_file() -> None:
    row = dict.fromkeys(names(FILES[File.TIMES]))
    check_rows(FILES[File.TIMES], [row])
    del row["cut"]
    with pytest.raises(ValueError, match="lacks, or has too much: cut, cuts"):
        check_rows(FILES[File.TIMES], [row | {"cuts": 8}])
