"""What tables say of the knots beyond the atlas: bridge and braid index, families."""

from __future__ import annotations

import importlib.metadata
from collections.abc import Iterable
from dataclasses import dataclass
from functools import cache

from knotopt.atlas.schema import KnotRow
from knotopt.catalogue.knotinfo import is_installed

TORUS = ("3_1", "5_1", "7_1", "8_19", "9_1", "10_124", "11a_367", "13a_4878")
"""The torus knots up to 13 crossings: T(2,3) ... T(2,13), T(3,4) and T(3,5)."""
TWIST = (
    *("3_1", "4_1", "5_2", "6_1", "7_2", "8_1", "9_2", "10_1"),
    *("11a_247", "12a_803", "13a_3143"),
)
"""The twist knots of one to eleven half twists and a clasp."""


@dataclass(frozen=True)
class Invariants:
    """What KnotInfo says of one knot; None: unknown, or known only between bounds.

    Attributes
    ----------
    bridge_index, braid_index, unknotting_number : int or None
    is_pretzel : bool or None
        Whether it has a pretzel notation, which may have entries of 1.
    """

    bridge_index: int | None
    braid_index: int | None
    unknotting_number: int | None
    is_pretzel: bool | None


def knotinfo_version() -> str | None:
    """Version of the installed table, if there is one."""
    return importlib.metadata.version("database_knotinfo") if is_installed() else None


def invariants(knots: Iterable[KnotRow]) -> dict[str, Invariants]:
    """Of those knots that KnotInfo has, by name; of none where it is not installed."""
    # A grid of the user's own may have any name.
    wanted = {knot.knot for knot in knots if knot.crossing_number is not None}
    table = _table() if is_installed() else {}
    return {name: found for name, found in table.items() if name in wanted}


@cache
def _table() -> dict[str, Invariants]:
    from database_knotinfo import link_list

    return {
        row["name"]: Invariants(
            _number(row["bridge_index"]),
            _number(row["braid_index"]),
            _number(row["unknotting_number"]),
            row["pretzel_notation"].startswith("P(") if row["pretzel_notation"] else None,
        )
        for row in link_list()[1:]
    }


def _number(cell: str) -> int | None:
    """None where it is empty or a range such as `[2,3]`."""
    return int(cell) if cell.isdigit() else None
