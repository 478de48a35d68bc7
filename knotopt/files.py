"""Files that are either whole or not there: results land by atomic rename."""

from __future__ import annotations

import os
import uuid
from pathlib import Path

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
