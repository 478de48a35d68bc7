"""`knotopt table1`: what is printed and written of one computation of the table."""

from __future__ import annotations

import csv
import json
from collections.abc import Iterable
from pathlib import Path

import pytest

from knotopt.tables import table1
from knotopt.tables.table1 import NOTE, Table1Result, compute_table1
from tests.helpers.command_line import Cli


@pytest.fixture(scope="module")
def computed() -> tuple[Table1Result, ...]:
    return tuple(compute_table1())


@pytest.fixture
def printed(cli: Cli, computed: tuple[Table1Result, ...]) -> Cli:
    """The command line, which takes the table as it was computed."""
    return taking(cli, computed)


def taking(cli: Cli, results: tuple[Table1Result, ...]) -> Cli:
    def at_hand(*, all_grids: bool = False) -> Iterable[Table1Result]:
        assert not all_grids
        return results

    cli.monkeypatch.setattr(table1, "compute_table1", at_hand)
    return cli


def test_the_table_and_the_note_are_printed(printed: Cli) -> None:
    status, out, _ = printed("table1")
    assert status == 0
    for row in printed.json("table1"):
        cells = (
            *row["row"].split(),
            row["knot"],
            str(row["needed"]),
            *f"{row['flown']} ({row['flown_tied']} of {row['flown_flights']})".split(),
            *(str(row[key]) for key in ("robots_after_paper", "robots_after")),
            "yes" if row["lcf_open"] else "no",
            str(row["robots_before"]),
            row["cut"],
            str(row["opening_same_cut"]),
            f"({row['opening_robots']})",
            str(row["span_same_cut"]),
            f"({row['span_robots']})",
            str(row["safe_same_cut"]),
            f"({row['safe_robots']})",
            str(row["loops_same_cut"]),
            f"({row['loops_robots']})",
            "yes",
        )
        assert list(cells) in [line.split() for line in out.splitlines()]
    assert " ".join(NOTE.split()) in " ".join(out.split())


def test_the_numbers_of_the_paper(printed: Cli) -> None:
    rows = printed.json("table1")
    assert [row["robots_after"] for row in rows] == [5, 5, 5, 7, 8, 6]
    assert [row["robots_after_paper"] for row in rows] == [5, 5, 5, 7, 8, 6]
    assert [row["robots_before"] for row in rows] == [10, 12, 14, 18, 18, 22]
    assert [row["crossings"] for row in rows] == [3, 4, 5, 7, 7, 9]
    assert rows[5]["reduction_percent"] == 72.7
    assert [row["lcf_open"] for row in rows] == [False, False, False, False, True, False]
    assert [row["opening_same_cut"] for row in rows] == [5, 5, 6, 12, 6, 6]
    assert [row["opening_robots"] for row in rows] == [5, 5, 6, 12, 6, 5]
    assert all(row["proven"] for row in rows)
    paths = [path for row in rows for path in row["paths"]]
    assert [path["method"] for path in paths] == ["relaxation", "nlp"] * 6
    assert {path["same_diagram"] for path in paths} == {True}
    lengths = [path["length"] for path in paths]
    assert all(ours < relaxed for relaxed, ours in zip(lengths[::2], lengths[1::2], strict=True))


def test_json_has_the_columns_of_the_csv(
    cli: Cli, computed: tuple[Table1Result, ...], tmp_path: Path
) -> None:
    first = taking(cli, computed[:1])  # five pictures instead of thirty
    rows = first.json("table1")
    status, out, _ = first("table1", "--out", tmp_path)
    assert status == 0 and "written:" in out
    columns, stored = of_csv(tmp_path / "table1.csv")
    assert [*columns, "paths"] == list(rows[0])
    assert [json.loads(row["supports"]) for row in stored] == [row["supports"] for row in rows]
    assert NOTE in (tmp_path / "table1.md").read_text()
    assert sorted(path.name for path in (tmp_path / "figures").iterdir()) == [
        f"table1_3_3_1{end}.png" for end in ("", "_fig5", "_fig7", "_minimal", "_path")
    ]
    columns, stored = of_csv(tmp_path / "table1_paths.csv")
    assert [row["method"] for row in stored] == ["relaxation", "nlp"]
    assert (tmp_path / "table1_paths.md").read_text().count("\n| ") == 3


def of_csv(path: Path) -> tuple[list[str], list[dict[str, str]]]:
    """Columns and rows."""
    with path.open(newline="") as stream:
        reader = csv.DictReader(stream)
        rows = list(reader)
    return [*(reader.fieldnames or ())], rows


def test_all_grids_are_not_written(cli: Cli, tmp_path: Path) -> None:
    status, _, err = cli("table1", "--all-grids", "--out", tmp_path)
    assert status == 2 and "leave out --all-grids" in err and not list(tmp_path.iterdir())


@pytest.mark.slow
def test_all_grids(cli: Cli) -> None:
    rows = cli.json("table1", "--all-grids")
    assert len(rows) == 15
    assert all(row["robots_after"] == row["robots_after_paper"] for row in rows)


@pytest.mark.slow
def test_the_table_is_written_the_same_every_time(cli: Cli, tmp_path: Path) -> None:
    for run in "ab":
        assert cli("table1", "--out", tmp_path / run)[0] == 0
    figures = sorted(path.name for path in (tmp_path / "a/figures").iterdir())
    assert len(figures) == 30 and "table1_7_Var1_7_2_minimal.png" in figures
    assert {"table1_9_9_2_fig5.png", "table1_9_9_2_fig7.png", "table1_9_9_2_path.png"} < {*figures}
    assert (tmp_path / "a/table1.md").read_text().count("\n| ") >= 6
    assert (tmp_path / "a/table1_paths.md").read_text().count("\n| ") == 13
    for path in (tmp_path / "a").rglob("*.*"):
        if path.stem == "table1_paths":
            continue  # these have milliseconds
        assert path.read_bytes() == (tmp_path / "b" / path.relative_to(tmp_path / "a")).read_bytes()
