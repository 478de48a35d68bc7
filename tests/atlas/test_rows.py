"""An atlas: its rows against other ways to them, and its parts."""

from __future__ import annotations

import json
from dataclasses import fields, replace
from pathlib import Path
from typing import Any

import pyarrow as pa
import pytest

from knotopt.atlas import run as running
from knotopt.atlas.columns import FILES
from knotopt.atlas.engine import Local
from knotopt.atlas.knot_list import catalogue_rows, folder_rows
from knotopt.atlas.measure import KnotResult, agrees_with_definition, measure_knot
from knotopt.atlas.run import Progress, run_atlas
from knotopt.atlas.schema import MANIFEST, PARTS, File, KnotRow, Manifest, Settings
from knotopt.atlas.store import read_manifest, read_rows
from knotopt.cable.cable import Cable
from knotopt.cable.cut import OUTER_CUTS
from knotopt.document.columns import names
from knotopt.errors import FileFormatError, OutputError, RequirementError
from knotopt.reading.knot import read_knot
from knotopt.supports.registry import FORMULATIONS
from knotopt.supports.search import best_supports
from knotopt.supports.span import SPAN
from knotopt.tables import methods
from knotopt.tables.comparison import compare
from tests.helpers.small_atlas import LIST, SETTINGS, Replay, contents


def test_rows_agree_with_compare_and_search(measured: dict[int, KnotResult]) -> None:
    for knot in LIST[:3]:
        rows = measured[knot.number].rows
        assert [row["cut"] for row in rows] == list(OUTER_CUTS)
        best = compare(
            knot.knot, knot.diagram, cuts=[Cable(knot.diagram, c).cut for c in OUTER_CUTS]
        )
        first = min(rows, key=lambda row: row["lcf_robots"])
        assert (first["lcf_robots"], first["cut"], first["lcf_open"]) == (
            best["lcf_robots"],
            best["lcf_cut"],
            best["lcf_open"],
        )
        layered = min(rows, key=lambda row: row["layered_robots"])
        assert (layered["layered_robots"], layered["layered_open"]) == (
            best["layered_robots"],
            best["layered_open"],
        )
        assert min(row["opening_robots"] or 99 for row in rows) == best["opening_robots"]
        assert {row["baseline"] for row in rows} == {best["robots_before"]}
        assert {row["crossings"] for row in rows} == {best["crossings"]}


def test_both_threading_modes_and_span(measured: dict[int, KnotResult]) -> None:
    knot = LIST[3]
    result = measure_knot(knot, Settings(span=True, check=1))
    for row in result.rows:
        cut = [Cable(knot.diagram, row["cut"]).cut]
        other = best_supports(knot.diagram, _asked("opening", "over-under"), cuts=cut)
        assert row["over_under_robots"] == other.best.robots
        for method in (methods.SPAN, methods.SAFE, methods.LOOPS):
            smallest = best_supports(knot.diagram, method.requirements(), cuts=cut).best
            assert row[f"{method.key}_robots"] == smallest.robots
        assert row["safe_robots"] >= max(row["span_robots"], row["loops_robots"])
        assert row["over_under_robots"] <= (row["opening_robots"] or 0)
        assert row["span_status"] == row["opening_status"] == "optimal"
        assert row["checked"]
    plain = measured[knot.number].rows
    assert [row | _no_span() for row in result.rows] == list(plain)


def _asked(formulation: str, threading: str | None = None) -> Any:
    from knotopt.supports.requirements import Requirements

    return Requirements(formulation, threading=threading)


def _no_span() -> dict[str, None]:
    return {name: None for name in names(FILES[File.ATLAS]) if name.startswith(("span_", "safe_"))}


def test_lcf_below_means_that_no_open_set_is_as_small(measured: dict[int, KnotResult]) -> None:
    rows = [row for result in measured.values() for row in result.rows]
    assert {row["lcf_below"] for row in rows} == {True, False}
    for row in rows:
        assert row["lcf_below"] == (row["lcf_robots"] < (row["opening_robots"] or 0))
        assert not (row["lcf_below"] and row["lcf_open"])


