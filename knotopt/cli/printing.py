"""How results are printed: JSON, tables, paragraphs, names with values."""

from __future__ import annotations

import json
import sys
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from knotopt.document.model import Document

LEAST = 9  # of a column of words that are longer [characters]
BETWEEN = 3  # characters between two columns


def print_json(content: Any) -> None:
    """Print JSON with each innermost list on one line, where `json` would use a line a number."""
    print(_indented(content, ""))


def print_table(columns: Sequence[str], rows: Iterable[Sequence[Any]]) -> None:
    """Print a table; numbers stand to the right.

    Into a pipe or a file, a row is one line. In a terminal that is too narrow, long text breaks
    into lines between its words; where that is not enough, rows become columns, or columns are
    printed in several tables, each with the first one. None vanishes, and no number breaks.
    """
    words = {True: "yes", False: "no"}
    cells = [[words[v] if isinstance(v, bool) else str(v) for v in row] for row in rows]
    by_column = [[column, *(row[k] for row in cells)] for k, column in enumerate(columns)]
    room = _terminal_width()
    if room is None:
        print(_unbroken(by_column))
        return
    if _least_width(by_column, room) <= room:
        _print_grid(by_column, room)
        return
    across = [[*line] for line in zip(*by_column, strict=True)]
    if _least_width(across, room) <= room:
        _print_grid(across, room, headed=False)
        return
    first, *others = by_column
    while others:
        taken = 1
        while taken < len(others) and _least_width([first, *others[: taken + 1]], room) <= room:
            taken += 1
        _print_grid([first, *others[:taken]], room)
        others = others[taken:]


def _terminal_width() -> int | None:
    """Of the terminal that is printed to [characters]; None for a pipe or a file."""
    from rich.console import Console

    return Console().width if sys.stdout.isatty() else None


def _is_number(cell: str) -> bool:
    return cell.replace(".", "").lstrip("-").isdigit()


def _least(column: Sequence[str], room: int) -> int:
    """The least width of a column: numbers and words stay whole, unless they are very long."""
    head, *cells = column
    words = [word for cell in cells for word in ([cell] if _is_number(cell) else cell.split())]
    longest = max(map(len, [*head.split(), *words]), default=0)
    return min(longest, max(LEAST, room // 2))


def _least_width(by_column: Sequence[Sequence[str]], room: int) -> int:
    return sum(_least(column, room) + BETWEEN for column in by_column) - BETWEEN + 2


def _widths(by_column: Sequence[Sequence[str]], room: int) -> list[int]:
    """Of each column: as wide as its cells, or what is left is shared among those that break."""
    widths = [_least(column, room) for column in by_column]
    left = room - _least_width(by_column, room)
    missing = [
        max(map(len, column)) - width for column, width in zip(by_column, widths, strict=True)
    ]
    narrow = sorted(range(len(widths)), key=missing.__getitem__)
    for done, place in enumerate(narrow):
        more = max(0, min(missing[place], left // (len(narrow) - done)))
        widths[place] += more
        left -= more
    return widths


def _unbroken(by_column: Sequence[Sequence[str]]) -> str:
    """Columns, each with its head, a row a line: what `rich` makes of them, but at once."""
    from rich.cells import cell_len

    aligned = []
    for head, *cells in by_column:
        width = max(map(cell_len, [head, *cells]))
        right = all(map(_is_number, cells))
        filled = [" " * (width - cell_len(cell)) for cell in [head, *cells]]
        texts = zip([head, *cells], filled, strict=True)
        aligned.append([fill + cell if right else cell + fill for cell, fill in texts])
    head, *rows = (f" {(' ' * BETWEEN).join(line)} " for line in zip(*aligned, strict=True))
    width = cell_len(head)
    return "\n".join([" " * width, head, f" {'─' * (width - 2)} ", *rows, " " * width])


def _print_grid(by_column: Sequence[Sequence[str]], room: int, *, headed: bool = True) -> None:
    """Print columns, each with its head, as wide as there is room."""
    from rich import box
    from rich.console import Console
    from rich.table import Table
    from rich.text import Text

    # Text, not markup: columns and cells hold [brackets].
    table = Table(box=box.SIMPLE_HEAD, pad_edge=False, show_header=headed)
    for column, width in zip(by_column, _widths(by_column, room), strict=True):
        head, *cells = column
        table.add_column(
            Text(head),
            justify="right" if all(map(_is_number, cells)) else "left",
            width=width,  # that `rich` finds by itself may be less than a word's
            overflow="fold",
        )
    for row in zip(*(column[headed:] for column in by_column), strict=True):
        table.add_row(*map(Text, row))
    Console(width=room).print(table)


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
