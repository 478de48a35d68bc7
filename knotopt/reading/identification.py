"""Which knot something is that was read: what the reading leaves open included."""

from __future__ import annotations

from dataclasses import replace

from knotopt.diagram.grid import GridDiagram
from knotopt.identify.identify import Identified, identify
from knotopt.identify.summands import MOST_SUMS, KnotSum, sums
from knotopt.planar.planar_diagram import PlanarDiagram
from knotopt.planar.small_grid import small_grid
from knotopt.reading.names import mirror_name
from knotopt.reading.record import NamedDiagram, ReadSummand


def identify_read(named: NamedDiagram, *, prove: bool = False, seed: int = 0) -> Identified:
    """Name the knot of what `knotopt.read` returns, as `knotopt identify` does.

    Where the reading may as well be the mirror image, `up_to_mirror` is set. Where it is a
    connected sum of which each summand may be, the candidates are all sums that it can be; the
    invariants are those of the one that was chosen.

    Parameters
    ----------
    named : NamedDiagram
    prove, seed
        As for `knotopt.identify.identify.identify`.

    Raises
    ------
    MissingExtraError
        A proof is asked for without the `snappy` extra.

    Examples
    --------
    >>> from knotopt.reading.knot import read_knot
    >>> identify_read(read_knot("trefoil # trefoil")).candidates
    ('3_1#3_1', '3_1#m3_1', 'm3_1#m3_1')
    >>> found = identify_read(read_knot("DT: [(4, 6, 2)]"))
    >>> found.candidates, found.up_to_mirror
    (('3_1',), True)
    """
    found = identify(named.diagram, planar=named.planar, prove=prove, seed=seed)
    if named.summands:
        return _of_summands(found, named.summands, prove=prove, seed=seed)
    return replace(found, up_to_mirror=named.ambiguous and not found.is_amphicheiral)


def name_given(named: NamedDiagram, found: Identified) -> str | None:
    """The name by which the knot was asked for, if that name alone says which knot it is.

    Of a knot of the tables, the candidate of that name; of any other, such as a large torus knot,
    the name as it was given.

    Examples
    --------
    >>> from knotopt.reading.knot import read_knot
    >>> named = read_knot("T(30,31)")
    >>> name_given(named, identify_read(named))
    'T(30,31)'
    """
    if named.form != "name" or named.ambiguous:
        return None
    if not found.candidates:
        return named.name
    names = [named.name] + ([mirror_name(named.name)] if found.is_amphicheiral else [])
    return next((name for name in names if name in found.candidates), None)


def _of_summands(
    whole: Identified, summands: tuple[ReadSummand, ...], *, prove: bool, seed: int
) -> Identified:
    """All knots that a sum can be whose summands may be mirror images, each by itself."""
    known: dict[ReadSummand, Identified] = {}
    for summand in summands:
        if summand not in known:
            known[summand] = _identify(summand.diagram, prove=prove, seed=seed)
    chosen = sums([known[summand].knots for summand in summands])
    knots = sums([_hands(known[summand].knots, summand.either_hand) for summand in summands])
    is_whole = {*knots} == {each for knot in chosen for each in (knot, knot.mirror)}
    return replace(
        whole,
        knots=chosen if is_whole else knots,
        by=tuple(dict.fromkeys(word for each in known.values() for word in each.by)),
        proven=all(each.proven for each in known.values()) and len(knots) < MOST_SUMS,
        up_to_mirror=is_whole and {*knots} != {*chosen},
    )


def _identify(diagram: GridDiagram | PlanarDiagram, *, prove: bool, seed: int) -> Identified:
    if isinstance(diagram, GridDiagram):
        return identify(diagram, prove=prove, seed=seed)
    return identify(small_grid(diagram, seed=seed), planar=diagram, prove=prove, seed=seed)


def _hands(knots: tuple[KnotSum, ...], either_hand: bool) -> list[KnotSum]:
    """The knots, and their mirror images if either hand is meant."""
    hands = [each for knot in knots for each in (knot, knot.mirror)]
    return [*dict.fromkeys(hands)] if either_hand else [*knots]
