"""Flight plans in files: what is read is what was written, and nonsense is named."""

from __future__ import annotations

import json
import re
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from knotopt.cable.cable import Cable
from knotopt.diagram.families import torus_knot
from knotopt.errors import FileFormatError, RequirementError
from knotopt.flight.limits import ROOM, FlightLimits
from knotopt.flight.plan import FlightPlan, PlannedCrossing
from knotopt.flight.plan_file import check_plan, plan_to_json, read_plan
from knotopt.reading.knot import read_knot
from tests.helpers.strategies import cables


@st.composite
def plans(draw: st.DrawFn) -> FlightPlan:
    """Plans with the cable of any knot, whose numbers are any that 1e-5 m can tell apart."""
    cable = draw(cables(max_size=6))
    inner = range(2, len(cable.path))
    supports = tuple(sorted(draw(st.sets(st.sampled_from(inner), max_size=4))))
    robots, samples = len(supports) + 2, draw(st.integers(2, 6))
    random = np.random.default_rng(draw(st.integers(0, 2**32)))
    positions = random.integers(-(10**6), 10**6, (samples, robots, 3)) / 10**5
    positions[0] = np.arange(robots)[:, None] * [0.25, 0.5, 0.0]
    numbers = st.floats(-1e6, 1e6, allow_nan=False)
    crossings = st.builds(
        PlannedCrossing,
        span=st.integers(2, 9),
        older=st.integers(1, 8),
        over=st.booleans(),
        sense=st.sampled_from((1, -1)),
        place=st.tuples(numbers, numbers),
        height=numbers,
        cable_height=numbers,
        route=numbers,
        time=numbers,
    )
    interval = draw(st.floats(0.01, 1))
    return FlightPlan(
        name=draw(st.text(max_size=9)),
        cable=cable,
        supports=supports,
        chosen_by=draw(st.sampled_from(("milp", "lcf", "all"))),
        schedule=draw(st.sampled_from(("fixed", "optimised"))),
        world=replace(ROOM, step=draw(st.floats(0.2, 2))),
        limits=FlightLimits(speed=draw(st.floats(0.1, 2)), slack=draw(st.floats(0, 1))),
        times=np.arange(samples) * interval,
        tightening=draw(st.integers(0, samples - 2)) * interval,
        positions=positions,
        lengths=random.uniform(0.1, 5, robots - 1),
        route=random.integers(-(10**6), 10**6, (draw(st.integers(2, 6)), 3)) / 10**5,
        passes=random.uniform(0, 9, robots - 1),
        crossings=tuple(draw(st.lists(crossings, max_size=3))),
        notes=tuple(draw(st.lists(st.text(max_size=9), max_size=2))),
    )


def small_plan() -> FlightPlan:
    start = np.arange(5)[:, None] * [0.3, 0.0, 0.0] + [0.0, 0.0, 2.0]
    return FlightPlan(
        name="3_1",
        cable=Cable(torus_knot(2, 3), "L+"),
        supports=(4, 5, 7),
        chosen_by="milp",
        schedule="fixed",
        world=ROOM,
        limits=FlightLimits(),
        times=np.arange(4) * 0.05,
        positions=np.repeat(start[None], 4, axis=0),
        lengths=np.full(4, 0.4),
        route=start,
        passes=np.arange(4.0),
        crossings=(PlannedCrossing(4, 1, True, 1, (0.8, 1.6), 2.3, 1.9, 2.0, 0.1),),
    )


def read(text: str) -> FlightPlan:
    with TemporaryDirectory() as folder:
        path = Path(folder) / "plan.json"
        path.write_text(text, encoding="utf-8")
        return read_plan(path)


@given(plans())
def test_what_is_read_is_what_was_written(plan: FlightPlan) -> None:
    text = plan_to_json(plan)
    found = read(text)
    assert plan_to_json(found) == text
    assert found.cable.path == plan.cable.path and str(found.cable.cut) == str(plan.cable.cut)
    for name in ("times", "positions", "lengths", "passes", "route"):
        assert np.array_equal(getattr(found, name), getattr(plan, name)), name
    rest = ("name", "supports", "chosen_by", "schedule", "world", "limits", "crossings", "notes")
    for name in (*rest, "tightening"):
        assert getattr(found, name) == getattr(plan, name), name


def test_the_grid_in_a_plan_is_a_diagram_to_everything_else(tmp_path: Path) -> None:
    path = tmp_path / "plan.json"
    path.write_text(plan_to_json(small_plan()), encoding="utf-8")
    assert read_knot(path).diagram.marks == small_plan().cable.diagram.marks


def test_positions_are_rounded_to_a_hundredth_of_a_millimetre() -> None:
    plan = small_plan()
    moved = replace(plan, positions=plan.positions + 1.23456789e-2)
    assert np.abs(read(plan_to_json(moved)).positions - moved.positions).max() <= 0.5e-5


