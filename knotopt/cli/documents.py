"""How the tables of a document are printed in a terminal."""

from __future__ import annotations

from typing import TYPE_CHECKING

from knotopt.cli.printing import print_note, print_table

if TYPE_CHECKING:
    from knotopt.document.model import Document


def print_tables(document: Document) -> None:
    """Print the document's tables, each with its caption below."""
    for table in document.tables:
        print_table(table.heads, table.rows)
        print_note(table.caption)
