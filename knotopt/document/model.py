"""A document before it is written in some format: sections of paragraphs, tables and pictures.

Text may have `code` between backticks; everything else in it is shown as it is.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass

NONE = "\N{EN DASH}"
"""A cell with nothing to say."""
_CONTROL = re.compile(r"\s*[\x00-\x1f\x7f-\x9f\u2028\u2029]\s*")  # line breaks too


@dataclass(frozen=True)
class Table:
    """Rows of cells under heads.

    Attributes
    ----------
    heads : tuple of str
    rows : tuple of tuple of str
    caption : str
        What it shows, and of how many knots and cuts.
    sides : str
        For each column "l" or "r"; by default columns of numbers stand to the right.
    """

    heads: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]
    caption: str
    sides: str = ""

    def __post_init__(self) -> None:
        for row in self.rows:
            if len(row) != len(self.heads):
                raise ValueError(f"row {row} has {len(row)} cells under {len(self.heads)} heads")
        if not self.sides:
            columns = [[row[index] for row in self.rows] for index in range(len(self.heads))]
            sides = "".join("r" if all(map(_is_number, column)) else "l" for column in columns)
            object.__setattr__(self, "sides", sides)
        elif len(self.sides) != len(self.heads) or {*self.sides} - {*"lr"}:
            raise ValueError(f"{self.sides!r} is not l or r for each of {len(self.heads)} heads")


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
    """A heading, if it has one, and what stands under it."""

    title: str
    blocks: tuple[Block, ...]


@dataclass(frozen=True)
class Document:
    """Title, if it has one, facts by name, sections."""

    title: str
    facts: tuple[tuple[str, str], ...]
    sections: tuple[Section, ...]

    @property
    def blocks(self) -> list[Block]:
        """What stands in all sections, in order."""
        return [block for section in self.sections for block in section.blocks]

    @property
    def pictures(self) -> list[Picture]:
        """All pictures, in their order."""
        return [block for block in self.blocks if isinstance(block, Picture)]

    @property
    def tables(self) -> list[Table]:
        """All tables, in their order."""
        return [block for block in self.blocks if isinstance(block, Table)]


def table(
    heads: Sequence[str], rows: Sequence[Sequence[str]], caption: str, sides: str = ""
) -> Table:
    """A table of whatever sequences."""
    return Table(tuple(heads), tuple(map(tuple, rows)), caption, sides)


def table_of(rows: Sequence[Sequence[tuple[str, str]]], caption: str) -> Table:
    """A table of rows whose cells come with their heads, which are the same in each."""
    heads = [head for head, _ in rows[0]] if rows else []
    return table(heads, [[cell for _, cell in row] for row in rows], caption)


def tables(title: str, *parts: Table) -> Document:
    """A document of tables alone."""
    return Document(title, (), (Section("", parts),))


def pieces(text: str) -> Iterator[tuple[bool, str]]:
    """The text in pieces: whether it is code, and what it is, with spaces for line breaks.

    Examples
    --------
    >>> list(pieces("robots of `opening`"))
    [(False, 'robots of '), (True, 'opening')]
    """
    for index, piece in enumerate(re.split(r"`([^`]+)`", _CONTROL.sub(" ", text))):
        if piece:
            yield index % 2 == 1, piece


def marked(text: str, code: Callable[[str], str], plain: Callable[[str], str]) -> str:
    """The text with code written by one function, all else by another."""
    return "".join((code if is_code else plain)(piece) for is_code, piece in pieces(text))


def _is_number(cell: str) -> bool:
    return cell in ("", NONE) or re.fullmatch(r"[-+\N{MINUS SIGN}]?[\d.,]+( %)?", cell) is not None
