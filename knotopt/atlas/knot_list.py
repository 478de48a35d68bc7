"""The list of knots of an atlas: the catalogue's, KnotInfo's, a folder's grids, or those named."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from pathlib import Path

from knotopt.atlas.schema import KnotRow
from knotopt.catalogue.knotinfo import knotinfo_knots
from knotopt.catalogue.knots import PrimeKnot, shipped_knots
from knotopt.errors import FileFormatError
from knotopt.reading.knot import read_knot
from knotopt.reading.record import NamedDiagram

INVARIANTS = ("crossing_number", "arc_index", "alternating", "determinant", "signature")
SUFFIXES = (".json", ".csv")


def knot_rows(knots: Iterable[NamedDiagram]) -> tuple[KnotRow, ...]:
    """The knots numbered from 1; one that is listed twice counts once.

    Examples
    --------
    >>> rows = knot_rows(map(read_knot, ["3_1", "4_1", "3_1"]))
    >>> [(row.number, row.knot, row.arc_index) for row in rows]
    [(1, '3_1', 5), (2, '4_1', 6)]
    """
    rows = []
    for number, named in enumerate(dict.fromkeys(knots), 1):
        prime = named.prime_knot
        rows.append(
            KnotRow(
                number=number,
                knot=named.name,
                source=named.source,
                grid_size=named.diagram.size,
                minus=named.diagram.minus,
                plus=named.diagram.plus,
                **{name: getattr(prime, name, None) for name in INVARIANTS},
            )
        )
    return tuple(rows)


def catalogue_rows(*, knotinfo: bool = False) -> tuple[KnotRow, ...]:
    """The 249 knots that are shipped, or all of KnotInfo's.

    Raises
    ------
    MissingExtraError
        KnotInfo's table is not installed.
    """
    table: dict[str, PrimeKnot] = knotinfo_knots() if knotinfo else shipped_knots()
    return knot_rows(
        NamedDiagram(knot.name, knot.diagram, "KnotInfo", knot) for knot in table.values()
    )


def folder_rows(
    folder: Path, read: Callable[[Path], NamedDiagram] = read_knot
) -> tuple[KnotRow, ...]:
    """The knots in a folder's `.json` and `.csv` files, by name.

    Parameters
    ----------
    folder : Path
    read : callable
        Reads one of the files.

    Raises
    ------
    FileFormatError
        There are none, or a file is no grid diagram of a knot; the message names it.
    """
    try:
        paths = sorted(path for path in folder.iterdir() if path.suffix.lower() in SUFFIXES)
    except OSError as error:
        raise FileFormatError(f"cannot read {folder}: {error.strerror}") from error
    if not paths:
        raise FileFormatError(f"{folder} has no grids: no file ends in {' or '.join(SUFFIXES)}")
    # The folder's place is no part of a run: it may be copied, and gone on with there.
    return knot_rows(
        NamedDiagram(path.name, read(path).diagram, f"file {path.name}") for path in paths
    )
