"""Constrained Delaunay triangulation of a cable's mesh inside its frame (CDT, by pythoncdt)."""

from __future__ import annotations

from typing import Any

import numpy as np
import pythoncdt

from knotopt.arrays import FloatArray, IntArray


def triangulate(positions: FloatArray, segments: IntArray) -> IntArray:
    """Triangles of the convex hull that have every segment among their edges.

    Parameters
    ----------
    positions : float array, shape (V, 2)
    segments : int array, shape (S, 2)

    Returns
    -------
    int array, shape (T, 3), counterclockwise

    Raises
    ------
    pythoncdt exception (RuntimeError)
        Two segments cross, or a point lies twice in `positions`.
    """
    found = pythoncdt.Triangulation(
        pythoncdt.VertexInsertionOrder.AUTO, pythoncdt.IntersectingConstraintEdges.NOT_ALLOWED, 0.0
    )
    # Arrays are buffers, though their type does not say so before Python 3.12.
    vertices: Any = np.ascontiguousarray(positions, dtype=np.float64)
    edges: Any = np.ascontiguousarray(segments, dtype=np.uint32)
    found.insert_vertices(vertices)
    found.insert_edges(edges)
    found.erase_super_triangle()
    triangles: IntArray = found.triangles_array()["vertices"].astype(np.int64)
    return triangles