def test_checkers_agree_and_notice_what_is_wrong(measured: dict[int, KnotResult]) -> None:
    rows = [row for result in measured.values() for row in result.rows]
    assert all(row["checked"] for row in rows)
    row = measured[1].rows[0]
    cable = Cable(LIST[0].diagram, row["cut"])
    for wrong in (
        row | {"lcf_open": not row["lcf_open"]},
        row | {"layered_open_over_under": not row["layered_open_over_under"]},
        row | {"opening_supports": row["opening_supports"][1:]},
        row | {"over_under_supports": ()},
        row | {"span_supports": ()},
    ):
        assert not agrees_with_definition(cable, wrong, SETTINGS)


def test_one_knot_in_so_many_is_checked() -> None:
    from knotopt.atlas.measure import is_checked

    rows = catalogue_rows()
    chosen = [knot.knot for knot in rows if is_checked(knot, Settings(check=16))]
    assert 8 <= len(chosen) <= 25
    assert [k.knot for k in reversed(rows) if is_checked(k, Settings(check=16))] == chosen[::-1]
    assert chosen != [k.knot for k in rows if is_checked(k, Settings(check=16, seed=1))]
    assert not any(is_checked(knot, Settings(check=0)) for knot in rows)


def test_openness_counts() -> None:
    loose = measure_knot(LIST[2], Settings("1/10")).rows
    strict = measure_knot(LIST[2], Settings("1")).rows
    assert sum(row["opening_robots"] or 0 for row in loose) < sum(
        row["opening_robots"] or 0 for row in strict
    )


def test_paths_are_rows_of_their_own(tmp_path: Path) -> None:
    settings = Settings(paths=True, check=0)
    run_atlas(tmp_path / "run", LIST[:1], settings, Local(1))
    paths = read_rows(tmp_path / "run", File.PATHS).to_pylist()
    assert len(paths) == 8 * 4
    assert [(p["cut"], p["supports"], p["method"]) for p in paths[:5]] == [
        ("L+", "lcf", "relaxation"),
        ("L+", "lcf", "nlp"),
        ("L+", "opening", "relaxation"),
        ("L+", "opening", "nlp"),
        ("L-", "lcf", "relaxation"),
    ]
    assert all(p["same_diagram"] and p["length"] > 10 for p in paths)
    times = read_rows(tmp_path / "run", File.TIMES).to_pylist()
    assert all(row["paths_seconds"] > 0 for row in times)
    assert "casadi" in read_manifest(tmp_path / "run").versions


def test_files_of_a_whole_run(whole: Path, measured: dict[int, KnotResult]) -> None:
    assert sorted(path.name for path in whole.iterdir()) == [
        File.ATLAS,
        File.KNOTS,
        MANIFEST,
        File.TIMES,
    ]
    atlas, times = read_rows(whole, File.ATLAS), read_rows(whole, File.TIMES)
    rows = [_tuples(row) for row in atlas.to_pylist()]
    assert rows == [row for number in sorted(measured) for row in measured[number].rows]
    for column in ("number", "knot", "cut"):
        assert times[column] == atlas[column]
    assert {len(result.times) for result in measured.values()} == {8}
    listed = [KnotRow(**_tuples(row)) for row in read_rows(whole, File.KNOTS).to_pylist()]
    assert tuple(listed) == LIST
    assert tuple(field.name for field in fields(KnotRow)) == names(FILES[File.KNOTS])
    for name in (File.ATLAS, File.KNOTS, File.TIMES):
        schema = read_rows(whole, name).schema
        assert tuple(schema.names) == names(FILES[name])
        for column in FILES[name]:
            documented = schema.field(column.name).metadata[b"meaning"].decode()
            assert documented == column.meaning != ""
    manifest = json.loads(atlas.schema.metadata[b"knotopt"])
    assert manifest == json.loads((whole / MANIFEST).read_text())
    assert manifest["settings"]["seed"] == 0
    assert set(manifest["versions"]) == {"knotopt", "numpy", "ortools"}


def _tuples(row: dict[str, Any]) -> dict[str, Any]:
    return {key: tuple(v) if isinstance(v, list) else v for key, v in row.items()}


