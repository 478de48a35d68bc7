"""Crossings of a grid, and the fewest robots that lay it: one support on every loop of the cable.

A loop is what a crossing cuts off: the cable from its one visit to its other, whose turning points
are an interval of the closed path. The fewest supports of a cut are found by a sweep that places
each as late as it can (greedy interval piercing), for all cuts together by one table of where the
next loop closes.
"""

from __future__ import annotations

from knotopt.search.lines import Lines

NONE = 1 << 40
"""No crossing: farther than any other."""


def find_crossings(lines: Lines, size: int, reach: list[int]) -> int:
    """The number of crossings, and from each segment how far its nearest loop reaches.

    Parameters
    ----------
    lines : Lines
    size : int
        At most 62 where integers have 64 bits.
    reach : list of int, length at least 2 `size`
        Set to the least number of segments ahead on the closed path at which one is crossed that
        this one crosses; `NONE` for a segment without crossings.
    """
    minus, plus, place, cross_place = lines[0], lines[1], lines[4], lines[5]
    length = 2 * size
    for segment in range(length):
        reach[segment] = NONE
    count = 0
    passing = 0  # bits of the rows whose segments pass this column or end in it
    for column in range(size):
        ends = (1 << minus[column]) | (1 << plus[column])
        row = min(minus[column], plus[column])
        between = (1 << max(minus[column], plus[column])) - (2 << row)
        crossed = passing & ~ends & between
        passing ^= ends
        here = place[column]
        while crossed:
            row += 1
            if (crossed >> row) & 1:
                crossed ^= 1 << row
                count += 1
                there = cross_place[row]
                ahead = there - here
                if ahead < 0:
                    ahead += length
                reach[here] = min(reach[here], ahead)
                reach[there] = min(reach[there], length - ahead)
    return count


def fewest_robots(size: int, reach: list[int], closing: list[int]) -> int:
    """The fewest robots under `loops` over all crossing-free cuts.

    Parameters
    ----------
    size : int
    reach : list of int, length at least 2 `size`
        As `find_crossings` sets it.
    closing : list of int, length at least 2 `size`
        Set to the segment at which, from each one on, the first loop closes.

    Returns
    -------
    int
        `NONE` if every segment is crossed, which no grid's are.
    """
    length = 2 * size
    soonest = NONE
    for segment in range(2 * length - 1, -1, -1):
        if segment >= length:
            soonest = min(soonest, segment + reach[segment - length])
        else:
            soonest = min(soonest, segment + reach[segment])
            closing[segment] = soonest
    fewest = NONE
    for cut in range(length):
        if reach[cut] == NONE:
            robots, at = 2, cut + 1
            while robots < fewest:
                close = closing[at] if at < length else closing[at - length] + length
                if close >= cut + length:
                    break
                robots += 1  # at the turning point where the closing segment begins
                at = close
            fewest = min(fewest, robots)
    return fewest
