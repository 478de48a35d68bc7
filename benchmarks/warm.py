"""The path program made warm: the time of an import belongs to no path."""

from __future__ import annotations

from functools import cache


@cache
def warm_paths() -> None:
    """Import CasADi, differentiate the elements and solve a path, once a process."""
    from knotopt.path.measures import both_methods
    from knotopt.reading.knot import read_knot
    from knotopt.supports.lcf import best_cut

    both_methods(best_cut(read_knot("3").diagram))
