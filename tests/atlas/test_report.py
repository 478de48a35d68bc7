"""The report of an atlas: its numbers by other ways to them, and what it is written in."""

from __future__ import annotations

import csv
import io
import re
import shutil
from collections import Counter
from dataclasses import replace
from pathlib import Path
from statistics import mean
from typing import Any

import numpy as np
import pytest
from scipy.stats import spearmanr

from knotopt.atlas.engine import Local
from knotopt.atlas.knot_list import knot_rows
from knotopt.atlas.report import cases, invariants
from knotopt.atlas.report.atlas_csv import COLUMNS, atlas_csv
from knotopt.atlas.report.cuts import by_cut_table, spread_table
from knotopt.atlas.report.families import alternating_table, families_table
from knotopt.atlas.report.heuristic import class_table, classes, variants_table
from knotopt.atlas.report.invariants import TORUS, TWIST, Invariants
from knotopt.atlas.report.relations import correlation_table, invariant_columns, partial_spearman
from knotopt.atlas.report.report import report_document, report_files
from knotopt.atlas.report.results import Results, read_results
from knotopt.atlas.report.robots import distribution_table, means_table
from knotopt.atlas.report.times import paths_section, times_table
from knotopt.atlas.run import run_atlas
from knotopt.atlas.schema import File, Settings
from knotopt.atlas.store import read_rows
from knotopt.cable.cut import OUTER_CUTS
from knotopt.catalogue.knotinfo import is_installed
from knotopt.document.markdown import markdown
from knotopt.document.model import Table
from knotopt.errors import OutputError
from knotopt.reading.knot import read_knot
from knotopt.verify.opening import check_opening
from tests.helpers.typesetting import typeset

NAMES = ("3_1", "5_1", "5_2", "8_1", "8_19", "8_20", "8_21")


def run(folder: Path, names: tuple[str, ...], settings: Settings | None = None) -> Results:
    listed = knot_rows(map(read_knot, names))
    run_atlas(folder, listed, settings or Settings(check=0), Local())
    return read_results(folder)


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder: Path = tmp_path_factory.mktemp("atlas") / "run"
    run(folder, NAMES, Settings(check=1))
    return folder


@pytest.fixture(scope="module")
def results(folder: Path) -> Results:
    return read_results(folder)


@pytest.fixture(scope="module")
def rows(folder: Path) -> list[dict[str, Any]]:
    return list(read_rows(folder, File.ATLAS).to_pylist())


def column(table: Table, head: str) -> dict[str, str]:
    """The cells under a head, by their row's first cell."""
    place = table.heads.index(head)
    return {row[0]: row[place] for row in table.rows}


def by_knot(rows: list[dict[str, Any]], key: str) -> dict[str, list[Any]]:
    found: dict[str, list[Any]] = {}
    for row in rows:
        found.setdefault(row["knot"], []).append(row[key])
    return found


def test_means_and_distribution(results: Results, rows: list[dict[str, Any]]) -> None:
    means = means_table(results)
    assert "`span`" not in means.heads
    for head, key in (("LCF", "lcf_robots"), ("`opening`", "opening_robots")):
        cells = column(means, head)
        for number in (3, 5, 8):
            group = [row[key] for row in rows if row["crossing_number"] == number]
            assert cells[str(number)] == f"{mean(group):.2f}"
        best = [min(values) for values in by_knot(rows, key).values()]
        assert cells["all, best cut of each"] == f"{mean(best):.2f}"
    fewest = Counter(min(values) for values in by_knot(rows, "opening_robots").values())
    spread = distribution_table(results, "opening_robots")
    for head in spread.heads[2:]:
        assert column(spread, head)["all"] == (str(fewest[int(head)]) if fewest[int(head)] else "")
    assert sum(int(cell or 0) for cell in spread.rows[-1][2:]) == len(NAMES)


def test_classes_of_cuts(results: Results, rows: list[dict[str, Any]]) -> None:
    total = sum(held.astype(int) for held in classes(results).values())
    assert np.all(total == 1)
    assert np.array_equal(classes(results)["fewer than any open"], results.holds("lcf_below"))
    found = class_table(results)
    excess = [row["lcf_robots"] - row["opening_robots"] for row in rows if row["lcf_open"]]
    below = [row["opening_robots"] - row["lcf_robots"] for row in rows if row["lcf_below"]]
    *_, everything = found.rows
    assert everything[0:3] == ("all", str(len(rows)), f"{100 * len(excess) / len(rows):.1f} %")
    assert everything[-4:] == (
        f"{mean(excess):.2f}",
        str(max(excess)),
        f"{mean(below):.2f}",
        str(max(below)),
    )
    layered = column(variants_table(results), "open")["layered, over-under"]
    share = mean(row["layered_open_over_under"] for row in rows)
    assert layered == f"{100 * share:.1f} %"


