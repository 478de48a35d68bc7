"""The folder of a flight: what is in it, what it says, and what it may replace."""

from __future__ import annotations

import json
import sys
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from knotopt.errors import MissingExtraError, OutputError
from knotopt.export.crazyswarm import export_files
from knotopt.files import check_folder, write_folder
from knotopt.flight.examine import examine_flight, examine_plan
from knotopt.flight.plan_file import read_plan
from knotopt.flight.planner import plan_flight
from knotopt.flight.record import Disturbance
from knotopt.mission.content import flight_content, mission_content
from knotopt.mission.folder import NAMES, flight_files, flight_pictures, why_kept
from knotopt.mission.mission import Mission
from knotopt.rehearsal.flown_set import FlownSet
from knotopt.sim.judge import Outcome, Verdict
from knotopt.sim.trials import Flight
from tests.helpers.small_flight import small_plan, small_record

PLAN = small_plan()
RECORD = small_record(PLAN)
TIED = Verdict(Outcome.TIED, "3_1", True, True, "1 - t + t^2")
WRONG = Verdict(Outcome.WRONG_KNOT, "unknot", False, True, "1")


@pytest.fixture(scope="module")
def planned() -> Mission:
    exports, fit = export_files(PLAN)
    return Mission(PLAN, examine_plan(PLAN), exports, fit, 20.0)


@pytest.fixture(scope="module")
def flown(planned: Mission) -> Mission:
    """As if the undisturbed flight had tied the knot, and one of two disturbed ones."""
    undisturbed = Flight(PLAN, RECORD, TIED)
    stuck = replace(RECORD, finished=False, disturbance=Disturbance(seed=2))
    failed = Flight(PLAN, stuck, WRONG)
    return replace(
        planned,
        steady=None,
        flown=FlownSet(undisturbed, robust=3, separation=1.1, steady=20.0, rehearsals=1, ways=4),
        failed=failed,
        disturbed=(flight_content("seed 1", undisturbed), flight_content("seed 2", failed)),
    )


def test_a_plan_is_examined_by_what_it_flies() -> None:
    """The small plan's crossings are made up: its leader flies straight to its place."""
    found = examine_plan(PLAN)
    assert [row.result for row in found.crossings] == ["wrong way", "missing"]
    assert found.crossings[-1].sentence == "span 4 under span 2: never crossed"
    assert len(found.amiss) == 2
    fast = examine_plan(replace(PLAN, limits=replace(PLAN.limits, speed=0.1)))
    assert "the limit is 0.1 m/s" in fast.limits.broken[0]
    low = examine_plan(replace(PLAN, world=replace(PLAN.world, ceiling=2.3, altitude=2.0)))
    assert low.limits.broken == found.limits.broken
    crowded = replace(PLAN, limits=replace(PLAN.limits, separation=0.3, downwash=0.9))
    assert "of their separation" in " ".join(examine_plan(crowded).limits.broken)


def test_the_crossings_of_a_real_plan_are_found_again() -> None:
    plan = plan_flight("3_1", PLAN.cable, (3, 4, 6), schedule="fixed")
    found = examine_plan(plan)
    assert [row.planned for row in found.crossings] == [each.name for each in plan.crossings]
    assert not found.amiss
    lower = plan.positions.copy()
    over = next(crossing for crossing in plan.crossings if crossing.over)
    lower[np.abs(plan.times - over.time) < 0.5, -1, 2] = 1.0
    (wrong,) = examine_plan(replace(plan, positions=lower)).amiss
    assert wrong.planned == over.name and wrong.result == "wrong height"
    assert wrong.happened.startswith("executed as under ")


def test_a_flight_is_examined_against_the_cable() -> None:
    found = examine_flight(PLAN, RECORD)
    assert [row.planned for row in found.crossings if row.planned] == [
        "span 4 over span 1",
        "span 4 under span 2",
    ]
    assert found.limits.highest.value == pytest.approx(2.3)
    broken = replace(RECORD, cable=np.full_like(RECORD.cable, np.nan))
    with pytest.raises(ValueError, match="not finite"):
        examine_flight(PLAN, broken)
    down = Flight(PLAN, broken, replace(WRONG, outcome=Outcome.UNSOUND))
    assert down.examination is None and "the simulation broke down" in down.why


def test_reasons(planned: Mission, flown: Mission) -> None:
    reasons = planned.reasons
    assert "on laid cable: span 4 under span 2: never crossed" in reasons
    assert not any("on laid cable" in reason for reason in flown.reasons)
    assert flown.failed is not None
    failed = replace(flown, flown=FlownSet(flown.failed))
    assert failed.reasons[-1].startswith(
        "the undisturbed flight: wrong knot: unknot, held back at 11.0 s of the plan; span 4 "
    )
    assert flown.tied == 1
    assert flown.success == "1 of 2 tie it (95 % interval 9 to 91 %); noise of 0 mm"


