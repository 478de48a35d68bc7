"""A run's folder: begun as a whole, filled by parts, each whole or not there, and merged.

A part holds whole knots, with the columns of the atlas, of the times, and the rows that were
requested as lists. Its metadata is the manifest and its pages have checksums, so that nothing
foreign or damaged is merged.
"""

from __future__ import annotations

import fcntl
import os
import shutil
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from dataclasses import asdict
from pathlib import Path

import numpy as np

from knotopt.atlas.columns import CUT_KEYS, FILES
from knotopt.atlas.measure import KnotResult
from knotopt.atlas.schema import MANIFEST, PARTS, File, KnotRow, Manifest
from knotopt.cable.cut import OUTER_CUTS
from knotopt.document.columns import Row, check_rows, names
from knotopt.errors import OutputError, require_extra
from knotopt.files import write_atomically, write_folder

require_extra("pyarrow", "atlas", "an atlas")
import pyarrow as pa  # noqa: E402
import pyarrow.parquet as pq  # noqa: E402

_METADATA = b"knotopt"
_KINDS = {
    int: pa.int32(),
    str: pa.string(),
    bool: pa.bool_(),
    float: pa.float64(),
    tuple[int, ...]: pa.list_(pa.int16()),
}


class Run:
    """The folder of one run while it is filled.

    Attributes
    ----------
    folder : Path
    manifest : Manifest
    done : set of int
        Numbers of the knots that are in a part.
    is_complete : bool
        Whether the parts were merged.
    """

    def __init__(self, folder: Path, manifest: Manifest) -> None:
        self.folder, self.manifest = folder, manifest
        self.is_complete = (folder / File.ATLAS).exists()
        self.done: set[int] = set()
        self._parts = sorted((folder / PARTS).glob("part-*.parquet"))
        for part in () if self.is_complete else self._parts:
            numbers = self._numbers(part)
            if twice := self.done & numbers:
                raise OutputError(
                    f"{part} has knot {min(twice)} of the list, which an earlier part has too: "
                    "remove one of them"
                )
            self.done |= numbers

    def add(self, results: Iterable[KnotResult]) -> None:
        """Write the rows of whole knots as one part; they survive whatever happens next.

        Raises
        ------
        OutputError
            It cannot be written; the parts before it stay.
        """
        rows: list[Row] = []
        for result in results:
            listed = {File.ATLAS: result.rows, File.TIMES: result.times, **result.requested}
            for name, found in listed.items():
                check_rows(FILES[name], found)
            for row, times in zip(result.rows, result.times, strict=True):
                lists = {
                    _list_of(name): [each for each in found if each["cut"] == row["cut"]]
                    for name, found in result.requested.items()
                }
                rows.append({**row, **times, **lists})
        if not rows:
            return
        last = int(self._parts[-1].stem.removeprefix("part-")) if self._parts else 0
        path = self.folder / PARTS / f"part-{last + 1:08d}.parquet"
        write_atomically(path, _to_bytes(pa.Table.from_pylist(rows, _part_schema(self.manifest))))
        self._parts.append(path)
        self.done |= {row["number"] for row in rows}

    def finish(self) -> None:
        """Merge the parts into the final files, then remove them and what a kill left.

        Raises
        ------
        OutputError
            A file cannot be written, or a part is damaged; the parts stay.
        """
        if not self.is_complete:
            table = pa.concat_tables([self._read(part) for part in self._parts])
            table = table.combine_chunks().sort_by("number")  # stable: cuts are in order
            for name in self.manifest.settings.requested:
                found = table[_list_of(name)].combine_chunks().flatten()
                rows = pa.Table.from_batches([pa.RecordBatch.from_struct_array(found)])
                self._write(name, rows)
            self._write(File.TIMES, table)
            self._write(File.ATLAS, table)  # last: it says that the run is complete
            self.is_complete = True
        shutil.rmtree(self.folder / PARTS, ignore_errors=True)
        for torn in self.folder.glob(".*.tmp"):
            torn.unlink()
        self._parts = []

    def _write(self, name: str, table: pa.Table) -> None:
        schema = arrow_schema(name, self.manifest)
        write_atomically(self.folder / name, _to_bytes(table.select(schema.names).cast(schema)))

    def _read(self, part: Path) -> pa.Table:
        table = _read_table(part, "its knots are then measured again")
        _check_origin(part, table, self.manifest)
        # Earlier releases kept a list of paths, empty where none were asked for.
        return table.select(_part_schema(self.manifest).names)

    def _numbers(self, part: Path) -> set[int]:
        numbers, rows = np.unique(self._read(part)["number"].to_numpy(), return_counts=True)
        if numbers.min() < 1 or numbers.max() > self.manifest.knots or set(rows) != {8}:
            raise OutputError(f"{part} is damaged (not {len(OUTER_CUTS)} rows a knot): remove it")
        return set(numbers.tolist())


