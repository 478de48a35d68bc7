"""Families of grid diagrams: torus knots and random knots of a given size."""

from __future__ import annotations

import math
import random

from knotopt.diagram.grid import GridDiagram
from knotopt.errors import GridError

MAX_SIZE = 10_000
"""Largest grid made here: its crossings alone take N * N bytes."""


def torus_knot(p: int, q: int) -> GridDiagram:
    """The standard grid of the torus knot T(p, q), of size |p| + |q| (its arc index if both >= 2).

    T(p, q) with p q > 0 is the positive (right-handed) knot, with p q < 0 its mirror image.
    Source: Cromwell, "Arc presentations of knots and links", Banach Center Publ. 42 (1998), for the
    grid; Etnyre and Honda, "Knots and contact geometry I: torus knots and the figure eight knot",
    arXiv:math/0006112, for the arc index.

    Raises
    ------
    GridError
        p or q is zero, they have a common divisor (then T(p, q) is a link), or the grid would be
        larger than `MAX_SIZE`.

    Examples
    --------
    >>> torus_knot(2, 7).size
    9
    >>> torus_knot(2, 4)
    Traceback (most recent call last):
    ...
    knotopt.errors.GridError: T(2,4) is a link of 2 components, a knot has 1
    """
    if p == 0 or q == 0:
        raise GridError(f"T({p},{q}): p and q must not be zero")
    components = math.gcd(p, q)
    if components != 1:
        raise GridError(f"T({p},{q}) is a link of {components} components, a knot has 1")
    size = abs(p) + abs(q)
    _check_size(size)
    minus = range(1, size + 1)
    plus = [(row + abs(p) - 1) % size + 1 for row in minus]
    marks = [*enumerate(minus, 1), *enumerate(plus, 1)]  # with columns over rows: T(|p|, -|q|)
    if p * q > 0:
        marks = [(column, size + 1 - row) for column, row in marks]
    return GridDiagram.from_marks(marks)


def random_knot(size: int, seed: int) -> GridDiagram:
    """A grid diagram drawn uniformly from all oriented knot diagrams of this size.

    An order in which to visit the columns and one in which to visit the rows is one diagram of a
    single component, and each diagram comes from `size` such pairs; so no draw is rejected.

    Parameters
    ----------
    size : int
        Grid size N >= 2.
    seed : int
        Seed of the generator; the same seed gives the same diagram.

    Raises
    ------
    GridError
        The size is below 2 or above `MAX_SIZE`.

    Examples
    --------
    >>> random_knot(6, seed=1) == random_knot(6, seed=1)
    True
    """
    _check_size(size)
    generator = random.Random(int(seed))
    columns = generator.sample(range(1, size + 1), size)
    rows = generator.sample(range(1, size + 1), size)
    minus, plus = [0] * size, [0] * size
    for step, column in enumerate(columns):
        minus[column - 1] = rows[step - 1]
        plus[column - 1] = rows[step]
    return GridDiagram(tuple(minus), tuple(plus))


def _check_size(size: int) -> None:
    if not 2 <= size <= MAX_SIZE:
        raise GridError(f"a grid diagram has size 2 to {MAX_SIZE}, not {size}")
