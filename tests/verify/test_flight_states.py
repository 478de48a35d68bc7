"""States of the cable in flight: against polylines cut short, Gauss codes of grids, and physics."""

from __future__ import annotations

from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from knotopt import Cable
from knotopt.arrays import FloatArray
from knotopt.cable.alexander import alexander_from_gauss, alexander_polynomial
from knotopt.reading.knot import read_knot
from knotopt.topology.cable_state import cable_state
from knotopt.topology.closure import closed_gauss
from knotopt.topology.extract import extract_state
from knotopt.topology.legal import refusal, successors
from knotopt.topology.state import RopeState
from knotopt.verify.flight import leader_events
from knotopt.verify.flight_places import _place, _Seen, executed_states, planned_states
from knotopt.verify.flight_states import (
    EndCrossing,
    Interval,
    StateSequence,
    _can_cross,
    compare_states,
    state_sequence,
)
from knotopt.verify.flight_word import RouteCrossing, compare_words
from tests.helpers.strategies import cables

EXACT = 1e-9


def polynomial(state: RopeState) -> tuple[int, ...]:
    return alexander_from_gauss(*closed_gauss(state))


def gauss_states(cable: Cable) -> list[tuple[RopeState]]:
    """The states of a grid's path cut off behind each crossing's second visit."""
    times, index, over = (each.tolist() for each in cable.visits)
    signs = cable.crossings.sign.tolist()
    states = []
    for end in sorted(cable.crossings.second.tolist()):
        met = [
            (k + 1) * (1 if up else -1)
            for k, up in zip(index, over, strict=True)
            if cable.crossings[k].second <= end
        ]
        states.append((RopeState.from_gauss(met, signs),))
    assert len(times) == 2 * len(states)
    return states


@settings(max_examples=40)
@given(cables(max_size=9))
def test_the_leader_can_cross_what_the_rules_of_plans_say(cable: Cable) -> None:
    state = cable_state(cable)
    last = len(state.code)
    for segment in range(last + 1):
        for over, sense in ((over, sense) for over in (True, False) for sense in (1, -1)):
            action = EndCrossing(over, sense, 0.0, ()).action(segment, last)
            allowed = refusal(state, action) is None
            assert _can_cross(state.code, segment, sense) == allowed


def exactly(place: float) -> Interval:
    return place, place


def crossings_of(points: FloatArray) -> tuple[list[EndCrossing], list[RopeState]]:
    """A polyline's crossings in the order of their second visits, and the states behind each."""
    found = extract_state(points)
    assume(found.state is not None)
    assert found.state is not None
    code, at = found.state.code, found.visits.parameter.tolist()
    crossings: list[EndCrossing] = []
    earlier: list[tuple[Interval, Interval]] = []
    states = []
    for visit, entry in enumerate(code):
        first = entry >> 2
        if first > visit:
            continue
        over = bool(entry & 2)
        sign = 2 * (entry & 1) - 1
        crossings.append(EndCrossing(over, -sign if over else sign, at[first], tuple(earlier)))
        earlier.append((exactly(at[first]), exactly(at[visit])))
        if visit + 1 < len(code):
            assume(at[visit + 1] - at[visit] > 1e-6)
            assume(int(at[visit + 1]) > int(at[visit]) or at[visit + 1] % 1 - at[visit] % 1 > 1e-6)
            cut = (at[visit] + at[visit + 1]) / 2
        else:
            cut = len(points) - 1.0
        k = int(np.ceil(cut))
        end = points[k - 1] + (cut - (k - 1)) * (points[k] - points[k - 1])
        behind = extract_state(np.vstack((points[:k], end)))
        assume(behind.state is not None)
        assert behind.state is not None
        states.append(behind.state)
    return crossings, states


@settings(max_examples=200)
@given(st.integers(0, 2**32), st.integers(4, 12))
def test_a_random_polyline_goes_through_the_states_of_its_beginnings(seed: int, count: int) -> None:
    points = np.random.default_rng(seed).normal(size=(count, 3))
    crossings, states = crossings_of(points)
    found = state_sequence(crossings, EXACT)
    assert found.misfit == ""
    assert [state for (state,) in found.steps] == states


