"""The columns of what is known of a knot, whatever its diagram, of every table."""

from __future__ import annotations

from collections.abc import Collection, Sequence

from knotopt.document.columns import Column, Row
from knotopt.sandwich.known import known_of_knot

COLUMNS = (
    Column("needed", int, "no fewer robots tie the knot, under assumptions", True),
    Column("flown", int, "robots of the smallest team known to tie it in simulation", True),
    Column("flown_tied", int, "disturbed flights in which that team tied it", True),
    Column("flown_flights", int, "of so many", True),
)
"""Of a knot, on whatever diagram; its mirror image has the same."""
HEADS = ("needed", "flown")
NOTE = """\
Needed and flown are of the knot, on whatever diagram: no fewer robots tie it, proven for a model \
of the laid cable whose assumptions `knotopt solve` names; and the smallest team that is known to \
tie it in simulation, in brackets in how many of how many disturbed flights."""


def cells(candidates: Collection[str], alexander: Sequence[int] = ()) -> Row:
    """The cells of `COLUMNS` for a knot by its names, as `known_of_knot` takes them.

    Examples
    --------
    >>> cells(["4_1"])["needed"], cells(["10_165"])["flown"]
    (4, None)
    """
    known = known_of_knot(candidates, alexander)
    team = known.flown
    return {
        "needed": known.needed.robots,
        "flown": None if team is None else team.robots,
        "flown_tied": None if team is None else team.tied,
        "flown_flights": None if team is None else team.flights,
    }


def display(row: Row) -> tuple[str, str]:
    """A row's cells under `HEADS`."""
    flown = "–"
    if row["flown"] is not None:
        flown = f"{row['flown']} ({row['flown_tied']} of {row['flown_flights']})"
    return str(row["needed"]), flown
