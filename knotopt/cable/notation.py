"""Gauss, PD and DT codes of the closed-up cable, as other knot software reads them.

The cable closes along its crossing-free cut, so the closed knot has exactly the cable's crossings.
Edges and labels are numbered along the path from p_1.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from knotopt.cable.cable import Cable


def gauss_code(cable: Cable) -> tuple[int, ...]:
    """Signed Gauss code, length 2C: +k for the over and -k for the under visit of crossing k.

    Crossings are numbered from 1 in the order of their first visits.

    Examples
    --------
    >>> from knotopt.diagram.families import torus_knot
    >>> gauss_code(Cable(torus_knot(2, 3), "L+"))
    (1, -2, 3, -1, 2, -3)
    """
    _, index, over = cable.visits
    return tuple(
        crossing + 1 if is_over else -crossing - 1
        for crossing, is_over in zip(index.tolist(), over.tolist(), strict=True)
    )


def pd_code(cable: Cable) -> tuple[tuple[int, int, int, int], ...]:
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
    _, index, over = cable.visits
    return pd_from_gauss(index.tolist(), over.tolist(), cable.crossings.sign.tolist())


def pd_from_gauss(
    visits: Sequence[int], over: Sequence[bool], signs: Sequence[int]
) -> tuple[tuple[int, int, int, int], ...]:
    """Planar diagram code of a closed curve from its Gauss code.

    Parameters
    ----------
    visits : sequence of int, length 2C
        Index (from 0) of the crossing at each visit.
    over : sequence of bool, length 2C
        Whether the visit passes over.
    signs : sequence of +1 or -1, length C
        Sign of each crossing.
    """
    edges = len(visits)
    places = [[0, 0] for _ in signs]  # [under, over] incoming edge
    for edge, (crossing, is_over) in enumerate(zip(visits, over, strict=True), 1):
        places[crossing][is_over] = edge
    code = []
    for (under, incoming), sign in zip(places, signs, strict=True):
        outgoing = incoming % edges + 1
        right, left = (outgoing, incoming) if sign > 0 else (incoming, outgoing)
        code.append((under, right, under % edges + 1, left))
    return tuple(code)


def dt_code(cable: Cable) -> tuple[int, ...]:
    """Dowker-Thistlethwaite code: the even label paired with 1, 3, 5, ...; negative if it is over.

    The code does not tell a knot from its mirror image.

    Examples
    --------
    >>> from knotopt.diagram.families import torus_knot
    >>> dt_code(Cable(torus_knot(2, 3), "L+"))
    (4, 6, 2)
    """
    _, index, over = cable.visits
    pairs = np.argsort(index, kind="stable").reshape(-1, 2) + 1  # of labels, one odd, one even
    odd, even = np.where(pairs[:, :1] % 2 == 1, pairs, pairs[:, ::-1]).T
    signed = np.where(over[even - 1], -even, even)
    return tuple(signed[np.argsort(odd)].tolist())
