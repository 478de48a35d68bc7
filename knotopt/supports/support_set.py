"""A set of support robots on a cable, whichever method chose it."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Iterable

from knotopt.cable.cable import Cable
from knotopt.showing import ShownShort, plural


class SupportSet(ShownShort, ABC):
    """What every method's result says of its supports."""

    supports: tuple[int, ...]
    """Turning points that carry a support robot (1-based on the path), without p_1 and p_n."""

    @property
    @abstractmethod
    def cable(self) -> Cable:
        """The cable the supports belong to."""

    @property
    def in_words(self) -> str:
        """How many robots, on which cut."""
        return f"cut {self.cable.cut}, {plural(self.robots, 'robot')} instead of {self.baseline}"

    @property
    def robots(self) -> int:
        """Robots after reduction: the supports and the two lifting robots."""
        return len(self.supports) + 2

    @property
    def baseline(self) -> int:
        """Robots before reduction: one at each of the 2N turning points."""
        return len(self.cable.path)

    @property
    def reduction_percent(self) -> float:
        """Share of the baseline's robots that is saved [percent, to one decimal]."""
        return round(100 * (self.baseline - self.robots) / self.baseline, 1)

    @property
    def placed_supports(self) -> tuple[tuple[int, int, int], ...]:
        """[index on the path (1-based), column, row] of each support."""
        return place(self.cable, self.supports)


def place(cable: Cable, supports: Iterable[int]) -> tuple[tuple[int, int, int], ...]:
    """[index on the path (1-based), column, row] of each support."""
    return tuple((index, *cable.path[index - 1]) for index in supports)


def format_supports(placed: Iterable[tuple[int, int, int]]) -> str:
    """Placed supports as text.

    Examples
    --------
    >>> format_supports([(3, 3, 2), (4, 5, 2)])
    'p3[3,2] p4[5,2]'
    """
    return " ".join(f"p{index}[{column},{row}]" for index, column, row in placed)