def test_best_and_worst_cut(results: Results, rows: list[dict[str, Any]]) -> None:
    robots = by_knot(rows, "opening_robots").values()
    _, last, piercing = (row for row in spread_table(results).rows if row[1] == "all")
    assert piercing[:3] == ("`loops`", "all", str(len(NAMES)))
    assert last[:3] == ("`opening`", "all", str(len(NAMES)))
    assert last[3] == f"{mean(map(min, robots)):.2f}"
    assert last[7] == str(max(max(values) - min(values) for values in robots))
    _, best, alone = by_cut_table(results).rows
    for k, _ in enumerate(OUTER_CUTS, 1):
        assert int(best[k]) == sum(values[k - 1] == min(values) for values in robots)
        assert int(alone[k]) <= int(best[k])


def test_families(results: Results) -> None:
    known = {"8_20": Invariants(3, 3, 1, True), "8_1": Invariants(2, 5, 1, False)}
    found = families_table(results, known)
    assert column(found, "knots") | {} == {
        "all": "7",
        "alternating": "4",
        "not alternating": "3",
        "torus": "3",
        "twist": "3",
        "two-bridge": "1",
        "three-bridge": "1",
        "pretzel": "1",
        "not pretzel": "1",
    }
    assert column(found, "of")["pretzel"] == "2"
    assert column(found, "fewest, most")["twist"] == "5, 5"
    (row,) = [r for r in alternating_table(results).rows if r[0] == "crossing number 8"]
    assert row[1:3] == ("1", "3")


@pytest.mark.slow
@pytest.mark.skipif(not is_installed(), reason="needs the knotinfo extra")
def test_torus_and_twist_knots_by_their_two_bridge_notation() -> None:
    from database_knotinfo import link_list

    table = link_list()[1:]
    torus = [row["name"] for row in table if row["geometric_type"].startswith("torus")]
    twist = []
    for row in table:
        if row["two_bridge_notation"]:
            p, q = map(int, row["two_bridge_notation"].strip("[]").split(","))
            if {2 % p, -2 % p} & {q % p, pow(q, -1, p)}:
                twist.append(row["name"])
    assert sorted(torus) == sorted(TORUS)
    assert sorted(twist) == sorted(TWIST)
    for row in table[1:]:  # what the report says of families' sizes
        if row["alternating"] == "Y":
            assert int(row["arc_index"]) == int(row["crossing_number"]) + 2
        else:
            assert int(row["arc_index"]) <= int(row["crossing_number"])
    known = invariants.invariants(knot_rows(map(read_knot, ("3_1", "10_11", "T(2,5)"))))
    assert known["3_1"] == Invariants(2, 2, 1, True)
    assert known["10_11"].unknotting_number is None  # two or three
    assert set(known) == {"3_1", "10_11"}


def test_rank_correlations_by_residuals() -> None:
    generator = np.random.default_rng(0)
    x, y, z, w = generator.integers(0, 6, (4, 80)).astype(float)
    y += x + z
    x[3] = np.nan
    kept = ~np.isnan(x)
    assert partial_spearman(x, y) == pytest.approx(spearmanr(x[kept], y[kept]).statistic)
    ranks = [np.argsort(np.argsort(v[kept])) for v in (x, y)]
    assert len(ranks[0]) == 79
    from scipy.stats import rankdata

    r = {name: rankdata(v[kept]) for name, v in {"x": x, "y": y, "z": z, "w": w}.items()}
    for given in (["z"], ["z", "w"]):
        base = np.column_stack([np.ones(79), *(r[name] for name in given)])

        def left(name: str, base: np.ndarray = base) -> np.ndarray:
            return r[name] - base @ np.linalg.lstsq(base, r[name], rcond=None)[0]

        expected = np.corrcoef(left("x"), left("y"))[0, 1]
        others = [{"z": z, "w": w}[name] for name in given]
        assert partial_spearman(x, y, *others) == pytest.approx(expected)


def test_rank_correlations_that_are_undefined() -> None:
    x = np.arange(8.0)
    assert np.isnan(partial_spearman(x, np.ones(8)))
    assert np.isnan(partial_spearman(x, x[::-1], x**3))  # fixed by what is given
    assert np.isnan(partial_spearman(x[:2], x[:2]))
    assert np.isnan(partial_spearman(x, np.full(8, np.nan)))
    assert np.isnan(partial_spearman(x, np.cos(x), np.sin(x), np.exp(np.sin(x))))