@settings(max_examples=150)
@given(st.integers(0, 2**32), st.floats(0, 2))
def test_a_tolerance_only_adds_states(seed: int, tolerance: float) -> None:
    """What is true stays among what is possible; what is possible is planar and one action on."""
    points = np.random.default_rng(seed).normal(size=(6, 3))
    crossings, states = crossings_of(points)
    found = state_sequence(crossings, tolerance)
    assume("so near" not in found.misfit)
    assert all(state in step for state, step in zip(states, found.steps, strict=True))
    assert all(state.is_planar for step in found.steps for state in step)
    for before, after in pairwise(((RopeState(()),), *found.steps)):
        reached = {state for each in before for _, state in successors(each)}
        assert {*after} <= reached


@settings(max_examples=100)
@given(cables(2, 8))
def test_a_plan_round_all_corners_goes_through_the_gauss_code(cable: Cable) -> None:
    word = []
    for crossing in sorted(cable.crossings, key=lambda each: each.second):
        older, span = np.searchsorted(cable.times, (crossing.first, crossing.second)).tolist()
        over = not crossing.first_over
        sense = -crossing.sign if over else crossing.sign
        place = (float(crossing.column), float(crossing.row))
        word.append(RouteCrossing(span, older, over, sense, place, 0, 0, crossing.second))
    lengths = np.diff(cable.times) * 1.3
    found = planned_states(word, np.insert(cable.points, 2, 0, axis=1), lengths, 0.1)
    assert (list(found.steps), found.misfit) == (gauss_states(cable), "")


@settings(max_examples=50)
@given(cables(2, 7))
def test_a_grid_path_drawn_out_goes_through_the_gauss_code(cable: Cable) -> None:
    """The rest of the cable hangs straight below the leader."""
    visited, _, over = cable.visits
    rest = np.unique(np.concatenate((np.arange(0, cable.length, 0.5), cable.times)))
    leader = np.append(np.arange(0.13, cable.length, 0.25), cable.length)
    at = np.minimum(rest[None], leader[:, None])
    x, y = (np.interp(at, np.arange(cable.length + 1), axis) for axis in cable.cells.T)
    z = np.interp(at, visited, np.where(over, 0.3, -0.3)) if len(visited) else 0 * at
    laid = np.stack((x, y, z), axis=2)
    corners = np.searchsorted(rest, cable.times)
    events = leader_events(leader, laid, corners, cable.times[:-1])
    found = executed_states(events, leader, laid, corners, 0.1, events)
    assert (list(found.steps), found.misfit) == (gauss_states(cable), "")


@dataclass(frozen=True)
class Planned:
    """A planned letter with its place."""

    span: int
    older: int
    over: bool
    sense: int
    place: tuple[float, float]


ANCHORS = np.array([[0.0, 0, 0], [4, 0, 0], [4, 3, 0], [-1, 3, 0], [0.5, 1, 0], [6, -2, 0]])
LENGTHS = np.array([4.4, 3.3, 5.5, 3.3, 6.6])
WORD = (
    Planned(4, 1, True, -1, (1.0, 0.0)),
    Planned(4, 1, False, 1, (2.0, 0.0)),
    Planned(4, 1, True, -1, (3.0, 0.0)),
)


def states(word: tuple[Planned, ...]) -> StateSequence:
    return planned_states(word, ANCHORS, LENGTHS, 0.05)


def executed(word: tuple[Planned, ...]) -> list[RouteCrossing]:
    return [
        RouteCrossing(each.span, each.older, each.over, each.sense, each.place, each.over, 0.5, k)
        for k, each in enumerate(word)
    ]


def difference(word: tuple[Planned, ...]) -> str:
    """Of another word, from WORD."""
    comparison = compare_states(states(WORD), states(word), compare_words(WORD, executed(word)))
    assert comparison.sentence.startswith(f"as planned ({len(comparison.results)} of 3)")
    return comparison.difference


def moved(which: int, x: float) -> tuple[Planned, ...]:
    return tuple(
        replace(each, place=(x, 0.0)) if k == which else each for k, each in enumerate(WORD)
    )


