"""Reading grid diagrams from files, and writing results, files and folders, atomically."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from hypothesis import HealthCheck, given, settings

from knotopt.diagram.families import torus_knot
from knotopt.diagram.grid import GridDiagram
from knotopt.diagram.reading import read_grid
from knotopt.errors import FileFormatError, OutputError
from knotopt.files import check_folder, write_atomically, write_folder
from tests.helpers.strategies import diagrams


def csv_of(lines: object) -> str:
    return "".join(",".join(map(str, line)) + "\n" for line in lines)  # type: ignore[attr-defined]


@settings(suppress_health_check=[HealthCheck.function_scoped_fixture], max_examples=30)
@given(diagrams())
def test_every_form_is_read_back(tmp_path: Path, diagram: GridDiagram) -> None:
    matrix, marks = diagram.matrix.tolist(), [list(mark) for mark in diagram.marks]
    oriented = GridDiagram.from_marks(marks)
    forms = {
        "matrix.json": (json.dumps(matrix), diagram),
        "key.json": (json.dumps({"matrix": matrix, "comment": "any"}), diagram),
        "marks.json": (json.dumps(marks), oriented),
        "grid.json": (json.dumps({"grid": marks}), oriented),
        "matrix.csv": (csv_of(matrix), diagram),
        "marks.csv": (csv_of(marks), oriented),
        "header.csv": ("\ufeffcolumn,row\n\n" + csv_of(marks), oriented),
    }
    for name, (text, expected) in forms.items():
        path = tmp_path / name
        path.write_text(text, encoding="utf-8")
        assert read_grid(path) == expected, name
        assert read_grid(str(path)) == expected


@pytest.mark.parametrize(
    ("name", "text", "message"),
    [
        ("a.txt", "", r"a.txt: expected a .json or .csv file"),
        ("a.json", "{", r"a.json: line 1 is not JSON"),
        ("a.json", "[\n1,\n", r"a.json: line 3 is not JSON"),
        (
            "a.json",
            '{"knot": "3_1"}',
            r"""expected either the key "grid" or "matrix", found 'knot'""",
        ),
        ("a.json", '{"grid": [], "matrix": []}', "found 'grid', 'matrix'"),
        ("a.json", "{}", "found none"),
        ("a.json", "3", "expected a list of lists"),
        ("a.json", '{"grid": 3}', r'expected a list of lists.*\(key "grid"\)'),
        ("a.json", "[[1, 0], [0, 1], [1, 1], [0, 0]]", r"a.json: mark \[1, 0\] is outside"),
        ("a.json", "[]", "no marks"),
        ("a.json", '{"matrix": []}', "at least 2 x 2"),
        ("a.json", "[" * 100_000, "not the JSON of a grid diagram"),
        ("a.json", "[[" + "1" * 5000 + "]]", "not the JSON of a grid diagram"),
        ("a.csv", "1" * 200_000, "not the CSV of a grid diagram"),
        ("a.csv", "1,-1\n-1,x\n", "a.csv: line 2 is '-1,x', expected integers"),
        ("a.csv", "column,row\n1,1.5\n", "line 2"),
        ("a.csv", "1,-1,0\n-1,1\n", "not square"),
        ("a.csv", "", "no marks"),
    ],
)
def test_bad_files(tmp_path: Path, name: str, text: str, message: str) -> None:
    path = tmp_path / name
    path.write_text(text)
    with pytest.raises(FileFormatError, match=message):
        read_grid(path)


def test_unreadable_files(tmp_path: Path) -> None:
    with pytest.raises(FileFormatError, match=r"cannot read .*none.json: No such file"):
        read_grid(tmp_path / "none.json")
    (tmp_path / "dir.json").mkdir()
    with pytest.raises(FileFormatError, match="Is a directory"):
        read_grid(tmp_path / "dir.json")
    (tmp_path / "bytes.csv").write_bytes(b"\xff\xfe1")
    with pytest.raises(FileFormatError, match=r"not UTF-8 text \(byte 0\)"):
        read_grid(tmp_path / "bytes.csv")


def test_writing_is_all_or_nothing(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    path = tmp_path / "new" / "result.csv"
    write_atomically(path, "first")
    assert path.read_text() == "first"

    def full_disk(_descriptor: int) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr("os.fsync", full_disk)
    with pytest.raises(OutputError, match=r"cannot write .*result.csv: No space left"):
        write_atomically(path, b"second")
    assert path.read_text() == "first"
    assert [entry.name for entry in path.parent.iterdir()] == ["result.csv"]


def test_writing_where_a_file_is_in_the_way(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("")
    with pytest.raises(OutputError, match="cannot write"):
        write_atomically(tmp_path / "file" / "result.csv", "")


def test_torus_knot_survives_the_round_trip_by_file(tmp_path: Path) -> None:
    write_atomically(tmp_path / "t.json", json.dumps({"grid": torus_knot(3, 5).marks}))
    assert read_grid(tmp_path / "t.json") == torus_knot(3, 5)


def listed(folder: Path) -> list[str]:
    return sorted(entry.name for entry in folder.iterdir())


def replaceable(_folder: Path) -> str:
    return ""


def test_a_folder_appears_whole(tmp_path: Path) -> None:
    folder = tmp_path / "new" / "er" / "flight"
    write_folder(folder, {"a.txt": "\u00e9\n", "b.bin": b"\x00"})
    assert (folder / "a.txt").read_bytes() == b"\xc3\xa9\n"
    assert listed(folder) == ["a.txt", "b.bin"] and listed(folder.parent) == ["flight"]


def test_a_folder_is_replaced_as_a_whole_or_kept(tmp_path: Path) -> None:
    folder = tmp_path / "flight"
    folder.mkdir()
    write_folder(folder, {"old": ""})  # an empty one is in nobody's way
    with pytest.raises(OutputError, match="flight is there already"):
        write_folder(folder, {"new": ""})
    with pytest.raises(OutputError, match="flight is mine"):
        write_folder(folder, {"new": ""}, lambda _: "is mine")
    assert listed(folder) == ["old"]
    (tmp_path / "link").symlink_to(folder)
    write_folder(tmp_path / "link", {"new": ""}, replaceable)
    assert listed(folder) == ["new"] and (tmp_path / "link").is_symlink()
    assert listed(tmp_path) == ["flight", "link"]


@pytest.mark.parametrize("error", [OSError(28, "No space left on device"), KeyboardInterrupt()])
@pytest.mark.parametrize("there", [False, True])
@pytest.mark.parametrize("breaks", ["os.fsync", "pathlib.Path.rename"])
def test_a_folder_that_cannot_be_written_leaves_nothing(
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    error: BaseException,
    there: bool,
    breaks: str,
) -> None:
    folder = tmp_path / "a" / "flight"
    if there:
        write_folder(folder, {"old": "kept"})
    calls = []
    rename = Path.rename

    def fails(*arguments: Path) -> Path | None:
        calls.append(arguments)
        # A second file, or where the new folder takes the place of the old.
        if breaks == "os.fsync" and len(calls) < 2:
            return None
        if breaks != "os.fsync" and arguments[0].suffix != ".tmp":
            return rename(*arguments)
        raise error

    monkeypatch.setattr(breaks, fails)
    expected = OutputError if isinstance(error, OSError) else KeyboardInterrupt
    with pytest.raises(expected):
        write_folder(folder, {"one": "", "two": ""}, replaceable)
    monkeypatch.undo()
    if there:
        assert listed(tmp_path / "a") == ["flight"] and listed(folder) == ["old"]
    else:
        assert listed(tmp_path) == []


def test_folders_that_cannot_be(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "file").write_text("")
    monkeypatch.chdir(tmp_path)
    for path, words in (
        (Path("file"), "cannot write file: a file is in the way"),
        (Path("file/flight"), "cannot write file/flight: Not a directory"),
        (Path("x" * 300), "File name too long"),
        (Path(), r". is the current folder, which cannot be replaced as a whole: name a folder"),
        (Path("/proc"), "/proc is a mount point"),
        (Path("/proc/flight"), "cannot write /proc/flight: "),
    ):
        with pytest.raises(OutputError, match=words):
            check_folder(path)
        with pytest.raises(OutputError, match=words):
            write_folder(path, {})
    assert listed(tmp_path) == ["file"]
