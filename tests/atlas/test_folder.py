"""Folders that are not the run's own, damaged ones, full disks, and workers that fail."""

from __future__ import annotations

import errno
import json
import os
import re
from collections.abc import Callable, Iterable, Iterator
from dataclasses import replace
from importlib.metadata import version
from pathlib import Path
from typing import Any

import pyarrow as pa
import pyarrow.parquet as pq
import pytest

from knotopt.atlas.engine import Engine, EngineError
from knotopt.atlas.measure import KnotResult
from knotopt.atlas.run import run_atlas
from knotopt.atlas.schema import MANIFEST, PARTS, File, Settings
from knotopt.atlas.store import read_rows
from knotopt.errors import OutputError
from tests.helpers.small_atlas import LIST, SETTINGS, Replay, contents

HERE = re.escape(version("ortools"))


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
    half: Path, measured: dict[int, KnotResult], settings: Settings, words: str
) -> None:
    before = contents(half)
    with pytest.raises(OutputError, match=words):
        run_atlas(half, LIST, settings, Replay(measured))
    assert contents(half) == before


def test_another_list(whole: Path, measured: dict[int, KnotResult]) -> None:
    for other in (LIST[:4], (*LIST[:4], replace(LIST[4], minus=LIST[4].plus, plus=LIST[4].minus))):
        with pytest.raises(OutputError, match="another list, of 5 knots"):
            run_atlas(whole, other, SETTINGS, Replay(measured))


@pytest.mark.parametrize("folder", ["half", "whole"])
def test_another_version(
    folder: str, measured: dict[int, KnotResult], request: pytest.FixtureRequest
) -> None:
    path: Path = request.getfixturevalue(folder)
    text = (path / MANIFEST).read_text()
    versions = json.loads(text)["versions"]
    (path / MANIFEST).write_text(text.replace(versions["ortools"], "9.10"))
    before = contents(path)
    with pytest.raises(OutputError, match=rf"was begun with ortools 9\.10, here is {HERE}"):
        run_atlas(path, LIST, SETTINGS, Replay(measured))
    (path / MANIFEST).write_text(text.replace("knotopt atlas 1", "knotopt atlas 0"))
    with pytest.raises(OutputError, match=r"manifest.json is damaged, or of another version"):
        run_atlas(path, LIST, SETTINGS, Replay(measured))
    (path / MANIFEST).write_text(text.replace(versions["ortools"], "9.10"))
    assert contents(path) == before


@pytest.mark.parametrize("text", ["", "[]", "{}", '{"format": "knotopt atlas 1"}', "\xff", "null"])
def test_damaged_manifest(half: Path, measured: dict[int, KnotResult], text: str) -> None:
    (half / MANIFEST).write_bytes(text.encode("latin-1"))
    with pytest.raises(OutputError, match=r"manifest.json is damaged, or of another version"):
        run_atlas(half, LIST, SETTINGS, Replay(measured))


def test_not_a_run_folder(tmp_path: Path, measured: dict[int, KnotResult]) -> None:
    (tmp_path / "letters").mkdir()
    (tmp_path / "letters" / "a.txt").write_text("mine")
    with pytest.raises(OutputError, match=r"letters is not the folder of an atlas: no manifest"):
        run_atlas(tmp_path / "letters", LIST, SETTINGS, Replay(measured))
    assert contents(tmp_path) == {"letters/a.txt": b"mine"}
    with pytest.raises(OutputError, match="is a file, not the folder of an atlas"):
        run_atlas(tmp_path / "letters" / "a.txt", LIST, SETTINGS, Replay(measured))
    with pytest.raises(OutputError, match="cannot write"):
        run_atlas(tmp_path / "letters" / "a.txt" / "run", LIST, SETTINGS, Replay(measured))


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
    half: Path, measured: dict[int, KnotResult], damage: Callable[[bytes], bytes]
) -> None:
    part = half / PARTS / "part-00000001.parquet"
    part.write_bytes(damage(part.read_bytes()))
    before = contents(half)
    with pytest.raises(OutputError, match=r"part-00000001.parquet is damaged .*: remove it"):
        run_atlas(half, LIST, SETTINGS, Replay(measured))
    assert contents(half) == before
    part.unlink()
    run_atlas(half, LIST, SETTINGS, Replay(measured))
    assert read_rows(half, File.ATLAS).num_rows == 40


