"""How results are printed: JSON, tables, paragraphs, names with values."""

from __future__ import annotations

import json
import sys
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from knotopt.document.model import Document

UNBROKEN = 1_000_000  # characters
NARROWEST = 9  # of a column whose cells are longer [characters]


def print_json(content: Any) -> None:
    """Print JSON with each innermost list on one line, where `json` would use a line a number."""
    print(_indented(content, ""))


def print_table(columns: Sequence[str], rows: Iterable[Sequence[Any]]) -> None:
    """Print a table; numbers stand to the right."""
    from rich import box
    from rich.console import Console
    from rich.table import Table
    from rich.text import Text

    # Text, not markup: columns and cells hold [brackets].
    table = Table(box=box.SIMPLE_HEAD, pad_edge=False)
    words = {True: "yes", False: "no"}
    cells = [[words[v] if isinstance(v, bool) else str(v) for v in row] for row in rows]
    for index, column in enumerate(columns):
        numeric = all(row[index].replace(".", "").lstrip("-").isdigit() for row in cells)
        # In a narrow terminal long cells break into lines; no column vanishes.
        width = max(map(len, [column, *(row[index] for row in cells)]))
        table.add_column(
            Text(column),
            justify="right" if numeric else "left",
            min_width=min(width, NARROWEST),
            overflow="fold",
        )
    for row in cells:
        table.add_row(*(Text(cell) for cell in row))
    # Into a pipe or a file, a row is one line.
    Console(width=None if sys.stdout.isatty() else UNBROKEN).print(table)


def print_tables(document: Document) -> None:
    """Print the document's tables, each with its caption below."""
    for table in document.tables:
        print_table(table.heads, table.rows)
        print_note(table.caption)


def print_written(*paths: Path | None) -> None:
    """Say where results were written; what is None was not asked for."""
    for path in paths:
        if path is not None:
            print(f"written: {path}")


def print_note(text: str) -> None:
    """Print a paragraph, broken between words at the terminal's width."""
    from rich.console import Console

    Console().print(text, markup=False, highlight=False)


def print_facts(facts: Iterable[tuple[str, Any]]) -> None:
    """Print names and values, one to a line."""
    listed = list(facts)
    width = max(len(name) for name, _ in listed)
    for name, value in listed:
        print(f"{name:<{width}}  {value}")


def _indented(content: Any, indent: str) -> str:
    deeper = indent + "  "
    if isinstance(content, dict) and content:
        lines = [f"{deeper}{json.dumps(k)}: {_indented(v, deeper)}" for k, v in content.items()]
        return "{\n" + ",\n".join(lines) + f"\n{indent}}}"
    if isinstance(content, list) and any(isinstance(entry, dict) for entry in content):
        return "[\n" + ",\n".join(deeper + _indented(e, deeper) for e in content) + f"\n{indent}]"
    return json.dumps(content, ensure_ascii=False)
