"""`knotopt report`: a folder as a whole, or a sentence and what was there before."""

from __future__ import annotations

import sys
from pathlib import Path

import pytest

from tests.helpers.command_line import Cli

FILES = {"report.md", "report.tex", "report.html", "atlas.csv"}


@pytest.fixture(scope="module")
def run_dir(tmp_path_factory: pytest.TempPathFactory) -> Path:
    from knotopt.atlas.engine import Local
    from knotopt.atlas.knot_list import knot_rows
    from knotopt.atlas.run import run_atlas
    from knotopt.atlas.schema import Settings
    from knotopt.reading.knot import read_knot

    folder: Path = tmp_path_factory.mktemp("atlas") / "run"
    run_atlas(folder, knot_rows(map(read_knot, ("3_1", "4_1"))), Settings(check=0), Local())
    return folder


def _in_a_page(file: Path) -> int:
    """A place in a Parquet file where data lie, which have checksums."""
    import pyarrow.parquet as pq

    column = pq.ParquetFile(file).metadata.row_group(0).column(0)
    begin: int = column.dictionary_page_offset or column.data_page_offset
    return begin + int(column.total_compressed_size) - 1


def contents(folder: Path) -> dict[str, bytes]:
    return {path.name: path.read_bytes() for path in folder.iterdir()}


def test_report_replaces_a_former_one(cli: Cli, run_dir: Path, tmp_path: Path) -> None:
    out = tmp_path / "report"
    assert cli("report", run_dir, "--out", out) == (0, f"written: {out}\n", "")
    first = contents(out)
    assert set(first) >= FILES
    assert {name.rsplit(".", 1)[1] for name in first} == {"md", "tex", "html", "csv", "png", "pdf"}
    assert cli("report", run_dir, "--out", out)[0] == 0
    assert contents(out) == first
    assert [path.name for path in tmp_path.iterdir()] == ["report"]


def test_what_is_no_report_stays(cli: Cli, run_dir: Path, tmp_path: Path) -> None:
    (tmp_path / "notes.txt").write_text("mine")
    status, output, errors = cli("report", run_dir, "--out", tmp_path)
    assert (status, output) == (1, "")
    assert "holds notes.txt, which is no file of a report: name another folder" in errors
    (tmp_path / "notes.txt").rename(tmp_path / "report.md")
    status, _, errors = cli("report", run_dir, "--out", tmp_path)
    assert status == 1
    assert "has no report.md of a report in it" in errors
    assert contents(tmp_path) == {"report.md": b"mine"}


def test_runs_that_cannot_be_reported(cli: Cli, run_dir: Path, tmp_path: Path) -> None:
    out, partial = tmp_path / "report", tmp_path / "partial"
    status, _, errors = cli("report", tmp_path / "nothing", "--out", out)
    assert status == 1
    assert "is not the folder of an atlas: no manifest.json" in errors
    partial.mkdir()
    for name in ("manifest.json", "knots.parquet"):
        (partial / name).write_bytes((run_dir / name).read_bytes())
    status, _, errors = cli("report", partial, "--out", out)
    assert status == 1
    assert "is not complete: run `knotopt atlas` again to go on with it" in errors
    for name in ("times.parquet", "atlas.parquet"):
        (partial / name).write_bytes((run_dir / name).read_bytes())
    data = bytearray((partial / "atlas.parquet").read_bytes())
    data[_in_a_page(partial / "atlas.parquet")] ^= 0xFF
    (partial / "atlas.parquet").write_bytes(data)
    status, _, errors = cli("report", partial, "--out", out)
    assert status == 1
    assert "atlas.parquet is damaged" in errors
    assert not out.exists()


@pytest.mark.parametrize(
    ("package", "words"),
    [
        ("pyarrow", "an atlas needs pyarrow, which is not installed; install it with: pip install"),
        ("matplotlib", "drawing pictures needs matplotlib, which is not installed; install it"),
    ],
)
def test_missing_extras(cli: Cli, run_dir: Path, tmp_path: Path, package: str, words: str) -> None:
    gone = ("knotopt.atlas.store", "knotopt.atlas.run", "knotopt.atlas.report", "knotopt.plot")
    for name in [name for name in sys.modules if name.startswith(gone)]:
        cli.monkeypatch.delitem(sys.modules, name)
    cli.monkeypatch.setitem(sys.modules, package, None)
    status, output, errors = cli("report", run_dir, "--out", tmp_path / "report")
    assert (status, output) == (1, "")
    assert errors.startswith(f"knotopt: {words}")
    assert list(tmp_path.iterdir()) == []
