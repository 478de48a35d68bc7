"""The crossings that a cable loses when the spans between its robots become straight.

Where a strand passes over older cable nothing holds it there: it may be drawn straight above all
that is laid. What it hooks under holds it. So of a crossing only the *hooks* count, those that the
later visit passes under; a hook is lost

- on one span, if both its visits are on the same span, which is straight and cannot cross itself;
- undone, if the leader's next crossing undoes it, there and back under the same older span: the
  flight's word leaves both out, and the strand is straight there (`knotopt.flight.layout.reduced`).
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum

import numpy as np

from knotopt.cable.cable import Cable
from knotopt.flight.grid_layout import letters_of_grid
from knotopt.flight.layout import Letter, reduced, undone_pairs
from knotopt.path.mesh import robot_times


class Loss(StrEnum):
    """Why a crossing is lost."""

    ONE_SPAN = "both visits on one span"
    UNDONE = "undone by the next crossing"


@dataclass(frozen=True)
class LostHook:
    """A crossing that the later visit no longer passes under.

    Attributes
    ----------
    crossing : int
        Index into `cable.crossings`.
    loss : Loss
    bare : frozenset of int or None
        Turning points (1-based) without a support. As long as there is none on any of them, the
        hook stays lost, wherever else supports are. None where no such thing is known.
    """

    crossing: int
    loss: Loss
    bare: frozenset[int] | None


def lost_hooks(cable: Cable, supports: tuple[int, ...]) -> tuple[LostHook, ...]:
    """The hooks that a set of supports loses, in the order of their crossings.

    Parameters
    ----------
    cable : Cable
    supports : tuple of int
        Turning points with a support robot (1-based).

    Raises
    ------
    RequirementError
        A support that is no turning point between the ends.

    Notes
    -----
    Why a hook that was undone stays so: let c be the first of two letters that undo each other, and
    w what lies between, which has undone itself. While no support lies between c and its undoing,
    they are on one span; while none lies between the older visits of two letters that undo each
    other in c w, those are on one older span. Then c w and the undoing cancel in the words of all
    such sets. Either c undoes a letter before it, or it is undone by one behind it: in both cases
    it is lost. Of the letter that undid c that cannot be said: it may take the place of one before.

    Examples
    --------
    >>> from knotopt.catalogue.knots import shipped_knots
    >>> cable = Cable(shipped_knots()["6_3"].diagram, "L+")
    >>> [(lost.crossing, str(lost.loss)) for lost in lost_hooks(cable, (5, 7, 13))]
    [(0, 'undone by the next crossing'), (1, 'undone by the next crossing')]
    """
    crossings = cable.crossings
    times = robot_times(cable, supports)
    first, second = np.searchsorted(times, (crossings.first, crossings.second), side="left")
    own: list[int] = np.flatnonzero(first == second).tolist()
    found = [LostHook(c, Loss.ONE_SPAN, _loop(cable, c)) for c in own if crossings.first_over[c]]
    for word in letters_of_grid(cable, supports):
        found += _undone(cable, word, own)
    return tuple(sorted(found, key=lambda each: each.crossing))


def flown_crossings(cable: Cable, supports: tuple[int, ...]) -> tuple[int, ...]:
    """The crossings of different spans that nothing undoes: those that the leader makes.

    Parameters, raises
        As for `lost_hooks`.

    Returns
    -------
    tuple of int
        Indices into `cable.crossings`, ascending.
    """
    words = letters_of_grid(cable, supports)
    ranks = {letter.rank for word in words for letter in reduced(word)}
    return tuple(
        c for c, first in enumerate(cable.crossings.first.tolist()) if float(first) in ranks
    )


def _undone(cable: Cable, word: tuple[Letter, ...], own: list[int]) -> list[LostHook]:
    """The hooks of one span that the next crossing undoes.

    `own` are the crossings of spans with themselves.
    """
    crossings = cable.crossings
    number = {float(first): c for c, first in enumerate(crossings.first.tolist())}
    index = [number[letter.rank] for letter in word if letter.rank is not None]
    pairs = undone_pairs(word)
    found = []
    for place, back in pairs:
        if word[place].over:
            continue
        start, end = (int(crossings.second[index[k]]) for k in (place, back))
        bare = _turning_points(cable, start, end)
        for inner, its_back in pairs:
            if place <= inner <= back:
                visits = sorted(int(crossings.first[index[k]]) for k in (inner, its_back))
                bare |= _turning_points(cable, *visits)
        for c in own:
            if start < crossings.second[c] < end:
                bare |= _loop(cable, c)
        found.append(LostHook(index[place], Loss.UNDONE, bare))
        found.append(LostHook(index[back], Loss.UNDONE, None))
    return found


def _loop(cable: Cable, crossing: int) -> frozenset[int]:
    """Turning points between the visits of a crossing."""
    crossings = cable.crossings
    return _turning_points(cable, int(crossings.first[crossing]), int(crossings.second[crossing]))


def _turning_points(cable: Cable, start: int, end: int) -> frozenset[int]:
    """Those between two times (1-based)."""
    first, last = np.searchsorted(cable.times, (start, end))
    return frozenset(range(int(first) + 1, int(last) + 1))
