"""What the pages share: heads of tables, and the machine of a run."""

from __future__ import annotations

from benchmarks.results import Row


def ruled(heads: str) -> list[str]:
    """The first two lines of a table in Markdown, of its heads between bars.

    Examples
    --------
    >>> ruled("| knot | robots |")
    ['| knot | robots |', '|---|---|']
    """
    return [heads, "|---" * (heads.count("|") - 1) + "|"]


def machine_words(header: Row) -> str:
    """What a benchmark ran on, with which packages."""
    return ", ".join(f"{key} {value}" for key, value in header["machine"].items())
