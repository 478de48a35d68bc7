"""Gauss, PD and DT codes of the closed-up cable, as other knot software reads them.

The cable closes along its crossing-free cut, so the closed knot has exactly the cable's crossings.
Edges and labels are numbered along the path from p_1.
"""

from __future__ import annotations

from knotopt.cable.cable import Cable
from knotopt.planar import dt, gauss
from knotopt.planar.planar_diagram import Crossing, PlanarDiagram


def closed_diagram(cable: Cable) -> PlanarDiagram:
    """The planar diagram of the closed-up cable, crossings in the order of their first visits."""
    _, index, over = cable.visits
    return gauss.from_visits(index.tolist(), over.tolist(), cable.crossings.sign.tolist())


def gauss_code(cable: Cable) -> tuple[int, ...]:
    """Gauss code, length 2C: +k for the over and -k for the under visit of crossing k.

    Crossings are numbered from 1 in the order of their first visits.

    Examples
    --------
    >>> from knotopt.diagram.families import torus_knot
    >>> gauss_code(Cable(torus_knot(2, 3), "L+"))
    (1, -2, 3, -1, 2, -3)
    """
    return gauss.gauss_code(closed_diagram(cable))


def pd_code(cable: Cable) -> tuple[Crossing, ...]:
    """Planar diagram code: at each crossing its four edges, counterclockwise from the incoming
    under edge. Edges are numbered 1 ... 2C.

    The same convention as KnotTheory, KnotInfo and Spherogram. A cable without crossings has the
    empty code.

    Examples
    --------
    >>> from knotopt.diagram.families import torus_knot
    >>> pd_code(Cable(torus_knot(2, 3), "L+"))
    ((4, 2, 5, 1), (2, 6, 3, 5), (6, 4, 1, 3))
    """
    return closed_diagram(cable).pd_code


def dt_code(cable: Cable) -> tuple[int, ...]:
    """Dowker-Thistlethwaite code: the even label paired with 1, 3, 5, ...; negative if it is over.

    The code does not tell a knot from its mirror image.

    Examples
    --------
    >>> from knotopt.diagram.families import torus_knot
    >>> dt_code(Cable(torus_knot(2, 3), "L+"))
    (4, 6, 2)
    """
    return dt.dt_code(closed_diagram(cable))
