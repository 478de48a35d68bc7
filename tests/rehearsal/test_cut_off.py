"""Sets of supports that are flown until one ties: by made-up flights, and once in physics."""

from __future__ import annotations

import json
import sys
from collections.abc import Callable
from dataclasses import replace
from itertools import combinations
from typing import Any

import pytest

from formulations.solution import Solution, Status
from knotopt.cable.cable import Cable
from knotopt.cable.cut import Cut, outer_cuts
from knotopt.diagram.families import torus_knot
from knotopt.errors import MissingExtraError, RequirementError
from knotopt.reading.knot import read_knot
from knotopt.rehearsal import cut_off
from knotopt.rehearsal.cut_off import AS_PLANNED, CutOff, FlownStatus, fly_set, solve_flown
from knotopt.rehearsal.flight_tests import FlightTests
from knotopt.rehearsal.flown_set import FlownSet
from knotopt.sim.judge import Outcome, Verdict
from knotopt.sim.simulators import Simulator
from knotopt.supports import by_size
from knotopt.supports.minimal import MinimalSupports
from knotopt.supports.requirements import Requirements
from knotopt.verify.span import check_span
from tests.helpers.small_flight import flown_set

TIED = Verdict(Outcome.TIED, "3_1", True, True, "1 - t + t^2")
LOST = Verdict(Outcome.WRONG_KNOT, "unknot", False, True, "1")
STUCK = Verdict(Outcome.STUCK, "unknot", False, True, "1")
SPAN = Requirements("span", 0.25, with_loops=False)
KNOT = torus_knot(2, 3)


class Flights:
    """Made up: a set ties if `ties` says so; which sets were flown is kept."""

    def __init__(self, ties: Callable[[MinimalSupports], bool]) -> None:
        self.ties = ties
        self.flown: list[tuple[str, tuple[int, ...]]] = []

    def __call__(self, result: MinimalSupports) -> FlownSet:
        self.flown.append((str(result.cable.cut), result.supports))
        if self.ties(result):
            return flown_set(TIED, TIED, TIED, TIED)
        return flown_set(LOST)


def open_sets(cut: Cut) -> list[tuple[int, ...]]:
    """All that are open by the definition of `span`, by size."""
    cable = Cable(KNOT, cut)
    points = range(2, len(cable.path))
    return [
        supports
        for size in range(len(points) + 1)
        for supports in combinations(points, size)
        if check_span(cable.path, KNOT.size, supports, SPAN.openness, SPAN.threading).is_open
    ]


def test_the_smallest_set_that_ties_by_exhaustive_search() -> None:
    """Whatever ties: here sets with p6, and with 6 robots or more."""
    cut = outer_cuts(KNOT)[0]

    def ties(supports: tuple[int, ...]) -> bool:
        return 6 in supports and len(supports) >= 4

    flights = Flights(lambda result: ties(result.supports))
    found = solve_flown("3_1", KNOT, SPAN, FlightTests(max_cut=1000), cuts=[cut], fly=flights)
    every = open_sets(cut)
    fewest = min(len(supports) for supports in every if ties(supports))
    assert found.status is FlownStatus.TIED and found.is_proven
    assert ties(found.result.supports) and len(found.result.supports) == fewest
    assert found.result.supports in every and found.result.report.is_open
    smaller = {supports for supports in every if len(supports) < fewest}
    failed = [each.supports for each in found.cut_off]
    assert len(set(failed)) == len(failed) and smaller <= set(failed) <= set(every)
    assert found.smaller_cut_off == len(smaller)
    assert not any(map(ties, failed))
    assert list(map(len, failed)) == sorted(map(len, failed))
    assert flights.flown == [("L+", supports) for supports in (*failed, found.result.supports)]
    assert sum(found.cut_off_by_robots.values()) == len(failed)
    assert found.tied is not None and found.tied.is_tied
    assert len(found.tied.disturbed) == found.tests.trials == 3 and found.tests.noise == 0.01


def test_over_cuts_the_next_set_may_be_on_another() -> None:
    """Nothing ties on the first cut: the answer is on another, no larger than any left."""
    flights = Flights(lambda result: str(result.cable.cut) == "B-")
    found = solve_flown("3_1", KNOT, SPAN, FlightTests(max_cut=200), fly=flights)
    assert found.status is FlownStatus.TIED and str(found.result.cable.cut) == "B-"
    best = min(len(supports) for supports in open_sets(Cut.parse("B-", KNOT.size)))
    assert found.result.robots == best + 2
    robots = [each.robots for each in found.cut_off]
    assert robots == sorted(robots) and max(robots) <= found.result.robots
    for cut in outer_cuts(KNOT):
        smaller = {each for each in open_sets(cut) if len(each) < best}
        assert smaller <= {each.supports for each in found.cut_off if each.cut == str(cut)}


def test_a_set_must_tie_in_every_flight(caplog: pytest.LogCaptureFixture) -> None:
    verdicts = iter([(LOST,), (TIED, TIED, STUCK, TIED), (TIED, TIED, TIED, TIED)])
    caplog.set_level("INFO", "knotopt")
    told: list[CutOff] = []
    found = solve_flown(
        "3_1", KNOT, SPAN, fly=lambda _: flown_set(*next(verdicts)), on_cut_off=told.append
    )
    said = [record.getMessage() for record in caplog.records]
    assert found.status is FlownStatus.TIED and found.cut_off == tuple(told) and len(told) == 2
    assert [each.tied_instead for each in told] == ["wrong knot: unknot", "stuck: unknot"]
    assert said[0] == f"set 1: 5 robots, cut {told[0].cut}, p4 p5 p7"
    assert said[1] == f"set 1: cut off: wrong knot: unknot; {told[0].failed}"
    assert told[0].failed.startswith("span 4 over span 1: ") and len(said) == 5
    assert told[0].supports == (4, 5, 7) and told[0].robots == 5
    for each in told:
        assert CutOff.from_json(json.loads(json.dumps(each.to_json()))) == each


