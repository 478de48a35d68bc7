"""Cable that is laid: as it lies, or as it hangs between two hovering robots by the model.

The model is straight in plan and a catenary in height.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import shapely
from scipy.optimize import brentq

from knotopt.arrays import FloatArray
from knotopt.flight.gates import Gate
from knotopt.path.curve import length_along

THIN = 0.02  # detail of laid cable that is left out in plan [grid steps]


@dataclass(frozen=True)
class LaidCable:
    """Cable that is laid already.

    Attributes
    ----------
    spans : sequence of float arrays, shape (m, 3)
        Spans 1, 2, ... from robot to robot [grid steps]; heights are above the robots'.
    """

    spans: Sequence[FloatArray]

    @property
    def in_plan(self) -> list[FloatArray]:
        """The spans seen from above, without what is too fine, shapes (m, 2)."""
        lines = [shapely.LineString(points[:, :2]).simplify(THIN) for points in self.spans]
        return [np.array(line.coords) for line in lines]

    def height(self, gate: Gate) -> float:
        """Height of the older cable in a gate."""
        span = self.spans[gate.letter.older - 1]
        return float(np.interp(gate.along, length_along(span[:, :2]), span[:, 2]))


def hanging_cable(start: FloatArray, end: FloatArray, length: float, count: int) -> FloatArray:
    """A cable of a given length between two points, evenly spaced along it.

    Parameters
    ----------
    start, end : float arrays, shape (3,)
    length : float
        If it is no longer than the distance, the cable is straight.
    count : int
        Number of points, at least 2.

    Returns
    -------
    float array, shape (count, 3)

    Examples
    --------
    >>> import numpy as np
    >>> cable = hanging_cable(np.zeros(3), np.array([1.0, 0, 0]), 1.1, 3)
    >>> cable.round(3).tolist()
    [[0.0, 0.0, 0.0], [0.5, 0.0, -0.2], [1.0, 0.0, 0.0]]
    """
    share = np.linspace(0, 1, count)
    across = float(np.hypot(*(end - start)[:2]))
    rise = float(end[2] - start[2])
    spare = math.sqrt(max(length**2 - rise**2, 0.0))
    if length <= math.hypot(across, rise) * (1 + 1e-9):
        return start + share[:, None] * (end - start)
    if across < 1e-3 * length:  # two strands beside each other
        down = share * length
        turn = (length - rise) / 2
        height = np.where(down < turn, -down, down - 2 * turn)
        flat = start[:2] + share[:, None] * (end - start)[:2]
        return np.column_stack((flat, start[2] + height))
    # z = c cosh((x - x0) / c): sqrt(L^2 - rise^2) = 2 c sinh(u) with u = across / (2 c).
    ratio = spare / across
    u = brentq(lambda u: math.sinh(u) / u - ratio, 1e-6, 20 + math.log(ratio))
    c = across / (2 * u)
    middle = across / 2 - c * math.asinh(rise / (2 * c * math.sinh(u)))
    along = c * math.sinh(-middle / c) + share * length
    x = middle + c * np.arcsinh(along / c)
    z = np.hypot(along, c)
    flat = start[:2] + (x / across)[:, None] * (end - start)[:2]
    return np.column_stack((flat, start[2] + z - z[0]))
