"""Places for labels beside points, clear of each other and of the lines drawn."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.patheffects import withStroke

from knotopt.arrays import FloatArray

LETTER = (0.62, 1.0)  # width and height of a letter over its font size
HALO = [withStroke(linewidth=1.5, foreground="white")]  # keeps letters legible on lines
OVERLAP = 1e3  # cost of another label, against 1 of each point of a line
AROUND = np.array([(1, 1), (-1, 1), (1, -1), (-1, -1), (0, 1.3), (1.3, 0), (0, -1.3), (-1.3, 0)])


def draw_labels(
    axes: Axes,
    points: FloatArray,
    texts: Sequence[str],
    lines: FloatArray,
    *,
    font: Sequence[float],
    distance: float,
    first: FloatArray | None = None,
    colours: Sequence[str],
) -> None:
    """Label points of a drawing whose axes have the same scale.

    Labels are placed one after the other, each where it covers no earlier one and the least of
    the lines; the same input gives the same places.

    Parameters
    ----------
    axes : Axes
        With its limits set.
    points : array of float, shape (k, 2)
    texts : sequence of str
        k labels.
    lines : array of float, shape (m, 2)
        What should stay visible, as points close to each other.
    font : sequence of float
        k sizes of letters [typographic points].
    distance : float
        From a point to the middle of its label along each axis [typographic points].
    first : array of float, shape (k, 2), optional
        Directions that are taken unless something lies there; by default up and to the right.
    colours : sequence of str
        k colours.
    """
    scale = _points_per_unit(axes)
    taken: list[tuple[FloatArray, FloatArray]] = []
    for k, (point, text) in enumerate(zip(points, texts, strict=True)):
        half = 0.5 * font[k] * np.array((LETTER[0] * len(text), LETTER[1]))
        shifts = distance * (AROUND if first is None else np.vstack((first[k], AROUND)))
        middles = point * scale + shifts
        covered = (np.abs(lines * scale - middles[:, None]) < half).all(axis=2).sum(axis=1)
        overlapped = [
            sum((np.abs(other - middle) < half + size).all() for other, size in taken)
            for middle in middles
        ]
        best = int(np.argmin(covered + OVERLAP * np.array(overlapped)))
        taken.append((middles[best], half))
        axes.annotate(
            text,
            (point[0], point[1]),
            (shifts[best][0], shifts[best][1]),
            textcoords="offset points",
            fontsize=font[k],
            ha="center",
            va="center",
            color=colours[k],
            zorder=6,
            path_effects=HALO,
        )


def _points_per_unit(axes: Axes) -> float:
    """Typographic points of a unit in a drawing whose axes have the same scale."""
    (left, right), (bottom, top) = axes.get_xlim(), axes.get_ylim()
    pixels = min(axes.bbox.width / (right - left), axes.bbox.height / (top - bottom))
    return 72 * pixels / axes.figure.dpi
