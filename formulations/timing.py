"""What is left of a time limit that several solves share."""

from __future__ import annotations

import time
from dataclasses import replace

from formulations.solution import Limits

LEAST = 1e-3  # a solver is always given some time [s]


class Deadline:
    """A time limit that starts now."""

    def __init__(self, limits: Limits) -> None:
        self.limits = limits
        self.started = time.perf_counter()

    @property
    def passed(self) -> bool:
        """Whether the time is over."""
        seconds = self.limits.seconds
        return seconds is not None and time.perf_counter() - self.started > seconds

    def left(self) -> Limits:
        """The same limits with the seconds that remain."""
        if self.limits.seconds is None:
            return self.limits
        spent = time.perf_counter() - self.started
        return replace(self.limits, seconds=max(LEAST, self.limits.seconds - spent))
