"""A flight of five robots that is made up quickly: straight ways to the anchors, one crossing."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from knotopt.cable.cable import Cable
from knotopt.diagram.families import torus_knot
from knotopt.flight.limits import ROOM, FlightLimits
from knotopt.flight.plan import FlightPlan, PlannedCrossing
from knotopt.flight.record import Disturbance, FlightRecord
from knotopt.rehearsal.flown_set import FlownSet
from knotopt.sim.judge import Verdict
from knotopt.sim.trials import Flight

EDGES = 12  # of the recorded cable between two robots


def small_plan(name: str = "3_1") -> FlightPlan:
    """Robots leave their file at 2 s and hover at their anchors from 8 s to 11 s."""
    cable = Cable(torus_knot(2, 3), "L+")
    supports = (4, 5, 7)
    turning = cable.points[[0, *(index - 1 for index in supports), -1]] * ROOM.step
    anchors = np.column_stack((turning, np.full(len(turning), ROOM.altitude)))
    file = anchors[0] + np.arange(len(turning))[:, None] * np.array([0.3, 0.0, 0.0])
    times = np.linspace(0, 11, 221)
    share = np.interp(times, [2, 8], [0, 1])[:, None, None]
    positions = file + share * (anchors - file)
    apart = np.linalg.norm(np.diff(positions, axis=1), axis=2).max(axis=0)
    crossing = PlannedCrossing(4, 1, True, 1, (0.8, 1.6), 2.3, 1.9, 2.0, 5.0)
    return FlightPlan(
        name=name,
        cable=cable,
        supports=supports,
        chosen_by="milp",
        schedule="fixed",
        world=ROOM,
        limits=FlightLimits(),
        times=times,
        positions=positions,
        lengths=1.1 * apart,
        route=positions[:, -1],
        crossings=(crossing, replace(crossing, older=2, over=False, height=1.4, time=7.0)),
        passes=np.linspace(2, 6.5, len(turning) - 1),
    )


def small_record(plan: FlightPlan, seconds: float = 12.1) -> FlightRecord:
    """A flight of that plan, evenly slower, 0.1 m higher, the cable straight between robots."""
    times = np.linspace(0, seconds, 243)
    clock = times * plan.duration / seconds
    frame = np.rint(clock / plan.interval).astype(int)
    robots = plan.positions[frame] + [0.0, 0.0, 0.1]
    vertices = np.linspace(0, plan.robots - 1, EDGES * (plan.robots - 1) + 1)
    low = np.minimum(vertices.astype(int), plan.robots - 2)
    share = (vertices - low)[:, None]
    return FlightRecord(
        times=times,
        clock=clock,
        cable=robots[:, low] + share * (robots[:, low + 1] - robots[:, low]),
        held=np.arange(plan.robots) * EDGES,
        finished=True,
        smallest_distance=0.02,
        largest_tension=0.1,
        disturbance=Disturbance(),
        seconds=0.5,
    )


def flown_set(*verdicts: Verdict) -> FlownSet:
    """Of that plan, as if its flights, the undisturbed one first, had been judged so."""
    plan = small_plan()
    first, *others = (Flight(plan, small_record(plan), verdict) for verdict in verdicts)
    return FlownSet(first, tuple(others))


def crossed(record: FlightRecord, lift: float) -> FlightRecord:
    """Two frames in which the last of three straight spans crosses the first, `lift` higher."""
    corners = np.array([[0, 0, 0], [2, 2, 0], [2, 0, lift], [0, 2, lift]], dtype=float)
    along = np.linspace(0, 3, 31)
    cable = np.column_stack([np.interp(along, range(4), axis) for axis in corners.T])
    return replace(
        record,
        times=record.times[:2],
        clock=record.clock[:2],
        cable=np.stack((cable, cable)),
        held=np.array([0, 10, 20, 30]),
    )
