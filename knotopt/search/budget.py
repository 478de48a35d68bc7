"""How long a search goes on: so many grids, which gives the same every time, or so many seconds."""

from __future__ import annotations

import re
from dataclasses import dataclass

from knotopt.errors import RequirementError


@dataclass(frozen=True)
class Budget:
    """Of a search; it ends with the step that reaches one of them.

    Parameters
    ----------
    grids : int, optional
        Grids looked at.
    seconds : float, optional

    Raises
    ------
    RequirementError
        Neither is given, or one is not positive.
    """

    grids: int | None = None
    seconds: float | None = None

    def __post_init__(self) -> None:
        given = [value for value in (self.grids, self.seconds) if value is not None]
        if not given or not all(0 < value < float("inf") for value in given):
            raise RequirementError("a budget is a positive number of grids, or of seconds")

    @classmethod
    def parse(cls, text: str) -> Budget:
        """A budget as it is written: "5s" or "0.5 s" for seconds, "2000000" for grids.

        Examples
        --------
        >>> Budget.parse("5s"), Budget.parse("2_000_000")
        (Budget(grids=None, seconds=5.0), Budget(grids=2000000, seconds=None))
        """
        seconds = re.fullmatch(r"\s*(\d{1,9}(?:\.\d*)?|\.\d+)\s*s\s*", text)
        if seconds:
            return cls(seconds=float(seconds[1]))
        if re.fullmatch(r"\s*\d[\d_]{0,17}\s*", text):
            return cls(grids=int(text))
        raise RequirementError(
            f"a budget is seconds, such as 5s, or a number of grids, such as 2000000, not {text!r}"
        )

    def is_spent(self, grids: int, seconds: float) -> bool:
        """Whether so many grids or seconds are enough."""
        return (self.grids is not None and grids >= self.grids) or (
            self.seconds is not None and seconds >= self.seconds
        )

    def __str__(self) -> str:
        return f"{self.seconds:g} s" if self.grids is None else f"{self.grids} grids"
