"""What a set that does not lay the knot says of other sets: clauses that cut it off.

A clause is a list of literals, +k for "p_k carries a support" and -k for "it does not"; every set
that lays the knot satisfies it.

A lost hook stays lost as long as its `bare` turning points carry no support. If no way of losing
these hooks, and any others besides, leaves the knot, then one of their turning points must carry a
support: a clause without negative literals, which cuts off all sets that leave them bare. Ways of
losing hooks are tried by invariants, one and all, so the clause is as sure as these.

Where that is not so (other hooks, lost as well, may make up for it) the words of the first spans
decide. They depend on the supports up to the end of the last of them alone, and with them which
hooks are lost there; if that cannot be made up for by what happens later, these supports change.
"""

from __future__ import annotations

from collections.abc import Collection
from itertools import chain

from knotopt.laid.hooks import LostHook
from knotopt.laid.laid import LaidTest
from knotopt.supports.by_size import Clause

MOST_WAYS = 2**16
"""Of losing hooks that are tried for one clause."""


def clause(test: LaidTest, supports: tuple[int, ...]) -> Clause | None:
    """What every set that lays the knot satisfies and this one does not; None if this one does.

    Parameters
    ----------
    test : LaidTest
        Of the cable.
    supports : tuple of int
        Turning points with a support robot (1-based).

    Returns
    -------
    tuple of int
        Literals by ascending turning point.

    Raises
    ------
    RequirementError
        A support that is no turning point between the ends.

    Examples
    --------
    Without supports nothing of the trefoil is left. Its first crossing is needed, so that its loop
    holds a support:

    >>> from knotopt.cable.cable import Cable
    >>> from knotopt.diagram.families import torus_knot
    >>> test = LaidTest(Cable(torus_knot(2, 3), "L+"))
    >>> clause(test, ())
    (3, 4, 5)
    >>> clause(test, (5,)) is None
    True
    """
    laid = test.laid(supports)
    if laid.is_knot:
        return None
    sure = [each for each in laid.lost if each.bare is not None]
    if not _some_way(test, [each.crossing for each in sure]):
        return tuple(sorted(_bare(_fewest(test, sure))))
    return _prefix(test, supports, laid.lost)


def _fewest(test: LaidTest, sure: list[LostHook]) -> list[LostHook]:
    """Lost hooks that no way makes up for, without those that can be left out."""
    for each in sorted(sure, key=lambda lost: -len(lost.bare or ())):
        fewer = [other for other in sure if other is not each]
        if fewer and not _some_way(test, [other.crossing for other in fewer]):
            sure = fewer
    return sure


def _bare(lost: list[LostHook]) -> frozenset[int]:
    return frozenset(chain.from_iterable(each.bare or () for each in lost))


def _prefix(test: LaidTest, supports: tuple[int, ...], lost: tuple[LostHook, ...]) -> Clause:
    """Of the first supports that decide: some turning point up to the last of them differs."""
    cable = test.cable
    for last in (*supports, len(cable.path)):
        end = int(cable.times[last - 1])
        settled = [c for c in test.hooks if cable.crossings.second[c] < end]
        gone = [each.crossing for each in lost if each.crossing in settled]
        open_ = [c for c in test.hooks if c not in settled]
        if last == len(cable.path) or not _some_way(test, gone, open_):
            break
    points = range(2, min(last, len(cable.path) - 1) + 1)
    return tuple(-k if k in supports else k for k in points)


def _some_way(test: LaidTest, lost: Collection[int], others: Collection[int] | None = None) -> bool:
    """Whether the knot may be left when these hooks are lost and any of the others besides.

    Where there are too many ways to try, it may.
    """
    free = [c for c in (test.hooks if others is None else others) if c not in lost]
    if 2 ** len(free) > MOST_WAYS:
        return True
    return any(test.apart(way) is None for way in test.ways.alike(lost, free))
