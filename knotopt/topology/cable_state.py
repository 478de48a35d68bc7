"""A cable as a rope: its ends p_1 ... p_2N are the rope's, in this order."""

from __future__ import annotations

import numpy as np

from knotopt.cable.cable import Cable
from knotopt.topology.state import RopeState


def cable_state(cable: Cable) -> RopeState:
    """The state of a cable: its grid diagram opened at the cut.

    Examples
    --------
    >>> from knotopt.diagram.families import torus_knot
    >>> print(cable_state(Cable(torus_knot(2, 3), "L+")))
    O1+ U2+ O3+ U1+ O2+ U3+
    """
    _, index, over = cable.visits
    visits = np.argsort(index, kind="stable").reshape(-1, 2)  # the two of each crossing
    partner = np.empty_like(index)
    partner[visits] = visits[:, ::-1]
    positive = cable.crossings.sign[index] > 0
    return RopeState(tuple((4 * partner + 2 * over + positive).tolist()))