def test_a_resumed_run_is_the_same(
    half: Path, whole: Path, measured: dict[int, KnotResult]
) -> None:
    assert [path.name for path in (half / PARTS).iterdir()] == ["part-00000001.parquet"]
    (half / PARTS / ".part-00000002.parquet.abc.tmp").write_bytes(b"torn")
    with pytest.raises(OutputError, match="is not complete"):
        read_rows(half, File.ATLAS)
    seen: list[Progress] = []
    engine = Replay(measured)
    done = run_atlas(half, LIST, SETTINGS, engine, seen.append)
    assert engine.asked == [2, 1]
    assert seen[0] == Progress(5, 3, 0)
    assert done == seen[-1] == Progress(5, 3, 2)
    assert contents(half) == contents(whole)  # times too: they are replayed


def test_parts_are_written_as_time_goes(
    tmp_path: Path, measured: dict[int, KnotResult], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(running, "SHORTEST", 0.0)
    monkeypatch.setattr(running, "SHARE", 0.0)
    parts = []
    run_atlas(
        tmp_path / "run",
        LIST,
        SETTINGS,
        Replay(measured),
        lambda _: parts.append(len(list((tmp_path / "run").glob("parts/*")))),
    )
    assert parts == [0, 0, 1, 2, 3, 4]


def test_a_complete_run_is_left_as_it_is(whole: Path, measured: dict[int, KnotResult]) -> None:
    before = contents(whole)
    engine = Replay(measured)
    assert run_atlas(whole, LIST, SETTINGS, engine) == Progress(5, 5, 0)
    assert engine.asked == []
    assert contents(whole) == before


def test_killed_between_the_final_files(
    half: Path, whole: Path, measured: dict[int, KnotResult], monkeypatch: pytest.MonkeyPatch
) -> None:
    from knotopt.atlas import store

    real = store.write_atomically

    def killed(path: Path, content: bytes) -> None:
        if path.name == File.ATLAS:
            raise KeyboardInterrupt
        real(path, content)

    with monkeypatch.context() as patch:
        patch.setattr(store, "write_atomically", killed)
        with pytest.raises(KeyboardInterrupt):
            run_atlas(half, LIST, SETTINGS, Replay(measured))
    assert (half / File.TIMES).exists()
    engine = Replay(measured)
    run_atlas(half, LIST, SETTINGS, engine)
    assert engine.asked == []
    assert contents(half) == contents(whole)


def test_lists(tmp_path: Path) -> None:
    assert len(catalogue_rows()) == 249
    with pytest.raises(FileFormatError, match=r"cannot read .*nowhere"):
        folder_rows(tmp_path / "nowhere")
    with pytest.raises(FileFormatError, match="has no grids"):
        folder_rows(tmp_path)
    marks = [list(mark) for mark in LIST[0].diagram.marks]
    (tmp_path / "b.json").write_text(json.dumps({"grid": marks}))
    (tmp_path / "a.csv").write_text("\n".join(f"{c},{r}" for c, r in marks))
    (tmp_path / "readme.md").write_text("no grid")
    rows = folder_rows(tmp_path)
    assert [(row.number, row.knot, row.source) for row in rows] == [
        (1, "a.csv", "file a.csv"),
        (2, "b.json", "file b.json"),
    ]
    assert {row.diagram for row in rows} == {read_knot("3_1").diagram}
    (tmp_path / "c.json").write_text("[[1, 5]]")
    with pytest.raises(FileFormatError, match=r"c\.json"):
        folder_rows(tmp_path)


def test_span_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    def too_large(*_: object) -> None:
        raise RequirementError("too large")

    monkeypatch.setitem(FORMULATIONS, "span", replace(SPAN, compile=too_large))
    row = measure_knot(LIST[0], Settings(span=True)).rows[0]
    assert (row["span_status"], row["span_robots"], row["opening_status"]) == (
        "refused",
        None,
        "optimal",
    )


def test_manifest_is_its_text() -> None:
    manifest = Manifest(Settings("1/4", 3, span=True), {"knotopt": "1"}, 2, "ab")
    assert Manifest.from_text(manifest.text) == manifest


def test_integers_fit(whole: Path) -> None:
    table = read_rows(whole, File.ATLAS)
    assert table.schema.field("lcf_supports").type == pa.list_(pa.int16())
    assert table.schema.field("span_robots").nullable
    assert not table.schema.field("lcf_robots").nullable
