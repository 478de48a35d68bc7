"""An atlas: its rows against other ways to them, its parts, and folders that are not its own."""

from __future__ import annotations

import errno
import json
import os
from collections.abc import Callable, Iterable, Iterator
from dataclasses import fields, replace
from pathlib import Path
from typing import Any

import pyarrow as pa
import pyarrow.parquet as pq
import pytest

from knotopt.atlas import run as running
from knotopt.atlas.engine import Engine, EngineError, Local
from knotopt.atlas.item import KnotResult, agrees_with_definition, measure_knot
from knotopt.atlas.run import Progress, run_atlas
from knotopt.atlas.schema import (
    ATLAS,
    KNOTS,
    MANIFEST,
    PARTS,
    PATHS,
    TIMES,
    AtlasRow,
    KnotRow,
    Manifest,
    Settings,
    meaning,
)
from knotopt.atlas.store import read_manifest, read_rows
from knotopt.atlas.work import catalogue_rows, folder_rows, knot_rows
from knotopt.cable.cable import Cable
from knotopt.cable.cut import OUTER_CUTS
from knotopt.catalogue.lookup import find_knot
from knotopt.comparison import compare
from knotopt.errors import FileFormatError, OutputError, RequirementError
from knotopt.supports.search import best_supports

LIST = knot_rows(map(find_knot, ("3_1", "4_1", "5_1", "5_2", "T(2,7)")))
SETTINGS = Settings(check=1)


@pytest.fixture(scope="module")
def results() -> dict[int, KnotResult]:
    return {knot.number: measure_knot(knot, SETTINGS) for knot in LIST}


class Replay:
    """Gives results at hand, last first; fails before the one numbered `fails_at`."""

    def __init__(
        self,
        results: dict[int, KnotResult],
        fails_at: int = 0,
        error: BaseException | None = None,
    ) -> None:
        self.results, self.fails_at, self.error = results, fails_at, error
        self.asked: list[int] = []

    def map(self, function: Callable[[Any], Any], items: Iterable[Any]) -> Iterator[Any]:
        assert function is not None
        for item in reversed(list(items)):
            if item.number == self.fails_at and self.error is not None:
                raise self.error
            self.asked.append(item.number)
            yield self.results[item.number]


def contents(folder: Path) -> dict[str, bytes]:
    return {
        str(path.relative_to(folder)): path.read_bytes()
        for path in folder.rglob("*")
        if path.is_file()
    }


@pytest.fixture
def whole(tmp_path: Path, results: dict[int, KnotResult]) -> Path:
    run_atlas(tmp_path / "whole", LIST, SETTINGS, Replay(results))
    return tmp_path / "whole"


@pytest.fixture
def half(tmp_path: Path, results: dict[int, KnotResult]) -> Path:
    with pytest.raises(KeyboardInterrupt):
        run_atlas(tmp_path / "half", LIST, SETTINGS, Replay(results, 2, KeyboardInterrupt()))
    return tmp_path / "half"


def test_rows_agree_with_compare_and_search(results: dict[int, KnotResult]) -> None:
    for knot in LIST[:3]:
        rows = results[knot.number].rows
        assert [row.cut for row in rows] == list(OUTER_CUTS)
        best = compare(
            knot.knot, knot.diagram, cuts=[Cable(knot.diagram, c).cut for c in OUTER_CUTS]
        )
        first = min(rows, key=lambda row: row.lcf_robots)
        assert (first.lcf_robots, first.cut, first.lcf_open) == (
            best.lcf_robots,
            best.lcf_cut,
            best.lcf_open,
        )
        layered = min(rows, key=lambda row: row.layered_robots)
        assert (layered.layered_robots, layered.layered_open) == (
            best.layered_robots,
            best.layered_open,
        )
        assert min(row.opening_robots or 99 for row in rows) == best.opening_robots
        assert {row.baseline for row in rows} == {best.robots_before}
        assert {row.crossings for row in rows} == {best.crossings}


def test_both_threading_modes_and_span(results: dict[int, KnotResult]) -> None:
    knot = LIST[3]
    result = measure_knot(knot, Settings(span=True, check=1))
    for row in result.rows:
        cut = [Cable(knot.diagram, row.cut).cut]
        other = best_supports(knot.diagram, _asked("opening", "over-under"), cuts=cut)
        assert row.over_under_robots == other.best.robots
        assert row.span_robots == best_supports(knot.diagram, _asked("span"), cuts=cut).best.robots
        assert row.over_under_robots <= (row.opening_robots or 0)
        assert row.span_status == row.opening_status == "optimal"
        assert row.checked
    plain = results[knot.number].rows
    assert [replace(row, **_no_span()) for row in result.rows] == list(plain)


