"""Flights in MuJoCo: robots follow setpoints by a clock that waits for those that are late.

A robot takes velocities: that of its setpoint, and a correction towards it. Where the cable holds a
robot back, the clock stands still; a plan that the cable does not allow ends "stuck".
"""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any, NamedTuple

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


class Frame(NamedTuple):
    """One sample of a record: time and clock [s], and the centreline, shape (M, 3) [m]."""

    time: float
    clock: float
    cable: FloatArray


@dataclass(eq=False)
class FlightState:
    """What changes during a flight beside the physics, and what was recorded so far."""

    noise: FloatArray
    gust: FloatArray
    smallest_distance: float
    largest_tension: float = 0.0
    commands: int = 0
    clock: float = 0.0
    mark: float = 0.0
    marked_at: int = 0
    finished: bool = True
    frames: tuple[Frame, ...] = ()
    seconds: float = 0.0


@dataclass(frozen=True, eq=False)
class MujocoCheckpoint:
    """Everything that the rest of a simulation depends on; the random numbers' state is NumPy's."""

    physics: FloatArray
    random: Any
    flight: FlightState


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
        self._random = np.random.default_rng(self.disturbance.seed)
        self._now = FlightState(
            noise=self._random.normal(0, self.disturbance.noise, start.shape),
            gust=self._random.normal(0, self.disturbance.gust, 2),
            smallest_distance=2 * self.material.radius,
        )
        self._keep_frame()
        self._now.seconds = time.perf_counter() - began

    @property
    def cable(self) -> FloatArray:
        """The centreline now, from p_1 to p_2N, shape (M, 3) [m]."""
        return np.asarray(self._built.origin + self._data.qpos.reshape(-1, 3))

    @property
    def held(self) -> IntArray:
        """Vertex of the centreline that each robot holds, shape (R,)."""
        return self._built.held

    @property
    def robots(self) -> FloatArray:
        """Positions of the robots now, shape (R, 3) [m]."""
        return np.asarray(self.cable[self.held])

    @property
    def time(self) -> float:
        """Since the start [s]."""
        return self._now.commands * CONTROL

    @property
    def clock(self) -> float:
        """Time of the plan that the robots are at [s]."""
        return self._now.clock

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
        passed, started_at = 0.0, self._now.clock
        self._mark(passed)
        self._now.finished = False
        while passed < duration - 1e-9:
            k = min(int(passed / interval), len(velocities) - 1)
            setpoints = positions[k] + (passed - k * interval) * velocities[k]
            rate = self._fly(setpoints, velocities[k])
            passed = min(duration, passed + rate * CONTROL)
            self._now.clock = started_at + passed
            if not self._goes_on(passed):
                break
        else:
            self._now.finished = True
        self._now.seconds += time.perf_counter() - began
        return self._now.finished

    def pull(self, velocities: FloatArray, goes_on: Callable[[FloatArray], bool]) -> bool:
        began = time.perf_counter()
        yields = ~velocities.any(axis=1)
        setpoints = self.robots
        self._mark(self._now.clock)
        self._now.finished = True
        while goes_on(self.robots):
            setpoints[yields, :2] = self.robots[yields, :2]
            rate = self._fly(setpoints, velocities)
            setpoints += rate * CONTROL * velocities
            self._now.clock += rate * CONTROL
            if not self._goes_on(self._now.clock):
                self._now.finished = False
                break
        self._now.seconds += time.perf_counter() - began
        return self._now.finished

    def checkpoint(self) -> MujocoCheckpoint:
        kind = self._mujoco.mjtState.mjSTATE_INTEGRATION
        physics = np.empty(self._mujoco.mj_stateSize(self._model, kind))
        self._mujoco.mj_getState(self._model, self._data, physics, kind)
        return MujocoCheckpoint(physics, self._random.bit_generator.state, replace(self._now))

    def restore(self, checkpoint: MujocoCheckpoint) -> None:
        kind = self._mujoco.mjtState.mjSTATE_INTEGRATION
        self._mujoco.mj_resetData(self._model, self._data)  # forgets MuJoCo's warnings
        self._mujoco.mj_setState(self._model, self._data, checkpoint.physics, kind)
        self._random.bit_generator.state = checkpoint.random
        self._now = replace(checkpoint.flight)

    def record(self) -> FlightRecord:
        """What happened since the start."""
        times, clock, cable = map(np.array, zip(*self._now.frames, strict=True))
        return FlightRecord(
            times,
            clock,
            cable,
            self.held,
            self._now.finished,
            self._now.smallest_distance,
            self._now.largest_tension,
            self.disturbance,
            self._now.seconds,
        )

    def _fly(self, setpoints: FloatArray, velocities: FloatArray) -> float:
        """One command to every robot, and the physics until the next; returns the clock's rate."""
        data = self._data
        behind = setpoints - self.robots
        lag = float(np.sqrt((behind**2).sum(axis=1).max()))
        rate = min(1.0, max(0.0, 2 - 2 * lag / LAG))
        self._disturb()
        commands = rate * velocities + GAIN * (behind + self._now.noise)
        speeds = np.sqrt((commands**2).sum(axis=1, keepdims=True))
        commands *= self._speed / np.maximum(speeds, self._speed)
        data.ctrl[:] = commands.ravel()
        self._mujoco.mj_step(self._model, data, self._substeps)
        self._now.commands += 1
        self._observe()
        return rate

    def _mark(self, passed: float) -> None:
        """Remember how far the clock is, and when: robots that get no farther are stuck."""
        self._now.mark, self._now.marked_at = passed, self._now.commands

    def _goes_on(self, passed: float) -> bool:
        """Record what a command led to; whether robots get on, and all is sound."""
        if self._now.commands % FRAME == 0:
            self._keep_frame()
        if passed - self._now.mark >= PROGRESS:
            self._mark(passed)
        return (self._now.commands - self._now.marked_at) * CONTROL <= STALL and self._is_sound()

    def _disturb(self) -> None:
        """Position errors and wind a command later."""
        disturbance = self.disturbance
        if disturbance.noise:
            self._now.noise = self._drifted(self._now.noise, disturbance.noise, NOISE_TIME)
        if disturbance.gust:
            self._now.gust = self._drifted(self._now.gust, disturbance.gust, GUST_TIME)
        if disturbance.gust or any(disturbance.wind):
            air = np.array([*(np.array(disturbance.wind) + self._now.gust), 0.0])
            drag = self._model.dof_damping.reshape(-1, 3)
            self._data.qfrc_applied[:] = (drag * air).ravel()

    def _drifted(self, values: FloatArray, deviation: float, within: float) -> FloatArray:
        """Values of an Ornstein-Uhlenbeck process a command later."""
        keep = np.exp(-CONTROL / within)
        kick = self._random.normal(0, deviation, values.shape)
        return np.asarray(keep * values + np.sqrt(1 - keep**2) * kick)

    def _observe(self) -> None:
        data = self._data
        if data.ne:
            self._now.largest_tension = max(
                self._now.largest_tension, -float(data.efc_force[: data.ne].min())
            )
        if data.ncon:
            contact = data.contact
            elements = contact.elem
            strands = np.abs(elements[:, 0] - elements[:, 1]) > 2
            if strands.any():
                nearest = float(contact.dist[strands].min()) + 2 * self.material.radius
                self._now.smallest_distance = min(self._now.smallest_distance, nearest)

    def _is_sound(self) -> bool:
        """Whether numbers are finite and no contact was left out; else strands may have passed."""
        if np.isfinite(self._data.qpos).all() and not self._data.warning.number.any():
            return True
        self._now.smallest_distance = 0.0
        return False

    def _keep_frame(self) -> None:
        self._now.frames += (Frame(self.time, self.clock, self.cable),)
