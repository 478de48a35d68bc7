"""Cables as ropes, flights as plans, and regions as faces: against pictures of the cable."""

from __future__ import annotations

from collections import Counter
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from scipy import ndimage

from knotopt.arrays import FloatArray, IntArray
from knotopt.cable.cable import Cable
from knotopt.cable.cut import crossing_free_cuts
from knotopt.cable.notation import gauss_code
from knotopt.catalogue.knots import shipped_knots
from knotopt.diagram.families import random_knot, torus_knot
from knotopt.flight.leader_plan import LeaderFaces, flown_plan, laid_plan, leader_faces
from knotopt.topology.actions import R1, C
from knotopt.topology.cable_state import cable_state
from knotopt.topology.extract import extract_state
from knotopt.topology.legal import apply
from knotopt.topology.plan import Plan, plan_graph
from knotopt.topology.state import TRIVIAL, RopeState
from tests.helpers.strategies import cables


@pytest.fixture(scope="module")
def catalogue() -> list[Cable]:
    """All knots opened at all crossing-free cuts."""
    diagrams = [knot.diagram for knot in shipped_knots().values()]
    return [Cable(diagram, cut) for diagram in diagrams for cut in crossing_free_cuts(diagram)]


def laid(cable: Cable, time: float) -> FloatArray:
    """What lies at a time, in space: columns at height 1, rows at height 0."""
    points = []
    for (start, start_time), (end, end_time) in pairwise(
        zip(cable.points, cable.times.tolist(), strict=True)
    ):
        if start_time >= time:
            break
        share = min(1.0, (time - start_time) / (end_time - start_time))
        height = float(start[0] == end[0])
        points += [[*start, height], [*(start + share * (end - start)), height]]
    return np.array(points)


def second_visits(cable: Cable) -> list[int]:
    """Times at which the leader makes the crossings."""
    return sorted(int(time) for time in cable.crossings.second)


def check_plan(cable: Cable, plan: Plan) -> None:
    """Every step by the rules, each with the last segment, and the cable's state at the end."""
    assert plan.states[0] == TRIVIAL and plan.states[-1] == cable_state(cable)
    assert len(plan) == len(cable.crossings)
    for state, action, after in zip(plan.states, plan.actions, plan.states[1:], strict=False):
        assert apply(state, action) == after
        last = 2 * state.crossings
        assert isinstance(action, R1 | C)
        assert last == action.idx if isinstance(action, R1) else last in {action.over, action.under}


def test_states_and_plans_of_the_catalogue(catalogue: list[Cable]) -> None:
    actions = 0
    for cable in catalogue:
        state = cable_state(cable)
        signs = cable.crossings.sign.tolist()
        assert state == RopeState.from_gauss(gauss_code(cable), signs)
        plan = flown_plan(cable)
        check_plan(cable, plan)
        actions += len(plan)
    assert (len(catalogue), actions) == (2042, 29120)


def test_the_rope_laid_so_far_has_the_plans_states(catalogue: list[Cable]) -> None:
    """By its crossings as seen from above, just after each one is made."""
    for cable in catalogue[::97]:
        plan = flown_plan(cable)
        for time, state in zip(second_visits(cable), plan.states[1:], strict=True):
            assert extract_state(laid(cable, time + 0.5)).state == state


@settings(max_examples=60)
@given(cables())
def test_any_cable(cable: Cable) -> None:
    assert extract_state(laid(cable, cable.length)).state == cable_state(cable)
    plan = flown_plan(cable)
    check_plan(cable, plan)
    for time, state in zip(second_visits(cable), plan.states[1:], strict=True):
        assert extract_state(laid(cable, time + 0.5)).state == state


def test_a_flight_is_one_of_the_plans_to_its_state(catalogue: list[Cable]) -> None:
    for cable in catalogue[::41]:
        plan = flown_plan(cable)
        graph = plan_graph(cable_state(cable))
        for state, action, after in zip(plan.states, plan.actions, plan.states[1:], strict=False):
            assert (action, after) in graph.steps[state]


def test_a_flight_backward_lays_the_reverse() -> None:
    """From p_n to p_1: the plan of the reversed state, with its labels reversed step by step."""
    state = cable_state(Cable(torus_knot(3, 4), "L+"))
    backward = laid_plan(state.reverse())
    mirrored = [RopeState(()), *(step.reverse() for step in backward.states[1:])]
    for before, action, after in zip(mirrored, backward.actions, mirrored[1:], strict=False):
        assert apply(before, action.reverse(before.crossings)) == after
    assert mirrored[-1] == state


def test_an_unknotted_cable_without_crossings() -> None:
    cable = Cable(torus_knot(1, 1), "L+")
    assert cable_state(cable) == TRIVIAL and len(flown_plan(cable)) == 0
    faces = leader_faces(cable)
    assert faces.inside.shape == (0, 0) and faces.kept_open.shape == (0,)


