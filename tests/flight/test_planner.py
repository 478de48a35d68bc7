"""Plans of flights for the Table I grids, examined from their samples; and impossible requests."""

from __future__ import annotations

import math
from functools import cache
from itertools import combinations, pairwise, product

import numpy as np
import pytest

from knotopt import Cable, shipped_knots
from knotopt.arrays import FloatArray
from knotopt.catalogue.table1_grids import table1_grids
from knotopt.errors import RequirementError
from knotopt.flight.examine import examine_plan
from knotopt.flight.limits import FlightLimits
from knotopt.flight.plan import FlightPlan
from knotopt.flight.planner import plan_flight
from knotopt.path.world import World
from knotopt.supports.requirements import Requirements
from knotopt.supports.selection import choose_supports
from knotopt.verify.flight_limits import LimitsReport
from knotopt.verify.flight_word import compare_words, plan_word

CHOICES = ("lcf", "milp", "all")
GRIDS = {grid.row: grid for grid in table1_grids() if grid.preferred}
SMALL = {("3", "lcf"), ("3", "milp"), ("3", "all"), ("4", "lcf")}
CASES = [
    pytest.param(*case, id="-".join(case), marks=[] if case in SMALL else pytest.mark.slow)
    for case in product(GRIDS, CHOICES)
]


@cache
def planned(row: str, choice: str, schedule: str = "optimised") -> FlightPlan:
    grid = GRIDS[row]
    requirements = Requirements("span", 0.25) if choice == "milp" else None
    found = choose_supports(grid.diagram, choice, "best", requirements)
    return plan_flight(grid.knot, found.cable, found.supports, choice, schedule=schedule)


def measured(plan: FlightPlan) -> LimitsReport:
    return examine_plan(plan).limits


def flown(track: FloatArray) -> FloatArray:
    """Distance flown up to each sample."""
    moved = np.linalg.norm(np.diff(track, axis=0), axis=1)
    return np.concatenate(([0.0], np.cumsum(moved)))


@pytest.mark.parametrize(("row", "choice"), CASES)
@pytest.mark.parametrize("schedule", ["optimised", "fixed"])
def test_limits_are_kept(row: str, choice: str, schedule: str) -> None:
    report = measured(planned(row, choice, schedule))
    broken = {sentence for sentence in report.broken if sentence != report.separation.broken}
    assert not broken


@pytest.mark.parametrize(("row", "choice"), CASES)
def test_robots_keep_their_separation_or_a_note_says_so(row: str, choice: str) -> None:
    plan = planned(row, choice)
    separation = measured(plan).separation
    assert not separation.broken or any("separation" in note for note in plan.notes)


@pytest.mark.parametrize(("row", "choice"), CASES)
@pytest.mark.parametrize("schedule", ["optimised", "fixed"])
def test_the_route_crosses_laid_cable_as_planned(row: str, choice: str, schedule: str) -> None:
    plan = planned(row, choice, schedule)
    along = flown(plan.route)
    track = flown(plan.positions[:, -1])
    assert track[-1] == pytest.approx(along[-1] - leading(plan), rel=0.01)
    passes = leading(plan) + np.interp(plan.passes, plan.times, track)
    places = [plan.route[int(np.argmin(np.abs(along - at)))] for at in passes]
    assert np.abs(np.array(places) - plan.anchors[:-1]).max() < 0.08
    word = plan_word(plan.route, passes, plan.anchors, plan.lengths)
    rows = compare_words(plan.crossings, word)
    assert [row.kind for row in rows] == ["as planned"] * len(rows)
    assert rows or not plan.crossings
    for row_ in rows:
        assert row_.planned is not None and row_.executed is not None


def leading(plan: FlightPlan) -> float:
    """Distance along the route, straight there, at which the leader starts."""
    return float(np.linalg.norm(plan.positions[0, -1] - plan.route[0]))


@pytest.mark.parametrize(("row", "choice"), CASES)
@pytest.mark.parametrize("schedule", ["optimised", "fixed"])
def test_crossings_are_in_order_and_the_leader_is_there_in_time(
    row: str, choice: str, schedule: str
) -> None:
    plan = planned(row, choice, schedule)
    times = [crossing.time for crossing in plan.crossings]
    assert times == sorted(times)
    assert sorted(plan.passes.tolist()) == plan.passes.tolist()
    for crossing in plan.crossings:
        assert plan.limits.hover_before < crossing.time < plan.duration - plan.limits.hover_after
        assert plan.passes[crossing.span - 1] < crossing.time
        assert crossing.span == len(plan.passes) or crossing.time < plan.passes[crossing.span]
        leader = [np.interp(crossing.time, plan.times, axis) for axis in plan.positions[:, -1].T]
        assert leader == pytest.approx([*crossing.place, crossing.height], abs=0.03)
        assert (crossing.height > crossing.cable_height) is crossing.over
    leader_at_passes = np.column_stack(
        [np.interp(plan.passes, plan.times, axis) for axis in plan.positions[:, -1].T]
    )
    assert leader_at_passes == pytest.approx(plan.anchors[:-1], abs=0.03)