def test_part_of_another_run(half: Path, tmp_path: Path, measured: dict[int, KnotResult]) -> None:
    with pytest.raises(KeyboardInterrupt):
        run_atlas(
            tmp_path / "other", LIST, Settings(check=3), Replay(measured, 1, KeyboardInterrupt())
        )
    part = tmp_path / "other" / PARTS / "part-00000001.parquet"
    (half / PARTS / "part-00000002.parquet").write_bytes(part.read_bytes())
    with pytest.raises(OutputError, match=r"part-00000002.parquet is of another run"):
        run_atlas(half, LIST, SETTINGS, Replay(measured))


def test_the_same_knot_in_two_parts(half: Path, measured: dict[int, KnotResult]) -> None:
    part = half / PARTS / "part-00000001.parquet"
    (half / PARTS / "part-00000007.parquet").write_bytes(part.read_bytes())
    with pytest.raises(OutputError, match=r"part-00000007.parquet has knot 3 of the list"):
        run_atlas(half, LIST, SETTINGS, Replay(measured))


def test_damaged_final_file(whole: Path) -> None:
    (whole / File.ATLAS).write_bytes(_flip((whole / File.ATLAS).read_bytes()))
    with pytest.raises(OutputError, match=r"atlas.parquet is damaged"):
        read_rows(whole, File.ATLAS)
    with pytest.raises(OutputError, match=r"has no paths.parquet: the run was not asked for it"):
        read_rows(whole, File.PATHS)


def test_full_disk(
    half: Path, whole: Path, measured: dict[int, KnotResult], monkeypatch: pytest.MonkeyPatch
) -> None:
    before = contents(half)

    def full(_: int) -> None:
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

    with monkeypatch.context() as patch:
        patch.setattr(os, "fsync", full)
        with pytest.raises(OutputError, match=r"cannot write .*part-.*: No space left on device"):
            run_atlas(half, LIST, SETTINGS, Replay(measured))
        with pytest.raises(OutputError, match="No space left on device"):
            run_atlas(half.with_name("new"), LIST, SETTINGS, Replay(measured))
    assert contents(half) == before
    assert not half.with_name("new").exists()
    run_atlas(half, LIST, SETTINGS, Replay(measured))
    assert contents(half) == contents(whole)


def test_full_disk_at_the_merge(
    half: Path, whole: Path, measured: dict[int, KnotResult], monkeypatch: pytest.MonkeyPatch
) -> None:
    from knotopt.atlas import store

    real = store.write_atomically

    def full(path: Path, content: bytes) -> None:
        if path.name == File.ATLAS:
            raise OutputError(f"cannot write {path}: No space left on device")
        real(path, content)

    with monkeypatch.context() as patch:
        patch.setattr(store, "write_atomically", full)
        with pytest.raises(OutputError, match="No space left"):
            run_atlas(half, LIST, SETTINGS, Replay(measured))
    assert len(list((half / PARTS).iterdir())) == 2
    run_atlas(half, LIST, SETTINGS, Replay(measured))
    assert contents(half) == contents(whole)


def test_results_are_kept_when_an_item_fails(
    tmp_path: Path, measured: dict[int, KnotResult]
) -> None:
    with pytest.raises(EngineError):
        run_atlas(tmp_path / "run", LIST, SETTINGS, Replay(measured, 1, EngineError("dead")))
    engine = Replay(measured)
    run_atlas(tmp_path / "run", LIST, SETTINGS, engine)
    assert engine.asked == [1]


def test_results_of_other_versions_are_not_mixed(
    tmp_path: Path, measured: dict[int, KnotResult]
) -> None:
    other = replace(measured[2], versions={**measured[2].versions, "ortools": "9.9"})
    with pytest.raises(EngineError, match=rf"a worker has ortools 9\.9, this process {HERE}"):
        run_atlas(tmp_path / "run", LIST, SETTINGS, Replay({**measured, 2: other}))
    engine = Replay(measured)
    run_atlas(tmp_path / "run", LIST, SETTINGS, engine)
    assert engine.asked == [2, 1]


def test_two_processes_do_not_share_a_folder(half: Path, measured: dict[int, KnotResult]) -> None:
    class Inside(Replay):
        def map(self, function: Any, items: Iterable[Any]) -> Iterator[Any]:
            with pytest.raises(OutputError, match="another process is at work"):
                run_atlas(half, LIST, SETTINGS, Replay(measured))
            yield from super().map(function, items)

    engine: Engine = Inside(measured)
    run_atlas(half, LIST, SETTINGS, engine)
    assert read_rows(half, File.ATLAS).num_rows == 40