def _asked(formulation: str, threading: str | None = None) -> Any:
    from knotopt.supports.requirements import Requirements

    return Requirements(formulation, threading=threading)


def _no_span() -> dict[str, None]:
    return {column.name: None for column in fields(AtlasRow) if column.name.startswith("span_")}


def test_lcf_below_means_that_no_open_set_is_as_small(results: dict[int, KnotResult]) -> None:
    rows = [row for result in results.values() for row in result.rows]
    assert {row.lcf_below for row in rows} == {True, False}
    for row in rows:
        assert row.lcf_below == (row.lcf_robots < (row.opening_robots or 0))
        assert not (row.lcf_below and row.lcf_open)


def test_checkers_agree_and_notice_what_is_wrong(results: dict[int, KnotResult]) -> None:
    rows = [row for result in results.values() for row in result.rows]
    assert all(row.checked for row in rows)
    row = results[1].rows[0]
    cable = Cable(LIST[0].diagram, row.cut)
    for wrong in (
        replace(row, lcf_open=not row.lcf_open),
        replace(row, layered_open_over_under=not row.layered_open_over_under),
        replace(row, opening_supports=row.opening_supports[1:]),
        replace(row, over_under_supports=()),
        replace(row, span_supports=()),
    ):
        assert not agrees_with_definition(cable, wrong, SETTINGS)


def test_one_knot_in_so_many_is_checked() -> None:
    from knotopt.atlas.item import is_checked

    rows = catalogue_rows()
    chosen = [knot.knot for knot in rows if is_checked(knot, Settings(check=16))]
    assert 8 <= len(chosen) <= 25
    assert [k.knot for k in reversed(rows) if is_checked(k, Settings(check=16))] == chosen[::-1]
    assert chosen != [k.knot for k in rows if is_checked(k, Settings(check=16, seed=1))]
    assert not any(is_checked(knot, Settings(check=0)) for knot in rows)


def test_openness_counts() -> None:
    loose = measure_knot(LIST[2], Settings("1/10")).rows
    strict = measure_knot(LIST[2], Settings("1")).rows
    assert sum(row.opening_robots or 0 for row in loose) < sum(
        row.opening_robots or 0 for row in strict
    )


def test_paths_are_rows_of_their_own(tmp_path: Path) -> None:
    settings = Settings(paths=True, check=0)
    run_atlas(tmp_path / "run", LIST[:1], settings, Local(1))
    paths = read_rows(tmp_path / "run", PATHS).to_pylist()
    assert len(paths) == 8 * 4
    assert [(p["cut"], p["supports"], p["method"]) for p in paths[:5]] == [
        ("L+", "lcf", "relaxation"),
        ("L+", "lcf", "nlp"),
        ("L+", "opening", "relaxation"),
        ("L+", "opening", "nlp"),
        ("L-", "lcf", "relaxation"),
    ]
    assert all(p["same_diagram"] and p["length"] > 10 for p in paths)
    times = read_rows(tmp_path / "run", TIMES).to_pylist()
    assert all(row["paths_seconds"] > 0 for row in times)
    assert "casadi" in read_manifest(tmp_path / "run").versions


def test_files_of_a_whole_run(whole: Path, results: dict[int, KnotResult]) -> None:
    assert sorted(path.name for path in whole.iterdir()) == [ATLAS, KNOTS, MANIFEST, TIMES]
    atlas, times = read_rows(whole, ATLAS), read_rows(whole, TIMES)
    rows = [_tuples(row) for row in atlas.to_pylist()]
    assert [AtlasRow(**row) for row in rows] == [
        row for number in sorted(results) for row in results[number].rows
    ]
    for column in ("number", "knot", "cut"):
        assert times[column] == atlas[column]
    assert {len(result.times) for result in results.values()} == {8}
    listed = [KnotRow(**_tuples(row)) for row in read_rows(whole, KNOTS).to_pylist()]
    assert tuple(listed) == LIST
    for row_class, table in ((AtlasRow, atlas), (KnotRow, read_rows(whole, KNOTS))):
        for column in fields(row_class):
            documented = table.schema.field(column.name).metadata[b"meaning"].decode()
            assert documented == meaning(column) != ""
    manifest = json.loads(atlas.schema.metadata[b"knotopt"])
    assert manifest == json.loads((whole / MANIFEST).read_text())
    assert manifest["settings"]["seed"] == 0
    assert set(manifest["versions"]) == {"knotopt", "numpy", "ortools"}