def test_a_set_without_a_plan_is_cut_off(monkeypatch: pytest.MonkeyPatch) -> None:
    def no_route(*_: Any, **__: Any) -> Any:
        raise RequirementError("no route over span 3")

    monkeypatch.setattr(cut_off, "rehearse_flight", no_route)
    monkeypatch.setattr(Simulator, "require", lambda _: None)
    found = solve_flown("3_1", KNOT, SPAN, FlightTests(max_cut=2))
    assert found.status is FlownStatus.BUDGET and found.tied is None
    assert {each.tied_instead for each in found.cut_off} == {"no flight planned"}
    first = found.cut_off[0]
    assert (first.verdict, first.trials, first.failed) == (None, (), "no route over span 3")
    assert CutOff.from_json(first.to_json()) == first


def test_the_budget_and_how_to_go_on() -> None:
    never = Flights(lambda _: False)
    found = solve_flown("3_1", KNOT, SPAN, FlightTests(max_cut=3), fly=never)
    assert found.status is FlownStatus.BUDGET and len(found.cut_off) == len(never.flown) == 3
    assert found.result.found and found.is_proven  # the next one, not flown
    assert (str(found.result.cable.cut), found.result.supports) not in never.flown
    assert len(solve_flown("3_1", KNOT, SPAN, fly=never).cut_off) == FlightTests.MAX_CUT
    again = Flights(lambda _: False)
    longer = solve_flown("3_1", KNOT, SPAN, FlightTests(max_cut=5), known=found.cut_off, fly=again)
    assert longer.cut_off[:3] == found.cut_off and len(longer.cut_off) == 5
    assert again.flown[0] == (str(found.result.cable.cut), found.result.supports)
    whole = solve_flown("3_1", KNOT, SPAN, FlightTests(max_cut=5), fly=Flights(lambda _: False))
    assert whole.cut_off == longer.cut_off


def test_a_budget_of_time(monkeypatch: pytest.MonkeyPatch) -> None:
    clock = iter(range(0, 1000, 10))
    monkeypatch.setattr("time.monotonic", lambda: float(next(clock)))
    found = solve_flown("3_1", KNOT, SPAN, FlightTests(seconds=35), fly=Flights(lambda _: False))
    assert found.status is FlownStatus.BUDGET and len(found.cut_off) == 3


def test_every_set_was_flown() -> None:
    cut = outer_cuts(KNOT)[0]
    every = open_sets(cut)
    known = tuple(CutOff("L+", supports, LOST, (), "") for supports in every[:-2])
    flights = Flights(lambda _: False)
    found = solve_flown(
        "3_1", KNOT, SPAN, FlightTests(max_cut=1000), cuts=[cut], known=known, fly=flights
    )
    assert found.status is FlownStatus.NO_SET and not found.result.found and not found.is_proven
    assert {supports for _, supports in flights.flown} == set(every[-2:])
    assert found.smaller_cut_off == 0 and len(found.cut_off) == len(every)


def test_a_solver_that_stops_early(monkeypatch: pytest.MonkeyPatch) -> None:
    from formulations.backends.cp_sat import CpSat

    monkeypatch.setattr(CpSat, "solve", lambda *_: Solution(Status.UNKNOWN, "UNKNOWN"))
    asked = Requirements("span", separation=100)
    found = solve_flown("3_1", KNOT, asked, fly=Flights(lambda _: True))
    assert found.status is FlownStatus.UNKNOWN and not found.is_proven


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"noise": -0.1}, "noise is a number of metres from 0 up, not -0.1"),
        ({"noise": float("nan")}, "not nan"),
        ({"trials": 0}, "disturbed flights are at least 1, not 0"),
        ({"seconds": 0.0}, "time for flights must be positive, not 0 s"),
        ({"max_cut": 0}, "at least 1 set may be cut off, not 0"),
    ],
)
def test_numbers_that_make_no_sense(options: dict[str, Any], message: str) -> None:
    with pytest.raises(RequirementError, match=message):
        FlightTests(**options)


def test_without_mujoco_nothing_is_solved(monkeypatch: pytest.MonkeyPatch) -> None:
    def solve(*_: Any, **__: Any) -> Any:
        raise AssertionError("a program was solved")

    monkeypatch.setitem(sys.modules, "mujoco", None)
    monkeypatch.setattr(by_size, "minimal_supports", solve)
    with pytest.raises(MissingExtraError, match="simulating a flight needs mujoco"):
        solve_flown("3_1", KNOT)


@pytest.mark.slow
def test_in_physics() -> None:
    """The smallest set of `span` ties 3_1; a cable without supports does not."""
    pytest.importorskip("mujoco")
    diagram = read_knot("3").diagram
    tests = FlightTests(max_cut=3, trials=2)
    found = solve_flown("3_1", diagram, SPAN, tests)
    assert found.status is FlownStatus.TIED and found.tied is not None
    assert found.tied.plan.supports == found.result.supports
    assert len(found.tied.disturbed) == 2
    lost = fly_set("3_1", replace(found.result, supports=()), tests)
    assert not lost.is_tied and not lost.disturbed
    assert CutOff.of(found.result, lost).failed == AS_PLANNED
