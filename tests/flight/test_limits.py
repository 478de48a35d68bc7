"""Limits of a flight, what disturbs it, and what a fit says of a flight that is not one."""

from __future__ import annotations

import math
from dataclasses import replace

import pytest

from knotopt.errors import RequirementError
from knotopt.export.fitting import fit_trajectories
from knotopt.export.recheck import recheck
from knotopt.flight.limits import RANGES, FlightLimits
from knotopt.flight.record import Disturbance
from tests.helpers.small_flight import small_plan


@pytest.mark.parametrize(
    ("name", "value", "message"),
    [
        ("speed", 1e9, "speed lies between 0.01 and 20 m/s, not at 1000000000.0"),
        ("speed", 1e-9, "speed lies between 0.01 and 20 m/s, not at 1e-09"),
        ("acceleration", 1e9, "acceleration lies between 0.01 and 100 m/s^2, not at 1000000000.0"),
        ("acceleration", 1e-9, "acceleration lies between 0.01 and 100 m/s^2, not at 1e-09"),
        ("spacing", 1e6, "spacing lies between 0.01 and 10 m, not at 1000000.0"),
        ("slack", 1e6, "slack lies between 0 and 10 of it, not at 1000000.0"),
        ("hover_before", 1e6, "hover_before lies between 0.05 and 600 s, not at 1000000.0"),
        ("speed", 0, "speed must be positive"),
        ("speed", math.nan, "speed is a number from 0 up, not nan"),
    ],
)
def test_limits_out_of_scale(name: str, value: float, message: str) -> None:
    with pytest.raises(RequirementError) as caught:
        FlightLimits(**{name: value})
    assert str(caught.value) == message


def test_every_limit_has_a_range_that_holds_the_usual() -> None:
    usual = FlightLimits()
    assert {*RANGES} == {*usual.__dataclass_fields__}
    assert all(least <= getattr(usual, name) <= most for name, (least, most, _) in RANGES.items())


def test_distances_that_are_equal_but_for_rounding() -> None:
    assert FlightLimits(spacing=0.3, separation=3 * 0.1).spacing == 0.3
    assert FlightLimits(downwash=0.3, separation=3 * 0.1).downwash == 0.3
    near = "a spacing of 0.2999999 m is less than the separation of 0.3 m"
    with pytest.raises(RequirementError, match=near):
        FlightLimits(spacing=0.2999999, separation=0.3)
    near = "a downwash of 0.2999999 m is less than the separation of 0.3 m"
    with pytest.raises(RequirementError, match=near):
        FlightLimits(downwash=0.2999999, separation=0.3)


@pytest.mark.parametrize(
    ("values", "message"),
    [
        ({"noise": -0.1}, "noise is a number from 0 up, not -0.1"),
        ({"noise": math.nan}, "noise is a number from 0 up, not nan"),
        ({"gust": math.inf}, "gust is a number from 0 up, not inf"),
        ({"gust": "strong"}, "gust is a number from 0 up, not 'strong'"),
        ({"wind": (0.1,)}, "wind is two numbers (x, y), not (0.1,)"),
        ({"wind": (0.1, math.nan)}, "wind is two numbers (x, y), not (0.1, nan)"),
        ({"wind": 0.3}, "wind is two numbers (x, y), not 0.3"),
        ({"seed": -1}, "seed is a whole number from 0 up, not -1"),
        ({"seed": 1.5}, "seed is a whole number from 0 up, not 1.5"),
    ],
)
def test_disturbances_that_are_none(values: dict[str, object], message: str) -> None:
    with pytest.raises(RequirementError) as caught:
        Disturbance(**values)  # type: ignore[arg-type]
    assert str(caught.value) == message


def test_a_crossing_after_the_flight_is_not_flown() -> None:
    plan = small_plan()
    first, last = plan.crossings
    late = replace(plan, crossings=(first, replace(last, time=99.0)))
    report = recheck(late, fit_trajectories(plan))
    assert [each.crossing for each in report.crossings] == [first]
    assert (
        "crossing span 4 under span 2 is not flown: its time 99.00 s is not between 0 and 11.00 s"
    ) in report.broken
