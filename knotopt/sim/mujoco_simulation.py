"""Flights in MuJoCo: robots follow setpoints by a clock that waits for those that are late.

A robot takes velocities: that of its setpoint, and a correction towards it. Where the cable holds a
robot back, the clock stands still; a plan that the cable does not allow ends "stuck".
"""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from knotopt.arrays import FloatArray, IntArray
from knotopt.errors import RequirementError
from knotopt.flight.record import Disturbance, FlightRecord
from knotopt.sim.hanging import cable_at_rest, check_start
from knotopt.sim.material import Material
from knotopt.sim.mujoco_model import cable_model
from knotopt.sim.simulation import FRAME_TIME, PROGRESS, STALL

DT = 1 / 200  # of the physics [s]
CONTROL = 0.02  # between commands to the robots [s]
FRAME = round(FRAME_TIME / CONTROL)  # commands between frames of the record
GAIN = 4.0  # of the correction towards a setpoint [1/s]
LAG = 0.1  # of the latest robot at which the clock stands still; it slows down from half of it [m]
NOISE_TIME = 0.5  # in which position errors change [s]
GUST_TIME = 1.0  # in which the wind changes [s]


@dataclass(frozen=True, eq=False)
class Frame:
    """One sample of a record: time and clock [s], and the centreline, shape (M, 3) [m]."""

    time: float
    clock: float
    cable: FloatArray


@dataclass(frozen=True, eq=False)
class MujocoCheckpoint:
    """Everything that the rest of a simulation depends on, and what was recorded so far."""

    physics: FloatArray
    commands: int
    clock: float
    random: Any
    noise: FloatArray
    gust: FloatArray
    finished: bool
    smallest_distance: float
    largest_tension: float
    frames: tuple[Frame, ...]
    seconds: float


