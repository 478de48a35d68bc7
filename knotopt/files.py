"""Files and folders that are either whole or not there: results land by atomic rename.

What takes long is collected beside its final place and goes on where it stopped.
"""

from __future__ import annotations

import json
import os
import shutil
import tempfile
import uuid
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import TextIO

from knotopt.errors import OutputError


def write_atomically(path: Path, content: str | bytes) -> None:
    """Write a file through a temporary one beside it, so that no reader sees half of it.

    Parameters
    ----------
    path : Path
        Missing parent folders are made.
    content : str or bytes
        Text is written as UTF-8 with "\\n" line ends.

    Raises
    ------
    OutputError
        The file cannot be written there; an existing one is left as it was.
    """
    check_file(path)
    temporary = path.with_name(f".{path.name}.{uuid.uuid4().hex}.tmp")
    with _writing(path):
        path.parent.mkdir(parents=True, exist_ok=True)
        try:
            _write_through(temporary, content)
            temporary.replace(path)
        finally:
            temporary.unlink(missing_ok=True)


def check_file(path: Path) -> None:
    """Whether a path can be a file's, before what takes long is computed.

    Raises
    ------
    OutputError
        It names no file, or a folder that is there.
    """
    with _writing(path):
        if not path.name or path.is_dir():
            raise OutputError(f"cannot write {path}: that is a folder")


def write_folder(
    path: Path, files: Mapping[str, str | bytes], why_kept: Callable[[Path], str] | None = None
) -> None:
    """Write a folder as a whole: it appears with all its files, or is left as it was.

    Parameters
    ----------
    path : Path
        Missing parent folders are made. A link is followed.
    files : mapping of str to str or bytes
        Names of files to their contents, text as UTF-8.
    why_kept : callable, optional
        Why a folder that is there already, and not empty, cannot be replaced, in words that follow
        its name; "" if it can. By default none can.

    Raises
    ------
    OutputError
        The folder cannot be written there, or one that is there is not to be replaced. Nothing is
        left behind.
    """
    check_folder(path, why_kept)
    target = path.resolve()
    token = uuid.uuid4().hex
    temporary, old = (target.with_name(f".{token}.{end}") for end in ("tmp", "old"))
    made: list[Path] = []
    with _writing(path):
        try:
            for parent in reversed((target.parent, *target.parent.parents)):
                if not parent.exists():
                    parent.mkdir()
                    made.append(parent)
            temporary.mkdir()
            for name, content in files.items():
                _write_through(temporary / name, content)
            if target.exists():
                target.rename(old)
            try:
                temporary.rename(target)
            except BaseException:
                if old.exists():
                    old.rename(target)
                raise
        except BaseException:
            shutil.rmtree(temporary, ignore_errors=True)
            for parent in reversed(made):
                parent.rmdir()
            raise
    shutil.rmtree(old, ignore_errors=True)


def check_folder(path: Path, why_kept: Callable[[Path], str] | None = None) -> None:
    """Whether `write_folder` can write there, before what takes long is computed.

    Raises
    ------
    OutputError
        It cannot.
    """
    target = path.resolve()
    with _writing(path):
        if target.exists() and not target.is_dir():
            raise OutputError(f"cannot write {path}: a file is in the way")
        if target.is_dir():
            if target == Path.cwd() or target.is_mount():
                what = "a mount point" if target.is_mount() else "the current folder"
                raise OutputError(
                    f"{path} is {what}, which cannot be replaced as a whole: "
                    "name a folder inside it"
                )
            if any(target.iterdir()):
                why = "is there already" if why_kept is None else why_kept(target)
                if why:
                    raise OutputError(f"{path} {why}")
            with tempfile.TemporaryDirectory(dir=target):  # its files will have to go
                pass
        above = next(parent for parent in target.parents if parent.exists())
        with tempfile.TemporaryDirectory(dir=above):
            pass


@contextmanager
def _writing(path: Path) -> Iterator[None]:
    """Whatever the system says against it becomes an error that names the path."""
    try:
        yield
    except OSError as error:
        raise OutputError(f"cannot write {path}: {error.strerror}") from error


def _write_through(path: Path, content: str | bytes) -> None:
    """Write a file down to the disk, text as UTF-8."""
    with path.open("wb") as stream:
        stream.write(content.encode() if isinstance(content, str) else content)
        stream.flush()
        os.fsync(stream.fileno())


class Lines:
    """Lines of a file in the making: those there already, and more to come."""

    def __init__(self, done: list[str], stream: TextIO) -> None:
        self.done = done
        self._stream = stream

    def write(self, line: str) -> None:
        """Add one line, with or without its end; it survives whatever happens next."""
        self._stream.write(line.rstrip("\n") + "\n")
        self._stream.flush()


@contextmanager
def resumable_lines(
    path: Path, header: str, finish: Callable[[list[str]], str] | None = None
) -> Iterator[Lines]:
    """Collect the lines of a file, JSON each, which lands under its name when all are there.

    Until then, and if anything fails, they are in `PATH.partial` after a line with the header. A
    later call with the same header finds them in `done`; a torn last line is dropped. `finish`
    makes the file's text of the lines; by default it is the lines.

    Raises
    ------
    OutputError
        The file cannot be written there, or the partial one is damaged or of another run.
    """
    check_file(path)
    partial = path.with_name(f"{path.name}.partial")
    try:
        with _writing(path):
            path.parent.mkdir(parents=True, exist_ok=True)
            text = partial.read_text(encoding="utf-8") if partial.exists() else f"{header}\n"
    except UnicodeDecodeError as error:
        raise OutputError(f"{partial} is damaged: remove the file") from error
    first, *rest = text.split("\n")
    if first != header:
        raise OutputError(
            f"{partial} has the beginning of another run: finish that one, or remove the file"
        )
    done = rest[:-1]  # what follows the last line end is torn
    for number, line in enumerate(done, 2):
        try:
            json.loads(line)
        except ValueError as error:
            raise OutputError(f"{partial}, line {number} is damaged: remove the file") from error
    write_atomically(partial, "\n".join([header, *done, ""]))
    try:
        with partial.open("a", encoding="utf-8") as stream:
            yield Lines(done, stream)
    except BaseException:
        if partial.read_text(encoding="utf-8") == f"{header}\n":
            partial.unlink()  # nothing to go on from
        raise
    lines = partial.read_text(encoding="utf-8").splitlines()[1:]
    write_atomically(path, finish(lines) if finish else "".join(f"{line}\n" for line in lines))
    partial.unlink()
