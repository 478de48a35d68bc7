"""Flights in MuJoCo: the cable at rest, robots on it, and checkpoints."""

from __future__ import annotations

import sys
from dataclasses import replace

import numpy as np
import pytest

from knotopt.cable.cable import Cable
from knotopt.errors import MissingExtraError, RequirementError
from knotopt.flight.limits import ROOM, FlightLimits
from knotopt.flight.plan import FlightPlan
from knotopt.flight.record import Disturbance, FlightRecord
from knotopt.reading.knot import read_knot
from knotopt.sim.hanging import hanging_chain
from knotopt.sim.judge import Outcome, judge
from knotopt.sim.material import Material
from knotopt.sim.mujoco_simulation import MujocoSimulation
from knotopt.sim.simulators import MUJOCO
from knotopt.sim.trials import simulate

SPEED = 0.4  # of the leader [m/s]
INTERVAL = 0.05
LIMITS = FlightLimits()
TREFOIL = Cable(read_knot("3").diagram, "L+")


def train(cable: Cable, supports: tuple[int, ...]) -> FlightPlan:
    """Robots in file along the grid path, each stopping at its turning point, with arcs of 0.9
    steps at the second visit to every crossing."""
    step, spacing = ROOM.step, LIMITS.spacing
    index = [0, *(k - 1 for k in supports), len(cable.path) - 1]
    robots = len(index)
    corners = cable.points * step
    lead = (robots - 1) * spacing
    back = (corners[1] - corners[0]) / np.linalg.norm(corners[1] - corners[0]) * lead
    way = np.vstack((corners[0] - back, corners))
    marks = np.concatenate(([0], np.cumsum(np.linalg.norm(np.diff(way, axis=0), axis=1))))
    total = marks[-1] - lead

    def place(s: np.ndarray) -> np.ndarray:
        plan = np.column_stack([np.interp(s, marks, way[:, k]) for k in (0, 1)])
        height = np.full(len(s), ROOM.altitude)
        for crossing in cable.crossings:
            u = np.clip(np.abs(s - lead - crossing.second * step) / (0.9 * step), 0, 1)
            height += (-1 if crossing.first_over else 1) * 0.9 * step * (1 - u**2) ** 2
        return np.column_stack((plan, height))

    duration = LIMITS.hover_before + total / SPEED + LIMITS.hover_after
    times = np.arange(0, duration, INTERVAL)
    leader = lead + np.clip((times - LIMITS.hover_before) * SPEED, 0, total)
    ends = lead + cable.times[index] * step
    tracks = [
        place(np.minimum(leader - (robots - 1 - j) * spacing, ends[j])) for j in range(robots)
    ]
    positions = np.stack(tracks, axis=1)
    apart = np.linalg.norm(np.diff(positions, axis=1), axis=2).max(axis=0)
    return FlightPlan(
        name="3_1",
        cable=cable,
        supports=supports,
        chosen_by="all",
        schedule="fixed",
        world=ROOM,
        limits=LIMITS,
        times=times,
        positions=positions,
        lengths=(1 + LIMITS.slack) * apart,
        route=place(np.linspace(0, marks[-1], 200)),
        crossings=(),
        passes=np.zeros(robots - 1),
    )


def two_robots(disturbance: Disturbance | None = None, **options: float) -> MujocoSimulation:
    """Two robots 1 m apart with 1.5 m of cable between them."""
    pytest.importorskip("mujoco")
    start = np.array([[0.0, 0, 2], [1, 0, 2]])
    return MujocoSimulation(
        start, np.array([1.5]), step=0.5, speed=0.6, disturbance=disturbance, **options
    )


def away(steps: int = 41) -> np.ndarray:
    """Setpoints of two robots: the second moves 0.4 m aside in 2 s and rises by 0.2 m."""
    share = np.linspace(0, 1, steps)[:, None]
    second = [1.0, 0, 2] + share * [0, 0.4, 0.2]
    return np.stack((np.tile([0.0, 0, 2], (steps, 1)), second), axis=1)


@pytest.fixture(scope="module")
def tied() -> tuple[FlightPlan, FlightRecord]:
    pytest.importorskip("mujoco")
    plan = train(TREFOIL, tuple(range(2, len(TREFOIL.path))))
    return plan, simulate(plan, Disturbance(noise=0.01, seed=3))


def test_a_train_with_all_corners_ties_the_trefoil(tied):
    plan, record = tied
    verdict = judge(record, plan.cable)
    assert verdict.outcome is Outcome.TIED
    assert (verdict.knot, verdict.polynomial) == ("3_1", "1 - t + t^2")
    assert verdict.is_wanted
    assert verdict.closures_agree
    assert str(verdict) == "tied: 3_1"


