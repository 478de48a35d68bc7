"""States of polylines, by the package and by the independent checker's crossings."""

from __future__ import annotations

from typing import Any

import numpy as np

from knotopt.arrays import FloatArray
from knotopt.topology.extract import extract_state
from knotopt.topology.state import RopeState
from knotopt.verify.crossings import curve_crossings

Points = FloatArray


def state_of(points: Any, **tolerances: float) -> RopeState:
    found = extract_state(points, **tolerances)
    assert found.state is not None, [str(ambiguity) for ambiguity in found.ambiguous]
    return found.state


def by_verifier(points: Points) -> RopeState:
    """The state by the crossings that the verifier finds, for points in general position."""
    visits, signs = curve_crossings(np.asarray(points, dtype=float)).code
    met: dict[int, list[int]] = {}
    for visit, (crossing, _) in enumerate(visits):
        met.setdefault(crossing, []).append(visit)
    return RopeState(
        tuple(
            4 * (sum(met[crossing]) - visit) + 2 * over + (signs[crossing] > 0)
            for visit, (crossing, over) in enumerate(visits)
        )
    )
