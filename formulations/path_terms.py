"""The terms of the path program: its objective and, block by block, its constraints."""

from __future__ import annotations

import math

import casadi as ca
import numpy as np

from formulations.arrays import FloatArray, IntArray
from formulations.elements import Element, Terms
from formulations.path import PathProgram

SMOOTHING = 1e-4  # a segment of length zero has length SMOOTHING, so that it has a derivative
SAFE_AREA = 1e-3  # twice the smallest area of a triangle, unless it starts out smaller
SHRINK = 0.1  # to which share a triangle smaller than that may shrink


class Layout:
    """Where each coordinate stands among the variables: free ones first, then fixed ones."""

    def __init__(self, program: PathProgram) -> None:
        self.vertices = len(program.positions)
        self.start = np.concatenate((program.positions.ravel(), program.heights))
        self.is_fixed = np.concatenate((np.repeat(program.held, 2), program.held_heights))
        self.fixed = int(self.is_fixed.sum())
        self.free = len(self.start) - self.fixed
        self._number = np.empty(len(self.start), dtype=np.int64)
        self._number[~self.is_fixed] = np.arange(self.free)
        self._number[self.is_fixed] = self.free + np.arange(self.fixed)

    def plane(self, vertices: IntArray) -> IntArray:
        """Numbers of the coordinates of vertices: shape (T, k) to (T, 2k)."""
        both = np.stack((2 * vertices, 2 * vertices + 1), axis=-1)
        return self._number[both.reshape(len(vertices), 2 * vertices.shape[1])]

    def space(self, chain: IntArray, places: IntArray) -> IntArray:
        """Numbers of x, y, z of places on the chain: shape (T, k) to (T, 3k)."""
        vertices = chain[places]
        three = (2 * vertices, 2 * vertices + 1, 2 * self.vertices + places)
        return self._number[np.stack(three, axis=-1).reshape(len(places), 3 * places.shape[1])]

    def height(self, places: IntArray) -> IntArray:
        """Numbers of the heights of places on the chain, same shape."""
        return self._number[2 * self.vertices + places]

    def values(self, x: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Positions and heights for values of the free variables."""
        full = self.start.copy()
        full[~self.is_fixed] = x
        return full[: 2 * self.vertices].reshape(-1, 2), full[2 * self.vertices :]


Objective = list[tuple[Terms, FloatArray]]  # terms and their parameters
Constraint = tuple[str, Terms, FloatArray, FloatArray]  # family, terms, parameters, lower bounds


def objective_terms(program: PathProgram, layout: Layout) -> Objective:
    places = np.arange(len(program.chain))
    segments = np.stack((places[:-1], places[1:]), axis=1)
    triples = np.stack((places[:-2], places[1:-1], places[2:]), axis=1)
    before, after = program.spacing[:-1], program.spacing[1:]
    weights = program.weights
    scales = np.stack(
        (
            2 * weights.bending / (before + after),
            weights.spacing * (before + after) / 2,
            before,
            after,
            np.full_like(before, weights.stiffness),
        ),
        axis=1,
    )
    return [
        (Terms(LENGTH, layout.space(program.chain, segments)), np.empty(0)),
        (Terms(BENDING, layout.space(program.chain, triples)), scales),
    ]


def constraint_terms(program: PathProgram, layout: Layout) -> list[Constraint]:
    bounds = program.bounds
    steep = np.stack((program.steep, program.steep + 1), axis=1)
    safe_areas = np.minimum(SAFE_AREA, SHRINK * program.doubled_areas)
    clearances = program.strand_distances**2
    families: list[tuple[str, Element, IntArray, float, FloatArray | float]] = [
        # same diagram: every triangle keeps a positive area
        ("diagram", AREA, layout.plane(program.triangles), 0.0, safe_areas),
        # clearance: strands stay apart, and leave crossings and robots at an angle
        ("clearance", DISTANCE, layout.plane(program.strand_pairs), 0.0, clearances),
        ("angle", CORNER, layout.plane(program.corners), math.tan(bounds.angle), 0.0),
        ("spread", SPREAD, layout.plane(program.arcs), 0.0, bounds.clearance**2),
        ("turn", TURN, layout.plane(program.turns), math.cos(bounds.angle), 0.0),
        # opening: threading vertices stay away from the segments of the regions they thread
        ("opening", DISTANCE, layout.plane(program.opening_pairs), 0.0, bounds.opening**2),
        # heights: over above under at crossings, and no steeper than the slope
        ("gap", DIFFERENCE, layout.height(program.crossings), 0.0, bounds.gap),
        ("slope", SLOPE, layout.space(program.chain, steep), bounds.slope**2, 0.0),
    ]
    found = []
    for family, element, variables, parameter, bound in families:
        terms = Terms(element, variables)
        if len(variables):
            numbers = np.full(len(variables) * element.parameters, parameter)
            found.append((family, terms, numbers, np.broadcast_to(bound, len(variables))))
    return found


def _length(u: ca.SX, _: ca.SX) -> ca.SX:
    return ca.sqrt(ca.sumsqr(u[3:] - u[:3]) + SMOOTHING**2)


def _bending(u: ca.SX, w: ca.SX) -> ca.SX:
    first, second = (u[3:6] - u[:3]) / w[2], (u[6:] - u[3:6]) / w[3]
    before = ca.sqrt(ca.sumsqr(first) + SMOOTHING**2)
    after = ca.sqrt(ca.sumsqr(second) + SMOOTHING**2)
    # Nominal lengths scale the bending, so segments that shrink could turn at no cost: vertices
    # would gather in a corner. The last two terms keep lengths near nominal, and in proportion.
    bend = ca.sumsqr(second - first)
    return (
        w[0] * (bend + w[4] * ((before - 1) ** 2 + (after - 1) ** 2)) + w[1] * (after - before) ** 2
    )


def _area(u: ca.SX, _: ca.SX) -> ca.SX:
    p, q = u[2:4] - u[:2], u[4:] - u[:2]
    return p[0] * q[1] - p[1] * q[0]


def _squared_distance(u: ca.SX, _: ca.SX) -> ca.SX:
    along = u[4:] - u[2:4]
    share = ca.dot(u[:2] - u[2:4], along) / (ca.sumsqr(along) + SMOOTHING**2)
    share = ca.fmin(1, ca.fmax(0, share))
    return ca.sumsqr(u[:2] - u[2:4] - share * along)


def _spread(u: ca.SX, _: ca.SX) -> ca.SX:
    return ca.sumsqr(u[2:] - u[:2])


def _corner(u: ca.SX, w: ca.SX) -> ca.SX:
    p, q = u[2:4] - u[:2], u[4:] - u[:2]
    return p[0] * q[1] - p[1] * q[0] - w[0] * ca.dot(p, q)


def _turn(u: ca.SX, w: ca.SX) -> ca.SX:
    p, q = u[2:4] - u[:2], u[4:] - u[:2]
    return w[0] * ca.sqrt(ca.sumsqr(p) * ca.sumsqr(q) + SMOOTHING**4) - ca.dot(p, q)


def _difference(u: ca.SX, _: ca.SX) -> ca.SX:
    return u[0] - u[1]


def _slope(u: ca.SX, w: ca.SX) -> ca.SX:
    step = u[3:] - u[:3]
    return w[0] * ca.sumsqr(step[:2]) - step[2] ** 2


LENGTH = Element("length", 6, 0, _length)
BENDING = Element("bending", 9, 5, _bending)
AREA = Element("area", 6, 0, _area)
DISTANCE = Element("distance", 6, 0, _squared_distance)
SPREAD = Element("spread", 4, 0, _spread)
CORNER = Element("corner", 6, 1, _corner)
TURN = Element("turn", 6, 1, _turn)
DIFFERENCE = Element("difference", 2, 0, _difference)
SLOPE = Element("slope", 6, 1, _slope)
