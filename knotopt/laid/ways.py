"""All ways of losing hooks, tried at once by the knot's determinant.

The determinant of a knot is that of the Goeritz matrix of a checkerboard colouring, and turning a
crossing over changes the sign of what it adds to it. So the determinants of thousands of diagrams
that differ in their crossings alone take one multiplication of matrices, and few diagrams are left
for the other invariants. Source: Goeritz, "Knoten und quadratische Formen",
doi:10.1007/BF01474158.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Sequence

import numpy as np

from knotopt.arrays import BoolArray, FloatArray
from knotopt.planar.planar_diagram import PlanarDiagram
from knotopt.planar.signature import checkerboard

CHUNK = 4096  # ways tried at once


class Ways:
    """Diagrams that differ from one in which crossings are turned over.

    Parameters
    ----------
    planar : PlanarDiagram
        With at least one crossing.
    """

    def __init__(self, planar: PlanarDiagram) -> None:
        meetings = checkerboard(planar)
        names = {
            face: k for k, face in enumerate(dict.fromkeys(f for m in meetings for f in m[:2]))
        }
        ends = np.zeros((len(meetings), len(names)))
        for crossing, (a, b, _) in enumerate(meetings):
            ends[crossing, names[a]] += 1
            ends[crossing, names[b]] -= 1
        turns = np.array([turn for *_, turn in meetings])
        self._adds: FloatArray = np.einsum("c,ci,cj->cij", turns, ends, ends)[:, 1:, 1:]
        self._determinant = float(self._determinants(np.zeros((1, len(turns)), dtype=bool))[0])

    def alike(self, lost: Collection[int], free: Sequence[int]) -> Iterator[tuple[int, ...]]:
        """Crossings that can be turned over without another determinant.

        Parameters
        ----------
        lost : collection of int
            Crossings that are turned over in every way.
        free : sequence of int
            Crossings of which any may be turned over besides.

        Yields
        ------
        tuple of int
            All that are turned over; ways with fewer of the first ones of `free` come first.

        Notes
        -----
        Determinants are whole numbers and compared to within a half, which is far more than the
        rounding of matrices of this size: no way is missed.
        """
        for start in range(0, 2 ** len(free), CHUNK):
            numbers = np.arange(start, min(start + CHUNK, 2 ** len(free)))
            turned = np.zeros((len(numbers), len(self._adds)), dtype=bool)
            turned[:, list(lost)] = True
            turned[:, list(free)] = (numbers[:, None] >> np.arange(len(free))) & 1
            same = np.abs(self._determinants(turned) - self._determinant) < 0.5
            for way in turned[same]:
                yield tuple(np.flatnonzero(way).tolist())

    def _determinants(self, turned: BoolArray) -> FloatArray:
        """Of each way, without sign."""
        signs = np.where(turned, -1.0, 1.0)
        forms = np.tensordot(signs, self._adds, axes=1)
        values: FloatArray = np.abs(np.linalg.det(forms))
        return values
