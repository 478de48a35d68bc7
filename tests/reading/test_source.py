"""Where knots come from: arguments, files of any name, standard input."""

from __future__ import annotations

import io
import sys
from pathlib import Path

import pytest

from knotopt.errors import FileFormatError, KnotoptError
from knotopt.reading.knot import read_knot
from knotopt.reading.source import MAX_BYTES, decode, read_source

MARKS = "[[1, 4], [1, 1], [2, 3], [2, 5], [3, 2], [3, 4], [4, 1], [4, 3], [5, 2], [5, 5]]"


@pytest.mark.parametrize("name", ["knot", "8_19", "T(2,7)", "a.json", "b.xyz", "-x", "no knot.csv"])
def test_a_file_is_read_whatever_it_is_called(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, name: str
) -> None:
    (tmp_path / name).write_text(MARKS)
    monkeypatch.chdir(tmp_path)
    found = read_knot(name)
    assert (found.name, found.source, found.form) == (name, f"file {name}", "marks of a grid")
    (tmp_path / name).write_text("8_19\n")
    assert read_knot(name).name == "8_19"


def test_folders_do_not_hide_names(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "8_19").mkdir()
    monkeypatch.chdir(tmp_path)
    assert read_knot("8_19").source == "KnotInfo"
    with pytest.raises(FileFormatError, match=r"cannot read .*8_19: Is a directory"):
        read_knot(tmp_path / "8_19")


@pytest.mark.parametrize("name", ["none.json", "none.txt", "here/none", "NONE.CSV"])
def test_missing_files(tmp_path: Path, name: str) -> None:
    with pytest.raises(FileFormatError, match=f"cannot read {name}: No such file"):
        read_knot(name)
    with pytest.raises(FileFormatError, match=r"cannot read .*: No such file"):
        read_knot(tmp_path / "none")


@pytest.mark.parametrize("content", ["3_1", MARKS, "O1-U2-O3-U1-O2-U3-"])
def test_standard_input(monkeypatch: pytest.MonkeyPatch, content: str) -> None:
    monkeypatch.setattr(sys, "stdin", io.TextIOWrapper(io.BytesIO(content.encode("utf-16"))))
    found = read_knot("-")
    assert found.diagram == read_knot(content).diagram
    if content != "3_1":
        assert found.name == found.source == "standard input"
    monkeypatch.setattr(sys, "stdin", io.TextIOWrapper(io.BytesIO(b"")))
    with pytest.raises(FileFormatError, match="standard input: there is nothing in it"):
        read_knot("-")


def test_what_is_too_long_is_refused_at_once(tmp_path: Path) -> None:
    with pytest.raises(FileFormatError, match="/dev/zero is longer than 4 MB"):
        read_knot("/dev/zero")
    with pytest.raises(FileFormatError, match="the text is longer than 4 MB"):
        read_knot(" " * (MAX_BYTES + 1))
    path = tmp_path / "large"
    with path.open("wb") as stream:
        stream.truncate(10**12)  # takes no room on the disk
    with pytest.raises(FileFormatError, match="large is longer than 4 MB"):
        read_knot(path)


def test_bytes_that_are_no_text() -> None:
    with pytest.raises(FileFormatError, match=r"a is not UTF-8 text \(byte 2\)"):
        decode(b"3_\xff", "a")
    with pytest.raises(FileFormatError, match=r"a is not UTF-16 text \(byte 2\)"):
        decode(b"\xff\xfe1", "a")
    assert decode("\ufeff\u22121\u00a02".encode(), "a") == "-1 2"


@pytest.mark.parametrize("text", ["\0", "3_1\0", "a" * 5000, "/" * 5000])
def test_texts_that_are_no_names_of_files(text: str) -> None:
    assert read_source(text).words == "as given"
    with pytest.raises(KnotoptError):
        read_knot(text)


@pytest.mark.parametrize(
    "code",
    [
        "3_1",
        "PD[X[1,5,2,4], X[3,1,4,6], X[5,3,6,2]]",
        "[[1,5,2,4],\n# the second\n[3,1,4,6],\n[5,3,6,2]]",
        "X1524 X3146 X5362",
        "4 6 2",
        "DT: bca",
        "[4, 6, 2]",
        "O1+U2+O3+U1+O2+U3+",
        "1, -2, 3, -1, 2, -3",
        "BR[2, {1, 1, 1}]",
        "1 1 1",
        "s1 s1 s1",
        "aaa",
    ],
)
def test_remarks_before_a_code_are_skipped(tmp_path: Path, code: str) -> None:
    without = read_knot(code)
    path = tmp_path / "knot.txt"
    path.write_text(text := f"# a trefoil [1, 2\n\n  % from a book\n// page 3\n{code}\n")
    for knot in (text, path):
        found = read_knot(knot)
        assert (found.form, found.diagram) == (without.form, without.diagram)


def test_lines_are_counted_with_the_remarks_before_them() -> None:
    with pytest.raises(FileFormatError, match=r"line 3 opens '\['"):
        read_knot("# one\n\n[1,\n")
    with pytest.raises(FileFormatError, match="there is nothing in it"):
        read_knot("# one\n# two\n")
    with pytest.raises(KnotoptError, match="#3_1"):
        read_knot("#3_1")
