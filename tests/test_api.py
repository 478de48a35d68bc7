"""One call from a knot to its supports, and one to its flight."""

from __future__ import annotations

import numpy as np
import pytest

import knotopt
from knotopt.errors import CutError, RequirementError, UnknownKnotError
from knotopt.supports.requirements import Requirements


def test_a_name_and_its_diagram_have_the_same_answer() -> None:
    named, drawn = knotopt.solve("4_1"), knotopt.solve(knotopt.read("4_1").diagram)
    assert (named.supports, named.cable) == (drawn.supports, drawn.cable)
    assert named.is_proven and named.report.is_open


def test_the_best_cut_is_no_worse_than_any() -> None:
    diagram = knotopt.read("5_2").diagram
    cuts = [str(cut) for cut in knotopt.outer_cuts(diagram)]
    assert knotopt.solve("5_2").robots <= min(knotopt.solve("5_2", cut=cut).robots for cut in cuts)


def test_a_flight_of_the_set_that_was_solved_for() -> None:
    asked = Requirements("span", 0.25)
    by_name = knotopt.plan("3", schedule="fixed")
    by_set = knotopt.plan("3", knotopt.solve("3", asked), schedule="fixed")
    assert by_name.supports == by_set.supports
    assert np.array_equal(by_name.positions, by_set.positions)
    assert (by_name.chosen_by, by_set.chosen_by) == ("milp", "given")


def test_what_is_asked_in_vain() -> None:
    with pytest.raises(UnknownKnotError, match="8_22"):
        knotopt.solve("8_22")
    with pytest.raises(CutError):
        knotopt.solve("3", cut="X+")
    with pytest.raises(RequirementError, match="of another diagram"):
        knotopt.plan("3", knotopt.solve("4"))
    with pytest.raises(RequirementError, match="it takes physics=True"):
        knotopt.plan("3", tighten=5.0)
    nothing = knotopt.solve("3", Requirements(forbidden=tuple(range(2, 10))), cut="L+")
    with pytest.raises(RequirementError, match="none was found"):
        knotopt.plan("3", nothing)


def test_a_flight_in_physics_is_rehearsed() -> None:
    pytest.importorskip("mujoco")
    flight = knotopt.plan("3", "all", physics=True)
    assert flight.name == "3_1" and len(flight.supports) == 8
    assert flight.limits.spacing > knotopt.FlightLimits().spacing  # the rehearsal's wider file
