"""What the team asks, compiled from a cable: distances between its turning points."""

from __future__ import annotations

import numpy as np

from formulations.team import ReachTarget, Team
from knotopt.arrays import FloatArray
from knotopt.cable.cable import Cable
from knotopt.supports.regions import Regions
from knotopt.supports.registry import find_formulation
from knotopt.supports.requirements import Requirements
from knotopt.supports.threading import threading_points

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
    u, w = np.triu_indices(len(cable.path), k=1)
    too_close: tuple[tuple[int, int], ...] = ()
    too_long: tuple[tuple[int, int], ...] = ()
    if requirements.separation is not None:
        close = distance[u, w] < requirements.separation - SLACK
        too_close = tuple(zip((u[close] + 1).tolist(), (w[close] + 1).tolist(), strict=True))
    if requirements.payload is not None:
        long = distance[u, w] > requirements.payload + SLACK
        too_long = tuple(zip((u[long] + 1).tolist(), (w[long] + 1).tolist(), strict=True))
    return Team(
        too_close=too_close,
        too_long=too_long,
        reach=tuple(_reach(regions, requirements)) if requirements.reach is not None else (),
        forbidden=requirements.forbidden,
        forced=requirements.forced,
        excluded=requirements.excluded,
        at_most=requirements.max_robots,
    )


def _distances(cable: Cable) -> FloatArray:
    apart = cable.points[:, None] - cable.points[None]
    distances: FloatArray = np.sqrt((apart * apart).sum(axis=-1))
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
    partner = {}
    for first, second in zip(
        cable.crossings.first.tolist(), cable.crossings.second.tolist(), strict=True
    ):
        partner[first], partner[second] = second, first
    targets = {}
    for region, q, entry in zip(
        threading.region.tolist(), threading.point.tolist(), threading.entry.tolist(), strict=True
    ):
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
