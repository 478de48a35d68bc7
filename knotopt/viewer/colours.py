"""Colours of robots and spans, from tail to leader."""

from __future__ import annotations

import numpy as np

# Okabe and Ito's palette without the yellow, which is lost on white, in the order of the rainbow;
# robots carry numbers as well.
STOPS = ((0, 114, 178), (86, 180, 233), (0, 158, 115), (230, 159, 0), (213, 94, 0), (204, 121, 167))


def ramp(count: int) -> list[str]:
    """So many colours, evenly along the palette.

    Examples
    --------
    >>> ramp(3)
    ['#0072b2', '#739e3a', '#cc79a7']
    >>> ramp(1)
    ['#0072b2']
    """
    stops = np.arange(len(STOPS))
    places = stops[-1] * np.arange(count) / max(count - 1, 1)
    mixed = [
        np.interp(places, stops, channel).round().astype(int)
        for channel in zip(*STOPS, strict=True)
    ]
    return [f"#{r:02x}{g:02x}{b:02x}" for r, g, b in zip(*mixed, strict=True)]