def picture(cable: Cable, *intervals: tuple[int, int]) -> IntArray:
    """Faces as numbers at twice the resolution, with the cable drawn during some intervals.

    The lattice point [column, row] is at (2 column, 2 row), middles of unit squares are at odd
    places; 0 marks the cable.
    """
    size = 2 * cable.diagram.size + 3
    free = np.ones((size, size), dtype=bool)
    for first, last in intervals:
        cells = cable.cells[first : last + 1]
        free[tuple(2 * cells.T)] = False
        free[tuple((cells[:-1] + cells[1:]).T)] = False
    labels: IntArray = ndimage.label(free)[0]
    return labels


def beside(cable: Cable, time: int, labels: IntArray) -> int:
    """The face at a square that touches the unit step of the cable after a time."""
    here, there = cable.cells[time], cable.cells[time + 1]
    ahead = there - here
    x, y = here + there + (-ahead[1], ahead[0])
    return int(labels[x, y])


def check_faces(cable: Cable, faces: LeaderFaces) -> None:
    seconds = second_visits(cable)
    regions = faces.regions
    for action, time in enumerate(seconds, 1):
        labels = picture(cable, (0, time))
        assert labels.max() == action + 1
        assert faces.inner[action - 1] == (beside(cable, time, labels) != labels[0, 0])
    for number, region in enumerate(regions):
        closed = region.intervals[-1][1]
        assert seconds[faces.closing[number] - 1] == closed
        labels = picture(cable, *region.intervals)
        for action, time in enumerate(seconds):
            assert faces.inside[number, action] == (
                time >= closed and beside(cable, time, labels) != labels[0, 0]
            )


def check_agreement(cable: Cable, faces: LeaderFaces) -> Counter[str]:
    """What must hold between required faces and active regions; counts."""
    seconds = [*second_visits(cable), cable.length + 1]
    visits, _, over = cable.visits
    turns = np.diff(np.searchsorted(cable.times, seconds)) > 0
    sides = over[np.searchsorted(visits, seconds[:-1])]
    assert (faces.inside.any(axis=0) == faces.inner).all()
    only_passed = faces.inner & ~faces.kept_open
    assert not (only_passed & turns).any()
    for action in np.flatnonzero(only_passed):
        assert sides[action] == sides[action + 1]
    passive_entered = ~faces.is_active & faces.is_entered
    assert not (faces.inside[passive_entered] & turns).any()
    for number in np.flatnonzero(faces.is_active & ~faces.is_entered).tolist():
        region = faces.regions[number]
        labels = picture(cable, *region.intervals)
        within = [
            cable.times[point]
            for point, place in enumerate(2 * cable.points)
            if labels[tuple(place)] not in {0, labels[0, 0]}
        ]
        # Nothing inside, but in a bay; or what is inside was laid before the pocket closed.
        assert all(time < region.intervals[-1][1] for time in within)
    later = [
        bool(inside[closing:].any())
        for inside, closing in zip(faces.inside, faces.closing, strict=True)
    ]
    return Counter(
        inner=int(faces.inner.sum()),
        kept=int((faces.inner & faces.kept_open).sum()),
        active=int(faces.is_active.sum()),
        entered=int((faces.is_active & faces.is_entered).sum()),
        later=int((faces.is_active & np.array(later, dtype=bool)).sum()),
        passive=int((~faces.is_active).sum()),
        passed=int(passive_entered.sum()),
    )


def test_faces_in_pictures_of_the_catalogue(catalogue: list[Cable]) -> None:
    for cable in catalogue[::67]:
        check_faces(cable, leader_faces(cable))


@settings(max_examples=60)
@given(cables(min_size=3, max_size=11))
def test_faces_in_pictures_of_any_cable(cable: Cable) -> None:
    faces = leader_faces(cable)
    check_faces(cable, faces)
    check_agreement(cable, faces)


def test_required_faces_and_active_regions_of_the_catalogue(catalogue: list[Cable]) -> None:
    """The numbers in the docstring of `LeaderFaces`."""
    counts = sum((check_agreement(cable, leader_faces(cable)) for cable in catalogue), Counter())
    assert (counts["inner"], counts["kept"]) == (15538, 15410)
    assert (counts["active"], counts["entered"], counts["later"]) == (23626, 23626, 23626 - 615)
    assert (counts["passive"], counts["passed"]) == (18007, 4198)


def test_an_active_pocket_that_nothing_enters_and_a_loop_with_a_bay() -> None:
    for size, seed, cut, name in (
        (6, 14, "L+", "pocket c2 c3"),
        (10, 2, "col7+", "loop c1"),
    ):
        cable = Cable(random_knot(size, seed), cut)
        faces = leader_faces(cable)
        (number,) = np.flatnonzero(faces.is_active & ~faces.is_entered).tolist()
        assert faces.regions[number].name == name
        check_agreement(cable, faces)
