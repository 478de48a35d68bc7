"""Which knot a diagram shows: its name in the tables, chirality included, by invariants."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial
from itertools import product

from knotopt.diagram.grid import GridDiagram
from knotopt.diagram.simplify import simplify
from knotopt.diagram.sums import split_sum
from knotopt.identify.colourings import colouring_polynomial
from knotopt.identify.finite_groups import alternating_group, psl2
from knotopt.identify.invariants import Invariants, invariants
from knotopt.identify.jones import jones_polynomial
from knotopt.identify.summands import KnotSum, crossings_in_table, knots_with
from knotopt.planar.from_grid import planar_diagram
from knotopt.planar.planar_diagram import PlanarDiagram
from knotopt.planar.sums import summands

COLOURINGS = {
    "PSL(2,5)": partial(psl2, 5),
    "PSL(2,7)": partial(psl2, 7),
    "PSL(2,11)": partial(psl2, 11),
    "the alternating group of degree 7": partial(alternating_group, 7),
}
"""Groups in whose elements strands are coloured; those after the first two only to decide between
candidates. The last tells mutants apart, which the others hardly can."""
MOST_COMBINATIONS = 100  # of candidates for the summands


@dataclass(frozen=True)
class Identified:
    """Which knots a diagram can be of, as far as invariants tell.

    Attributes
    ----------
    candidates : tuple of str
        Names of the knots of the tables that have all invariants of this one: m8_19 is the mirror
        image of 8_19, 3_1#m3_1 a connected sum. One: the knot is identified. None: it is not in the
        tables.
    by : tuple of str
        What the candidates agree with it in: "Alexander polynomial", ...
    table_crossings : int
        The crossing number up to which all prime knots were compared.
    invariants : Invariants
        Of the whole knot.
    grid : GridDiagram
        The simplified diagram.
    crossings : int
        Of its planar diagram, without those that a summand of an unknot has.
    """

    candidates: tuple[str, ...]
    by: tuple[str, ...]
    table_crossings: int
    invariants: Invariants
    grid: GridDiagram
    crossings: int

    @property
    def name(self) -> str | None:
        """The knot's name, if one is left."""
        return self.candidates[0] if len(self.candidates) == 1 else None


def identify(diagram: GridDiagram, *, seed: int = 0) -> Identified:
    """Name the knot of a grid diagram.

    Parameters
    ----------
    diagram : GridDiagram
    seed : int
        Of the simplification.

    Returns
    -------
    Identified
        A knot is compared with all prime knots of the tables (up to 13 crossings with the
        `knotinfo` extra, 10 without), their mirror images and their connected sums. A grid of size
        2 is the unknot's, which needs no invariants; all else is by invariants.

    Examples
    --------
    >>> from knotopt.diagram.families import torus_knot
    >>> found = identify(torus_knot(3, -4))
    >>> found.name, found.by[:3]
    ('m8_19', ('Alexander polynomial', 'signature', 'Jones polynomial'))
    >>> identify(torus_knot(1, 5)).candidates
    ('0_1',)

    Notes
    -----
    Simplification takes most of the time, about 100 ms for a grid of size 15.
    """
    grid = simplify(diagram, seed=seed)
    planar = planar_diagram(grid)
    if grid.size == 2:
        unknot = KnotSum(()).name
        by = ("grid of size 2",)
        return Identified((unknot,), by, crossings_in_table(), invariants(planar), grid, 0)
    parts = [_compare(part) for part in summands(planar)]
    if not all(part.knots for part in parts):  # one more try: it may be a sum in disguise
        split = split_sum(grid, seed=seed)
        if len(split) > 1:
            parts = [_compare(planar_diagram(part)) for part in split]
    return Identified(
        _names([part.knots for part in parts]),
        tuple(dict.fromkeys(name for part in parts for name in part.by)),
        crossings_in_table(),
        invariants(planar),
        grid,
        sum(part.crossings for part in parts),
    )


@dataclass(frozen=True)
class _Compared:
    """The knots of the tables that a summand may be."""

    knots: list[KnotSum]
    by: tuple[str, ...]
    crossings: int


def _compare(planar: PlanarDiagram) -> _Compared:
    """The knots of the tables whose invariants are those of the diagram's."""
    own = invariants(planar)
    if own.alexander is None:
        return _Compared([], (), len(planar.crossings))
    left = knots_with(own.alexander, own.signature)
    by = ["Alexander polynomial", "signature"]
    if own.jones is not None:
        left = [knot for knot in left if jones_polynomial(knot.planar) == own.jones]
        by.append("Jones polynomial")
    for number, (group, classes) in enumerate(COLOURINGS.items()):
        if not left or (number > 1 and len(left) == 1):
            break
        for colours in classes():
            left = _agreeing(left, planar, partial(colouring_polynomial, colours=colours))
        by.append(f"colourings by {group}")
    return _Compared(left, tuple(by), len(planar.crossings))


def _agreeing(
    knots: list[KnotSum], planar: PlanarDiagram, invariant: Callable[[PlanarDiagram], object | None]
) -> list[KnotSum]:
    """The knots with the same value, or for which it is too costly (None)."""
    value = invariant(planar)
    if value is None:
        return knots
    return [knot for knot in knots if invariant(knot.planar) in (None, value)]


def _names(parts: Sequence[list[KnotSum]]) -> tuple[str, ...]:
    """Names of the sums of one candidate of each part."""
    found: dict[str, None] = {}
    for chosen in product(*parts):
        found[sum(chosen, KnotSum(())).name] = None
        if len(found) == MOST_COMBINATIONS:
            break
    return tuple(found)