def test_a_word_flown_as_planned() -> None:
    comparison = compare_states(states(WORD), states(WORD), compare_words(WORD, executed(WORD)))
    assert (comparison.sentence, comparison.difference) == ("as planned (3 of 3)", "")
    assert [str(state) for (state,) in comparison.executed.steps] == [
        "U1+ O1+",
        "U1+ O2+ O1+ U2+",
        "U1+ O2+ U3+ O1+ U2+ O3+",
    ]


def test_the_same_word_in_another_order_along_the_older_span_is_another_knot() -> None:
    word = moved(0, 3.5)[:1] + moved(1, 0.5)[1:2] + WORD[2:]
    word = (word[0], word[1], replace(WORD[2], place=(2.0, 0.0)))
    assert [row.kind for row in compare_words(WORD, executed(word))] == ["as planned"] * 3
    assert difference(word) == (
        "crossing 2 lies elsewhere among the cable's other crossings: "
        "O1+ U2+ O2+ U1+, not U1+ O2+ O1+ U2+"
    )
    ((tied,), (other,)) = states(WORD).steps[-1], states(word).steps[-1]
    assert (polynomial(tied), polynomial(other)) == ((1, -1, 1), (1,))


def test_a_crossing_that_the_leader_cannot_get_to() -> None:
    """Inside the loop that two crossings close, and the third is outside it."""
    found = states((*moved(0, 2.0)[:1], *moved(1, 1.0)[1:2], *moved(2, 3.0)[2:]))
    assert len(found.steps) == 2
    assert found.misfit == (
        "crossing 3: the leader cannot get there without another one, as of its own tether"
    )
    plan = compare_states(found, states(WORD), [])
    assert plan.sentence == f"as planned (1 of 3); {plan.difference}"
    back = compare_states(found, found, [])
    assert back.sentence == f"as planned (2 of 3); the plan, {found.misfit}"


def test_other_words() -> None:
    assert difference((WORD[0], replace(WORD[1], over=True), WORD[2])) == (
        "span 4 over span 1: missing: crossed 0.00 m along the route and undone 1.00 m along the "
        "route"
    )
    one = states(WORD[:1]), states((replace(WORD[0], over=False),))
    low = replace(executed(WORD[:1])[0], over=False, height=0.0)
    comparison = compare_states(*one, compare_words(WORD[:1], [low]))
    assert comparison.sentence.startswith("as planned (0 of 1); span 4 over span 1: executed as un")
    assert difference(WORD[:2]) == "span 4 over span 1: missing: never crossed"
    extra = replace(WORD[2], older=2, place=(4.0, 1.0))
    assert difference((*WORD, extra)).startswith("extra: span 4 over span 2 3.00 m along")


def test_crossings_too_near_to_tell_apart() -> None:
    """The third crossing is beside the second: both ways round are possible, nothing is guessed."""
    near = moved(2, 2.02)
    found = states(near)
    assert [len(step) for step in found.steps] == [1, 1, 2]
    exact = planned_states(near, ANCHORS, LENGTHS, 0.001)
    assert [len(step) for step in exact.steps] == [1, 1, 1]
    comparison = compare_states(states(WORD), found, compare_words(WORD, executed(near)))
    assert comparison.sentence == "as planned (2 of 3), 1 not told apart"


def test_too_many_orders() -> None:
    unknown = (-1.0, 1.0)
    crossings = [
        EndCrossing(k % 2 == 0, 1 - 2 * (k % 2), 0.0, ((unknown, unknown),) * k) for k in range(9)
    ]
    found = state_sequence(crossings, 0.1)
    assert "over 64 orders are possible" in found.misfit and len(found.steps) < 9


