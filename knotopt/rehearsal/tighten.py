"""Pulling a knot tight: its ends fly apart, and the supports give way to the cable.

Robots stay on the cable, so a knot is tight when two of them cannot come closer, or when cable from
end to end holds. How the supports give way is found in simulation: they keep their height and fly
as fast as cable draws them. Their ways, smoothed, become part of the plan.
"""

from __future__ import annotations

import logging
from dataclasses import replace

import numpy as np
from scipy.interpolate import CubicSpline
from scipy.ndimage import gaussian_filter1d
from scipy.spatial.distance import pdist

from knotopt.arrays import FloatArray
from knotopt.cable.cable import Cable
from knotopt.errors import RequirementError
from knotopt.flight.plan import FlightPlan
from knotopt.flight.planner import INTERVAL, sample_times, with_margin
from knotopt.path.world import World
from knotopt.rehearsal.flown_set import FlownSet
from knotopt.rehearsal.rehearse import TRIALS
from knotopt.sim.simulation import FRAME_TIME, PROGRESS
from knotopt.sim.simulators import MUJOCO, Simulator
from knotopt.sim.trials import fly_trial, fly_trials

logger = logging.getLogger(__name__)

PACE = 0.2  # of each end [m/s], at most half of what robots may fly
APART = 1.05  # of their separation that robots keep
TAUT = 0.99  # of the cable between two robots that they get apart
SMOOTH = 0.3  # standard deviation of the time over which ways are smoothed [s]
SHARES = (1.0, 0.8, 0.6, 0.4)
"""Of the pull that are tried, until the knot stays tied as often as before."""


def check_tightening(cable: Cable, apart: float, world: World) -> None:
    """Refuse to pull a knot's ends `apart` metres apart where that cannot be meant.

    Raises
    ------
    RequirementError
        Ends inside the diagram, which would be pulled through the knot, or that are as far apart
        already.
    """
    if not cable.cut.is_outer:
        raise RequirementError(
            f"a knot is pulled tight by ends outside it; those of cut {cable.cut} are inside: "
            "choose an outer cut"
        )
    laid = world.step * float(np.linalg.norm(cable.points[-1] - cable.points[0]))
    if not laid < apart < np.inf:
        raise RequirementError(
            f"the knot's ends are {laid:.2f} m apart when it is laid; "
            f"pulled tight they are farther apart, not {apart:g} m"
        )


def tighten_flight(flown: FlownSet, apart: float, simulator: Simulator = MUJOCO) -> FlownSet:
    """Pull the knot of a rehearsed flight tight after it.

    Parameters
    ----------
    flown : FlownSet
    apart : float
        That the ends get at most [m]. They stop earlier, and a note of the plan says why, where
        two robots come near their separation or the cable holds.
    simulator : Simulator

    Returns
    -------
    FlownSet
        Its plan has a `tightening`, its undisturbed flight is the whole one; `robust` too.
        The flight as it was, with a note, if it does not tie the knot, or no pull keeps it tied.

    Raises
    ------
    RequirementError
        As `check_tightening` raises it.
    """
    plan = flown.plan
    check_tightening(plan.cable, apart, plan.world)
    if not flown.is_tied:
        return flown.noted("not pulled tight: the flight does not tie the knot")
    logger.info("pulling tight")
    ways, why = _pull(plan, apart, simulator)
    for share in SHARES:
        tightened = _tightened(plan, ways[: max(2, round(share * len(ways)))])
        flight = fly_trial(tightened, simulator=simulator)
        robust = sum(each.is_tied for each in fly_trials(tightened, TRIALS, simulator))
        logger.info(
            "%g of the pull: %s; disturbed %d of %d", share, flight.verdict, robust, len(TRIALS)
        )
        if flight.is_tied and robust >= flown.robust:
            break
    else:
        return flown.noted("not pulled tight: no pull keeps the knot")
    tight = replace(flown, undisturbed=flight, robust=robust)
    if share < 1:
        why = "farther it is not the knot"
    pulled = f"the ends are pulled {tightened.ends_apart[1]:.2f} m apart, not {apart:g} m"
    return tight.noted(f"{pulled}: {why}") if why else tight


