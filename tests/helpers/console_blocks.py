"""What pages show of commands, and whether that is what is printed."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path

CONSOLE = re.compile(r"^```console\n(.*?)^```$", re.DOTALL | re.MULTILINE)


def commands(page: Path) -> Iterator[tuple[str, str]]:
    """Each `$ knotopt ...` of a page and what is shown under it."""
    for block in CONSOLE.findall(page.read_text()):
        for command in re.split(r"^\$ knotopt ", block, flags=re.MULTILINE)[1:]:
            first, _, shown = command.partition("\n")
            yield first, shown


def expect_shown(command: str, shown: str, out: str) -> None:
    """What a page shows is in the output, between the dots; of paths and flights, no numbers."""
    out, shown = (re.sub(r" +$", "", text, flags=re.MULTILINE) for text in (out, shown))
    pieces = shown.split("...\n")
    if command.startswith(("path", "fly")):
        texts = (re.sub(r"[\d.]*\d|[ ─]+", " ", text) for text in (out, *pieces))
        out, *pieces = (re.sub(r" *\n *", "\n", text).strip() for text in texts)
    at = 0
    for piece in pieces:
        assert piece in out[at:], f"knotopt {command}"
        at = out.index(piece, at) + len(piece)
