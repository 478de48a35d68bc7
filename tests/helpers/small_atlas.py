"""A small atlas: its list of knots, its settings, and an engine that gives results at hand."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from pathlib import Path
from typing import Any

from knotopt.atlas.knot_list import knot_rows
from knotopt.atlas.measure import KnotResult
from knotopt.atlas.schema import Settings
from knotopt.reading.knot import read_knot

LIST = knot_rows(map(read_knot, ("3_1", "4_1", "5_1", "5_2", "T(2,7)")))
SETTINGS = Settings(check=1)


class Replay:
    """Gives results at hand, last first; fails before the one numbered `fails_at`."""

    def __init__(
        self,
        results: dict[int, KnotResult],
        fails_at: int = 0,
        error: BaseException | None = None,
    ) -> None:
        self.results, self.fails_at, self.error = results, fails_at, error
        self.asked: list[int] = []

    def map(self, function: Callable[[Any], Any], items: Iterable[Any]) -> Iterator[Any]:
        assert function is not None
        for item in reversed(list(items)):
            if item.number == self.fails_at and self.error is not None:
                raise self.error
            self.asked.append(item.number)
            yield self.results[item.number]


def contents(folder: Path) -> dict[str, bytes]:
    return {
        str(path.relative_to(folder)): path.read_bytes()
        for path in folder.rglob("*")
        if path.is_file()
    }
