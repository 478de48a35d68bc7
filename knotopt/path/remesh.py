"""Fewer vertices where the path is straight, more where it bends, without changing the diagram.

A vertex may go only if the triangle it forms with its two neighbours holds no other vertex: then no
strand passes through that triangle, and pulling the path straight across it is an isotopy. A vertex
put in the middle of a segment moves nothing.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from knotopt.arrays import BoolArray, FloatArray, IntArray
from knotopt.path.mesh import FRAME, Mesh
from knotopt.path.plane import cross

STRAIGHT = np.radians(20)  # a vertex that turns less may go
SHARP = np.radians(35)  # segments beside a vertex that turns more are halved
HALVINGS = 2  # of such segments at a time
LONGEST, SHORTEST = 1.6, 0.75  # of a segment, and of one left by a vertex that goes, times spacing


def remesh(mesh: Mesh, protected: IntArray, spacing: float, finest: float) -> Mesh:
    """The same path with segments of about the given length.

    Parameters
    ----------
    mesh : Mesh
    protected : int array
        Times of places that must stay, besides robots and crossings.
    spacing : float
        Wanted length of segments where the path is nearly straight [grid steps].
    finest : float
        Segments are not made shorter than this where it bends.
    """
    mesh = _coarsen(mesh, protected, spacing, finest)
    for _ in range(HALVINGS):
        turns = turning(mesh.plan)
        sharp = np.maximum(turns[:-1], turns[1:]) > SHARP
        mesh = _halved(mesh, sharp & (mesh.lengths > 2 * finest))
    while (long := mesh.lengths > LONGEST * spacing).any():
        mesh = _halved(mesh, long)
    return mesh


def turning(plan: FloatArray) -> FloatArray:
    """By how much the path turns at each place [rad], 0 at its ends, shape (m,)."""
    step = np.diff(plan, axis=0)
    ahead, behind = step[1:], step[:-1]
    turns = np.abs(np.arctan2(cross(behind, ahead), (behind * ahead).sum(axis=1)))
    return np.pad(turns, 1)


def _coarsen(mesh: Mesh, protected: IntArray, spacing: float, finest: float) -> Mesh:
    free = np.ones(len(mesh.chain), dtype=bool)
    free[mesh.joints] = False
    free[mesh.places(protected)] = False
    # An arc keeps a vertex of its own, or two strands could fall on one segment; one from a
    # crossing back to itself keeps two.
    for start, end in zip(mesh.joints[:-1], mesh.joints[1:], strict=True):
        least = 2 if mesh.chain[start] == mesh.chain[end] else 1
        inside = np.arange(start + 1, end)
        spare = int(free[start:end].sum()) - max(0, least - int((~free[inside]).sum()))
        free[inside[free[inside]][max(0, spare) :]] = False
    merged = np.full(len(mesh.chain), np.inf)
    merged[1:-1] = mesh.lengths[:-1] + mesh.lengths[1:]
    turns = turning(mesh.plan)
    wanted = free & (
        ((turns < STRAIGHT) & (merged < SHORTEST * 2 * spacing)) | (merged < 1.5 * finest)
    )
    gone = _every_other(wanted)
    gone[gone] = _empty_triangles(mesh, np.flatnonzero(gone))
    return _without(mesh, gone)


def _every_other(wanted: BoolArray) -> BoolArray:
    """Of each run of places the first, third, ...: no two neighbours."""
    place = np.arange(len(wanted))
    start = np.maximum.accumulate(np.where(wanted, -1, place))  # the last place before the run
    chosen: BoolArray = wanted & ((place - start) % 2 == 1)
    return chosen


def _empty_triangles(mesh: Mesh, places: IntArray) -> BoolArray:
    """Whether no vertex lies in or on the triangle of each place with its neighbours."""
    empty = np.ones(len(places), dtype=bool)
    vertices = mesh.positions[:-FRAME]
    for k, place in enumerate(places):
        corners = mesh.plan[place - 1 : place + 2]
        near = np.flatnonzero(
            (vertices >= corners.min(axis=0)).all(axis=1)
            & (vertices <= corners.max(axis=0)).all(axis=1)
        )
        near = near[~np.isin(near, mesh.chain[place - 1 : place + 2])]
        if len(near):
            along = np.roll(corners, -1, axis=0) - corners
            sides = cross(along[:, None], vertices[near] - corners[:, None])
            empty[k] = not ((sides >= 0).all(axis=0) | (sides <= 0).all(axis=0)).any()
    return empty


def _without(mesh: Mesh, gone: BoolArray) -> Mesh:
    if not gone.any():
        return mesh
    kept = np.ones(len(mesh.positions), dtype=bool)
    kept[mesh.chain[gone]] = False
    number = np.cumsum(kept) - 1
    return replace(
        mesh,
        positions=mesh.positions[kept],
        chain=number[mesh.chain[~gone]],
        times=mesh.times[~gone],
        heights=mesh.heights[~gone],
    )


def _halved(mesh: Mesh, chosen: BoolArray) -> Mesh:
    """The chosen segments with a vertex in their middle."""
    split = np.flatnonzero(chosen)
    if not len(split):
        return mesh
    count = len(mesh.positions) - FRAME
    middle = (mesh.plan[split] + mesh.plan[split + 1]) / 2
    at = split + 1
    return replace(
        mesh,
        positions=np.concatenate((mesh.positions[:count], middle, mesh.positions[count:])),
        # The frame's vertices, which come last, are on no chain.
        chain=np.insert(mesh.chain, at, count + np.arange(len(split))),
        times=np.insert(mesh.times, at, (mesh.times[split] + mesh.times[split + 1]) / 2),
        heights=np.insert(mesh.heights, at, (mesh.heights[split] + mesh.heights[split + 1]) / 2),
    )
