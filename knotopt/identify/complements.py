"""Hyperbolic complements of knots, compared by SnapPy (the `snappy` extra, GPL).

Knots with homeomorphic complements are the same (Gordon and Luecke, "Knots are determined by their
complements", doi:10.1090/S0894-0347-1989-0965210-7), up to mirror image unless orientation is
kept. SnapPy finds an isometry as an isomorphism of triangulations, which is combinatorial and so a
proof; that it finds none is not.
"""

from __future__ import annotations

import importlib.util
from typing import Any

from knotopt.errors import require_extra
from knotopt.planar.planar_diagram import PlanarDiagram

TRIES = 5  # triangulations of each complement


def is_installed() -> bool:
    """Whether the `snappy` extra is installed."""
    return importlib.util.find_spec("snappy") is not None


def require() -> None:
    """Raise MissingExtraError if it is not."""
    require_extra("snappy", "snappy", "a proof by isometry of complements")


def is_unknot(planar: PlanarDiagram) -> bool:
    """Whether knot Floer homology has rank 1, which it has for the unknot alone.

    Source: Ozsvath and Szabo, "Holomorphic disks and genus bounds", doi:10.2140/gt.2004.8.311.

    Examples
    --------
    >>> is_unknot(PlanarDiagram(((0, 4, 1, 3), (2, 0, 3, 5), (4, 2, 5, 1))))
    False
    """
    link = _link(planar)
    link.simplify("basic")  # kinks are refused
    return not link.crossings or link.knot_floer_homology()["total_rank"] == 1


def are_isometric(planar: PlanarDiagram, other: PlanarDiagram) -> bool:
    """Whether SnapPy finds an isometry of the complements that keeps the orientation.

    Examples
    --------
    >>> from knotopt.catalogue.knots import shipped_knots
    >>> from knotopt.planar.from_grid import planar_diagram
    >>> knot = planar_diagram(shipped_knots()["9_42"].diagram)
    >>> are_isometric(knot, knot), are_isometric(knot, knot.mirrored)
    (True, False)
    """
    first, second = _complement(planar), _complement(other)
    for _ in range(TRIES):
        try:
            isometries = first.is_isometric_to(second, return_isometries=True)
        except RuntimeError:  # no canonical triangulation was found; another one may have one
            isometries = []
        if isometries:
            return any(each.cusp_maps()[0].det() == 1 for each in isometries)
        first.randomize()
        second.randomize()
    return False


def _complement(planar: PlanarDiagram) -> Any:
    return _link(planar).exterior()


def _link(planar: PlanarDiagram) -> Any:
    import snappy

    return snappy.Link([list(crossing) for crossing in planar.crossings])
