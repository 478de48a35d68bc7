"""The words of spans: against the grid's segments, and the grid's path across straight spans."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from knotopt import Cable, shipped_knots
from knotopt.arrays import FloatArray
from knotopt.flight.grid_layout import NUDGE, span_words
from knotopt.flight.layout import Letter
from tests.helpers.strategies import cables


def cross(a: FloatArray, b: FloatArray) -> float:
    return float(a[0] * b[1] - a[1] * b[0])


def met_segments(cable: Cable) -> list[list[tuple[int, bool, int]]]:
    """For each segment of the path, in order: older segment, over, sense; columns are over rows."""
    points = np.array(cable.path, dtype=float)
    found = []
    for span, (a, b) in enumerate(pairwise(points), 1):
        met = []
        for older, (c, d) in enumerate(pairwise(points[:span]), 1):
            if cross(b - a, d - c) == 0:
                continue
            share = cross(c - a, d - c) / cross(b - a, d - c)
            there = cross(c - a, b - a) / cross(b - a, d - c)
            if 0 < share < 1 and 0 < there < 1:
                sense = 1 if cross(d - c, b - a) > 0 else -1
                met.append((share, (older, bool(a[0] == b[0]), sense)))
        found.append([letter for _, letter in sorted(met)])
    return found


def signed_crossings(path: FloatArray, start: FloatArray, end: FloatArray) -> int:
    """How often a path goes from right to left of a straight span, less the way back."""
    count = 0
    for a, b in pairwise(path):
        sides = cross(end - start, a - start), cross(end - start, b - start)
        ends = cross(b - a, start - a), cross(b - a, end - a)
        if sides[0] * sides[1] < 0 and ends[0] * ends[1] < 0:
            count += 1 if sides[1] > 0 else -1
    return count


def short(word: tuple[Letter, ...]) -> list[tuple[int, bool, int]]:
    return [(letter.older, letter.over, letter.sense) for letter in word]


@settings(max_examples=100)
@given(cables())
def test_with_all_turning_points_words_are_the_crossings_in_order(cable: Cable) -> None:
    words = span_words(cable, tuple(range(2, len(cable.path))))
    assert [short(word) for word in words] == met_segments(cable)
    visited = sorted(cable.crossings, key=lambda crossing: crossing.second)
    letters = [letter for word in words for letter in word]
    assert [letter.rank for letter in letters] == [crossing.first for crossing in visited]


@settings(max_examples=200)
@given(cables(4, 9), st.data())
def test_a_word_crosses_straight_spans_as_often_as_the_grid_path_does(
    cable: Cable, data: st.DataObject
) -> None:
    """A route with these letters can be drawn straight: it winds about no robot that is passed.

    Between fixed ends, how often a route crosses a straight span, signed, is the same for all
    routes that do not pass the span's ends on another side; the grid's path is one of them.
    """
    inner = range(2, len(cable.path))
    supports = tuple(k for k in inner if data.draw(st.booleans(), label=f"p{k}"))
    words = span_words(cable, supports)
    assert len(words) == len(supports) + 1
    robots = [0, *(k - 1 for k in supports), len(cable.path) - 1]
    points = cable.points.astype(float)
    for span, word in enumerate(words, 1):
        path = points[robots[span - 1] : robots[span] + 1] + NUDGE
        for older in range(1, span - 1):
            ends = points[robots[older - 1]], points[robots[older]]
            count = sum(letter.sense for letter in word if letter.older == older)
            assert count == signed_crossings(path, *ends), f"span {span}, older {older}"


@settings(max_examples=200)
@given(cables(4, 9), st.data())
def test_letters_are_crossings_of_the_grid_or_detours_over_a_span(
    cable: Cable, data: st.DataObject
) -> None:
    inner = range(2, len(cable.path))
    supports = tuple(k for k in inner if data.draw(st.booleans(), label=f"p{k}"))
    robots = np.array([0, *(cable.times[k - 1] for k in supports), cable.length])
    crossings = {crossing.first: crossing for crossing in cable.crossings}
    for span, word in enumerate(span_words(cable, supports), 1):
        for letter in word:
            assert 1 <= letter.older < span and letter.sense in (1, -1)
            if letter.rank is None:
                assert letter.over
                continue
            crossing = crossings[int(letter.rank)]
            assert letter.over is not crossing.first_over
            assert robots[letter.older - 1] < crossing.first < robots[letter.older]
            assert robots[span - 1] < crossing.second < robots[span]
        times = [crossings[int(x.rank)].second for x in word if x.rank is not None]
        assert times == sorted(times)
        assert not any(a.cancels(b) or b.cancels(a) for a, b in pairwise(word))


@settings(max_examples=50)
@given(cables(3, 9))
def test_without_supports_there_is_nothing_to_cross(cable: Cable) -> None:
    assert span_words(cable, ()) == ((),)


def test_a_robot_on_the_wrong_side_of_a_straight_span_is_reached_over_it() -> None:
    """All but one support of the trefoil's grid: the one missing makes the span cut a corner."""
    cable = Cable(shipped_knots()["3_1"].diagram, "L+")
    everywhere = tuple(range(2, len(cable.path)))
    detours = 0
    for left_out in everywhere:
        words = span_words(cable, tuple(k for k in everywhere if k != left_out))
        detours += sum(letter.rank is None for word in words for letter in word)
    assert detours > 0


def test_letters_in_words_and_their_inverses() -> None:
    letter = Letter(2, True, 1, None)
    assert str(letter) == "over span 2" and str(Letter(3, False, 1, 2.0)) == "under span 3"
    assert letter.cancels(Letter(2, True, -1, 4.0))
    for other in (Letter(2, True, 1, None), Letter(2, False, -1, None), Letter(3, True, -1, None)):
        assert not letter.cancels(other)
