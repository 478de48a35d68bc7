"""Crossing-height arcs: how a path of given plan rises over and dips under its crossings."""

from __future__ import annotations

import numpy as np
from scipy.interpolate import PchipInterpolator

from knotopt.arrays import FloatArray, IntArray


def height_arcs(
    along: FloatArray, robots: IntArray, over: IntArray, under: IntArray, gap: float
) -> FloatArray:
    """Heights that are half the gap above and below at crossings and 0 at robots.

    Between those places the height goes monotonically, by piecewise cubic Hermite interpolation
    (Fritsch and Carlson, doi:10.1137/0717021), so that it is flat at each rise and dip.

    Parameters
    ----------
    along : float array, shape (m,), increasing
        Length along the path at each place [grid steps].
    robots, over, under : int arrays
        Places of robots, and of the upper and lower visit of each crossing.
    gap : float
        Vertical distance at crossings [grid steps].

    Returns
    -------
    float array, shape (m,)

    Examples
    --------
    >>> along = np.arange(5.0)
    >>> height_arcs(along, np.array([0, 4]), np.array([1]), np.array([3]), 0.5).tolist()
    [0.0, 0.25, 0.0, -0.25, 0.0]
    """
    places = np.concatenate((robots, over, under))
    values = np.repeat([0.0, gap / 2, -gap / 2], [len(robots), len(over), len(under)])
    order = np.argsort(places)
    heights: FloatArray = PchipInterpolator(along[places[order]], values[order])(along)
    return heights
