"""A report before it is written in some format: sections of paragraphs, tables and pictures.

Text may have `code` between backticks; everything else in it is shown as it is.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

NONE = "\N{EN DASH}"
"""A cell with nothing to say."""


@dataclass(frozen=True)
class Table:
    """Rows of cells under heads; columns of numbers stand to the right.

    Attributes
    ----------
    heads : tuple of str
    rows : tuple of tuple of str
    caption : str
        What it shows, and of how many knots and cuts.
    """

    heads: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]
    caption: str

    def __post_init__(self) -> None:
        for row in self.rows:
            if len(row) != len(self.heads):
                raise ValueError(f"row {row} has {len(row)} cells under {len(self.heads)} heads")

    @property
    def is_number(self) -> tuple[bool, ...]:
        """Which columns hold numbers only."""
        return tuple(
            all(_is_number(row[index]) for row in self.rows) for index in range(len(self.heads))
        )


@dataclass(frozen=True)
class Picture:
    """A figure by the stem of its file's name.

    Attributes
    ----------
    name : str
    caption : str
    shows : str
        For who cannot see it.
    is_wide : bool
        Whether it takes the page's width, not that of a column.
    """

    name: str
    caption: str
    shows: str
    is_wide: bool = False


Block = str | tuple[str, ...] | Table | Picture
"""A paragraph, a list, a table or a picture."""


@dataclass(frozen=True)
class Section:
    """A heading and what stands under it."""

    title: str
    blocks: tuple[Block, ...]


@dataclass(frozen=True)
class Document:
    """A report: title, facts by name, sections."""

    title: str
    facts: tuple[tuple[str, str], ...]
    sections: tuple[Section, ...]

    @property
    def pictures(self) -> list[Picture]:
        """All pictures, in their order."""
        return [
            block
            for section in self.sections
            for block in section.blocks
            if isinstance(block, Picture)
        ]


def table(heads: Sequence[str], rows: Sequence[Sequence[str]], caption: str) -> Table:
    """A table of whatever sequences."""
    return Table(tuple(heads), tuple(map(tuple, rows)), caption)


def pieces(text: str) -> Iterator[tuple[bool, str]]:
    """The text in pieces: whether it is code, and what it is.

    Examples
    --------
    >>> list(pieces("robots of `opening`"))
    [(False, 'robots of '), (True, 'opening')]
    """
    for index, piece in enumerate(re.split(r"`([^`]*)`", text)):
        if piece:
            yield index % 2 == 1, piece


def _is_number(cell: str) -> bool:
    return cell in ("", NONE) or re.fullmatch(r"[-+\N{MINUS SIGN}]?[\d.,]+( %)?", cell) is not None
