"""The paper's relaxation: springs between all nodes and a straightening force (eq. 11 to 13).

Nodes are the cable's turning points, or more of them; robots stay fixed. Every free node of mass m
is driven by a straightening force of constant magnitude, towards its two neighbours (eq. 11), and
by a spring and a damper to EVERY other node, whose rest length is the initial distance (eq. 12).
Equation 13 is integrated by the semi-implicit Euler method until both the largest displacement and
the largest velocity of a step fall below their thresholds. Nothing keeps the diagram.
"""

from __future__ import annotations

import logging
import time
from dataclasses import dataclass, fields

import numpy as np

from formulations.ipopt import PathStatus
from knotopt.arrays import BoolArray, FloatArray
from knotopt.cable.cable import Cable
from knotopt.errors import RequirementError
from knotopt.path.arcs import with_arcs
from knotopt.path.mesh import between, robot_times
from knotopt.path.requirements import PathRequirements
from knotopt.path.result import PathResult, examine, unmet

logger = logging.getLogger(__name__)
ASTRAY = 10.0  # times the grid's size, beyond which a node has gone astray
NEAR_ZERO = 1e-9  # shorter vectors have no direction


@dataclass(frozen=True)
class Relaxation:
    """Parameters of the relaxation; the paper gives none, so the unit of force is that of `alpha`.

    The stiffness is the softest of 0.3, 0.5, 1, ... that keeps the diagram and converges for LCF's
    sets on the six grids of Table I; softer springs give shorter paths of other diagrams.

    Parameters
    ----------
    alpha : float
        Magnitude of the straightening force [force].
    stiffness : float
        Of every spring, k of eq. 12 [force per grid step].
    damping : float
        Of every damper, c of eq. 12 [force s per grid step].
    mass : float
        Of every free node, m of eq. 13 [force s^2 per grid step].
    step : float
        Time step [s].
    straight : float
        Turn below which three nodes count as collinear, so that eq. 11 is zero [rad].
    displacement, velocity : float
        Thresholds: the largest of a step at which it ends [grid steps; grid steps per s].
    least_steps, most_steps : int
        Steps before the thresholds are looked at, since it starts at rest, and steps after which it
        has not converged.
    spacing : float or None
        Nodes are put between turning points so that none are farther apart [grid steps]; None
        keeps the turning points alone, as in the paper.

    Raises
    ------
    RequirementError
        A value that is not a positive number.
    """

    alpha: float = 1.0
    stiffness: float = 0.5
    damping: float = 0.5
    mass: float = 1.0
    step: float = 0.02
    straight: float = 0.02
    displacement: float = 1e-3
    velocity: float = 1e-2
    least_steps: int = 50
    most_steps: int = 5000
    spacing: float | None = None

    def __post_init__(self) -> None:
        for field in fields(self):
            value = getattr(self, field.name)
            if value is None and field.name == "spacing":
                continue
            if not isinstance(value, int | float) or not 0 < value < float("inf"):
                raise RequirementError(
                    f"{field.name} of the relaxation must be a positive number, not {value!r}"
                )
            if field.name.endswith("_steps") and value != int(value):
                raise RequirementError(f"{field.name} of the relaxation are counted, not {value}")


@dataclass(frozen=True, eq=False)
class RelaxationRun:
    """A relaxation, step by step.

    Attributes
    ----------
    times : int array, shape (m,)
        Time on the grid path of each node [grid steps].
    fixed : bool array, shape (m,)
        Nodes held by robots.
    trajectory : float array, shape (steps + 1, m, 2)
        Positions after each step, the grid path first [grid steps].
    converged : bool
    """

    times: FloatArray
    fixed: BoolArray
    trajectory: FloatArray
    converged: bool

    @property
    def steps(self) -> int:
        """Steps taken."""
        return len(self.trajectory) - 1


def relax(
    cable: Cable,
    supports: tuple[int, ...],
    parameters: Relaxation | None = None,
) -> RelaxationRun:
    """Integrate eq. 13 from the grid path.

    Parameters
    ----------
    cable : Cable
    supports : tuple of int
        Turning points with a support robot (1-based).
    parameters : Relaxation, optional

    Raises
    ------
    RequirementError
        A support that is no turning point between the ends.

    Notes
    -----
    O(m^2) time and memory a step, on arrays.
    """
    asked = parameters or Relaxation()
    times = _node_times(cable, asked.spacing)
    start = between(cable.cells, times)
    fixed = np.isin(times, robot_times(cable, supports))
    position, velocity = start.copy(), np.zeros_like(start)
    rest = np.linalg.norm(start[:, None] - start[None], axis=2)
    trajectory = [start]
    for done in range(1, int(asked.most_steps) + 1):
        force = _spring_forces(position, velocity, rest, asked)
        force += asked.alpha * straightening(position, asked.straight)
        force[fixed] = 0
        velocity = velocity + asked.step * force / asked.mass
        position = position + asked.step * velocity
        trajectory.append(position)
        fastest = float(np.linalg.norm(velocity, axis=1).max(initial=0))
        is_slow = fastest < asked.velocity and asked.step * fastest < asked.displacement
        converged = is_slow and done >= asked.least_steps
        if converged or not np.isfinite(fastest):
            break
    return RelaxationRun(times, fixed, np.array(trajectory), converged)


