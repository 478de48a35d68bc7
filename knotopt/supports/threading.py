"""Which turning points inside a region count as threading it.

Paper, section III.A.2. `turning-point`, the paper's mode, counts every one later on the path than
the region's start; `over-under` only those where the strand enters over the boundary and leaves
under it or the reverse (a strand that is over both times can be lifted off; one that ends inside
does not leave).
"""

from __future__ import annotations

from enum import StrEnum


class Threading(StrEnum):
    """Which turning points inside a region thread it."""

    TURNING_POINT = "turning-point"
    OVER_UNDER = "over-under"