def test_there_and_back_on_two_spans_counts_if_it_is_planned() -> None:
    there = Planned(4, 1, True, -1, (2.0, 0.0))
    back = Planned(5, 1, True, 1, (3.0, 0.0))
    word = (there, back)
    assert len(states(word).steps) == 2
    assert states((there, replace(back, span=4))).steps == ()
    cable = np.zeros((7, 13, 3))
    cable[:, :, :2] = drawn_anchors(13)
    cable[:, -1, :2] = np.column_stack((np.full(7, 2.0), [2.0, 1.0, -1.0, -1.0, -1.0, 1.0, 2.0]))
    cable[:, -1, 2] = 1.0
    held, passes = [0, 2, 4, 6, 8, 12], [-4.0, -3.0, -2.0, -1.0, 3.0]
    events = [
        event for event in leader_events(np.arange(7.0), cable, held, passes) if event.older == 1
    ]
    assert [(event.span, event.sense) for event in events] == [(4, -1), (5, 1)]
    for planned, count in (((), 0), (word[:1], 0), (word, 2)):
        found = executed_states(events, np.arange(7.0), cable, held, 0.05, planned)
        assert len(found.letters) == count


def drawn_anchors(vertices: int) -> FloatArray:
    """Two vertices a span, the last span far away from all."""
    flat = np.array([[0.0, 0], [2, 0], [4, 0], [4.5, 2], [4, 3], [2, 3], [-1, 3], [-1, 2], [-1, 1]])
    rest = np.column_stack((np.full(vertices - len(flat), 9.0), np.arange(vertices - len(flat))))
    return np.vstack((flat, rest))


def test_where_a_crossing_is_that_shows_several_times_or_not_at_all() -> None:
    cable = np.zeros((3, 6, 3))
    cable[:, :5] = [[0, 0, 0], [4, 0, 0], [4, 3, 0], [0, 3, 0], [0, 2, 0]]
    cable[:, 5] = [[1, 1, 1], [1, -1, 1], [1, -2, 1]]
    (event,) = leader_events(np.arange(3.0), cable, [0, 1, 2, 3, 5], [-3, -2, -1, 0])
    assert (event.older, event.over, event.sense) == (1, True, -1)
    starts = np.array([0.0, 4, 7, 11, 15])
    seen = [_Seen(1, False, 1, 1.0, 12.0), _Seen(1, True, 1, 1.5, 12.5)]
    assert _place([event], 0, seen, starts) == ((1.0, 1.0), (12.0, 12.0))
    seen += [_Seen(1, False, -1, 2.0, 13.0), _Seen(1, False, 1, 3.0, 14.0)]
    assert _place([event], 0, seen, starts) == ((1.0, 3.0), (12.0, 14.0))
    assert _place([event], 0, [], starts) == ((0.0, 4.0), (11.0, np.inf))


@pytest.mark.parametrize(
    "row", ["3", *(pytest.param(row, marks=pytest.mark.slow) for row in ("4", "5"))]
)
def test_flights_of_table_1_with_a_robot_at_every_corner(row: str) -> None:
    """Planned states are the grid's own Gauss code; the cable's last state is seen from above."""
    pytest.importorskip("mujoco")
    from knotopt.flight.examine import examine_flight, examine_plan
    from knotopt.flight.planner import plan_flight
    from knotopt.sim.trials import fly_trial

    cable = Cable(read_knot(row).diagram, "L+")
    plan = plan_flight(row, cable, tuple(range(2, len(cable.path))))
    count = len(cable.crossings)
    assert examine_plan(plan).states.sentence == f"as planned ({count} of {count})"
    record = fly_trial(plan).record
    comparison = examine_flight(plan, record).states
    assert list(comparison.planned.steps) == gauss_states(cable)
    assert comparison.sentence == f"as planned ({count} of {count})"
    (last,) = comparison.executed.steps[-1]
    seen = extract_state(record.cable[-1]).state
    assert seen == last
    assert polynomial(last) == alexander_polynomial(cable)


def test_a_modelled_plan_with_few_robots_ties_its_knot() -> None:
    from knotopt.flight.examine import examine_plan
    from knotopt.flight.planner import plan_flight

    cable = Cable(read_knot("3").diagram, "L+")
    found = examine_plan(plan_flight("3_1", cable, (3, 4, 6), schedule="fixed")).states
    assert found.sentence == "as planned (3 of 3)"
    ((last,),) = found.planned.steps[-1:]
    assert polynomial(last) == alexander_polynomial(cable)