@contextmanager
def opened(folder: Path, manifest: Manifest, knots: Iterable[KnotRow]) -> Iterator[Run]:
    """The folder of a run, made if it is not there, for this process alone.

    Raises
    ------
    OutputError
        Something else is there, or the run of another list, version or settings, or a damaged
        part; or another process fills it. What is there stays as it was.
    """
    if not folder.exists() or (folder.is_dir() and not any(folder.iterdir())):
        listed = pa.Table.from_pylist(
            [asdict(knot) for knot in knots], arrow_schema(File.KNOTS, manifest)
        )
        write_folder(folder, {MANIFEST: manifest.text, File.KNOTS: _to_bytes(listed)})
    _compare(folder, read_manifest(folder), manifest)
    handle = os.open(folder, os.O_RDONLY)
    try:
        try:
            fcntl.flock(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)  # gone with the process
        except OSError as error:
            raise OutputError(f"another process is at work in {folder}") from error
        yield Run(folder, manifest)
    finally:
        os.close(handle)


def read_manifest(folder: Path) -> Manifest:
    """What a run was asked.

    Raises
    ------
    OutputError
        The folder holds no run, or one of another format.
    """
    path = folder / MANIFEST
    try:
        return Manifest.from_text(path.read_text(encoding="utf-8"))
    except FileNotFoundError as error:
        raise OutputError(f"{folder} is not the folder of an atlas: no {MANIFEST}") from error
    except NotADirectoryError as error:
        raise OutputError(f"{folder} is a file, not the folder of an atlas") from error
    except OSError as error:
        raise OutputError(f"cannot read {path}: {error.strerror}") from error
    except (ValueError, KeyError, TypeError, AttributeError) as error:
        raise OutputError(f"{path} is damaged, or of another version: {error}") from error


def read_rows(folder: Path, name: str) -> pa.Table:
    """The table of one of a run's files: KNOTS, ATLAS, TIMES, or one that was requested.

    Raises
    ------
    OutputError
        The run is not complete, or the file is damaged or of another run.
    """
    manifest = read_manifest(folder)
    if not (folder / File.ATLAS).exists():
        raise OutputError(f"{folder} is not complete: run `knotopt atlas` again to go on with it")
    if not (folder / name).exists():
        raise OutputError(f"{folder} has no {name}: the run was not asked for it")
    table = _read_table(folder / name, "the run must then be done again")
    _check_origin(folder / name, table, manifest)
    return table


def arrow_schema(name: str, manifest: Manifest) -> pa.Schema:
    """Columns of a file, their meanings as metadata, and the manifest."""
    return pa.schema(
        [
            pa.field(column.name, _KINDS[column.kind], column.optional, {"meaning": column.meaning})
            for column in FILES[name]
        ],
        {_METADATA: manifest.text.encode()},
    )


def _part_schema(manifest: Manifest) -> pa.Schema:
    schema = arrow_schema(File.ATLAS, manifest)
    for column in arrow_schema(File.TIMES, manifest):
        if column.name not in names(CUT_KEYS):
            schema = schema.append(column)
    for name in manifest.settings.requested:
        rows = pa.struct(list(arrow_schema(name, manifest)))
        schema = schema.append(pa.field(_list_of(name), pa.list_(rows)))
    return schema


def _list_of(name: str) -> str:
    """The column of a part that holds the rows of a file."""
    return name.removesuffix(".parquet")


def _to_bytes(table: pa.Table) -> bytes:
    sink = pa.BufferOutputStream()
    pq.write_table(table, sink, compression="zstd", write_page_checksum=True)
    written: bytes = sink.getvalue().to_pybytes()
    return written


def _read_table(path: Path, if_removed: str) -> pa.Table:
    try:
        return pq.read_table(path, page_checksum_verification=True)
    except (pa.ArrowException, OSError, ValueError) as error:
        words = str(error).splitlines()[0] if str(error) else "no Parquet"
        raise OutputError(f"{path} is damaged ({words}): remove it; {if_removed}") from error


def _check_origin(path: Path, table: pa.Table, manifest: Manifest) -> None:
    if (table.schema.metadata or {}).get(_METADATA) != manifest.text.encode():
        raise OutputError(f"{path} is of another run than {MANIFEST} of its folder: remove it")


def _compare(folder: Path, begun: Manifest, now: Manifest) -> None:
    """Raise if a folder's run is not the one asked for."""
    if begun == now:
        return
    words = f"another list, of {begun.knots} knots: finish it with that one"
    for package, version in reversed(now.versions.items()):
        if (there := begun.versions.get(package, "none")) != version:
            words = f"{package} {there}, here is {version}: finish it with that one"
    for name, value in reversed(asdict(now.settings).items()):
        if (there := getattr(begun.settings, name)) != value:
            words = f"{name} = {_said(there)}, not {_said(value)}: finish it with that"
    raise OutputError(f"{folder} was begun with {words}, or name another folder")


def _said(value: object) -> str:
    return ", ".join(value) or "none" if isinstance(value, tuple) else str(value)
