"""Every method on the same knots: rows by other ways to them, and what is made of them."""

from __future__ import annotations

import json
from typing import Any

import pytest

from knotopt.cable.cut import Cut
from knotopt.document.columns import names
from knotopt.document.formats import WRITERS
from knotopt.reading.knot import read_knot
from knotopt.supports.lcf import lcf_by_cut
from knotopt.supports.search import best_supports
from knotopt.tables.comparison import COLUMNS, HEADS, compare, comparison_table
from knotopt.tables.methods import USUAL_PROGRAMS


@pytest.fixture(scope="module")
def rows() -> list[dict[str, Any]]:
    found = [read_knot(name) for name in ("3", "8_19")]
    return [compare(knot.name, knot.diagram, source=knot.source) for knot in found]


def test_a_row_agrees_with_each_method_alone(rows: list[dict[str, Any]]) -> None:
    for row, name in zip(rows, ("3", "8_19"), strict=True):
        diagram = read_knot(name).diagram
        cuts = [Cut.parse(cut, diagram.size) for cut in ("L+", "L-", "R+", "R-")]
        cuts += [Cut.parse(cut, diagram.size) for cut in ("B+", "B-", "T+", "T-")]
        assert row["lcf_robots"] == min(each.robots for each in lcf_by_cut(diagram).values())
        for method in USUAL_PROGRAMS:
            search = best_supports(diagram, method.requirements(), cuts=cuts)
            assert row[f"{method.key}_robots"] <= search.best.robots
            assert row[f"{method.key}_proven"]
        assert (*row,) == (*names(COLUMNS), "paths")


def test_rows_survive_the_file_of_a_run_that_stopped(rows: list[dict[str, Any]]) -> None:
    again = [json.loads(json.dumps(row)) for row in rows]
    for write in WRITERS.values():
        assert write(comparison_table(again)) == write(comparison_table(rows))


def test_what_is_shown(rows: list[dict[str, Any]]) -> None:
    methods, paths = comparison_table(rows).document.tables
    first, second, means = methods.rows
    assert methods.heads == HEADS
    assert first == (
        "3_1 (Table I, row 3)",
        "3",
        "3 (12 of 12)",
        "10",
        "5",
        "no",
        "5",
        "no",
        "5",
        "7",
        "7",
        "3",
        "yes",
    )
    assert second == ("8_19", "4", "–", "14", "10", "yes", "8", "no", "9", "10", "10", "4", "yes")
    assert means[:6] == ("mean of 2", "3.50", "3.00 of 1", "12.00", "7.50", "50 %")
    assert means[-1] == "100 %"
    assert [row[:4] for row in paths.rows] == [
        (supports, method, "2 of 2", "2 of 2")
        for supports in ("lcf", "opening")
        for method in ("relaxation", "nlp")
    ]
    assert paths.caption.startswith("Medians over 2 knots. ")
    assert len(comparison_table(rows[:1]).document.tables[0].rows) == 1


def test_a_method_without_a_set(rows: list[dict[str, Any]]) -> None:
    none = rows[0] | {"opening_robots": None, "opening_proven": False}
    methods, _ = comparison_table([none, none]).document.tables
    assert methods.rows[0][-5:] == ("none", "7", "7", "3", "no")
    assert methods.rows[-1][-5:] == ("–", "7.00", "7.00", "3.00", "0 %")


def test_columns_of_paths(rows: list[dict[str, Any]]) -> None:
    found = comparison_table(rows)
    assert len(found.names) == len(COLUMNS) + 4 * 12
    assert found.rows[0]["opening_nlp_length"] == rows[0]["paths"][3]["length"]
    assert "lcf_relaxation_robots" not in found.names
