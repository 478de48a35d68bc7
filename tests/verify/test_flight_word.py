"""Words flown against words planned, and words of routes round all corners."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from knotopt import Cable
from knotopt.verify.flight_word import (
    RouteCrossing,
    catenary_height,
    compare_words,
    plan_word,
    reduced_word,
)
from tests.helpers.strategies import cables


@dataclass(frozen=True)
class Planned:
    """A planned letter."""

    span: int
    older: int
    over: bool
    sense: int


def executed(planned: Planned, route: float, gap: float | None = None) -> RouteCrossing:
    height = (0.2 if planned.over else -0.2) if gap is None else gap
    return RouteCrossing(
        planned.span, planned.older, height > 0, planned.sense, (0, 0), height, 0.0, route
    )


WORD = [Planned(4, 1, True, 1), Planned(4, 1, False, -1), Planned(4, 2, True, 1)]


def test_a_word_flown_as_planned() -> None:
    rows = compare_words(WORD, [executed(letter, k) for k, letter in enumerate(WORD)])
    assert [row.kind for row in rows] == ["as planned"] * 3
    expected = "span 4 under span 1: 1.00 m along the route, 0.20 m below the strand"
    assert rows[1].sentence == expected


def test_a_dip_that_was_too_shallow() -> None:
    """Under becomes over; then over and back over span 1 undo each other."""
    found = [executed(WORD[0], 1), executed(WORD[1], 2, 0.12), executed(WORD[2], 3)]
    rows = compare_words(WORD, found, [(0.0, 1.0), (0.03, 2.0), (0.0, 3.0)])
    assert [row.kind for row in rows] == ["missing", "wrong height", "as planned"]
    assert rows[0].sentence == (
        "span 4 over span 1: missing: crossed 1.00 m along the route and undone "
        "2.00 m along the route"
    )
    assert rows[1].sentence == (
        "span 4 under span 1: executed as over 2.00 m along the route: "
        "the leader was 0.12 m above the strand"
    )


def test_there_and_back_over_a_span_of_which_one_fails() -> None:
    """Planned over span 2 and back over it; the way back came out below, or not at all."""
    plan = [Planned(5, 2, True, -1), Planned(7, 2, True, 1), Planned(8, 3, True, 1)]
    way = executed(plan[0], 1), executed(plan[1], 2, -0.02), executed(plan[2], 3)
    assert [row.kind for row in compare_words(plan, way)] == [
        "as planned",
        "wrong height",
        "as planned",
    ]
    rows = compare_words(plan, [way[0], way[2]])
    assert [row.kind for row in rows] == ["as planned", "missing", "as planned"]
    assert [row.kind for row in compare_words(plan, way[2:])] == ["as planned"]


def test_a_letter_that_was_never_crossed() -> None:
    rows = compare_words(WORD[2:], [], [(0.3, 31.2)])
    assert [row.sentence for row in rows] == [
        "span 4 over span 2: missing: never crossed; nearest approach 0.30 m at 31.20 s of the plan"
    ]
    assert compare_words(WORD[2:], [])[0].sentence.endswith("missing: never crossed")


def test_a_single_letter_at_the_wrong_height_or_from_the_wrong_side() -> None:
    found = [executed(WORD[0], 1, -0.12), executed(replace(WORD[2], sense=-1), 3)]
    rows = compare_words([WORD[0], WORD[2]], found)
    assert [row.kind for row in rows] == ["wrong height", "wrong way"]
    assert rows[0].sentence == (
        "span 4 over span 1: executed as under 1.00 m along the route: "
        "the leader was 0.12 m below the strand"
    )
    assert rows[1].sentence.startswith("span 4 over span 2: crossed the other way, from left to r")


def test_missing_and_extra_letters() -> None:
    other, own = Planned(4, 3, False, 1), Planned(4, 5, True, 1)
    found = [executed(letter, k) for k, letter in enumerate([WORD[0], other, WORD[1], own])]
    rows = compare_words(WORD, found, [(0.0, 1.0), (0.0, 2.0), (math.inf, math.nan)])
    kinds = [row.kind for row in rows]
    assert kinds[:3] == ["as planned", "extra", "as planned"]
    assert sorted(kinds[3:]) == ["extra", "missing"]
    sentences = [row.sentence for row in rows]
    assert "extra: span 4 under span 3 1.00 m along the route" in sentences
    assert (
        "extra: on span 4 the leader crossed over its own tether 3.00 m along the route"
        in sentences
    )
    assert "span 4 over span 2: missing: the flight did not get that far" in sentences


@given(
    st.lists(
        st.builds(Planned, st.just(5), st.integers(1, 2), st.booleans(), st.sampled_from([1, -1])),
        max_size=12,
    )
)
def test_reduced_words(letters: list[Planned]) -> None:
    """Nothing is left to take out, and inserting a pair that undoes itself changes nothing."""
    word = reduced_word(letters)
    assert all(
        (a.older, a.over) != (b.older, b.over) or a.sense == b.sense for a, b in pairwise(word)
    )
    pair = [Planned(5, 1, True, 1), Planned(5, 1, True, -1)]
    for place in range(len(letters) + 1):
        assert reduced_word(letters[:place] + pair + letters[place:]) == word
    assert reduced_word([*letters, *(replace(x, sense=-x.sense) for x in letters[::-1])]) == ()
    rows = compare_words(letters, [executed(letter, k) for k, letter in enumerate(letters)])
    assert [row.kind for row in rows] == ["as planned"] * len(word)


@given(cables(2, 8))
@settings(max_examples=40)
def test_the_word_of_a_grid_path_flown_round_all_corners(cable: Cable) -> None:
    """Every corner an anchor, the route 0.6 above or below the grid at second visits."""
    crossings = sorted(cable.crossings, key=lambda crossing: crossing.second)
    along = np.arange(0, cable.length + 1e-9, 0.25)
    x, y = (np.interp(along, np.arange(cable.length + 1), axis) for axis in cable.cells.T)
    z = np.zeros_like(along)
    for crossing in crossings:
        z[np.abs(along - crossing.second) < 0.3] = -0.6 if crossing.first_over else 0.6
    route = np.stack((x, y, z), axis=1)
    way = np.concatenate(([0], np.cumsum(np.linalg.norm(np.diff(route, axis=0), axis=1))))
    anchors = np.column_stack((cable.points, np.zeros(len(cable.points))))
    lengths = np.diff(cable.times) * 1.001
    word = plan_word(route, np.interp(cable.times[:-1], along, way), anchors, lengths)
    assert len(word) == len(crossings)
    planned = []
    for found, crossing in zip(word, crossings, strict=True):
        assert found.place == pytest.approx((crossing.column, crossing.row), abs=1e-9)
        assert -0.4 < found.cable_height < 0
        older = int(np.searchsorted(cable.times, crossing.first))
        span = int(np.searchsorted(cable.times, crossing.second))
        sense = crossing.sign if crossing.first_over else -crossing.sign
        planned.append(Planned(span, older, not crossing.first_over, sense))
    assert [(f.span, f.older, f.over, f.sense) for f in word] == [
        (p.span, p.older, p.over, p.sense) for p in planned
    ]
    assert all(row.kind == "as planned" for row in compare_words(planned, word))


def test_a_route_above_the_anchors_but_below_a_taut_cable() -> None:
    """Over or under is decided by the catenary, not by the anchors' height."""
    anchors = [[0, 0, 2], [2, 0, 2], [1, 1, 2], [1, -1, 2]]
    route = [[0, 0, 2], [2, 0, 2], [1, 1, 2], [1, 0.2, 1.5], [1, -1, 1.5]]
    passes = np.concatenate(([0], np.cumsum(np.linalg.norm(np.diff(route, axis=0), axis=1))))[:3]
    for length, over in ((2.01, False), (3.0, True)):
        (found,) = plan_word(route, passes, anchors, [length, 2, 3])
        assert (found.span, found.older, found.over, found.sense) == (3, 1, over, -1)
        assert found.when == f"{found.route:.2f} m along the route"


