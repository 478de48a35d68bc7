"""The layout of a grid's cable with supports: what a flight must cross, span by span.

The letters of a span's word are the crossings of the grid, and more because a laid span is straight
where the grid's is not. Between the two lie places of robots that come later; such a robot is on
the wrong side of the straight span, and is reached, and left again, over that span. (The other way
round, past the tail, a slack cable would slip off over p_1.)

A letter and the next one cancel if they cross the same span on the same side, there and back: the
cable can be drawn straight there, as it will be between its robots. Crossings of a span with itself
are left out for the same reason.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from knotopt.arrays import FloatArray, IntArray
from knotopt.cable.cable import Cable
from knotopt.flight.layout import Layout, Letter, Word, reduced
from knotopt.path.mesh import robot_times

NUDGE = np.array([1.7e-6, 1.1e-6])  # off lattice points, through which straight spans may pass


def layout_of_supports(cable: Cable, supports: tuple[int, ...]) -> Layout:
    """Robots at the cable's ends and at its supports; words as the grid has them.

    Parameters
    ----------
    cable : Cable
    supports : tuple of int
        Turning points with a support robot (1-based).

    Raises
    ------
    RequirementError
        A support that is no turning point between the ends.
    """
    places = cable.cells[robot_times(cable, supports)]
    outwards = np.sign(cable.points[0] - cable.points[1])
    return Layout(places.astype(float), span_words(cable, supports), outwards)


def span_words(cable: Cable, supports: tuple[int, ...]) -> tuple[Word, ...]:
    """The word of every span, from 1 to R - 1, reduced.

    Parameters
    ----------
    cable : Cable
    supports : tuple of int
        Turning points with a support robot (1-based).

    Examples
    --------
    With a robot at every turning point each span has the crossings of its grid segment; with
    fewer, a span may have several.

    >>> from knotopt.reading.knot import read_knot
    >>> cable = Cable(read_knot("3").diagram, "L+")
    >>> [" ".join(map(str, word)) for word in span_words(cable, (3, 4, 6)) if word]
    ['over span 1 under span 1 over span 2']
    """
    times = robot_times(cable, supports)
    places = cable.cells[times].astype(float)
    found = []
    for span, word in enumerate(letters_of_grid(cable, supports), 1):
        leaving = _swept(cable, times, places, span - 1, span)
        entering = _swept(cable, times, places, span, span)
        inverse = [replace(letter, sense=-letter.sense) for letter in reversed(leaving)]
        found.append(reduced([*inverse, *word, *entering]))
    return tuple(found)


def letters_of_grid(cable: Cable, supports: tuple[int, ...]) -> tuple[Word, ...]:
    """The crossings of every span with older ones, as they come along it on the grid.

    A letter's rank is the time of the crossing's first visit.

    Parameters
    ----------
    cable : Cable
    supports : tuple of int
        Turning points with a support robot (1-based).
    """
    times = robot_times(cable, supports)
    words: list[list[Letter]] = [[] for _ in times[1:]]
    for crossing in sorted(cable.crossings, key=lambda each: each.second):
        older, span = np.searchsorted(times, (crossing.first, crossing.second), side="left")
        if older != span:
            over = not crossing.first_over
            sense = -crossing.sign if over else crossing.sign
            words[span - 1].append(Letter(int(older), over, sense, float(crossing.first)))
    return tuple(map(tuple, words))


def _swept(
    cable: Cable, times: IntArray, places: FloatArray, robot: int, span: int
) -> list[Letter]:
    """Letters by which robot `robot` (from 0) is reached past the spans laid before `span`.

    The place of a robot is swept by a span if the closed curve along the grid's span and back along
    the straight one winds about it. Nearer spans come later.
    """
    found = []
    place = places[robot] + NUDGE
    for older in range(1, min(span, robot)):
        start, end = times[older - 1], times[older]
        turns = _winding(cable.cells[start : end + 1].astype(float), place)
        chord = places[older] - places[older - 1]
        normal = np.array([-chord[1], chord[0]]) / np.hypot(*chord)
        apart = abs(float(normal @ (place - places[older - 1])))
        letter = Letter(older, True, -int(np.sign(turns)), None)
        found += [(apart, letter)] * abs(turns)
    return [letter for _, letter in sorted(found, key=lambda each: -each[0])]


def _winding(curve: FloatArray, point: FloatArray) -> int:
    """How often a closed polygon winds about a point."""
    there = curve - point
    following = np.roll(there, -1, axis=0)
    cross = there[:, 0] * following[:, 1] - there[:, 1] * following[:, 0]
    angles = np.arctan2(cross, (there * following).sum(axis=1))
    return round(float(angles.sum()) / (2 * np.pi))
