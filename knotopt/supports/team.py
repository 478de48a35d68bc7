"""What the team asks, compiled from a cable: distances between its turning points."""

from __future__ import annotations

import numpy as np

from formulations.team import ReachTarget, Team
from knotopt.arrays import BoolArray, FloatArray
from knotopt.cable.cable import Cable
from knotopt.supports.loops import loop_stretches
from knotopt.supports.regions import Regions
from knotopt.supports.registry import find_formulation
from knotopt.supports.requirements import Requirements
from knotopt.supports.threading_points import threading_points

SLACK = 1e-9  # distances are compared with decimals that users write [grid steps]


def compile_team(regions: Regions, requirements: Requirements) -> Team:
    """The optional families of the requirements, for one cable.

    Raises
    ------
    RequirementError
        A point that the cable does not have.
    """
    cable = regions.cable
    requirements.check_points(len(cable.path))
    distance = _distances(cable)
    separation, payload = requirements.separation or 0.0, requirements.payload or np.inf

    def pairs(chosen: BoolArray) -> tuple[tuple[int, int], ...]:
        return tuple((u, w) for u, w in (np.argwhere(np.triu(chosen, k=1)) + 1).tolist())

    return Team(
        stretches=loop_stretches(cable) if requirements.with_loops else (),
        too_close=pairs(distance < separation - SLACK),
        too_long=pairs(distance > payload + SLACK),
        reach=tuple(_reach(regions, requirements)) if requirements.reach is not None else (),
        forbidden=requirements.forbidden,
        forced=requirements.forced,
        excluded=requirements.excluded,
        clauses=requirements.clauses,
        at_most=requirements.max_robots,
    )


def _distances(cable: Cable) -> FloatArray:
    distances: FloatArray = np.linalg.norm(cable.points[:, None] - cable.points, axis=-1)
    return distances


def _reach(regions: Regions, requirements: Requirements) -> list[ReachTarget]:
    """For each threading: the robots that may be near, each with what makes it one of them.

    The threaded span is the one that the strand passes when it enters: its ends are the last robot
    before that place and the first one after it, if that is laid by then. The span being flown
    starts at the last robot before the threading point.
    """
    cable = regions.cable
    threading = threading_points(regions, requirements.threading)
    if find_formulation(requirements.formulation).threads_once:
        threading = threading.first_of_strands()
    assert requirements.reach is not None
    near = _distances(cable) <= requirements.reach + SLACK
    first, second = cable.crossings.first.tolist(), cable.crossings.second.tolist()
    partner = dict(zip(first + second, second + first, strict=True))
    targets = {}
    columns = (threading.region, threading.point, threading.entry)
    for region, q, entry in zip(*(column.tolist() for column in columns), strict=True):
        crossed = int(np.searchsorted(cable.times, partner[entry]))  # first point after it
        entered = int(np.searchsorted(cable.times, entry))
        options = []
        for k in np.flatnonzero(near[q]).tolist():
            laid = partner[entry] < entry and k < entered
            if laid and k < crossed:
                options.append((k + 1, *range(-(k + 2), -crossed - 1, -1)))
            if laid and k >= crossed:
                options.append((k + 1, *range(-(crossed + 1), -k - 1, -1)))
            if k < q:
                options.append((k + 1, *range(-(k + 2), -q - 1, -1)))
        name = f"{regions.name(region)}, threaded at p{q + 1}"
        targets[entry, q] = ReachTarget(tuple(dict.fromkeys(options)), name)
    return list(targets.values())
