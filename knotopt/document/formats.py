"""Which writer a file's suffix means."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from knotopt.document.columns import Row
from knotopt.document.csv import csv_text
from knotopt.document.latex import latex_tables
from knotopt.document.markdown import markdown
from knotopt.document.model import Document
from knotopt.errors import OutputError
from knotopt.frames import data_frame

if TYPE_CHECKING:
    import pandas as pd


@dataclass(frozen=True)
class Tabulation:
    """Tables for people, and rows under the names of their columns for programs."""

    document: Document
    names: tuple[str, ...]
    rows: tuple[Row, ...]

    def to_dataframe(self) -> pd.DataFrame:
        """The rows as a data frame of pandas.

        Raises
        ------
        MissingExtraError
            pandas is not installed.
        """
        return data_frame(self.rows, self.names)


WRITERS: dict[str, Callable[[Tabulation], str]] = {
    ".csv": lambda found: csv_text(found.names, found.rows),
    ".md": lambda found: markdown(found.document),
    ".tex": lambda found: latex_tables(found.document),
}
"""Suffix of a file to what writes its text."""


def writer_for(path: Path) -> Callable[[Tabulation], str]:
    """The writer that a file's suffix names.

    Raises
    ------
    OutputError
        There is none.
    """
    try:
        return WRITERS[path.suffix.lower()]
    except KeyError:
        raise OutputError(f"{path}: tables are written as {', '.join(WRITERS)}") from None