@given(
    st.floats(0.05, 3),
    st.floats(-2, 2),
    st.floats(1e-6, 4),
    st.floats(0, 1),
)
def test_a_catenary_has_its_length_and_hangs(
    across: float, rise: float, slack: float, share: float
) -> None:
    length = math.hypot(across, rise) * (1 + slack)
    ends = np.array([[1.0, 2.0, 0.5], [1 + 0.6 * across, 2 + 0.8 * across, 0.5 + rise]])
    shares = np.linspace(0, 1, 401)
    z = np.array([catenary_height(*ends, length, float(u)) for u in shares])
    assert z[0] == pytest.approx(0.5) and z[-1] == pytest.approx(0.5 + rise)
    assert (np.diff(z, 2) > -1e-9).all()
    measured = np.hypot(np.diff(z), across * np.diff(shares)).sum()
    assert measured == pytest.approx(length, rel=2e-3)
    turned = catenary_height(ends[1], ends[0], length, 1 - share)
    assert catenary_height(*ends, length, share) == pytest.approx(turned, abs=1e-6)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"route": [[0, 0, 0]]}, "route: at least two points"),
        ({"passes": [0.0]}, "3 robots need one pass and one length less"),
        ({"lengths": [1.0, np.nan]}, "not finite"),
        ({"passes": [1.0, 0.5]}, "out of order"),
    ],
)
def test_wrong_plans(change: dict[str, object], message: str) -> None:
    plan: dict[str, object] = {
        "route": [[0, 0, 0], [2, 0, 0]],
        "passes": [0.0, 1.0],
        "anchors": [[0, 0, 0], [1, 0, 0], [2, 0, 0]],
        "lengths": [1.0, 1.0],
    }
    with pytest.raises(ValueError, match=message):
        plan_word(**(plan | change))  # type: ignore[arg-type]
