"""A document as Markdown with tables, as GitHub and MkDocs read it."""

from __future__ import annotations

import re

from knotopt.document.model import Block, Document, Picture, Table, marked

# An underscore inside a word, as in 8_19, means nothing.
_SPECIAL = re.compile(r"[\\*|\[\]#`&<~]|^>|(?<![A-Za-z0-9])_|_(?![A-Za-z0-9])")
# Not every reader of Markdown takes a backslash before these.
_ENTITIES = {"&": "&amp;", "<": "&lt;", ">": "&gt;", "~": "&#126;"}


def markdown(document: Document) -> str:
    """The document's text; pictures are .png files beside it."""
    parts = [f"# {_text(document.title)}"] if document.title else []
    if document.facts:
        parts += ["\n".join(f"- {_text(name)}: {_text(value)}" for name, value in document.facts)]
    for section in document.sections:
        parts += [f"## {_text(section.title)}"] if section.title else []
        parts += [markdown_block(block) for block in section.blocks]
    return "\n\n".join(parts) + "\n"


def markdown_block(block: Block) -> str:
    """One block of a document."""
    match block:
        case str():
            return _text(block)
        case tuple():
            return "\n".join(f"- {_text(item)}" for item in block)
        case Picture():
            shown = f"![{_text(block.shows)}]({block.name}.png)"
            return f"{shown}\n\n*{_text(block.caption)}*"
        case Table():
            caption = f"\n\n{_text(block.caption)}" if block.caption else ""
            return _table(block) + caption


def _table(block: Table) -> str:
    rows = ["".join("|---:" if side == "r" else "|---" for side in block.sides) + "|"]
    rows += [f"| {' | '.join(map(_cell, row))} |" for row in block.rows]
    return "\n".join([f"| {' | '.join(map(_cell, block.heads))} |", *rows])


def _text(text: str) -> str:
    return marked(text, lambda piece: f"`{piece}`", _plain)


def _plain(piece: str) -> str:
    return _SPECIAL.sub(_escaped, piece)


def _escaped(found: re.Match[str]) -> str:
    return _ENTITIES.get(found[0], f"\\{found[0]}")


def _cell(text: str) -> str:
    """In a table a bar ends the cell even inside code."""
    return marked(text, lambda piece: "`" + piece.replace("|", r"\|") + "`", _plain)