def test_the_record_of_a_flight(tied):
    plan, record = tied
    assert record.finished
    np.testing.assert_allclose(np.diff(record.times), 0.1, atol=1e-9)
    assert (np.diff(record.clock) >= 0).all()
    assert record.clock[-1] == pytest.approx(plan.duration, abs=0.1)
    assert record.robots.shape == (len(record.times), plan.robots, 3)
    assert np.abs(record.robots[-1] - plan.anchors).max() < 0.05
    assert 0.8 * Material().radius < record.smallest_distance <= 2 * Material().radius
    assert 0.02 < record.largest_tension < 1.5


def test_the_cable_does_not_stretch(tied):
    plan, record = tied
    edges = np.linalg.norm(np.diff(record.cable, axis=1), axis=2)
    nominal = np.concatenate(
        [
            np.full(last - first, length / (last - first))
            for first, last, length in zip(
                record.held[:-1], record.held[1:], plan.lengths, strict=True
            )
        ]
    )
    assert np.abs(edges / nominal - 1).max() < 0.03
    assert np.median(np.abs(edges / nominal - 1)) < 1e-3


def test_without_supports_nothing_is_tied():
    pytest.importorskip("mujoco")
    plan = train(TREFOIL, ())
    verdict = judge(simulate(plan), plan.cable)
    assert verdict.knot == "unknot"
    assert not verdict.is_wanted
    assert verdict.outcome in (Outcome.WRONG_KNOT, Outcome.STUCK)


def test_the_cable_starts_at_rest_and_stays():
    simulation = two_robots()
    before = simulation.cable
    assert simulation.follow(np.tile(simulation.robots, (21, 1, 1)), 0.1)
    assert simulation.time == pytest.approx(2.0)
    assert np.abs(simulation.cable - before).max() < 0.02


def test_narrow_bights_start_apart_and_with_little_energy():
    pytest.importorskip("mujoco")
    start = np.array([[0.0, 0, 2], [0.3, 0, 2], [0.6, 0, 2]])
    simulation = MujocoSimulation(start, np.array([2.0, 2.0]), step=0.5, speed=0.6)
    assert simulation.record().smallest_distance == 2 * simulation.material.radius
    simulation.follow(np.tile(start, (11, 1, 1)), 0.1)
    record = simulation.record()
    speeds = np.linalg.norm(np.diff(record.cable, axis=0), axis=2) / 0.1
    assert speeds.max() < 0.6
    assert record.smallest_distance > 1.6 * simulation.material.radius


def test_the_cable_hangs_as_deep_as_the_catenary():
    simulation = two_robots()
    simulation.follow(np.tile(simulation.robots, (41, 1, 1)), 0.1)
    chain = hanging_chain(*simulation.robots, 1.5, 15)
    assert simulation.cable[:, 2].min() == pytest.approx(chain[:, 2].min(), abs=0.01)


def test_a_narrow_bight_starts_with_little_energy():
    pytest.importorskip("mujoco")
    start = np.array([[0.0, 0, 2], [0.12, 0, 2]])
    simulation = MujocoSimulation(start, np.array([3.0]), step=1.0, speed=0.6)
    assert (simulation.held[-1], simulation.cable[:, 0].min() < 0) == (15, True)
    simulation.follow(np.tile(start, (11, 1, 1)), 0.1)
    record = simulation.record()
    assert np.linalg.norm(np.diff(record.cable, axis=0), axis=2).max() / 0.1 < 0.8
    assert record.smallest_distance > 1.6 * simulation.material.radius


def test_a_seed_decides_a_flight():
    noisy = Disturbance(noise=0.02, wind=(0.3, 0.0), gust=0.2, seed=5)
    ends = []
    for seed in (5, 5, 6):
        simulation = two_robots(replace(noisy, seed=seed))
        simulation.follow(away(), INTERVAL)
        ends.append(simulation.cable)
    assert np.array_equal(ends[0], ends[1])
    assert np.abs(ends[0] - ends[2]).max() > 1e-3


def test_a_checkpoint_continues_as_if_nothing_had_happened():
    simulation = two_robots(Disturbance(noise=0.02, gust=0.2, seed=1))
    simulation.follow(away(), INTERVAL)
    checkpoint = simulation.checkpoint()
    simulation.follow(away()[::-1], INTERVAL)
    first = simulation.record()
    simulation.restore(checkpoint)
    assert simulation.clock == pytest.approx(2.0)
    simulation.follow(np.tile(away()[-1], (30, 1, 1)), INTERVAL)
    simulation.restore(checkpoint)
    simulation.follow(away()[::-1], INTERVAL)
    again = simulation.record()
    for name in ("times", "clock", "cable"):
        assert np.array_equal(getattr(first, name), getattr(again, name))
    assert first.smallest_distance == again.smallest_distance
    assert first.largest_tension == again.largest_tension


