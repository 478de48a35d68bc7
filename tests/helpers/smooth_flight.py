"""A flight that is smooth, as long and as steep as a test wants it."""

from __future__ import annotations

import numpy as np

from knotopt.cable.cable import Cable
from knotopt.diagram.families import torus_knot
from knotopt.flight.limits import ROOM, FlightLimits
from knotopt.flight.plan import FlightPlan, PlannedCrossing
from knotopt.path.world import World

AMPLE = FlightLimits(speed=9, acceleration=90)


def flight(
    *,
    legs: tuple[int, ...] = (3,),
    depth: float = 0.4,
    seconds: float = 20.0,
    interval: float = 0.05,
    robots: int = 3,
    limits: FlightLimits = AMPLE,
    world: World = ROOM,
) -> FlightPlan:
    """A flight that is smooth: robots glide to their anchors, the leader in bends and dips.

    On each leg, of `seconds`, the leader makes that many bends and dips of that depth; between
    legs all rest for 1 s.
    """
    times = np.arange(round((len(legs) * (seconds + 1) + 4) / interval) + 1) * interval
    share, bends = np.zeros(len(times)), np.zeros(len(times))
    for number, count in enumerate(legs):
        u = np.clip((times - 2 - number * (seconds + 1)) / seconds, 0, 1)
        smooth = u**4 * (35 - 84 * u + 70 * u**2 - 20 * u**3)
        share += smooth / len(legs)
        bends += count * smooth
    start = np.arange(robots)[:, None] * [0.3, 0.0, 0.0] + [1.0, 0.5, 2.0]
    anchors = start + np.arange(robots)[:, None] * [0.5, 1.0, 0.0]
    positions = start + share[:, None, None] * (anchors - start)
    positions[:, -1, 0] += 0.5 * np.sin(2 * np.pi * bends) ** 2
    positions[:, -1, 2] -= depth * np.sin(np.pi * bends) ** 2
    amid = len(times) // 2
    place = positions[amid, -1]
    return FlightPlan(
        name='3_1 "flat"',
        cable=Cable(torus_knot(2, 3), "L+"),
        supports=tuple(range(3, 3 + robots - 2)),
        chosen_by="all",
        schedule="fixed",
        world=world,
        limits=limits,
        times=times,
        positions=positions,
        lengths=np.full(robots - 1, 3.0),
        route=positions[:, -1],
        crossings=(
            PlannedCrossing(
                robots - 1, 1, True, 1, (place[0], place[1]), place[2], place[2] - 0.3, 2.0,
                float(times[amid]),
            ),
        ),
        passes=np.zeros(robots - 1),
    )  # fmt: skip