def _pull(plan: FlightPlan, apart: float, simulator: Simulator) -> tuple[FloatArray, str]:
    """Fly the plan, then the ends away from each other until something stops them.

    Returns
    -------
    ways : float array, shape (T, R, 3)
        Of the robots, a sample every `FRAME_TIME`.
    why : str
        It ended; "" if the ends are as far apart as they should.
    """
    simulation = simulator.start(
        plan.positions[0], plan.lengths, step=plan.world.step, speed=plan.limits.speed
    )
    simulation.follow(plan.positions, plan.interval)
    begun = len(simulation.record().times) - 1
    out = (plan.anchors[-1] - plan.anchors[0]) / np.linalg.norm(plan.anchors[-1] - plan.anchors[0])
    velocities = np.zeros_like(plan.anchors)
    pace = min(PACE, plan.limits.speed / 2)
    velocities[0], velocities[-1] = -pace * out, pace * out
    ellipsoid = [plan.limits.separation, plan.limits.separation, plan.limits.downwash]

    def is_far(robots: FloatArray) -> bool:
        return float(np.linalg.norm(robots[-1] - robots[0])) >= apart

    def nearest(robots: FloatArray) -> tuple[float, str]:
        distances = pdist(robots / ellipsoid)
        first, second = np.array(np.triu_indices(len(robots), 1))[:, distances.argmin()] + 1
        return float(distances.min()), f"robots {first} and {second} come too near each other"

    gave_way = simulation.pull(
        velocities, lambda robots: not is_far(robots) and nearest(robots)[0] > APART
    )
    record = simulation.record()
    end = len(record.times)
    if not gave_way:  # the time in which nothing moved is left out
        end = int(np.searchsorted(record.clock, record.clock[-1] - PROGRESS)) + 1
    ways = record.robots[begun:end]
    ways = ways[np.isfinite(ways).all(axis=(1, 2))]  # a simulation may break down
    if not gave_way:
        return ways, "the cable holds them"
    return ways, "" if is_far(simulation.robots) else nearest(simulation.robots)[1]


def _tightened(plan: FlightPlan, ways: FloatArray) -> FlightPlan:
    """The plan with robots' ways after it: level, smooth, within limits, the cable not taut."""
    moved = ways - ways[0]
    moved[:, :, 2] = 0.0
    rest = round(4 * SMOOTH / FRAME_TIME)  # in which smoothed robots start and stop
    moved = np.pad(moved, ((rest, rest), (0, 0), (0, 0)), mode="edge")
    places = plan.anchors + moved
    stretched = np.linalg.norm(np.diff(places, axis=1), axis=2) / plan.lengths
    middle = places.mean(axis=1, keepdims=True)
    most = np.maximum.accumulate(stretched.max(axis=1))
    places = middle + np.minimum(1.0, TAUT / most)[:, None, None] * (places - middle)
    smooth = gaussian_filter1d(places, SMOOTH / FRAME_TIME, axis=0, mode="nearest")
    curve = CubicSpline(FRAME_TIME * np.arange(len(smooth)), smooth, bc_type="clamped")
    speed, acceleration = with_margin(plan.limits)
    at = curve.x
    slower = max(
        1.0,
        float(np.linalg.norm(curve(at, 1), axis=2).max()) / speed,
        np.sqrt(float(np.linalg.norm(curve(at, 2), axis=2).max()) / acceleration),
    )
    count = int(np.ceil(slower * at[-1] / INTERVAL))
    hover = int(np.ceil(plan.limits.hover_after / INTERVAL))
    positions = curve(np.minimum(np.arange(1, count + hover + 1) * INTERVAL / slower, at[-1]))
    positions += plan.anchors - smooth[0]
    positions[:, :, 2] = plan.anchors[:, 2]
    return replace(
        plan,
        times=sample_times(len(plan.times) + len(positions)),
        positions=np.concatenate((plan.positions, positions)),
        tightening=INTERVAL * len(positions),
    )
