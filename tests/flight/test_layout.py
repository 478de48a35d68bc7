"""Layouts: what is refused, and a flight planned from places and words alone."""

from __future__ import annotations

import re
from dataclasses import replace

import numpy as np
import pytest

from knotopt import Cable, shipped_knots
from knotopt.errors import RequirementError
from knotopt.flight.layout import Layout, Letter
from knotopt.flight.limits import ROOM, FlightLimits
from knotopt.flight.planner import FlightPlanner, plan_flight
from knotopt.flight.route import SpanShape
from knotopt.verify.flight_word import compare_words, plan_word
from tests.helpers.layouts import TREFOIL

PLACES = [[0.0, 0.0], [4.0, 0.0], [1.0, 3.0]]
LETTER = Letter(1, True, 1, None)


def test_a_flight_of_a_layout_without_a_grid_crosses_what_its_words_say() -> None:
    planner = FlightPlanner(TREFOIL).with_routes(SpanShape()).spaced_out()
    motion = planner.motion("fixed")
    assert motion.robots == 3
    places = TREFOIL.places * ROOM.step
    assert motion.anchors[:, :2] == pytest.approx(places, abs=5e-3)
    assert [crossing.name for crossing in motion.crossings] == [
        "span 2 over span 1",
        "span 2 under span 1",
    ]
    formation = planner.formation()
    passes = np.array([formation.arc_length(stop) for stop in formation.stops[:-1]])
    found = plan_word(motion.route, passes, motion.anchors, motion.lengths)
    rows = compare_words(motion.crossings, found)
    assert [row.kind for row in rows] == ["as planned", "as planned"]
    # The robots come along the tail, from the left.
    assert (np.diff(motion.positions[0, :, 0]) > 0).all()
    assert motion.positions[0, :, 1] == pytest.approx(0.0, abs=0.01)


def test_places_and_words_of_a_grid_written_by_hand_give_the_grid_s_flight() -> None:
    cable = Cable(shipped_knots()["3_1"].diagram, "R+")
    words = [[], [Letter(1, True, -1, 5), Letter(1, False, 1, 12)]]
    layout = Layout([[5, 1], [2, 2], [5, 4]], words, outwards=(2, 0))
    planner = FlightPlanner(layout, ROOM, FlightLimits())
    by_hand = planner.with_routes(SpanShape()).spaced_out().motion("fixed")
    plan = plan_flight("3_1", cable, (8,), schedule="fixed")
    assert np.array_equal(plan.positions, by_hand.positions)
    assert plan.crossings == by_hand.crossings and np.array_equal(plan.lengths, by_hand.lengths)


def test_a_step_leaves_the_planner_before_it_as_it_was() -> None:
    planner = FlightPlanner(TREFOIL)
    planned = planner.with_routes(SpanShape())
    wider = replace(planned, spacing=0.5)
    assert (planner.spans, planner.lengths) == ((), ())
    assert len(planned.spans) == len(planned.lengths) == 2
    assert (planned.spacing, wider.spacing) == (0.3, 0.5)
    shorter = planned.with_flown(planned.formation().stops[1])
    assert len(planned.flown) == 0 < len(shorter.flown)


@pytest.mark.parametrize(
    ("places", "words", "outwards", "message"),
    [
        ([[0.0, 0.0]], [], (1, 0), "places have the shape (1, 2), expected (R, 2)"),
        (np.zeros((2, 3)), [[]], (1, 0), "places have the shape (2, 3), expected (R, 2)"),
        (PLACES, [[]], (1, 0), "3 robots have 2 spans between them, not 1"),
        (PLACES, [[LETTER], []], (1, 0), "span 1 crosses no laid cable over span 1"),
        (PLACES, [[], [Letter(2, True, 1, 0)]], (1, 0), "span 2 crosses no laid cable over span 2"),
        (PLACES, [[], [LETTER]], (0, 0), "[0.0, 0.0] is no direction in plan"),
    ],
)
def test_layouts_that_make_no_sense(
    places: list[list[float]],
    words: list[list[Letter]],
    outwards: tuple[float, float],
    message: str,
) -> None:
    with pytest.raises(RequirementError, match=re.escape(message)):
        Layout(places, words, outwards)
