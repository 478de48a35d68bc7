"""All that a flight is planned from: where robots shall hover, and what every span shall cross.

Span j is the cable from robot j to robot j + 1. While the leader flies it, spans 1 to j - 1 are
laid. Its word is the list of its crossings with them in the order of flight, each a letter.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Protocol, Self, TypeVar

import numpy as np
from numpy.typing import ArrayLike

from knotopt.arrays import FloatArray
from knotopt.cable.cable import frozen
from knotopt.errors import RequirementError

OUTSIDE = 20.0  # as far as no route goes [grid steps]


@dataclass(frozen=True)
class Letter:
    """One crossing of a route with an older span.

    Attributes
    ----------
    older : int
        The older span, from 1.
    over : bool
        Whether the route passes over it.
    sense : int
        +1 where the route goes from the right of the older span to its left, else -1.
    rank : float or None
        Crossings of one older span come along it in ascending order of this number; on the cable of
        a grid it is the time of the first visit [grid steps]. None for a crossing that may come
        anywhere.
    """

    older: int
    over: bool
    sense: int
    rank: float | None

    def cancels(self, other: Letter) -> bool:
        """Whether this letter followed by the other is no crossing at all."""
        return (self.older, self.over, self.sense) == (other.older, other.over, -other.sense)

    def __str__(self) -> str:
        return f"{'over' if self.over else 'under'} span {self.older}"


Word = tuple[Letter, ...]


class Cancelling(Protocol):
    """What may undo another of its kind, such as a letter."""

    def cancels(self, other: Self, /) -> bool: ...


AnyCancelling = TypeVar("AnyCancelling", bound=Cancelling)


def reduced(letters: Iterable[AnyCancelling]) -> tuple[AnyCancelling, ...]:
    """What is left when neighbours that cancel are taken out, repeatedly.

    Examples
    --------
    >>> there, back = Letter(1, True, 1, None), Letter(1, True, -1, None)
    >>> under = Letter(2, False, 1, None)
    >>> reduced([there, under, there, back]) == (there, under)
    True
    """
    letters = tuple(letters)
    undone = {place for pair in undone_pairs(letters) for place in pair}
    return tuple(letter for place, letter in enumerate(letters) if place not in undone)


def undone_pairs(letters: Sequence[Cancelling]) -> tuple[tuple[int, int], ...]:
    """Places, from 0, of the letters that are taken out, with those that undo them.

    A letter undoes the last one before it that is left.

    Examples
    --------
    >>> there, back = Letter(1, True, 1, None), Letter(1, True, -1, None)
    >>> undone_pairs([there, there, back, there])
    ((1, 2),)
    """
    pairs, left = [], list[int]()
    for place, letter in enumerate(letters):
        if left and letters[left[-1]].cancels(letter):
            pairs.append((left.pop(), place))
        else:
            left.append(place)
    return tuple(pairs)


@dataclass(frozen=True, eq=False)
class Layout:
    """Places of the robots and words of the spans between them.

    Parameters
    ----------
    places : float array, shape (R, 2)
        Of the robots in plan, from the cable's first end to its last [grid steps].
    words : sequence of sequence of Letter
        One for each of the R - 1 spans.
    outwards : array of two numbers
        Direction in plan away from the knot at the first end, made a unit vector: there the robots
        queue, and the cable's tail lies, which no route crosses.

    Raises
    ------
    RequirementError
        Words or a direction that do not fit the places.

    Examples
    --------
    A trefoil with one support: the second span winds about the first.

    >>> over_under = [Letter(1, True, 1, 0), Letter(1, False, -1, 1)]
    >>> Layout([[0, 0], [6, 0], [3, 3]], [[], over_under], (-1, 0)).robots
    3
    """

    places: FloatArray
    words: tuple[Word, ...]
    outwards: FloatArray

    def __init__(
        self,
        places: ArrayLike,
        words: Sequence[Sequence[Letter]],
        outwards: ArrayLike,
    ) -> None:
        object.__setattr__(self, "places", frozen(np.array(places, dtype=np.float64)))
        object.__setattr__(self, "words", tuple(tuple(word) for word in words))
        direction = np.array(outwards, dtype=np.float64)
        if direction.shape != (2,) or not direction.any():
            raise RequirementError(f"{direction.tolist()} is no direction in plan")
        object.__setattr__(self, "outwards", frozen(direction / np.hypot(*direction)))
        if self.places.ndim != 2 or self.places.shape[1] != 2 or self.robots < 2:
            raise RequirementError(f"places have the shape {self.places.shape}, expected (R, 2)")
        if len(self.words) != self.robots - 1:
            raise RequirementError(
                f"{self.robots} robots have {self.robots - 1} spans between them, "
                f"not {len(self.words)}"
            )
        for span, word in enumerate(self.words, 1):
            for letter in word:
                if not 1 <= letter.older < span:
                    raise RequirementError(f"span {span} crosses no laid cable {letter}")

    @property
    def robots(self) -> int:
        """Number of robots R."""
        return len(self.places)

    @property
    def tail(self) -> FloatArray:
        """The line in plan along which the robots come, shape (2, 2)."""
        return np.stack((self.places[0], self.places[0] + OUTSIDE * self.outwards))
