"""Missions as `knotopt fly` makes them: planned on the model of laid cable, or flown in physics."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace

from knotopt.export.crazyswarm import export_files
from knotopt.flight.examine import examine_plan
from knotopt.flight.plan import FlightPlan
from knotopt.flight.record import Disturbance
from knotopt.flight.request import FlightRequest
from knotopt.mission.alternatives import plan_first, plan_set, rehearse_first
from knotopt.mission.content import flight_content
from knotopt.mission.mission import Mission, seed_name
from knotopt.sim.simulators import MUJOCO, Simulator
from knotopt.sim.trials import fly_trial
from knotopt.supports.selection import GivenSupports
from knotopt.supports.support_set import SupportSet


def plan_mission(sets: Iterable[SupportSet], request: FlightRequest) -> Mission:
    """A mission by the model of laid cable.

    Raises
    ------
    As `plan_first`.
    """
    plan = plan_first(sets, request)
    if plan.schedule == "fixed":
        return _examined(plan)
    same = GivenSupports(plan.cable, plan.supports)
    return _examined(plan, plan_set(same, replace(request, schedule="fixed")).duration)


def rehearse_mission(
    sets: Iterable[SupportSet],
    request: FlightRequest,
    tighten: float | None = None,
    simulator: Simulator = MUJOCO,
) -> Mission:
    """A mission rehearsed in physics, perhaps pulled tight, and flown undisturbed.

    Raises
    ------
    As `rehearse_first`.
    """
    flown = rehearse_first(sets, request, tighten, simulator=simulator)
    plan = flown.plan
    mission = _examined(plan, None if plan.schedule == "fixed" else flown.steady)
    return replace(mission, flown=flown)


def fly_disturbed(
    mission: Mission, disturbances: Iterable[Disturbance], simulator: Simulator = MUJOCO
) -> Mission:
    """The mission with its plan flown once more for each disturbance."""
    contents, failed = [], None
    for disturbance in disturbances:
        flight = fly_trial(mission.plan, disturbance, simulator)
        contents.append(flight_content(seed_name(flight), flight))
        if failed is None and not flight.is_tied:
            failed = flight
    return replace(mission, failed=failed, disturbed=tuple(contents))


def _examined(plan: FlightPlan, steady: float | None = None) -> Mission:
    exports, fit = export_files(plan)
    return Mission(plan, examine_plan(plan), exports, fit, steady)
