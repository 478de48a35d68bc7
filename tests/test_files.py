"""Writing results, files and folders, atomically."""

from __future__ import annotations

from pathlib import Path

import pytest

from knotopt.errors import OutputError
from knotopt.files import check_folder, write_atomically, write_folder


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