def _set(*path: Any) -> Callable[[dict[str, Any]], None]:
    """A change of a file's content: the last of the path is the new value."""

    def change(content: Any) -> None:
        *inner, last, value = path
        for key in inner:
            content = content[key]
        content[last] = value

    return change


def _drop(*path: Any) -> Callable[[dict[str, Any]], None]:
    def change(content: Any) -> None:
        *inner, last = path
        for key in inner:
            content = content[key]
        del content[last]

    return change


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (_set("format", "other"), '"format" is not'),
        (_set("version", 1), "of version 1; this program reads version 2"),
        (_drop("tightening"), 'the key "tightening" is missing'),
        (_set("tightening", 9.5), "tightening: 9.5 s are no part of a flight of 0.15 s"),
        (_set("tightening", "late"), '"tightening" is "late", expected seconds'),
        (_drop("route"), 'the key "route" is missing'),
        (_drop("limits", "slack"), 'the key "slack" in "limits" is missing'),
        (_set("world", "roof", 3.0), 'the key "roof" in "world" is unknown'),
        (_set("limits", "speed", -1), "speed is a number from 0 up"),
        (_set("limits", "speed", "fast"), "speed is a number from 0 up"),
        (_set("cut", "Q+"), "no cut is named 'Q+'"),
        (_set("name", 3), '"name" is 3, expected text'),
        (_set("grid", 0, [9, 9]), "column"),
        (_set("supports", [1]), '"supports": 1 is none of the turning points 2 to 9'),
        (_set("supports", [True]), '"supports": True is none'),
        (_set("supports", [5, 4, 7]), "are not in order"),
        (_set("supports", [4, 5]), "positions has the shape (4, 5, 3), expected (4, 4, 3)"),
        (_set("positions", 2, 1, 1, np.nan), "y of robot 2 at 0.100 s is not a finite number"),
        (_set("positions", 3, 4, 2, -np.inf), "z of robot 5 at 0.150 s is not a finite number"),
        (_set("positions", 2, 1, None), '"positions"'),
        (_set("positions", 2, 1, 1, None), '"positions" holds something that is not a number'),
        (_set("positions", 2, 1, 1, "1"), '"positions" holds something that is not a number'),
        (_set("positions", 0, 1, [0.05, 0, 2]), "robots 1 and 2 start too close, 0.050 m apart"),
        (_set("positions", 0, 1, [0.0, 0, 1.7]), "0.000 m apart in plan, 0.300 m in height"),
        (_set("times", 1, 0.06), "times are not evenly spaced from 0"),
        (_set("times", [0.1, 0.2, 0.3, 0.4]), "times are not evenly spaced from 0"),
        (_set("times", 1, np.nan), "times: entry 2 is not a finite number"),
        (_set("lengths", 0, -1.0), "lengths: -1 m is no length of cable"),
        (_set("lengths", [1.0]), "lengths has the shape"),
        (_set("route", 1, 1, np.inf), "route: entry 2 is not a finite number"),
        (_set("crossings", 0, 7), "entry 1 is not an object"),
        (_drop("crossings", 0, "time"), 'the key "time" in entry 1 of "crossings" is missing'),
        (_set("crossings", 0, "over", 1), '"over" in entry 1 of "crossings" is 1, expected bool'),
        (_set("crossings", 0, "height", np.nan), '"height" in entry 1 of "crossings" is nan'),
        (_set("crossings", 0, "place", [1.0]), '"place" in entry 1 of "crossings" is not'),
    ],
)
def test_what_is_wrong_is_named(change: Callable[[dict[str, Any]], None], message: str) -> None:
    content = json.loads(plan_to_json(small_plan()))
    change(content)
    with pytest.raises(FileFormatError, match=re.escape(message)) as error:
        read(json.dumps(content))
    assert "plan.json" in str(error.value)


@pytest.mark.parametrize("text", ["", "{", "[1]", '"plan"', "9" * 5000, "\ufeff{}"])
def test_other_files_are_no_flight_plans(text: str) -> None:
    with pytest.raises(FileFormatError, match=r"is not JSON|is no flight plan"):
        read(text)


def test_files_that_cannot_be_read(tmp_path: Path) -> None:
    with pytest.raises(FileFormatError, match="cannot read"):
        read_plan(tmp_path / "none.json")
    (tmp_path / "plan.json").write_bytes(b"\xff\xfe")
    with pytest.raises(FileFormatError, match="is not JSON"):
        read_plan(tmp_path / "plan.json")


def test_nonsense_is_not_written() -> None:
    plan = small_plan()
    positions = plan.positions.copy()
    positions[1, 2, 0] = np.nan
    with pytest.raises(RequirementError, match="x of robot 3 at 0"):
        plan_to_json(replace(plan, positions=positions))
    with pytest.raises(RequirementError, match="1 samples"):
        check_plan(replace(plan, times=plan.times[:1], positions=plan.positions[:1]))
