"""Motions and texts made small enough to live inside a page.

A motion is resampled evenly in time, rounded to a few millimetres, and stored as differences
between frames, low bytes before high bytes, deflated, base64.
"""

from __future__ import annotations

import base64
import math
import zlib

import numpy as np

from knotopt.arrays import FloatArray
from knotopt.errors import RequirementError

FRAME = 0.2  # between frames [s]; at 1.5 m/s^2 a straight line in between is off by 8 mm at most
UNIT = 0.002  # positions are rounded to [m]
LARGEST = 32_000  # of the whole numbers that two bytes hold


def resampled(times: FloatArray, values: FloatArray, count: int) -> FloatArray:
    """Values at `count` even times from the first to the last, shape (count, ...)."""
    at = np.linspace(times[0], times[-1], count)
    place = np.interp(at, times, np.arange(len(times)))
    low = np.minimum(place.astype(np.int64), max(len(times) - 2, 0))
    high = np.minimum(low + 1, len(times) - 1)
    share = (place - low).reshape(-1, *[1] * (values.ndim - 1))
    found: FloatArray = values[low] + share * (values[high] - values[low])
    return found


def frame_count(times: FloatArray) -> int:
    """Number of frames that show a motion, at least 2."""
    return max(2, math.ceil(float(times[-1] - times[0]) / FRAME) + 1)


def packed_motion(values: FloatArray, what: str) -> dict[str, object]:
    """Positions over time for the page, which undoes this.

    Parameters
    ----------
    values : float array, shape (F, P, D) [m]
    what : str
        For the error.

    Raises
    ------
    RequirementError
        Some position is not a number, or not finite.
    """
    if not np.isfinite(values).all():
        raise RequirementError(f"{what} has positions that are not finite numbers")
    unit = max(UNIT, float(np.abs(values).max(initial=0.0)) / LARGEST)
    whole = np.rint(values / unit).astype(np.int16)
    steps = np.diff(whole.reshape(len(whole), -1), axis=0, prepend=np.int16(0)).astype("<u2")
    planes = np.concatenate(((steps & 255).ravel(), (steps >> 8).ravel())).astype(np.uint8)
    frames, points, axes = values.shape
    return {
        "frames": frames,
        "points": points,
        "axes": axes,
        "unit": unit,
        "bytes": _deflated(planes.tobytes()),
    }


def packed_text(text: str) -> str:
    """A text's UTF-8 bytes, deflated, base64."""
    return _deflated(text.encode())


def _deflated(data: bytes) -> str:
    return base64.b64encode(zlib.compress(data, 9)).decode("ascii")
