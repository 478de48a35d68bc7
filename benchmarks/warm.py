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


@cache
def warm_paths() -> None:
    """Import CasADi, differentiate the elements and solve a path, once a process."""
    from knotopt.catalogue.lookup import find_knot
    from knotopt.path.measures import both_methods
    from knotopt.supports.lcf import best_cut

    both_methods(best_cut(find_knot("3").diagram))
