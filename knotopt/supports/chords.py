"""Crossings that move: where straight chords cross, exactly, and what that leaves of a region.

A moved crossing is c' = (X, Y) / D in integers. On random grids up to N = 60 squared distances are
exact up to one rounding, so that equal ones compare equal.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from knotopt.arrays import BoolArray, FloatArray, IntArray
from knotopt.supports.opening import cross, crossings_of_ray, squared_distance


@dataclass(frozen=True, eq=False)
class Chords:
    """Straight spans as they lie when the leader threads: start, end (S, 2).

    at_end (S,): whether the chord is a tether that ends where the strand crosses itself to enter.
    """

    start: IntArray
    end: IntArray
    at_end: BoolArray


@dataclass(frozen=True, eq=False)
class Moved:
    """Crossings c' = xy / d of chords of one list with chords of another; d > 0.

    meets: whether they cross; along: numerator of c's place on the first chord (over d).
    """

    xy: IntArray
    d: IntArray
    meets: BoolArray
    along: IntArray


def meet(first: Chords, second: Chords) -> Moved:
    """All crossings, shape (first, second): inside both chords, or at an end that counts."""
    a, u = first.start[:, None], (first.end - first.start)[:, None]
    c, v = second.start[None], (second.end - second.start)[None]
    d = cross(u, v)
    s, t = cross(c - a, v), cross(c - a, u)
    s, t, d = s * np.sign(d), t * np.sign(d), np.abs(d)
    meets = (d > 0) & (s > 0) & (t > 0)
    meets &= (s < d) | (first.at_end[:, None] & (s == d))
    meets &= (t < d) | (second.at_end[None] & (t == d))
    d = np.where(meets, d, 1)
    return Moved(a * d[..., None] + u * s[..., None], d, meets, s)


def ray_to(anchor: IntArray, moved: Moved, q: IntArray) -> IntArray:
    """Signed crossings of the segments anchor -> c' with the ray from q to the right."""
    d = moved.d[..., None]
    return crossings_of_ray(anchor * d, moved.xy, q * d)


def distance_to(anchor: IntArray, moved: Moved, q: IntArray) -> FloatArray:
    """Squared distances of q from the segments anchor - c', exact up to one rounding."""
    return squared_distance(q, anchor, moved.xy, moved.d)


def between(
    chords: Chords, moved0: Moved, moved1: Moved, q: IntArray
) -> tuple[IntArray, FloatArray]:
    """The edge from the second moved crossing to the first, both on one chord.

    Returns
    -------
    signed crossings with the ray from q to the right, and the squared distance of q from the
    chord's line where its nearest point lies between the crossings (else infinite: one of the
    crossings is nearest), both of shape (chord, first, second)
    """
    along, offset = chords.end - chords.start, q - chords.start
    side = cross(along, offset)
    length, dot = (along * along).sum(axis=1), (along * offset).sum(axis=1)
    # The ray meets the chord's line if q lies to the left of it, seen upward.
    hit = (side * np.sign(along[:, 1]) > 0).astype(np.int64)
    below0, below1 = (moved.xy[..., 1] <= q[1] * moved.d for moved in (moved0, moved1))
    turns = hit[:, None, None] * (below1[:, None].astype(np.int64) - below0[:, :, None])
    beyond0, beyond1 = (
        np.sign(moved.along * length[:, None] - dot[:, None] * moved.d)
        for moved in (moved0, moved1)
    )
    nearest_between = beyond0[:, :, None] * beyond1[:, None] < 0
    distance = side * side / np.maximum(length, 1)
    return turns, np.where(nearest_between, distance[:, None, None], np.inf)