@pytest.mark.parametrize(("row", "choice"), CASES)
def test_robots_start_in_file_stay_in_it_and_end_at_their_anchors(row: str, choice: str) -> None:
    plan = planned(row, choice)
    cable, world = plan.cable, plan.world
    indices = [1, *plan.supports, len(cable.path)]
    anchors = np.array([cable.path[k - 1] for k in indices]) * world.step
    assert plan.anchors[:, :2] == pytest.approx(anchors, abs=5e-3)
    assert plan.anchors[:, 2] == pytest.approx(world.altitude, abs=5e-3)
    # In file: on a straight line out of p_1's place, the leader first, evenly spaced.
    start = plan.positions[0]
    assert start[-1] == pytest.approx(plan.anchors[0], abs=0.03)
    gaps = np.diff(start, axis=0)
    assert np.abs(gaps - gaps[0]).max() < 0.01  # the route is rounded where it bends next
    assert np.linalg.norm(gaps[0]) >= plan.limits.spacing - 1e-3
    # Every robot flies the leader's route as far as its anchor, and none passes another.
    along = flown(plan.route)
    offsets = np.linalg.norm(start - plan.route[0], axis=1)
    before = np.full(len(plan.times), -np.inf)
    for robot in range(plan.robots):
        at = offsets[robot] + flown(plan.positions[:, robot])
        on_route = np.column_stack([np.interp(at, along, axis) for axis in plan.route.T])
        assert np.abs(on_route - plan.positions[:, robot]).max() < 0.08
        assert (at - before > 0.05).all()
        before = at
    # Rear robots stop first.
    arrived = [
        int(np.argmax(np.linalg.norm(track - track[-1], axis=1) < 1e-3))
        for track in plan.positions.transpose(1, 0, 2)
    ]
    assert arrived == sorted(arrived)


@pytest.mark.parametrize("choice", ["lcf", "milp"])
def test_a_plan_is_the_same_twice(choice: str) -> None:
    plan = planned("3", choice)
    again = plan_flight(plan.name, plan.cable, plan.supports, choice)
    assert np.array_equal(plan.positions, again.positions)
    assert np.array_equal(plan.lengths, again.lengths) and plan.crossings == again.crossings


def share(row: str, choice: str) -> float:
    """Duration of the optimised flight, of that of the fixed one."""
    return planned(row, choice).duration / planned(row, choice, "fixed").duration


def test_the_optimised_schedule_is_much_shorter_than_the_fixed_one() -> None:
    assert max(share(*case) for case in SMALL) <= 0.8


@pytest.mark.slow
@pytest.mark.parametrize("choice", CHOICES)
def test_it_is_shorter_by_a_fifth_in_the_median_over_all_rows(choice: str) -> None:
    every = [share(row, choice) for row in GRIDS]
    assert np.median(every) <= 0.8 and max(every) < 1


def trefoil() -> Cable:
    return Cable(shipped_knots()["3_1"].diagram, "L+")


def test_a_schedule_of_no_such_name() -> None:
    with pytest.raises(RequirementError, match="optimised, fixed, not 'fastest'"):
        plan_flight("3_1", trefoil(), (3, 4, 6), schedule="fastest")


@pytest.mark.parametrize(
    ("world", "message"),
    [
        (
            World(step=0.5, altitude=2.2, floor=2.15, ceiling=3.2),
            "under span ., which .* flies at .* m; ",
        ),
        (
            World(step=0.5, altitude=2.2, floor=0.2, ceiling=2.21),
            "over span ., which .* flies at .* m; ",
        ),
    ],
)
def test_a_room_that_is_too_low(world: World, message: str) -> None:
    with pytest.raises(RequirementError, match=message) as caught:
        plan_flight("3_1", trefoil(), (3, 4, 6), world=world, schedule="fixed")
    assert f"the room has {world.floor:g} to {world.ceiling:g} m" in str(caught.value)


def test_anchors_that_are_closer_than_the_separation() -> None:
    """Grid steps of 0.2 m: two robots hover less than 0.5 m apart; the error says which."""
    cable, supports = trefoil(), (3, 4, 6)
    world = World(step=0.2, altitude=2.2, floor=0.2, ceiling=3.2)
    limits = FlightLimits(separation=0.5, downwash=0.5, spacing=0.5)
    places = [cable.path[k - 1] for k in (1, *supports, len(cable.path))]
    apart = {
        (i + 1, j + 1): 0.2 * math.dist(places[i], places[j])
        for i, j in combinations(range(len(places)), 2)
    }
    (first, second), nearest = min(apart.items(), key=lambda item: item[1])
    assert nearest < 0.5
    message = f"robots {first} and {second} hover {nearest:.2f} m apart.* separation of 0.5 m"
    with pytest.raises(RequirementError, match=message):
        plan_flight("3_1", cable, supports, world=world, limits=limits, schedule="fixed")


def test_a_larger_spacing_is_kept() -> None:
    limits = FlightLimits(spacing=0.5)
    plan = plan_flight("3_1", trefoil(), (3, 4, 6), limits=limits, schedule="fixed")
    for one, other in pairwise(plan.positions[0]):
        assert np.linalg.norm(other - one) >= 0.5 - 1e-3
