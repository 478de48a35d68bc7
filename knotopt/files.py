"""Files that are either whole or not there: results land by atomic rename."""

from __future__ import annotations

import os
from pathlib import Path

from knotopt.errors import FileFormatError


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
    FileFormatError
        The file cannot be written there; an existing one is left as it was.
    """
    data = content.encode() if isinstance(content, str) else content
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        temporary = path.with_name(f".{path.name}.{os.getpid()}.tmp")
        try:
            temporary.write_bytes(data)
            temporary.replace(path)
        finally:
            temporary.unlink(missing_ok=True)
    except OSError as error:
        raise FileFormatError(f"cannot write {path}: {error.strerror}") from error