def test_correlations_say_how_many_knots_they_rest_on(results: Results) -> None:
    known = {"8_20": Invariants(3, None, 1, True), "8_1": Invariants(2, 5, 1, False)}
    found = correlation_table(results, invariant_columns(results, known), "opening_robots")
    assert set(column(found, "knots").values()) == {"7"}
    assert "bridge index" not in column(found, "knots")  # of two knots
    assert column(found, "given arc index")["arc index"] == "–"


def test_cases_are_what_they_are_called(results: Results) -> None:
    wasteful, failing = cases.wasteful(results), cases.failing(results)
    assert wasteful
    assert failing
    for found, is_open in ((wasteful, True), (failing, False)):
        sizes = [abs(case.difference) for case in found]
        assert sizes == sorted(sizes, reverse=True)
        assert len({case.name for case in found}) == len(found)
        for case in found:
            assert (case.difference > 0) == is_open
            for supports, expected in ((case.lcf, is_open), (case.smallest, True)):
                report = check_opening(
                    case.cable.path, case.cable.diagram.size, supports, results.manifest.settings.r
                )
                assert report.is_open == expected


def test_atlas_csv(results: Results, rows: list[dict[str, Any]]) -> None:
    read = list(csv.DictReader(io.StringIO(atlas_csv(results))))
    assert list(read[0]) == [name for name in COLUMNS if not name.startswith(("span", "safe"))]
    for line, row in zip(read, rows, strict=True):
        assert (line["knot"], line["cut"]) == (row["knot"], row["cut"])
        assert int(line["opening_robots"]) == row["opening_robots"]
        assert line["lcf_open"] == str(row["lcf_open"])
        assert [int(k) for k in line["opening_supports"].split()] == row["opening_supports"]


def test_times(results: Results) -> None:
    found = times_table(results)
    assert [row[0] for row in found.rows] == [
        "LCF and its layered set",
        "`opening`, turning-point",
        "`opening`, over-under",
        "`loops`",
        "checks by the definitions",
    ]
    for row in found.rows:
        assert row[1] == "56"
        assert float(row[2]) <= float(row[3]) <= float(row[4])


@pytest.mark.slow
def test_same_bytes_every_time(results: Results, folder: Path) -> None:
    first, second = report_files(results), report_files(read_results(folder))
    assert first == second
    text = first["report.md"]
    assert isinstance(text, str)
    assert "7 knots, 56 cuts" in text
    for name in re.findall(r"\]\((\w+\.png)\)", text):
        assert name in first


def test_span_and_paths_are_reported(tmp_path: Path) -> None:
    found = run(tmp_path / "run", ("3_1",), Settings(span=True, paths=True, check=0))
    document = report_document(found, {})
    titles = [section.title for section in document.sections]
    assert "Cable paths" in titles
    text = markdown(document)
    assert "| LCF | layered | `opening` | over-under | `span` |" in text
    assert "No set of this run was examined by the definitions" in text
    assert "which is not" not in text
    section = paths_section(found)
    assert section is not None
    (paths,) = section.blocks
    assert isinstance(paths, Table)
    assert column(paths, "paths") == {"lcf": "8", "opening": "8"}


def test_grids_that_no_table_knows(tmp_path: Path) -> None:
    found = run(tmp_path / "run", ("T(2,5)", "3_1"))
    files = report_files(found)
    assert "not in a table" in str(files["report.md"])
    unknown = run(tmp_path / "other", ("T(2,5)",))
    names = [picture.name for picture in report_document(unknown, {}).pictures]
    assert "relations" not in names  # no arc index
    assert "| T(2,5) |" in str(report_files(unknown)["report.md"])


def test_unfinished_and_damaged_runs(results: Results, folder: Path, tmp_path: Path) -> None:
    with pytest.raises(OutputError, match="is not the folder of an atlas"):
        read_results(tmp_path)
    copy = tmp_path / "run"
    shutil.copytree(folder, copy)
    (copy / File.ATLAS).rename(copy / "elsewhere")
    with pytest.raises(OutputError, match="is not complete: run `knotopt atlas` again"):
        read_results(copy)
    assert len(results.knots) == len(NAMES)


@pytest.mark.slow
def test_latex_of_a_report(results: Results, tmp_path: Path) -> None:
    for name, content in report_files(results).items():
        data = content.encode() if isinstance(content, str) else content
        (tmp_path / name).write_bytes(data)
    log = typeset((tmp_path / "report.tex").read_text(encoding="utf-8"), tmp_path)
    assert "Overfull" not in log


def test_refused_spans_are_said(results: Results) -> None:
    asked = replace(results.manifest, settings=replace(results.manifest.settings, span=True))
    text = markdown(report_document(replace(results, manifest=asked), {}))
    assert "It is left out here: 56 cuts are too large for it." in text
