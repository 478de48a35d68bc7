"""Circle packings: tangent discs for the vertices of a triangulated disc.

The angles around vertices are the derivative of a convex function of the radii's logarithms (Colin
de Verdière, "Un principe variationnel pour les empilements de cercles", Invent. math. 104, 1991,
doi:10.1007/BF01245096), so Newton's method finds the radii.
"""

from __future__ import annotations

import numpy as np

from knotopt.arrays import BoolArray, ComplexArray, FloatArray, IntArray

Triangle = tuple[int, int, int]

ACCURACY = 1e-10  # of the angles around a vertex [rad]
MOST_STEPS = 200
OVERLAP = 1e-6  # of two discs, as a share of the distance at which they touch: more than rounding


def circle_packing(
    triangles: list[Triangle], boundary: list[int]
) -> tuple[ComplexArray, FloatArray]:
    """Discs that do not overlap, those of each triangle touching: centres and radii.

    Parameters
    ----------
    triangles : list of (int, int, int)
        Each counterclockwise; the vertices are 0, 1, ... and no edge is double.
    boundary : list of int
        The vertices on the boundary. Their radii are 1, or, if discs would overlap then, such that
        their centres form a polygon with equal angles, for which there always are radii.

    Raises
    ------
    ArithmeticError
        The radii differ by too many orders of magnitude.

    Notes
    -----
    O(v^3) a step for v vertices; some ten steps.

    Examples
    --------
    Three discs that touch, and one between them:

    >>> _, radii = circle_packing([(0, 1, 3), (1, 2, 3), (2, 0, 3)], [0, 1, 2])
    >>> radii.round(4).tolist()
    [1.0, 1.0, 1.0, 0.1547]
    """
    corners = np.array(triangles, dtype=np.int64)
    wanted = np.full(corners.max() + 1, 2 * np.pi)
    free = np.ones(len(wanted), dtype=bool)
    free[boundary] = False
    radii = _radii(corners, wanted, free)
    centres = _placed(triangles, radii)
    touching = radii[:, None] + radii
    np.fill_diagonal(touching, 0)
    if (np.abs(centres[:, None] - centres) < (1 - OVERLAP) * touching).any():
        wanted[boundary] = np.pi - 2 * np.pi / len(boundary)
        free[boundary[1:]] = True
        radii = _radii(corners, wanted, free)
        centres = _placed(triangles, radii)
    return centres, radii


def _radii(corners: IntArray, wanted: FloatArray, free: BoolArray) -> FloatArray:
    """Radii for which the angles [rad] around the free vertices are as wanted; the others' are 1.

    The weighted Laplacian of the graph is the convex function's second derivative.
    """
    logs = np.zeros(len(wanted))
    lacking, laplacian = _angles(corners, logs, wanted)
    for _ in range(MOST_STEPS):
        if np.abs(lacking[free]).max(initial=0.0) < ACCURACY:
            return np.exp(logs)
        step = np.zeros(len(wanted))
        step[free] = np.linalg.solve(laplacian[np.ix_(free, free)], -lacking[free])
        slope = lacking @ step
        new_lacking, laplacian = _angles(corners, logs + step, wanted)
        while new_lacking @ step > -0.5 * slope:  # far beyond the least value along the step
            step, slope = step / 2, slope / 2
            new_lacking, laplacian = _angles(corners, logs + step, wanted)
        logs, lacking = logs + step, new_lacking
    raise ArithmeticError("the radii of the circle packing did not converge")


def _angles(
    corners: IntArray, logs: FloatArray, wanted: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """What the angles around vertices lack of those wanted [rad], and its derivative by `logs`."""
    radii = np.exp(logs)
    lacking = wanted.copy()
    laplacian = np.zeros((len(logs), len(logs)))
    i, j, k = corners.T
    inradius = np.sqrt(radii[i] * radii[j] * radii[k] / (radii[i] + radii[j] + radii[k]))
    for one, two in ((i, j), (j, k), (k, i)):
        np.subtract.at(lacking, one, 2 * np.arctan2(inradius, radii[one]))
        weight = inradius / (radii[one] + radii[two])
        for a, b in ((one, two), (two, one)):
            np.add.at(laplacian, (a, a), weight)
            np.subtract.at(laplacian, (a, b), weight)
    return lacking, laplacian


def _placed(triangles: list[Triangle], radii: FloatArray) -> ComplexArray:
    """Centres of discs with these radii, triangle after triangle from the first one."""
    across = {(t[k], t[(k + 1) % 3]): t[(k + 2) % 3] for t in triangles for k in range(3)}
    centre = np.full(len(radii), np.nan, dtype=np.complex128)
    first, second, _ = triangles[0]
    centre[first], centre[second] = 0.0, radii[first] + radii[second]
    queue = [(first, second)]
    for a, b in queue:
        c = across.pop((a, b), None)
        if c is None:
            continue
        if np.isnan(centre[c]):
            ab, ac, bc = radii[a] + radii[b], radii[a] + radii[c], radii[b] + radii[c]
            cosine = (ab**2 + ac**2 - bc**2) / (2 * ab * ac)
            turn = complex(cosine, np.sqrt(max(0.0, 1 - cosine**2)))
            centre[c] = centre[a] + (centre[b] - centre[a]) / ab * ac * turn
        queue += [(a, c), (c, b), (b, a)]
    return centre
