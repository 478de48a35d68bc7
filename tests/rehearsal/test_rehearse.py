"""Planning by rehearsal: the trefoil, with supports and without."""

from __future__ import annotations

from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from knotopt.rehearsal import rehearse

pytest.importorskip("mujoco")

from knotopt import Cable, shipped_knots
from knotopt.flight.examine import examine_plan
from knotopt.flight.grid_layout import layout_of_supports
from knotopt.flight.layout import Layout
from knotopt.flight.limits import ROOM
from knotopt.flight.plan import FlightPlan, MotionPlan, with_supports
from knotopt.flight.planner import FlightPlanner
from knotopt.flight.request import FlightRequest
from knotopt.rehearsal.attempt import SHAPES, RehearsedFlight
from knotopt.rehearsal.observer import Observer
from knotopt.rehearsal.rehearse import rehearse_flight
from knotopt.sim.judge import Outcome, judge
from knotopt.sim.simulation import Simulation
from knotopt.sim.simulators import MUJOCO
from knotopt.sim.trials import fly_trial, simulate
from knotopt.supports.requirements import Requirements
from knotopt.supports.selection import choose_supports
from knotopt.verify.flight_limits import LimitsReport
from tests.helpers.layouts import TREFOIL


def measured(plan: FlightPlan) -> LimitsReport:
    return examine_plan(plan).limits


@cache
def flown() -> RehearsedFlight:
    """LCF's set for the trefoil, flown span by span."""
    chosen = choose_supports(shipped_knots()["3_1"].diagram, "lcf")
    return flown_by_layout(layout_of_supports(chosen.cable, chosen.supports))


def flown_by_layout(layout: Layout) -> RehearsedFlight:
    planner = FlightPlanner(layout).with_routes(SHAPES[0])
    crosses = np.array([len(word) > 0 for word in layout.words])
    run = RehearsedFlight(planner, np.where(crosses, 1.1, 1.0), SHAPES)
    assert run.fly() is None
    return run


@cache
def rehearsed() -> tuple[FlightPlan, tuple[str, ...], bool]:
    """Its plan, crossings failed, whether robots got stuck."""
    run = flown()
    return lcf_plan(run.motion()), tuple(run.given_up), run.stuck


def lcf_plan(motion: MotionPlan) -> FlightPlan:
    chosen = choose_supports(shipped_knots()["3_1"].diagram, "lcf")
    request = FlightRequest("3_1", "lcf")
    return with_supports(motion, chosen.cable, chosen.supports, request)


def test_a_rehearsed_plan_ties_the_trefoil() -> None:
    plan, failed, stuck = rehearsed()
    assert (failed, stuck, plan.schedule) == ((), False, "rehearsed")
    assert fly_trial(plan).verdict.outcome is Outcome.TIED


def test_a_rehearsed_plan_keeps_its_limits_but_for_where_its_parts_meet() -> None:
    report = measured(rehearsed()[0])
    assert set(report.broken) <= {report.acceleration.broken}


def test_a_rehearsed_plan_keeps_its_limits() -> None:
    plan, _, _ = rehearsed()
    assert measured(plan).broken == ()
    # From sample to sample too, with what a window of 0.1 s hides.
    steps = np.linalg.norm(np.diff(plan.positions, axis=0), axis=2)
    changes = np.linalg.norm(np.diff(plan.positions, n=2, axis=0), axis=2)
    assert steps.max() <= 1.01 * plan.limits.speed * plan.interval
    assert changes.max() <= 1.1 * plan.limits.acceleration * plan.interval**2


def test_a_file_that_starts_farther_out_flies_the_same_route() -> None:
    planner = flown().planner
    before = planner.formation()
    after = planner.started_farther(2.0).formation()
    more = after.stops[0] - before.stops[0]
    assert more == pytest.approx(2.0 * ROOM.step, abs=0.01)
    assert (planner.layout.robots - 1) * (after.spacing - before.spacing) == pytest.approx(more)
    inner = before.nodes
    leader = [each.positions(inner + shift)[:, -1] for each, shift in ((before, 0), (after, more))]
    assert leader[1] == pytest.approx(leader[0], abs=1e-3)
    assert np.diff(after.stops) == pytest.approx(np.diff(before.stops))


@pytest.mark.slow
def test_robots_that_came_too_near_fly_the_route_in_a_longer_file() -> None:
    run = flown()
    limits = replace(run.planner.limits, separation=0.33, spacing=0.33)  # more than it keeps
    planner = replace(run.planner, limits=limits)
    tight = planner.formation().separation
    chosen = choose_supports(shipped_knots()["3_1"].diagram, "lcf")
    request = FlightRequest("3_1", "lcf", limits=limits, schedule="fixed")
    task = rehearse._Task(chosen.cable, chosen.supports, request, MUJOCO)
    found = [each.flown for each in rehearse._from_farther(task, planner, run.lengths)]
    assert tight < 1 and 1 <= len(found) <= rehearse.FLOWN
    best = max(found, key=lambda each: each.rank)
    assert best.is_tied and best.separation >= 1
    assert measured(best.plan).separation.value >= 0.99


