"""Which vertices must keep away from which segments, and at which corners strands must fan out."""

from __future__ import annotations

from itertools import product

import numpy as np
from scipy.sparse import csr_array
from scipy.sparse.csgraph import dijkstra
from scipy.spatial import cKDTree

from knotopt.arrays import FloatArray, IntArray
from knotopt.path.mesh import FRAME, Mesh
from knotopt.path.plane import cross
from knotopt.path.threads import segment_distances

NEAR = 0.25  # distances larger than need be by so much are left to the next round [grid steps]
FAR = 1.5  # the same for what shares a triangle
STRAIGHT = 0.6  # distance over way between points of strands that need no watching
WIDE = 0.2  # minus the cosine of a corner that needs no watching: those beside it are sharp
CHUNK = 512  # vertices whose network distances are held at a time


def strand_pairs(
    mesh: Mesh, triangles: IntArray, clearance: float, neighbourhood: float
) -> tuple[IntArray, FloatArray]:
    """Vertices and segments that could come too near to each other, and how near they may come.

    Points may come within `clearance` of each other only if the way between them along the cable,
    changing strands at crossings, is shorter than `neighbourhood`; then their distance must still
    be that share of the clearance which the way has of the neighbourhood, so that strands fan out
    from crossings and no bend folds up.

    Parameters
    ----------
    mesh : Mesh
    triangles : int array, shape (T, 3)
    clearance, neighbourhood : float
        [grid steps]

    Returns
    -------
    int array, shape (K, 3)
        A vertex and the two ends of a segment: those that share a triangle, and those that are near
        each other on different strands.
    float array, shape (K,)
        Smallest distance [grid steps].
    """
    segments, positions = mesh.segments, mesh.positions
    middles = positions[segments].mean(axis=1)
    radius = clearance + NEAR + float(mesh.lengths.max()) / 2
    near = cKDTree(positions[:-FRAME]).sparse_distance_matrix(
        cKDTree(middles), radius, output_type="coo_matrix"
    )
    pairs = np.concatenate(
        (
            np.column_stack((near.row, segments[near.col])).astype(np.int64),
            _across_triangles(mesh, triangles),
        )
    )
    pairs[:, 1:] = np.sort(pairs[:, 1:], axis=1)
    shares = np.arange(len(pairs)) >= len(near.row)
    pairs, back = np.unique(pairs, axis=0, return_inverse=True)
    shares = np.bincount(back.ravel(), shares, minlength=len(pairs)) > 0
    distance = segment_distances(*(positions[pairs[:, k]] for k in range(3)))
    candidates = ~mesh.held[pairs].all(axis=1) & (shares | (distance < clearance + NEAR))
    pairs, shares, distance = pairs[candidates], shares[candidates], distance[candidates]
    ways = _ways(mesh, pairs, neighbourhood)
    least = clearance * np.minimum(1, ways.min(axis=1) / neighbourhood)
    apart = ways.min(axis=1) >= neighbourhood
    bent = (distance < least + NEAR / 2) & (distance < STRAIGHT * ways.mean(axis=1))
    kept = (ways.min(axis=1) > 0) & np.where(
        apart, distance < clearance + np.where(shares, FAR, NEAR), bent
    )
    return pairs[kept], least[kept]


def crossing_corners(mesh: Mesh) -> IntArray:
    """Corners of crossings that are not wide: vertex, neighbour, next one counterclockwise."""
    corners = []
    at = mesh.chain[mesh.over]
    for over, under in product((-1, 1), repeat=2):
        first, second = mesh.chain[mesh.over + over], mesh.chain[mesh.under + under]
        p, q = (mesh.positions[v] - mesh.positions[at] for v in (first, second))
        left = cross(p, q) > 0
        corners.append(
            np.stack((at, np.where(left, first, second), np.where(left, second, first)), axis=1)
        )
    found = np.concatenate(corners)
    p, q = (mesh.positions[found[:, k]] - mesh.positions[found[:, 0]] for k in (1, 2))
    cosine = (p * q).sum(axis=1) / (np.linalg.norm(p, axis=1) * np.linalg.norm(q, axis=1))
    kept: IntArray = found[cosine > -WIDE]
    return kept


def robot_turns(mesh: Mesh) -> IntArray:
    """Each support robot's vertex and its two neighbours on the path, shape (S, 3)."""
    places = mesh.robots[1:-1]
    return np.stack((mesh.chain[places], mesh.chain[places - 1], mesh.chain[places + 1]), axis=1)


def arc_ends(mesh: Mesh) -> IntArray:
    """Vertices at the two ends of each arc, without arcs between robots or back to themselves."""
    ends = np.stack((mesh.chain[mesh.joints[:-1]], mesh.chain[mesh.joints[1:]]), axis=1)
    different = ends[:, 0] != ends[:, 1]
    return np.unique(np.sort(ends[different & ~mesh.held[ends].all(axis=1)], axis=1), axis=0)


def _across_triangles(mesh: Mesh, triangles: IntArray) -> IntArray:
    """Vertex and opposite edge of every triangle, where that edge is a segment of the path."""
    count = len(mesh.positions)
    ends = np.sort(mesh.segments, axis=1)
    known = ends[:, 0] * count + ends[:, 1]
    found = []
    for k in range(3):
        vertex, a, b = (triangles[:, (k + j) % 3] for j in range(3))
        edge = np.minimum(a, b) * count + np.maximum(a, b)
        on_path = np.isin(edge, known) & (vertex < count - FRAME)
        found.append(np.stack((vertex, a, b), axis=1)[on_path])
    return np.concatenate(found)


def _ways(mesh: Mesh, pairs: IntArray, limit: float) -> FloatArray:
    """Ways along the cable from vertices to both ends of segments, inf beyond a limit, (K, 2)."""
    count = len(mesh.positions) - FRAME
    starts, ends = mesh.segments.T
    network = csr_array((mesh.lengths, (starts, ends)), shape=(count, count))
    ways = np.empty((len(pairs), 2))
    for low in range(0, count, CHUNK):
        mine = (pairs[:, 0] >= low) & (pairs[:, 0] < low + CHUNK)
        sources = np.arange(low, min(low + CHUNK, count))
        found = dijkstra(network, directed=False, indices=sources, limit=limit)
        ways[mine] = found[pairs[mine, :1] - low, pairs[mine, 1:]]
    return ways