def test_crossings_as_planned_that_do_not_make_the_knot(flown: Mission) -> None:
    """Without supports the taut cable is straight."""
    bare = plan_flight("3_1", PLAN.cable, ())
    found = examine_plan(bare)
    assert not found.crossings and "no longer cross" in found.lost[0]
    every = plan_flight("3_1", PLAN.cable, tuple(range(2, 10)), schedule="fixed")
    assert not examine_plan(every).lost
    said = dict(replace(flown, examination=found).measures())["taut cable"]
    assert said.startswith("need not be the knot: it loses loop ")
    failed = Flight(PLAN, RECORD, WRONG)
    failed.__dict__["examination"] = replace(found, crossings=())
    assert failed.why == "wrong knot: unknot; every crossing is as planned, which is not enough"


def test_measures(planned: Mission, flown: Mission) -> None:
    said = dict(planned.measures())
    assert said["time of flight"] == (
        "11.0 s, fixed schedule; 20.0 s at one pace throughout: 45 % shorter"
    )
    assert "undisturbed" not in said and "disturbed" not in said
    said = dict(flown.measures())
    assert said["undisturbed"] == "tied: 3_1"
    assert said["rehearsal"] == "4 ways tried in 1 flights"


def test_files(tmp_path: Path, flown: Mission) -> None:
    files = flight_files(flown) | flight_pictures(flown)
    robots = [f"robot_0{j}.csv" for j in range(1, 6)]
    assert sorted(files) == sorted(
        [*(name for name in NAMES if "*" not in name), *robots],
    )
    write_folder(tmp_path / "flight", files, why_kept)
    again = read_plan(tmp_path / "flight" / "plan.json")
    assert again.supports == PLAN.supports and len(again.times) == len(PLAN.times)
    content = json.loads((tmp_path / "flight" / "check.json").read_text())
    assert content == json.loads(json.dumps(mission_content(flown)))
    assert content["knot"] == "3_1" and content["robots"] == 5 and content["tied"] == 1
    assert content["limits"]["spacing"]["limit"] is None
    assert content["supports"][0] == [4, *PLAN.cable.path[3]]
    assert content["undisturbed"]["crossings"][0]["planned"] == "span 4 over span 1"
    page = str(files["viewer.html"])
    assert "waypoints.csv" in page and "what happened" in page and "seed 2" in page
    for name in ("flight.png", "strip.png"):
        assert bytes(files[name]).startswith(b"\x89PNG")
    assert bytes(files["flight.gif"]).startswith(b"GIF89a")


def test_a_plan_that_was_not_flown(planned: Mission) -> None:
    files = flight_files(planned)
    assert "what happened" not in str(files["viewer.html"])
    assert list(flight_pictures(planned)) == ["flight.png"]
    content: dict[str, Any] = json.loads(str(files["check.json"]))
    assert content["undisturbed"] is None and content["disturbed"] == []
    assert not content["ok"] and content["reasons"] == list(planned.reasons)


def test_pictures_need_matplotlib(planned: Mission, monkeypatch: pytest.MonkeyPatch) -> None:
    for name in [name for name in sys.modules if name.startswith("knotopt.plot")]:
        monkeypatch.delitem(sys.modules, name)
    monkeypatch.setitem(sys.modules, "matplotlib", None)
    with pytest.raises(MissingExtraError, match=r"knotopt\[viz\]"):
        flight_pictures(planned)


def test_only_flights_are_replaced(tmp_path: Path, planned: Mission) -> None:
    folder, files = tmp_path / "flight", flight_files(planned)
    write_folder(folder, files, why_kept)
    (folder / "robot_09_part2.csv").write_text("of a former flight")
    (folder / "report.html").write_text("the page of a flight, as it was called in 0.1")
    write_folder(folder, files, why_kept)
    assert sorted(entry.name for entry in folder.iterdir()) == sorted(files)
    for name in ("notes.txt", "bag"):
        (folder / name).mkdir()
        with pytest.raises(OutputError, match=f"flight holds {name}, which is no file of a fl"):
            write_folder(folder, files, why_kept)
        (folder / name).rmdir()
    (folder / "plan.json").write_text('{"format": "another program\'s"}')
    with pytest.raises(OutputError, match=r"flight has no plan.json of a flight in it"):
        check_folder(folder, why_kept)
    (folder / "plan.json").write_bytes(b"\xff")
    with pytest.raises(OutputError, match=r"has no plan.json of a flight"):
        check_folder(folder, why_kept)
    (folder / "plan.json").unlink()
    with pytest.raises(OutputError, match=r"has no plan.json of a flight"):
        check_folder(folder, why_kept)
