"""What the judge says of a cable, told by its Alexander polynomial."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
import spherogram

from knotopt.cable.cable import Cable
from knotopt.catalogue.knots import shipped_knots
from knotopt.diagram.grid import GridDiagram
from knotopt.flight.record import Disturbance, FlightRecord
from knotopt.reading.knot import read_knot
from knotopt.sim.judge import Outcome, closed_polynomials, judge, knot_name
from knotopt.sim.material import Material
from tests.helpers.snappy_invariants import invariants, seifert_invariants

TREFOIL = Cable(read_knot("3").diagram, "L+")


def lying(cable: Cable) -> np.ndarray:
    """The grid path lifted by half a step at visits that pass over, as a polyline."""
    where, _, over = cable.visits
    knots = np.unique(np.concatenate((cable.times, where, where - 0.4, where + 0.4)))
    height = np.zeros(len(knots))
    height[np.searchsorted(knots, where)] = np.where(over, 0.5, -0.5)
    plan = [np.interp(knots, cable.times, cable.points[:, k]) for k in (0, 1)]
    return np.column_stack((*plan, height))


def as_record(curve: np.ndarray, **changes: object) -> FlightRecord:
    """A flight that ended with the cable along a curve."""
    record = FlightRecord(
        times=np.zeros(1),
        clock=np.zeros(1),
        cable=curve[None],
        held=np.array([0, len(curve) - 1]),
        finished=True,
        smallest_distance=2 * Material().radius,
        largest_tension=0.1,
        disturbance=Disturbance(),
        seconds=0.0,
    )
    return replace(record, **changes)


@pytest.mark.parametrize(
    "name", ["3_1", "4_1", "5_2", "6_3", "7_4", "8_19", "8_20", "9_42", "10_124", "10_139"]
)
def test_the_judge_knows_lying_cables(name):
    knot = shipped_knots()[name]
    cable = Cable(knot.diagram, "L+")
    verdict = judge(as_record(lying(cable)), cable)
    assert verdict.outcome is Outcome.TIED
    assert name in verdict.knot.split(" or ")
    polynomial, _ = seifert_invariants(spherogram.Link(name))
    assert closed_polynomials(lying(cable)) == (polynomial,) * 3
    assert knot_name(polynomial) == verdict.knot


def test_mirror_images_are_not_told_apart():
    curve = lying(TREFOIL) * [1, 1, -1]
    assert judge(as_record(curve), TREFOIL).outcome is Outcome.TIED


def test_the_judge_takes_a_diagram_too():
    diagram: GridDiagram = read_knot("3").diagram
    verdict = judge(as_record(lying(TREFOIL)), diagram)
    assert verdict.is_wanted
    assert invariants(diagram).alexander == (1, -1, 1)


def test_a_straight_cable_is_the_unknot():
    curve = np.linspace([0.0, 0, 2], [3, 0, 2], 40)
    verdict = judge(as_record(curve), TREFOIL)
    assert verdict.outcome is Outcome.WRONG_KNOT
    assert (verdict.knot, verdict.polynomial) == ("unknot", "1")
    assert str(verdict) == "wrong knot: unknot"


def test_two_trefoils_in_a_row_have_no_name_of_their_own():
    first = lying(TREFOIL)
    second = first + np.array([20.0, 0, 0])
    verdict = judge(as_record(np.vstack((first, second))), TREFOIL)
    assert verdict.polynomial == "1 - 2t + 3t^2 - 2t^3 + t^4"
    assert verdict.knot == "8_20 or 10_140"  # which have the same polynomial


def test_stuck_and_unsound_flights_are_no_success():
    curve = lying(TREFOIL)
    stuck = judge(as_record(curve, finished=False), TREFOIL)
    assert (stuck.outcome, stuck.knot, stuck.is_wanted) == (Outcome.STUCK, "3_1", True)
    tunnelled = judge(as_record(curve, smallest_distance=0.7 * Material().radius), TREFOIL)
    assert (tunnelled.outcome, tunnelled.knot) == (Outcome.UNSOUND, "3_1")
    lost = judge(as_record(np.full((5, 3), np.nan)), TREFOIL)
    assert (lost.outcome, lost.knot) == (Outcome.UNSOUND, None)


def test_an_end_inside_the_tangle_is_unsound():
    """A cable that ends above a strand: closed downwards it is another knot."""
    verdict = judge(as_record(lying(TREFOIL)[:-4]), TREFOIL)
    assert not verdict.closures_agree
    assert verdict.outcome is Outcome.UNSOUND
    assert verdict.knot is None
    assert " | " in verdict.polynomial
