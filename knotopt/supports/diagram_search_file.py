"""A search over diagrams as JSON, to go on from."""

from __future__ import annotations

from typing import Any

from knotopt.diagram.grid import GridDiagram
from knotopt.search.found import FoundGrid
from knotopt.search.run import Run
from knotopt.search.search import GridSearch
from knotopt.supports.diagram_search import Walk

Known = tuple[GridSearch, Walk | None]


def to_json(grids: GridSearch, walk: Walk | None) -> dict[str, Any]:
    """What `from_json` makes the same of."""
    return {
        "given": _rows(grids.diagram),
        "seed": grids.seed,
        "runs": [
            {
                "looked": each.looked,
                "found": [[f.robots, f.crossings, _rows(f.diagram)] for f in each.found],
            }
            for each in grids.runs
        ],
        "walk": None
        if walk is None
        else vars(walk) | {"here": _rows(walk.here), "best": _rows(walk.best)},
    }


def from_json(content: dict[str, Any]) -> Known:
    """The inverse of `to_json`.

    Raises
    ------
    KeyError, TypeError, ValueError
        The content is damaged.
    """
    runs = tuple(
        Run(
            number,
            each["looked"],
            tuple(FoundGrid(robots, count, _grid(rows)) for robots, count, rows in each["found"]),
        )
        for number, each in enumerate(content["runs"])
    )
    walk = content["walk"]
    if walk is not None:
        walk = Walk(**walk | {"here": _grid(walk["here"]), "best": _grid(walk["best"])})
    return GridSearch(_grid(content["given"]), content["seed"], runs), walk


def _rows(diagram: GridDiagram) -> list[list[int]]:
    return [list(diagram.minus), list(diagram.plus)]


def _grid(rows: list[list[int]]) -> GridDiagram:
    minus, plus = rows
    return GridDiagram(tuple(minus), tuple(plus))
