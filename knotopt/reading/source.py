"""Where a knot comes from: the argument itself, a file of any name, standard input.

Text is UTF-8 or, with a byte order mark, UTF-16. Lines of remarks before it are left blank. Signs
and blanks that word processors and PDF files put in the place of those on the keyboard are read as
these.
"""

from __future__ import annotations

import codecs
import os
import re
import stat
import sys
from dataclasses import dataclass
from pathlib import Path
from typing import BinaryIO

from knotopt.errors import FileFormatError

MAX_BYTES = 4_000_000
"""Longest text: a matrix of size 1,000, or the marks of the largest grid."""

LONGEST_PATH = 4096

REMARK = re.compile(r"\s*(#|%|//)")
"""How a line begins that says nothing of the knot."""

_SAME = str.maketrans(
    {
        **dict.fromkeys("\u2212\u2010\u2011\u2012\u2013\ufe63\uff0d", "-"),
        **dict.fromkeys("\u00a0\u2007\u2009\u202f\u3000", " "),
        **dict.fromkeys("\u200b\ufeff"),
        **dict.fromkeys("\u201c\u201d", '"'),
        **dict.fromkeys("\u2018\u2019", "'"),
    }
)


@dataclass(frozen=True)
class Source:
    """A text and where it comes from.

    Attributes
    ----------
    text : str
    name : str
        Of the file, "standard input", or "" for an argument.
    words : str
        The same in words: "file PATH", "as given".
    """

    text: str
    name: str
    words: str

    @property
    def where(self) -> str:
        """What errors are led in by: the file's path."""
        return self.words.removeprefix("file ")


def read_source(knot: str | Path) -> Source:
    """The text that an argument is, or that is in the file of that name; "-" is standard input.

    Raises
    ------
    FileFormatError
        A file that is missing, cannot be read, is too long or is no text.
    """
    if knot == "-":
        content = _read(sys.stdin.buffer, "standard input")
        return Source(decode(content, "standard input"), "standard input", "standard input")
    path = Path(knot)
    mode = _mode(path)
    if mode is None or (stat.S_ISDIR(mode) and isinstance(knot, str) and not _is_path(knot)):
        if isinstance(knot, Path) or _is_path(knot):
            raise FileFormatError(f"cannot read {path}: No such file or directory")
        if len(knot) > MAX_BYTES:
            raise FileFormatError(f"the text is longer than {MAX_BYTES // 10**6} MB")
        return Source(_clean(knot), "", "as given")
    try:
        with path.open("rb") as stream:
            content = _read(stream, str(path))
    except OSError as error:
        raise FileFormatError(f"cannot read {path}: {error.strerror}") from error
    return Source(decode(content, str(path)), path.name, f"file {knot}")


def _mode(path: Path) -> int | None:
    """The kind of file there, as `stat` has it; None if there is none."""
    try:
        return path.stat().st_mode if len(str(path)) < LONGEST_PATH else None
    except (OSError, ValueError):  # ValueError: a name with a zero byte
        return None


def _is_path(text: str) -> bool:
    """Whether a text that is no existing file is meant as one."""
    if len(text) > 1000 or re.search(r"[\n\[\](){},;:\0]", text):
        return False
    return os.sep in text or bool(re.search(r"\.(json|csv|tsv|txt|dat|xyz)\s*$", text, re.I))


def _read(stream: BinaryIO, what: str) -> bytes:
    content = stream.read(MAX_BYTES + 1)
    if len(content) > MAX_BYTES:
        raise FileFormatError(f"{what} is longer than {MAX_BYTES // 10**6} MB")
    return content


def decode(content: bytes, what: str) -> str:
    """Text of bytes.

    Raises
    ------
    FileFormatError
        They are no text, naming the first wrong byte.
    """
    encoding = "utf-8-sig"
    if content.startswith((codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE)):
        encoding = "utf-16"
    elif b"\0" in (head := content[:64]):  # no mark: of plain text every other byte is zero
        encoding = "utf-16-be" if head[::2].count(0) > head[1::2].count(0) else "utf-16-le"
    try:
        text = content.decode(encoding)
    except UnicodeDecodeError as error:
        name = "UTF-8" if encoding == "utf-8-sig" else "UTF-16"
        raise FileFormatError(f"{what} is not {name} text (byte {error.start})") from error
    return _clean(text)


def _clean(text: str) -> str:
    """The text with the keyboard's signs, and blank lines for the remarks before it."""
    lines = text.translate(_SAME).splitlines(keepends=True)
    if len(lines) > 1:  # one line such as "#3_1" is all that there is
        for k, line in enumerate(lines):
            if line.strip() and not REMARK.match(line):
                break
            lines[k] = "\n"
    return "".join(lines)