def relaxed_path(
    cable: Cable,
    supports: tuple[int, ...],
    requirements: PathRequirements | None = None,
    parameters: Relaxation | None = None,
) -> PathResult:
    """The relaxation's final path with crossing-height arcs, to be compared with the program's.

    Crossings are looked for anew. Where a crossing is one of the grid's, the same strand passes
    over; at one that the grid does not have, a strand that was a column passes over one that was a
    row, else the later one passes over. The curve is the smooth one through the nodes if that has
    the diagram of the polyline, else the polyline.

    Raises
    ------
    RequirementError
        A support that is no turning point between the ends.

    Examples
    --------
    >>> from knotopt.reading.knot import read_knot
    >>> result = relaxed_path(Cable(read_knot("3").diagram, "L+"), (3, 4, 6))
    >>> result.method, result.status
    ('relaxation', <PathStatus.SOLVED: 'solved'>)
    """
    asked = requirements or PathRequirements()
    began = time.perf_counter()
    run = relax(cable, supports, parameters)
    supports = tuple(sorted(supports))
    final = run.trajectory[-1]
    # Not so either if some coordinate is not a number.
    is_near = bool(np.abs(final).max() < ASTRAY * cable.diagram.size)
    if not is_near:
        final = run.trajectory[0]
    curve, times = with_arcs(cable, supports, final, run.times, asked.gap)
    status = PathStatus.SOLVED if run.converged else PathStatus.STOPPED
    words = "converged" if run.converged else f"not converged in {run.steps} steps"
    spent = time.perf_counter() - began
    logger.info("path by relaxation: %s in %.2f s", words, spent)
    report = examine(cable, supports, curve, asked)
    return PathResult(
        cable,
        supports,
        asked,
        "relaxation",
        status if is_near else PathStatus.FAILED,
        words if is_near else f"diverged in {run.steps} steps: the grid path",
        curve,
        times,
        report,
        spent,
        steps=run.steps,
        blocked="; ".join(unmet(report, asked, curve, times, cable)),
    )


def straightening(position: FloatArray, straight: float) -> FloatArray:
    """Direction of eq. 11 at every node, shape (m, 2): zero at the ends and on straight stretches.

    Examples
    --------
    >>> straightening(np.array([[0.0, 0], [1, 0], [1, 1]]), 0.01).round(3).tolist()
    [[0.0, 0.0], [-0.707, 0.707], [0.0, 0.0]]
    """
    step = np.diff(position, axis=0)
    ahead = step / np.maximum(np.linalg.norm(step, axis=1), NEAR_ZERO)[:, None]
    bend = np.zeros_like(position)
    bend[1:-1] = ahead[1:] - ahead[:-1]
    size = np.linalg.norm(bend, axis=1)[:, None]
    direction: FloatArray = np.where(
        size > 2 * np.sin(straight / 2), bend / np.maximum(size, NEAR_ZERO), 0.0
    )
    return direction


def _spring_forces(
    position: FloatArray, velocity: FloatArray, rest: FloatArray, asked: Relaxation
) -> FloatArray:
    """Sum of eq. 12 over all other nodes, shape (m, 2)."""
    away = position[None] - position[:, None]
    distance = np.linalg.norm(away, axis=2)
    unit = away / np.maximum(distance, NEAR_ZERO)[..., None]
    closing = ((velocity[None] - velocity[:, None]) * unit).sum(axis=2)
    pull = asked.stiffness * (distance - rest) + asked.damping * closing
    forces: FloatArray = (pull[..., None] * unit).sum(axis=1)
    return forces


def _node_times(cable: Cable, spacing: float | None) -> FloatArray:
    """Times of the nodes: the turning points, and more if none may be far apart."""
    corners = cable.times.astype(np.float64)
    if spacing is None:
        return corners
    steps = np.diff(corners)
    count = np.ceil(steps / spacing).astype(np.int64)
    pieces = [a + np.arange(n) * (w / n) for a, w, n in zip(corners, steps, count, strict=False)]
    return np.concatenate((*pieces, corners[-1:]))
