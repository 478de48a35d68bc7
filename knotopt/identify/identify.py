"""Which knot a diagram shows: its name in the tables, chirality included, by invariants."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import partial

from knotopt.diagram.grid import GridDiagram
from knotopt.diagram.simplify import simplify
from knotopt.diagram.sums import split_sum
from knotopt.identify import complements
from knotopt.identify.colourings import colouring_polynomial
from knotopt.identify.finite_groups import ConjugacyClass, alternating_group, psl2
from knotopt.identify.invariants import Invariants, invariants
from knotopt.identify.jones import jones_polynomial
from knotopt.identify.summands import KnotSum, crossings_in_table, knots_with, sums
from knotopt.planar.from_grid import planar_diagram
from knotopt.planar.loosened import loosened
from knotopt.planar.planar_diagram import PlanarDiagram
from knotopt.planar.sums import summands

Groups = Mapping[str, Callable[[], Sequence[ConjugacyClass]]]

ALWAYS: Groups = {"PSL(2,5)": partial(psl2, 5), "PSL(2,7)": partial(psl2, 7)}
"""Groups in whose elements strands are always coloured."""
IF_NEEDED: Groups = {"PSL(2,11)": partial(psl2, 11), "A7": partial(alternating_group, 7)}
"""Those that only decide between candidates; the alternating group also between mutants."""
MAX_SPLIT = 40  # size of a grid that is walked about to find a connected sum


@dataclass(frozen=True)
class Identified:
    """Which knots a diagram can be of, as far as invariants tell.

    Attributes
    ----------
    knots : tuple of KnotSum
        The knots of the tables that have all invariants of this one. One: the knot is identified.
        None: it is not in the tables.
    by : tuple of str
        What the candidates agree with it in: "Alexander polynomial", ...
    table_crossings : int
        The crossing number up to which all prime knots were compared.
    proven : bool
        Whether it is the knot named for certain, or one of those named: if each summand's diagram
        has no more crossings than knots of the tables, which are complete; by isometries of
        complements; or by the grid of size 2, the unknot's. Else a knot that is in no table may
        have the same invariants.
    invariants : Invariants
        Of the whole knot.
    grid : GridDiagram
        The simplified diagram.
    crossings : int
        Of the planar diagram compared, without those that a summand of an unknot has.
    up_to_mirror : bool
        Whether the mirror images of the candidates are meant as well.
    """

    knots: tuple[KnotSum, ...]
    by: tuple[str, ...]
    table_crossings: int
    proven: bool
    invariants: Invariants
    grid: GridDiagram
    crossings: int
    up_to_mirror: bool = False

    @property
    def candidates(self) -> tuple[str, ...]:
        """The names of `knots`: m8_19 is the mirror image of 8_19, 3_1#m3_1 a connected sum."""
        return tuple(knot.name for knot in self.knots)

    @property
    def is_amphicheiral(self) -> bool:
        """Whether each candidate is its own mirror image."""
        return bool(self.knots) and all(knot.is_amphicheiral for knot in self.knots)

    @property
    def name(self) -> str | None:
        """The knot's name, if one is left."""
        return self.candidates[0] if len(self.candidates) == 1 else None


def identify(
    diagram: GridDiagram,
    *,
    planar: PlanarDiagram | None = None,
    prove: bool = False,
    seed: int = 0,
) -> Identified:
    """Name the knot of a grid diagram.

    Parameters
    ----------
    diagram : GridDiagram
    planar : PlanarDiagram, optional
        Another diagram of the same knot, such as that of the code it was drawn from: taken instead
        of the simplified grid's if it has fewer crossings, without loops and bigons.
    prove : bool
        Have SnapPy compare complements even if one candidate is left; of several, it compares them
        wherever it is installed.
    seed : int
        Of the simplification.

    Returns
    -------
    Identified
        A knot is compared with all prime knots of the tables (up to 13 crossings with the
        `knotinfo` extra, 10 without), their mirror images and their connected sums.

    Raises
    ------
    MissingExtraError
        A proof is asked for without the `snappy` extra.

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
    if prove:
        complements.require()
    grid = simplify(diagram, seed=seed)
    drawn = [loosened(each) for each in (planar_diagram(grid), planar) if each is not None]
    planar = min(drawn, key=lambda each: len(each.crossings))
    if grid.size == 2:
        parts = [_Compared([KnotSum(())], ("grid of size 2",), True, 0)]
    else:
        parts = [_compare(part, prove=prove) for part in summands(planar)]
        if not all(part.knots for part in parts) and grid.size <= MAX_SPLIT:
            split = split_sum(grid, seed=seed)
            if len(split) > 1:  # a sum in disguise
                parts = [_compare(loosened(planar_diagram(part)), prove=prove) for part in split]
    return Identified(
        sums([part.knots for part in parts]),
        tuple(dict.fromkeys(name for part in parts for name in part.by)),
        crossings_in_table(),
        all(part.proven for part in parts),
        invariants(planar),
        grid,
        sum(part.crossings for part in parts),
    )


@dataclass(frozen=True)
class _Compared:
    """The knots of the tables that a summand may be."""

    knots: list[KnotSum]
    by: tuple[str, ...]
    proven: bool
    crossings: int


def _compare(planar: PlanarDiagram, *, prove: bool) -> _Compared:
    """The knots of the tables whose invariants are those of the diagram's."""
    own = invariants(planar)
    if own.alexander is None or own.signature is None:
        return _Compared([], (), False, len(planar.crossings))
    left = knots_with(own.alexander, own.signature)
    by = ["Alexander polynomial", "signature"]
    if own.jones is not None:
        left = [knot for knot in left if jones_polynomial(knot.planar) == own.jones]
        by.append("Jones polynomial")
    if left:
        left = _coloured_alike(left, planar, ALWAYS)
        by.append("colouring polynomials")
    same: list[KnotSum] = []
    if (prove and left) or (len(left) > 1 and complements.is_installed()):
        same, how = _proven(left, planar)
        by += [how] if same else []
    left = same or left
    for group, classes in IF_NEEDED.items():
        if len(left) > 1:
            left = _coloured_alike(left, planar, {group: classes})
    crossings = len(planar.crossings)
    complete = len(left) == 1 and crossings <= crossings_in_table()
    return _Compared(left, tuple(by), bool(same) or complete, crossings)


def _proven(knots: list[KnotSum], planar: PlanarDiagram) -> tuple[list[KnotSum], str]:
    """Those of the knots that SnapPy proves it to be, and by what."""
    unknot = KnotSum(())
    if unknot in knots and complements.is_unknot(planar):
        return [unknot], "knot Floer homology"
    same = [knot for knot in knots if knot != unknot]
    same = [knot for knot in same if complements.are_isometric(planar, knot.planar)]
    return same, "isometry of complements"


def _coloured_alike(knots: list[KnotSum], planar: PlanarDiagram, groups: Groups) -> list[KnotSum]:
    """The knots with the same colouring polynomials."""
    for classes in groups.values():
        for colours in classes():
            knots = _agreeing(knots, planar, partial(colouring_polynomial, colours=colours))
    return knots


def _agreeing(
    knots: list[KnotSum], planar: PlanarDiagram, invariant: Callable[[PlanarDiagram], object | None]
) -> list[KnotSum]:
    """The knots with the same value, or for which it is too costly (None)."""
    value = invariant(planar)
    if value is None:
        return knots
    return [knot for knot in knots if invariant(knot.planar) in (None, value)]
