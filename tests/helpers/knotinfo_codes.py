"""Codes that KnotInfo's table lists for each knot, as they stand in its cells."""

from __future__ import annotations

import json
import re
from dataclasses import dataclass
from functools import cache

from database_knotinfo import link_list


@dataclass(frozen=True)
class Codes:
    """One knot's cells, and its signature in KnotInfo's sign."""

    name: str
    pd: str
    dt: str
    gauss: str
    braid: str
    signature: int

    @property
    def crossings(self) -> list[list[int]]:
        """The PD code, edges from 1."""
        found: list[list[int]] = json.loads(self.pd)
        return found

    @property
    def words(self) -> list[list[int]]:
        """Braid words: one, or a short one and one of few strands."""
        found = json.loads(re.sub(r"[{}]", lambda b: "[" if b[0] == "{" else "]", self.braid))
        return found if isinstance(found[0], list) else [found]


@cache
def knotinfo_codes(most_crossings: int = 10) -> tuple[Codes, ...]:
    """All knots of 3 to that many crossings, in KnotInfo's order."""
    _, *rows = link_list()
    return tuple(
        Codes(
            row["name"],
            row["pd_notation"],
            row["dt_notation"],
            row["gauss_notation"],
            row["braid_notation"],
            int(row["signature"]),
        )
        for row in rows
        if 3 <= int(row["crossing_number"]) <= most_crossings
    )
