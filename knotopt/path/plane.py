"""Which way things turn in the plane."""

from __future__ import annotations

import numpy as np

from knotopt.arrays import FloatArray


def cross(a: FloatArray, b: FloatArray) -> FloatArray:
    """Cross products of vectors in the plane, shape (..., 2): above 0 if b is on the left of a."""
    return np.asarray(a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0])
