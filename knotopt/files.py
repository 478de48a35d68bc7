"""Files that are either whole or not there: results land by atomic rename.

What takes long is collected beside its final place and goes on where it stopped.
"""

from __future__ import annotations

import json
import os
import uuid
from collections.abc import Callable, Iterator
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
    data = content.encode() if isinstance(content, str) else content
    temporary = path.with_name(f".{path.name}.{uuid.uuid4().hex}.tmp")
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        try:
            with temporary.open("wb") as stream:
                stream.write(data)
                stream.flush()
                os.fsync(stream.fileno())
            temporary.replace(path)
        finally:
            temporary.unlink(missing_ok=True)
    except OSError as error:
        raise OutputError(f"cannot write {path}: {error.strerror}") from error


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
    partial = path.with_name(f"{path.name}.partial")
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        text = partial.read_text(encoding="utf-8") if partial.exists() else f"{header}\n"
    except OSError as error:
        raise OutputError(f"cannot write {path}: {error.strerror}") from error
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