def _tuples(row: dict[str, Any]) -> dict[str, Any]:
    return {key: tuple(v) if isinstance(v, list) else v for key, v in row.items()}


def test_a_resumed_run_is_the_same(half: Path, whole: Path, results: dict[int, KnotResult]) -> None:
    assert [path.name for path in (half / PARTS).iterdir()] == ["part-00000001.parquet"]
    (half / PARTS / ".part-00000002.parquet.abc.tmp").write_bytes(b"torn")
    with pytest.raises(OutputError, match="is not complete"):
        read_rows(half, ATLAS)
    seen: list[Progress] = []
    engine = Replay(results)
    done = run_atlas(half, LIST, SETTINGS, engine, seen.append)
    assert engine.asked == [2, 1]
    assert seen[0] == Progress(5, 3, 0)
    assert done == seen[-1] == Progress(5, 3, 2)
    assert contents(half) == contents(whole)  # times too: they are replayed


def test_parts_are_written_as_time_goes(
    tmp_path: Path, results: dict[int, KnotResult], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(running, "SHORTEST", 0.0)
    monkeypatch.setattr(running, "SHARE", 0.0)
    parts = []
    run_atlas(
        tmp_path / "run",
        LIST,
        SETTINGS,
        Replay(results),
        lambda _: parts.append(len(list((tmp_path / "run").glob("parts/*")))),
    )
    assert parts == [0, 0, 1, 2, 3, 4]


def test_a_complete_run_is_left_as_it_is(whole: Path, results: dict[int, KnotResult]) -> None:
    before = contents(whole)
    engine = Replay(results)
    assert run_atlas(whole, LIST, SETTINGS, engine) == Progress(5, 5, 0)
    assert engine.asked == []
    assert contents(whole) == before


def test_killed_between_the_final_files(
    half: Path, whole: Path, results: dict[int, KnotResult], monkeypatch: pytest.MonkeyPatch
) -> None:
    from knotopt.atlas import store

    real = store.write_atomically

    def killed(path: Path, content: bytes) -> None:
        if path.name == ATLAS:
            raise KeyboardInterrupt
        real(path, content)

    with monkeypatch.context() as patch:
        patch.setattr(store, "write_atomically", killed)
        with pytest.raises(KeyboardInterrupt):
            run_atlas(half, LIST, SETTINGS, Replay(results))
    assert (half / TIMES).exists()
    engine = Replay(results)
    run_atlas(half, LIST, SETTINGS, engine)
    assert engine.asked == []
    assert contents(half) == contents(whole)


@pytest.mark.parametrize(
    ("settings", "words"),
    [
        (Settings("1/4", check=1), "openness = 1/2, not 1/4"),
        (Settings(seed=7, check=1), "seed = 0, not 7"),
        (Settings(span=True, check=1), "span = False, not True"),
        (Settings(check=2), "check = 1, not 2"),
    ],
)
def test_other_settings(
    half: Path, results: dict[int, KnotResult], settings: Settings, words: str
) -> None:
    before = contents(half)
    with pytest.raises(OutputError, match=words):
        run_atlas(half, LIST, settings, Replay(results))
    assert contents(half) == before


def test_another_list(whole: Path, results: dict[int, KnotResult]) -> None:
    for other in (LIST[:4], (*LIST[:4], replace(LIST[4], minus=LIST[4].plus, plus=LIST[4].minus))):
        with pytest.raises(OutputError, match="another list, of 5 knots"):
            run_atlas(whole, other, SETTINGS, Replay(results))


@pytest.mark.parametrize("folder", ["half", "whole"])
def test_another_version(
    folder: str, results: dict[int, KnotResult], request: pytest.FixtureRequest
) -> None:
    path: Path = request.getfixturevalue(folder)
    text = (path / MANIFEST).read_text()
    versions = json.loads(text)["versions"]
    (path / MANIFEST).write_text(text.replace(versions["ortools"], "9.10"))
    before = contents(path)
    with pytest.raises(OutputError, match=r"was begun with ortools 9\.10, here is 9\.11"):
        run_atlas(path, LIST, SETTINGS, Replay(results))
    (path / MANIFEST).write_text(text.replace("knotopt atlas 1", "knotopt atlas 0"))
    with pytest.raises(OutputError, match=r"manifest.json is damaged, or of another version"):
        run_atlas(path, LIST, SETTINGS, Replay(results))
    (path / MANIFEST).write_text(text.replace(versions["ortools"], "9.10"))
    assert contents(path) == before


@pytest.mark.parametrize("text", ["", "[]", "{}", '{"format": "knotopt atlas 1"}', "\xff", "null"])
def test_damaged_manifest(half: Path, results: dict[int, KnotResult], text: str) -> None:
    (half / MANIFEST).write_bytes(text.encode("latin-1"))
    with pytest.raises(OutputError, match=r"manifest.json is damaged, or of another version"):
        run_atlas(half, LIST, SETTINGS, Replay(results))


def test_not_a_run_folder(tmp_path: Path, results: dict[int, KnotResult]) -> None:
    (tmp_path / "letters").mkdir()
    (tmp_path / "letters" / "a.txt").write_text("mine")
    with pytest.raises(OutputError, match=r"letters is not the folder of an atlas: no manifest"):
        run_atlas(tmp_path / "letters", LIST, SETTINGS, Replay(results))
    assert contents(tmp_path) == {"letters/a.txt": b"mine"}
    with pytest.raises(OutputError, match="is a file, not the folder of an atlas"):
        run_atlas(tmp_path / "letters" / "a.txt", LIST, SETTINGS, Replay(results))
    with pytest.raises(OutputError, match="cannot write"):
        run_atlas(tmp_path / "letters" / "a.txt" / "run", LIST, SETTINGS, Replay(results))


def _flip(data: bytes) -> bytes:
    """One bit of the values of a column."""
    column = pq.read_metadata(pa.BufferReader(data)).row_group(0).column(4)
    last = column.data_page_offset + column.total_compressed_size - 1
    return data[:last] + bytes([data[last] ^ 1]) + data[last + 1 :]


@pytest.mark.parametrize(
    "damage",
    [lambda _: b"", lambda data: data[:-20], lambda _: b"not Parquet", _flip],
    ids=["empty", "torn", "foreign", "one byte"],
)
def test_damaged_part(
    half: Path, results: dict[int, KnotResult], damage: Callable[[bytes], bytes]
) -> None:
    part = half / PARTS / "part-00000001.parquet"
    part.write_bytes(damage(part.read_bytes()))
    before = contents(half)
    with pytest.raises(OutputError, match=r"part-00000001.parquet is damaged .*: remove it"):
        run_atlas(half, LIST, SETTINGS, Replay(results))
    assert contents(half) == before
    part.unlink()
    run_atlas(half, LIST, SETTINGS, Replay(results))
    assert read_rows(half, ATLAS).num_rows == 40


def test_part_of_another_run(half: Path, tmp_path: Path, results: dict[int, KnotResult]) -> None:
    with pytest.raises(KeyboardInterrupt):
        run_atlas(
            tmp_path / "other", LIST, Settings(check=3), Replay(results, 1, KeyboardInterrupt())
        )
    part = tmp_path / "other" / PARTS / "part-00000001.parquet"
    (half / PARTS / "part-00000002.parquet").write_bytes(part.read_bytes())
    with pytest.raises(OutputError, match=r"part-00000002.parquet is of another run"):
        run_atlas(half, LIST, SETTINGS, Replay(results))


def test_the_same_knot_in_two_parts(half: Path, results: dict[int, KnotResult]) -> None:
    part = half / PARTS / "part-00000001.parquet"
    (half / PARTS / "part-00000007.parquet").write_bytes(part.read_bytes())
    with pytest.raises(OutputError, match=r"part-00000007.parquet has knot 3 of the list"):
        run_atlas(half, LIST, SETTINGS, Replay(results))


def test_damaged_final_file(whole: Path) -> None:
    (whole / ATLAS).write_bytes(_flip((whole / ATLAS).read_bytes()))
    with pytest.raises(OutputError, match=r"atlas.parquet is damaged"):
        read_rows(whole, ATLAS)
    with pytest.raises(OutputError, match=r"has no paths.parquet: the run was not asked for it"):
        read_rows(whole, PATHS)


def test_full_disk(
    half: Path, whole: Path, results: dict[int, KnotResult], monkeypatch: pytest.MonkeyPatch
) -> None:
    before = contents(half)

    def full(_: int) -> None:
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

    with monkeypatch.context() as patch:
        patch.setattr(os, "fsync", full)
        with pytest.raises(OutputError, match=r"cannot write .*part-.*: No space left on device"):
            run_atlas(half, LIST, SETTINGS, Replay(results))
        with pytest.raises(OutputError, match="No space left on device"):
            run_atlas(half.with_name("new"), LIST, SETTINGS, Replay(results))
    assert contents(half) == before
    assert not half.with_name("new").exists()
    run_atlas(half, LIST, SETTINGS, Replay(results))
    assert contents(half) == contents(whole)


def test_full_disk_at_the_merge(
    half: Path, whole: Path, results: dict[int, KnotResult], monkeypatch: pytest.MonkeyPatch
) -> None:
    from knotopt.atlas import store

    real = store.write_atomically

    def full(path: Path, content: bytes) -> None:
        if path.name == ATLAS:
            raise OutputError(f"cannot write {path}: No space left on device")
        real(path, content)

    with monkeypatch.context() as patch:
        patch.setattr(store, "write_atomically", full)
        with pytest.raises(OutputError, match="No space left"):
            run_atlas(half, LIST, SETTINGS, Replay(results))
    assert len(list((half / PARTS).iterdir())) == 2
    run_atlas(half, LIST, SETTINGS, Replay(results))
    assert contents(half) == contents(whole)


def test_results_are_kept_when_an_item_fails(
    tmp_path: Path, results: dict[int, KnotResult]
) -> None:
    with pytest.raises(EngineError):
        run_atlas(tmp_path / "run", LIST, SETTINGS, Replay(results, 1, EngineError("dead")))
    engine = Replay(results)
    run_atlas(tmp_path / "run", LIST, SETTINGS, engine)
    assert engine.asked == [1]


def test_results_of_other_versions_are_not_mixed(
    tmp_path: Path, results: dict[int, KnotResult]
) -> None:
    other = replace(results[2], versions={**results[2].versions, "ortools": "9.9"})
    with pytest.raises(EngineError, match=r"a worker has ortools 9\.9, this process 9\.11"):
        run_atlas(tmp_path / "run", LIST, SETTINGS, Replay({**results, 2: other}))
    engine = Replay(results)
    run_atlas(tmp_path / "run", LIST, SETTINGS, engine)
    assert engine.asked == [2, 1]


def test_two_processes_do_not_share_a_folder(half: Path, results: dict[int, KnotResult]) -> None:
    class Inside(Replay):
        def map(self, function: Any, items: Iterable[Any]) -> Iterator[Any]:
            with pytest.raises(OutputError, match="another process is at work"):
                run_atlas(half, LIST, SETTINGS, Replay(results))
            yield from super().map(function, items)

    engine: Engine = Inside(results)
    run_atlas(half, LIST, SETTINGS, engine)
    assert read_rows(half, ATLAS).num_rows == 40


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
    assert {row.diagram for row in rows} == {find_knot("3_1").diagram}
    (tmp_path / "c.json").write_text("[[1, 2]]")
    with pytest.raises(FileFormatError, match=r"c\.json"):
        folder_rows(tmp_path)


def test_span_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    from knotopt.supports import minimal

    def too_large(*_: object) -> None:
        raise RequirementError("too large")

    monkeypatch.setattr(minimal, "compile_span", too_large)
    row = measure_knot(LIST[0], Settings(span=True)).rows[0]
    assert (row.span_status, row.span_robots, row.opening_status) == ("refused", None, "optimal")


def test_manifest_is_its_text() -> None:
    manifest = Manifest(Settings("1/4", 3, span=True), {"knotopt": "1"}, 2, "ab")
    assert Manifest.from_text(manifest.text) == manifest


def test_integers_fit(whole: Path) -> None:
    table = read_rows(whole, ATLAS)
    assert table.schema.field("lcf_supports").type == pa.list_(pa.int16())
    assert table.schema.field("span_robots").nullable
    assert not table.schema.field("lcf_robots").nullable