def assert_leader_is_at_its_crossings(plan: FlightPlan, near: float) -> None:
    assert plan.crossings
    times = [crossing.time for crossing in plan.crossings]
    assert times == sorted(times)
    for crossing in plan.crossings:
        assert plan.limits.hover_before < crossing.time < plan.duration - plan.limits.hover_after
        leader = [np.interp(crossing.time, plan.times, axis) for axis in plan.positions[:, -1].T]
        assert leader == pytest.approx([*crossing.place, crossing.height], abs=near)
        assert (crossing.height > crossing.cable_height) is crossing.over
    passed = np.column_stack(
        [np.interp(plan.passes, plan.times, axis) for axis in plan.positions[:, -1].T]
    )
    assert passed == pytest.approx(plan.anchors[:-1], abs=near)


def test_the_leader_is_at_its_crossings_when_the_plan_says_so() -> None:
    plan, _, _ = rehearsed()
    assert_leader_is_at_its_crossings(plan, 0.05)


def test_a_layout_without_a_grid_is_flown_and_ties_the_trefoil() -> None:
    run = flown_by_layout(TREFOIL)
    motion = run.motion()
    assert not run.stuck and motion.robots == 3
    assert [crossing.name for crossing in motion.crossings] == [
        "span 2 over span 1",
        "span 2 under span 1",
    ]
    assert judge(simulate(motion), shipped_knots()["3_1"].diagram).outcome is Outcome.TIED


def test_without_supports_nothing_is_tied() -> None:
    cable = Cable(shipped_knots()["3_1"].diagram, "L+")
    found = rehearse_flight(cable, (), FlightRequest("3_1"), attempts=1)
    assert not found.is_tied
    assert found.plan.robots == 2 and found.plan.crossings == ()
    assert measured(found.plan).broken == ()


def hovering(away: float) -> tuple[FlightPlanner, Simulation]:
    """A robot at every turning point of the trefoil, the third one off its place [m]."""
    cable = Cable(shipped_knots()["3_1"].diagram, "L+")
    layout = layout_of_supports(cable, tuple(range(2, len(cable.path))))
    apart = np.linalg.norm(np.diff(layout.places, axis=0), axis=1)
    planner = FlightPlanner(layout, lengths=tuple(1.1 * apart))
    flat = planner.layout.places * ROOM.step
    robots = np.column_stack((flat, np.full(len(flat), ROOM.altitude)))
    robots[2, :2] += away * (flat[1] - flat[2]) / np.hypot(*(flat[1] - flat[2]))
    lengths = np.array(planner.lengths) * ROOM.step
    simulation = MUJOCO.start(robots, lengths, step=ROOM.step, speed=0.6)
    simulation.follow(np.repeat(robots[None], 60, axis=0), 0.05)
    return planner, simulation


def test_cable_is_seen_as_it_lies_where_robots_have_arrived_and_else_as_modelled() -> None:
    planner, simulation = hovering(0.3)
    laid, modelled = Observer(planner, simulation).laid(3), planner.modelled_cable(3)
    spans = zip(laid.spans, modelled.spans, strict=True)
    assert [np.array_equal(one, other) for one, other in spans] == [False, True, True]
    for end, place in zip(laid.spans[0][[0, -1]], planner.layout.places[:2], strict=True):
        assert end == pytest.approx([*place, 0.0], abs=0.05)
    tether = Observer(planner, simulation).tether(len(planner.layout.places) - 1)
    assert tether is not None
    assert tether[0] == pytest.approx(planner.layout.places[-2], abs=0.05)
    assert np.linalg.norm(tether - planner.layout.places[-1], axis=1).min() > 0.5


def test_the_height_of_cable_is_seen() -> None:
    """Spans that hang freely between their robots hang as low as they do in the simulation."""
    planner, simulation = hovering(0.0)
    laid = Observer(planner, simulation).laid(4)
    for span, points in enumerate(laid.spans):
        held = slice(simulation.held[span], simulation.held[span + 1] + 1)
        lowest = (simulation.cable[held, 2].min() - ROOM.altitude) / ROOM.step
        assert lowest < -0.2
        assert points[:, 2].min() == pytest.approx(lowest, abs=0.05)


@pytest.mark.slow
def test_the_smallest_set_ties_the_trefoil_the_same_way_twice() -> None:
    diagram = shipped_knots()["3_1"].diagram
    chosen = choose_supports(diagram, "milp", "best", Requirements("span", 0.25))
    request = FlightRequest("3_1", "milp")
    one, other = (rehearse_flight(chosen.cable, chosen.supports, request) for _ in range(2))
    assert one.is_tied and one.given_up == ()
    assert one.separation >= 1 and measured(one.plan).broken == ()
    assert_leader_is_at_its_crossings(one.plan, 0.03)
    assert np.array_equal(one.plan.positions, other.plan.positions)
    assert np.array_equal(one.undisturbed.record.cable, other.undisturbed.record.cable)
    assert (one.robust, one.ways, one.rehearsals) == (other.robust, other.ways, other.rehearsals)
