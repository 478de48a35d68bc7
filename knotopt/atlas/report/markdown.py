"""A report as Markdown."""

from __future__ import annotations

from knotopt.atlas.report.document import Block, Document, Picture, Table, pieces

_SPECIAL = str.maketrans({each: f"\\{each}" for each in "\\*_|[]<>#~"})


def markdown(document: Document, ending: str = "png") -> str:
    """The report's text; pictures are files beside it."""
    lines = [f"# {_text(document.title)}", ""]
    lines += [f"- {_text(name)}: {_text(value)}" for name, value in document.facts]
    for section in document.sections:
        lines += ["", f"## {_text(section.title)}"]
        for block in section.blocks:
            lines += ["", *_block(block, ending)]
    return "\n".join(lines) + "\n"


def _block(block: Block, ending: str) -> list[str]:
    match block:
        case str():
            return [_text(block)]
        case tuple():
            return [f"- {_text(item)}" for item in block]
        case Picture():
            return [
                f"![{_text(block.shows)}]({block.name}.{ending})",
                "",
                f"*{_text(block.caption)}*",
            ]
        case Table():
            rule = ["---:" if number else "---" for number in block.is_number]
            rows = [[_text(cell) for cell in row] for row in (block.heads, *block.rows)]
            rows.insert(1, rule)
            return [*(f"| {' | '.join(row)} |" for row in rows), "", _text(block.caption)]


def _text(text: str) -> str:
    return "".join(
        f"`{piece}`" if is_code else piece.translate(_SPECIAL) for is_code, piece in pieces(text)
    )