def test_pieces_of_a_plan_are_the_whole():
    whole, pieces = two_robots(), two_robots()
    whole.follow(away(), INTERVAL)
    pieces.follow(away()[:21], INTERVAL)
    pieces.follow(away()[20:], INTERVAL)
    assert pieces.clock == pytest.approx(whole.clock)
    assert np.abs(whole.cable - pieces.cable).max() < 1e-3


def test_a_taut_cable_ends_stuck():
    simulation = two_robots()
    share = np.linspace(0, 1, 41)[:, None]
    way = np.stack((np.tile([0.0, 0, 2], (41, 1)), [1.0, 0, 2] + share * [1.0, 0, 0]), axis=1)
    assert not simulation.follow(way, INTERVAL)
    record = simulation.record()
    assert not record.finished
    assert record.clock[-1] < 2
    assert record.times[-1] > 5
    assert np.linalg.norm(np.diff(record.robots[-1], axis=0)) < 1.55
    assert record.largest_tension > 0.3


def test_a_flight_whose_numbers_blow_up_is_unsound(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)  # MuJoCo keeps a log of such flights where it runs
    simulation = two_robots(material=Material(force=1e9, response=1e-5))
    checkpoint = simulation.checkpoint()
    assert not simulation.follow(away(), INTERVAL)
    assert judge(simulation.record(), TREFOIL).outcome is Outcome.UNSOUND
    simulation.restore(checkpoint)
    assert np.isfinite(simulation.cable).all()


def test_wind_blows_the_cable_along():
    simulation = two_robots(Disturbance(wind=(0.0, 1.0)))
    simulation.follow(np.tile(simulation.robots, (31, 1, 1)), 0.1)
    # Drag m v / tau against weight m g leans the hanging cable by their ratio.
    lean = 1.0 / simulation.material.drag_time / 9.81
    bottom = simulation.cable[len(simulation.cable) // 2] - [0.5, 0, 2]
    assert bottom[1] / -bottom[2] == pytest.approx(lean, rel=0.1)


def test_noise_is_as_large_as_asked():
    simulation = two_robots(Disturbance(noise=0.03, seed=2))
    rest = simulation.robots
    simulation.follow(np.tile(rest, (201, 1, 1)), 0.1)
    errors = simulation.record().robots - rest
    assert 0.01 < errors.std() < 0.04


@pytest.mark.parametrize(
    ("start", "lengths", "message"),
    [
        ([[0, 0, 2], [0.02, 0, 2]], [1.0], "robots 1 and 2 start 0.020 m apart in plan"),
        ([[0, 0, 2], [1, 0, 2]], [0.9], "but the cable between them is 0.900 m long"),
        ([[0, 0, 2], [1, 0, np.nan]], [1.5], "finite"),
        ([[0, 0, 2], [1, 0, 2]], [1.5, 1.5], "there are 1 lengths"),
        ([[0, 0, 2]], [], "two robots or more"),
    ],
)
def test_impossible_starts_are_refused(start, lengths, message):
    with pytest.raises(RequirementError, match=message):
        MujocoSimulation(np.array(start, dtype=float), np.array(lengths), step=0.5, speed=0.6)


def test_impossible_cables_and_setpoints_are_refused():
    with pytest.raises(RequirementError, match="too stiff"):
        two_robots(dt=0.02)
    with pytest.raises(RequirementError, match="take three radii"):
        two_robots(material=Material(radius=0.04))
    simulation = two_robots()
    with pytest.raises(RequirementError, match="shape"):
        simulation.follow(np.zeros((5, 3, 3)), INTERVAL)
    with pytest.raises(RequirementError, match="finite"):
        simulation.follow(np.full((5, 2, 3), np.nan), INTERVAL)
    with pytest.raises(RequirementError, match="interval"):
        simulation.follow(away(), 0.0)


def test_without_mujoco_the_extra_is_named(monkeypatch):
    monkeypatch.setitem(sys.modules, "mujoco", None)
    with pytest.raises(MissingExtraError, match=r"a flight needs mujoco.*knotopt\[sim\]"):
        MUJOCO.start(np.array([[0.0, 0, 2], [1, 0, 2]]), np.array([1.5]), step=0.5, speed=0.6)
