"""KnotInfo's table by the `knotinfo` extra: 12,965 prime knots up to 13 crossings.

The package `database_knotinfo` holds 100 MB of CSV that takes seconds to parse; what knotopt needs
of it is parsed once and kept in the user's cache folder.
"""

from __future__ import annotations

import importlib.metadata
import importlib.util
import json
import re
import warnings
from functools import cache

import platformdirs

from knotopt.catalogue.knots import KnotTable, PrimeKnot
from knotopt.diagram.grid import Mark
from knotopt.errors import OutputError, require_extra
from knotopt.files import write_atomically

_PACKAGE = "database_knotinfo"
_CACHE_FORMAT = 2
SHIPPED_CROSSINGS = 10
"""Knots up to this crossing number ship with knotopt itself."""
LARGEST_CROSSINGS = 13
"""Crossing number at which KnotInfo's table ends."""
LARGEST_KNOTS = {
    "11a": 367,
    "11n": 185,
    "11": 552,  # in Conway's list
    "12a": 1288,
    "12n": 888,
    "13a": 4878,
    "13n": 5110,
}
"""How many knots of more crossings KnotInfo has: names end at these numbers."""


def is_installed() -> bool:
    """Whether the `knotinfo` extra is installed."""
    return importlib.util.find_spec(_PACKAGE) is not None


@cache
def knotinfo_knots() -> KnotTable:
    """All 12,965 prime knots of KnotInfo that have a grid, by name, in its order.

    Raises
    ------
    MissingExtraError
        The `knotinfo` extra is not installed.
    """
    require_extra(_PACKAGE, "knotinfo", "the table of knots above 10 crossings")
    version = importlib.metadata.version(_PACKAGE)
    path = platformdirs.user_cache_path("knotopt") / f"knotinfo-{version}-{_CACHE_FORMAT}.json"
    try:
        knots = [PrimeKnot.from_json(entry) for entry in json.loads(path.read_text("utf-8"))]
    except (OSError, ValueError, KeyError, TypeError):  # not there yet, or damaged: parse again
        knots = _parse()
        try:
            write_atomically(path, to_json_lines(knots))
        except OutputError as error:
            warnings.warn(f"KnotInfo's table is not cached: {error}", stacklevel=2)
    return KnotTable((knot.name, knot) for knot in knots)


def to_json_lines(knots: list[PrimeKnot]) -> str:
    """A JSON list with one knot to a line."""
    return "[\n" + ",\n".join(json.dumps(knot.to_json()) for knot in knots) + "\n]\n"


def _parse() -> list[PrimeKnot]:
    from database_knotinfo import link_list

    _, *rows = link_list()  # first the column names
    return [
        PrimeKnot(
            name=row["name"],
            crossing_number=int(row["crossing_number"]),
            arc_index=int(row["arc_index"]),
            alternating=row["alternating"] == "Y",
            determinant=int(row["determinant"]),
            signature=int(row["signature"]),
            alexander=_coefficients(row["alexander_polynomial"]),
            marks=_rows_reversed(json.loads(row["grid_notation"])),
            other_names=tuple(
                row[column]
                for column in ("dt_name", "classical_conway_name")
                if row[column] not in ("", row["name"])
            ),
            symmetry=row["symmetry_type"].strip(),
        )
        for row in rows
        if row["grid_notation"]  # 0_1 has none
    ]


def _rows_reversed(marks: list[list[int]]) -> tuple[Mark, ...]:
    """KnotInfo's marks in knotopt's convention: with columns over rows, y up, same chirality."""
    size = len(marks) // 2
    return tuple(sorted((column, size + 1 - row) for column, row in marks))


def _coefficients(polynomial: str) -> tuple[int, ...]:
    """Coefficients of a polynomial in t such as '-7+ 34*t-53*t^2', leading one made positive."""
    powers: dict[int, int] = {}
    for sign, factor, power in re.findall(
        r"([+-]?)(\d*)\*?(t(?:\^\(?\d+\)?)?)?", re.sub(r"\s", "", polynomial)
    ):
        if not factor and not power:
            continue
        exponent = int(re.sub(r"\D", "", power) or 1) if power else 0
        powers[exponent] = int(sign + (factor or "1"))
    coefficients = [powers.get(k, 0) for k in range(min(powers), max(powers) + 1)]
    return tuple(c if coefficients[-1] > 0 else -c for c in coefficients)
