"""Solvers made warm: the time of an import belongs to no instance."""

from __future__ import annotations

from functools import cache

from formulations.backends import get_backend
from formulations.instance import Instance, Row
from formulations.solution import Limits


@cache
def warm_up(solver: str) -> None:
    """Import a solver and solve something with it, once a process."""
    tiny = Instance("tiny", ("a", "b"), 2, (1, 1), (Row((1, 2), 1, "cover", "ab"),))
    get_backend(solver).solve(tiny, Limits())
