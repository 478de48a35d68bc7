"""Results of the benchmarks as they are kept, and what is common to all that is made of them."""

from __future__ import annotations

import json
from collections import defaultdict
from collections.abc import Iterable
from pathlib import Path
from typing import Any

RESULTS = Path(__file__).parent / "results"
SPEED_AT = 11  # grid size of a typical 9-crossing knot
SMALL = 11  # paths on grids up to this size are those of which a time is asked
FAMILIES = {"random": ("o", "#0072B2"), "T(p,p+1)": ("s", "#D55E00"), "T(2,N-2)": ("^", "#009E73")}
"""Family of grid diagrams to its marker and colour."""

Row = dict[str, Any]


def load(name: str) -> tuple[Row, list[Row]]:
    """Header and records of a benchmark; each record is its case and result in one.

    Raises
    ------
    FileNotFoundError
        It has not been run.
    """
    header, *records = (RESULTS / f"{name}.jsonl").read_text(encoding="utf-8").splitlines()
    rows = [json.loads(record) for record in records]
    return json.loads(header), [{**row["case"], **row["result"]} for row in rows]


def grouped(rows: Iterable[Row], *keys: str) -> dict[Any, list[Row]]:
    """Records by the value of a key, or by the values of several, in the order first met."""
    groups: dict[Any, list[Row]] = defaultdict(list)
    for row in rows:
        values = tuple(row[key] for key in keys)
        groups[values if len(keys) > 1 else values[0]].append(row)
    return dict(groups)
