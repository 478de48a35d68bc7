"""Colours of robots and spans, from tail to leader."""

from __future__ import annotations

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
    last = len(STOPS) - 1
    colours = []
    for index in range(count):
        place = last * index / max(count - 1, 1)
        low = min(int(place), last - 1)
        share = place - low
        mixed = (
            round(a + share * (b - a)) for a, b in zip(STOPS[low], STOPS[low + 1], strict=True)
        )
        colours.append("#" + "".join(f"{value:02x}" for value in mixed))
    return colours
