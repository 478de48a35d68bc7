"""The path program: the shortest, smoothest curve that keeps a plane diagram and its crossings.

Plane vertices move; a chain of them is the curve, and at a crossing two places of the chain share a
vertex. Four families of constraints, each in its own block below:

    same diagram   every triangle keeps a positive area. A map that is linear on every triangle,
                   keeps them all positive and the outer frame fixed is a homeomorphism of the
                   plane, so the curve keeps its crossings and their order.
    clearance      vertices stay away from the segments of other strands, and strands leave a
                   crossing, or a held vertex, at an angle.
    opening        certain vertices stay away from certain segments.
    heights        over minus under at least the gap at every crossing; slope, floor and ceiling.

Minimised are the length of the curve in space, its bending, and how unevenly vertices are spaced.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from formulations.arrays import BoolArray, FloatArray, IntArray


class ProgramError(ValueError):
    """Numbers that make no path program."""


@dataclass(frozen=True)
class Bounds:
    """What the constraints ask for [length units of the positions; heights too].

    `angle` is the smallest angle at which strands leave a crossing or a held vertex [rad].
    """

    clearance: float
    angle: float
    opening: float
    gap: float
    slope: float
    floor: float
    ceiling: float


@dataclass(frozen=True)
class Weights:
    """What is minimised besides the length.

    `bending` [length] weighs the integral of the squared curvature. `spacing` keeps the lengths of
    neighbouring segments in proportion, and `stiffness` all lengths near nominal, the more the
    shorter they are; where every length is nominal neither costs anything.
    """

    bending: float
    spacing: float
    stiffness: float


@dataclass(frozen=True, eq=False)
class PathProgram:
    """A path program: numbers only.

    Attributes
    ----------
    positions : float array, shape (V, 2); held : bool array, shape (V,)
        Where every vertex is at the start, and whether it must stay there.
    chain : int array, shape (m,)
        The curve's vertices in order.
    heights : float array, shape (m,); held_heights : bool array, shape (m,)
        Height of each place of the chain at the start, and whether it must stay.
    spacing : float array, shape (m - 1,)
        Nominal length of each segment, which scales the bending.
    triangles : int array, shape (T, 3), counterclockwise
    strand_pairs, opening_pairs : int array, shape (K, 3)
        A vertex and the two ends of a segment that it stays away from.
    strand_distances : float array, shape (K,)
        How far, for each of the strand pairs.
    corners : int array, shape (A, 3)
        A vertex and two neighbours, the second counterclockwise of the first.
    turns : int array, shape (B, 3)
        A vertex and its two neighbours on the chain, on whichever side.
    arcs : int array, shape (E, 2)
        Vertices, such as crossings that follow each other, that stay apart as strands do.
    crossings : int array, shape (C, 2)
        Places of the chain that pass over and under.
    steep : int array, shape (S,)
        Segments of the chain whose slope is bounded.
    bounds : Bounds
    weights : Weights
    reach : float
        How far a coordinate may move from its start; inf by default.

    Raises
    ------
    ProgramError
        An entry that is not finite, or two neighbours on the chain at the same point.
    """

    positions: FloatArray
    held: BoolArray
    chain: IntArray
    heights: FloatArray
    held_heights: BoolArray
    spacing: FloatArray
    triangles: IntArray
    strand_pairs: IntArray
    strand_distances: FloatArray
    opening_pairs: IntArray
    corners: IntArray
    turns: IntArray
    arcs: IntArray
    crossings: IntArray
    steep: IntArray
    bounds: Bounds
    weights: Weights
    reach: float = math.inf

    def __post_init__(self) -> None:
        for name in ("positions", "heights", "spacing"):
            bad = np.argwhere(~np.isfinite(getattr(self, name)))
            if len(bad):
                raise ProgramError(f"{name}: entry {bad[0].tolist()} is not a finite number")
        steps = np.diff(self.positions[self.chain], axis=0)
        equal = np.flatnonzero(~steps.any(axis=1))
        if len(equal):
            raise ProgramError(f"places {equal[0]} and {equal[0] + 1} of the chain coincide")

    @cached_property
    def doubled_areas(self) -> FloatArray:
        """Twice the signed area of every triangle at the start, shape (T,)."""
        return doubled_areas(self.positions, self.triangles)


def doubled_areas(positions: FloatArray, triangles: IntArray) -> FloatArray:
    """Twice the signed area of each triangle."""
    a, b, c = (positions[triangles[:, k]] for k in range(3))
    areas: FloatArray = (b[:, 0] - a[:, 0]) * (c[:, 1] - a[:, 1])
    areas -= (b[:, 1] - a[:, 1]) * (c[:, 0] - a[:, 0])
    return areas
