"""Crossings of a curve in space seen along a direction, from the curve alone.

Candidates come from a spatial index (shapely's STR tree); whether two segments cross is decided by
signs of areas, in rational arithmetic where floating point is near to zero.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction

import numpy as np
import shapely

from knotopt.arrays import FloatArray, IntArray
from knotopt.verify.regions import Cell, lay

UNSURE = 1e-9  # areas below this are computed again, exactly

Visit = tuple[int, bool]  # crossing, numbered as met; whether the curve passes over


@dataclass(frozen=True, eq=False)
class CurveCrossings:
    """Crossings of a polyline as seen from above, in the order first met.

    Attributes
    ----------
    first, second : float arrays, shape (C,)
        Where along the polyline they lie: k + u is in segment k at share u.
    point : float array, shape (C, 2)
    gap : float array, shape (C,)
        Height of the visit at `first` above that at `second`.
    sign : int array, shape (C,)
        +1 where the upper strand turns counterclockwise into the lower one's direction, else -1.
    """

    first: FloatArray
    second: FloatArray
    point: FloatArray
    gap: FloatArray
    sign: IntArray

    def __len__(self) -> int:
        return len(self.first)

    @property
    def visits(self) -> tuple[FloatArray, IntArray]:
        """Where along the polyline crossings are visited, in order, and which ones."""
        where = np.concatenate((self.first, self.second))
        order = np.argsort(where)
        return where[order], np.tile(np.arange(len(self)), 2)[order]

    @property
    def code(self) -> tuple[list[Visit], list[int]]:
        """Gauss code: crossing and over or not at each visit, and the crossings' signs."""
        where, which = self.visits
        over = np.where(where == self.first[which], self.gap[which] > 0, self.gap[which] < 0)
        return list(zip(which.tolist(), over.tolist(), strict=True)), self.sign.tolist()


def curve_crossings(points: FloatArray) -> CurveCrossings:
    """Every crossing of a polyline in space with itself, seen from above.

    Parameters
    ----------
    points : float array, shape (n, 3)

    Raises
    ------
    ValueError
        The polyline touches itself in a vertex or runs along itself, as seen from above.
    """
    flat = points[:, :2]
    segments = shapely.linestrings(np.stack((flat[:-1], flat[1:]), axis=1))
    i, j = shapely.STRtree(segments).query(segments)
    later = j > i + 1
    i, j = i[later], j[later]
    a, b, c, d = flat[i], flat[i + 1], flat[j], flat[j + 1]
    sides = np.stack((_areas(a, b, c), _areas(a, b, d), _areas(c, d, a), _areas(c, d, b)), axis=1)
    sign = np.sign(sides)
    for k in np.flatnonzero((np.abs(sides) < UNSURE).any(axis=1)):
        sign[k] = _exact_signs(a[k], b[k], c[k], d[k])
    apart = (sign[:, 0] * sign[:, 1] > 0) | (sign[:, 2] * sign[:, 3] > 0)
    touching = ~apart & (sign == 0).any(axis=1)
    if touching.any():
        worst = int(np.flatnonzero(touching)[0])
        x, y = a[worst].tolist()
        raise ValueError(
            f"segments {i[worst]} and {j[worst]} touch in a vertex, near ({x:.4f}, {y:.4f})"
        )
    i, j, sides = i[~apart], j[~apart], sides[~apart]
    u = sides[:, 2] / (sides[:, 2] - sides[:, 3])  # share on segment i
    v = sides[:, 0] / (sides[:, 0] - sides[:, 1])
    order = np.argsort(i + u)
    i, j, u, v, sides = i[order], j[order], u[order], v[order], sides[order]
    height = points[:, 2]
    gap = height[i] + u * (height[i + 1] - height[i]) - height[j] - v * (height[j + 1] - height[j])
    turn = np.sign(sides[:, 1] - sides[:, 0])  # of segment i into segment j's direction
    point = flat[i] + u[:, None] * (flat[i + 1] - flat[i])
    return CurveCrossings(i + u, j + v, point, gap, (turn * np.sign(gap)).astype(np.int64))


def grid_code(path: Sequence[Cell]) -> tuple[list[Visit], list[int]]:
    """The Gauss code of a cable on its grid, columns over rows, as `CurveCrossings.code` has it.

    Examples
    --------
    >>> grid_code([(1, 2), (3, 2), (3, 1), (2, 1), (2, 3)])
    ([(0, False), (0, True)], [-1])
    """
    cells = lay(path)
    met: dict[Cell, list[int]] = {}
    for time, cell in enumerate(cells):
        met.setdefault(cell, []).append(time)
    crossings = [times for times in met.values() if len(times) == 2]
    number = {time: k for k, times in enumerate(crossings) for time in times}

    def direction(time: int) -> Cell:
        return cells[time][0] - cells[time - 1][0], cells[time][1] - cells[time - 1][1]

    visits = [(number[time], direction(time)[0] == 0) for time in sorted(number)]
    signs = []
    for first, second in crossings:
        p, q = direction(first), direction(second)
        over, under = (p, q) if p[0] == 0 else (q, p)
        signs.append(1 if over[0] * under[1] - over[1] * under[0] > 0 else -1)
    return visits, signs


def _areas(a: FloatArray, b: FloatArray, c: FloatArray) -> FloatArray:
    areas: FloatArray = (b[:, 0] - a[:, 0]) * (c[:, 1] - a[:, 1])
    areas -= (b[:, 1] - a[:, 1]) * (c[:, 0] - a[:, 0])
    return areas


def _exact_signs(*corners: FloatArray) -> list[int]:
    a, b, c, d = ([Fraction(float(x)) for x in corner] for corner in corners)

    def sign(p: list[Fraction], q: list[Fraction], r: list[Fraction]) -> int:
        area = (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0])
        return (area > 0) - (area < 0)

    return [sign(a, b, c), sign(a, b, d), sign(c, d, a), sign(c, d, b)]
