"""A document as one HTML page that needs nothing else."""

from __future__ import annotations

import base64
from collections.abc import Mapping
from html import escape

from knotopt.document.model import Block, Document, Picture, Table, marked
from knotopt.document.pages import filled, page, part


def html(document: Document, pictures: Mapping[str, bytes]) -> str:
    """The page, to be written as UTF-8.

    Parameters
    ----------
    document : Document
    pictures : mapping of str to bytes
        SVG files of the pictures by name.

    Returns
    -------
    str
        HTML that loads nothing and runs nothing.
    """
    facts = "".join(
        f"<div><dt>{_text(name)}</dt><dd>{_text(value)}</dd></div>"
        for name, value in document.facts
    )
    sections = "".join(
        f'<section><h2 id="part-{number}">{_text(section.title)}</h2>'
        + "".join(
            _block(block, pictures, f"table-{number}-{index}")
            for index, block in enumerate(section.blocks, 1)
        )
        + "</section>\n"
        for number, section in enumerate(document.sections, 1)
    )
    contents = "".join(
        f'<li><a href="#part-{number}">{_text(section.title)}</a></li>'
        for number, section in enumerate(document.sections, 1)
    )
    parts = {"title": escape(document.title), "facts": facts}
    parts |= {"contents": contents, "sections": sections}
    body = filled(part(__package__, "document.html"), parts)
    return page(document.title, body, part(__package__, "document.css")) + "\n"


def _block(block: Block, pictures: Mapping[str, bytes], name: str) -> str:
    match block:
        case str():
            return f"<p>{_text(block)}</p>"
        case tuple():
            return "<ul>" + "".join(f"<li>{_text(item)}</li>" for item in block) + "</ul>"
        case Picture():
            data = base64.b64encode(pictures[block.name]).decode("ascii")
            kind = "picture broad" if block.is_wide else "picture"
            return (
                f'<figure class="{kind}"><img alt="{escape(block.shows)}" '
                f'src="data:image/svg+xml;base64,{data}"><p>{_text(block.caption)}</p></figure>'
            )
        case Table():
            return _table(block, name)


def _table(block: Table, name: str) -> str:
    kinds = [' class="number"' if side == "r" else "" for side in block.sides]
    head = "".join(
        f'<th scope="col"{kind}>{_text(text)}</th>'
        for kind, text in zip(kinds, block.heads, strict=True)
    )
    rows = "".join(
        "<tr>"
        + "".join(f"<td{kind}>{_text(cell)}</td>" for kind, cell in zip(kinds, row, strict=True))
        + "</tr>"
        for row in block.rows
    )
    return (
        f'<p class="caption" id="{name}">{_text(block.caption)}</p>'
        f'<div class="wide" tabindex="0" role="region" aria-labelledby="{name}">'
        f'<table aria-labelledby="{name}"><thead><tr>{head}</tr></thead>'
        f"<tbody>{rows}</tbody></table></div>"
    )


def _text(text: str) -> str:
    return marked(text, lambda piece: f"<code>{escape(piece)}</code>", escape)