class MujocoSimulation:
    """A cable and its robots in the air, as `knotopt.sim.simulation.Simulation` describes them.

    Parameters
    ----------
    start, lengths, step, speed, disturbance
        As for `knotopt.sim.simulators.Simulator.start`.
    material : Material
    dt : float
        Time step of the physics, rounded to a part of the time between commands [s].

    Raises
    ------
    RequirementError
        Robots that start too close or farther apart than the cable is long, or a cable that cannot
        be simulated.

    Notes
    -----
    Deterministic for a disturbance's seed. There is no ground, and robots do not touch anything.
    """

    def __init__(
        self,
        start: FloatArray,
        lengths: FloatArray,
        *,
        step: float,
        speed: float,
        disturbance: Disturbance | None = None,
        material: Material | None = None,
        dt: float = DT,
    ) -> None:
        began = time.perf_counter()
        self.disturbance = disturbance or Disturbance()
        self.material = material or Material()
        self._speed = speed
        start = np.ascontiguousarray(start, dtype=np.float64)
        lengths = np.ascontiguousarray(lengths, dtype=np.float64)
        check_start(start, lengths, self.material.radius)
        self._substeps = max(1, round(CONTROL / dt))
        built = cable_model(lengths, step, self.material, CONTROL / self._substeps)
        import mujoco

        self._mujoco = mujoco
        self._built, self._model = built, built.model
        self._data = mujoco.MjData(built.model)
        rest = cable_at_rest(start, built.held, built.edge_lengths, self.material.radius)
        self._data.qpos[:] = (rest - built.origin).ravel()
        self._commands = 0
        self._clock = 0.0
        self._random = np.random.default_rng(self.disturbance.seed)
        self._noise = self._random.normal(0, self.disturbance.noise, start.shape)
        self._gust = self._random.normal(0, self.disturbance.gust, 2)
        self._finished = True
        self._smallest_distance = 2 * self.material.radius
        self._largest_tension = 0.0
        self._frames = [self._frame()]
        self._seconds = time.perf_counter() - began

    @property
    def cable(self) -> FloatArray:
        """The centreline now, from p_1 to p_2N, shape (M, 3) [m]."""
        cable: FloatArray = self._built.origin + self._data.qpos.reshape(-1, 3)
        return cable

    @property
    def held(self) -> IntArray:
        """Vertex of the centreline that each robot holds, shape (R,)."""
        return self._built.held

    @property
    def robots(self) -> FloatArray:
        """Positions of the robots now, shape (R, 3) [m]."""
        robots: FloatArray = self.cable[self.held]
        return robots

    @property
    def time(self) -> float:
        """Since the start [s]."""
        return self._commands * CONTROL

    @property
    def clock(self) -> float:
        """Time of the plan that the robots are at [s]."""
        return self._clock

    def follow(self, positions: FloatArray, interval: float) -> bool:
        began = time.perf_counter()
        positions = np.ascontiguousarray(positions, dtype=np.float64)
        if positions.ndim != 3 or positions.shape[1:] != (len(self.held), 3):
            raise RequirementError(
                f"setpoints of {len(self.held)} robots have shape (T, {len(self.held)}, 3), "
                f"not {positions.shape}"
            )
        if not np.isfinite(positions).all():
            raise RequirementError("setpoints are finite numbers")
        if not interval > 0:
            raise RequirementError(f"the interval between setpoints is positive, not {interval!r}")
        velocities = np.diff(positions, axis=0) / interval
        duration = len(velocities) * interval
        passed = mark = 0.0
        marked_at = self._commands
        started_at = self._clock
        self._finished = False
        while passed < duration - 1e-9:
            k = min(int(passed / interval), len(velocities) - 1)
            setpoints = positions[k] + (passed - k * interval) * velocities[k]
            rate = self._fly(setpoints, velocities[k])
            passed = min(duration, passed + rate * CONTROL)
            self._clock = started_at + passed
            if self._commands % FRAME == 0:
                self._frames.append(self._frame())
            if passed - mark >= PROGRESS:
                mark, marked_at = passed, self._commands
            if (self._commands - marked_at) * CONTROL > STALL or not self._is_sound():
                break
        else:
            self._finished = True
        self._seconds += time.perf_counter() - began
        return self._finished

    def pull(self, velocities: FloatArray, goes_on: Callable[[FloatArray], bool]) -> bool:
        began = time.perf_counter()
        yields = ~velocities.any(axis=1)
        setpoints = self.robots
        mark, marked_at = self._clock, self._commands
        self._finished = True
        while goes_on(self.robots):
            setpoints[yields, :2] = self.robots[yields, :2]
            rate = self._fly(setpoints, velocities)
            setpoints += rate * CONTROL * velocities
            self._clock += rate * CONTROL
            if self._commands % FRAME == 0:
                self._frames.append(self._frame())
            if self._clock - mark >= PROGRESS:
                mark, marked_at = self._clock, self._commands
            if (self._commands - marked_at) * CONTROL > STALL or not self._is_sound():
                self._finished = False
                break
        self._seconds += time.perf_counter() - began
        return self._finished

    def checkpoint(self) -> MujocoCheckpoint:
        kind = self._mujoco.mjtState.mjSTATE_INTEGRATION
        physics = np.empty(self._mujoco.mj_stateSize(self._model, kind))
        self._mujoco.mj_getState(self._model, self._data, physics, kind)
        return MujocoCheckpoint(
            physics,
            self._commands,
            self._clock,
            self._random.bit_generator.state,
            self._noise,
            self._gust,
            self._finished,
            self._smallest_distance,
            self._largest_tension,
            tuple(self._frames),
            self._seconds,
        )

    def restore(self, checkpoint: MujocoCheckpoint) -> None:
        """Go back to a checkpoint of this simulation; what follows is what would have followed."""
        kind = self._mujoco.mjtState.mjSTATE_INTEGRATION
        self._mujoco.mj_resetData(self._model, self._data)  # forgets MuJoCo's warnings
        self._mujoco.mj_setState(self._model, self._data, checkpoint.physics, kind)
        self._commands = checkpoint.commands
        self._clock = checkpoint.clock
        self._random.bit_generator.state = checkpoint.random
        self._noise = checkpoint.noise
        self._gust = checkpoint.gust
        self._finished = checkpoint.finished
        self._smallest_distance = checkpoint.smallest_distance
        self._largest_tension = checkpoint.largest_tension
        self._frames = list(checkpoint.frames)
        self._seconds = checkpoint.seconds

    def record(self) -> FlightRecord:
        """What happened since the start."""
        return FlightRecord(
            np.array([frame.time for frame in self._frames]),
            np.array([frame.clock for frame in self._frames]),
            np.array([frame.cable for frame in self._frames]),
            self.held,
            self._finished,
            self._smallest_distance,
            self._largest_tension,
            self.disturbance,
            self._seconds,
        )

    def _fly(self, setpoints: FloatArray, velocities: FloatArray) -> float:
        """One command to every robot, and the physics until the next; returns the clock's rate."""
        data = self._data
        behind = setpoints - self.robots
        lag = float(np.sqrt((behind**2).sum(axis=1).max()))
        rate = min(1.0, max(0.0, 2 - 2 * lag / LAG))
        self._disturb()
        commands = rate * velocities + GAIN * (behind + self._noise)
        speeds = np.sqrt((commands**2).sum(axis=1, keepdims=True))
        commands *= self._speed / np.maximum(speeds, self._speed)
        data.ctrl[:] = commands.ravel()
        self._mujoco.mj_step(self._model, data, self._substeps)
        self._commands += 1
        self._observe()
        return rate

    def _disturb(self) -> None:
        """Position errors and wind a command later: Ornstein-Uhlenbeck processes."""
        disturbance = self.disturbance
        if disturbance.noise:
            keep = np.exp(-CONTROL / NOISE_TIME)
            kick = self._random.normal(0, disturbance.noise, self._noise.shape)
            self._noise = keep * self._noise + np.sqrt(1 - keep**2) * kick
        if disturbance.gust:
            keep = np.exp(-CONTROL / GUST_TIME)
            kick = self._random.normal(0, disturbance.gust, 2)
            self._gust = keep * self._gust + np.sqrt(1 - keep**2) * kick
        if disturbance.gust or any(disturbance.wind):
            air = np.array([*(np.array(disturbance.wind) + self._gust), 0.0])
            drag = self._model.dof_damping.reshape(-1, 3)
            self._data.qfrc_applied[:] = (drag * air).ravel()

    def _observe(self) -> None:
        data = self._data
        if data.ne:
            self._largest_tension = max(
                self._largest_tension, -float(data.efc_force[: data.ne].min())
            )
        if data.ncon:
            contact = data.contact
            elements = contact.elem
            strands = np.abs(elements[:, 0] - elements[:, 1]) > 2
            if strands.any():
                nearest = float(contact.dist[strands].min()) + 2 * self.material.radius
                self._smallest_distance = min(self._smallest_distance, nearest)

    def _is_sound(self) -> bool:
        """Whether numbers are finite and no contact was left out; else strands may have passed."""
        if np.isfinite(self._data.qpos).all() and not self._data.warning.number.any():
            return True
        self._smallest_distance = 0.0
        return False

    def _frame(self) -> Frame:
        return Frame(self.time, self._clock, self.cable)
