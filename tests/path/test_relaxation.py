"""The paper's relaxation against its equations written out, node by node."""

from __future__ import annotations

import numpy as np
import pytest

from formulations.ipopt import PathStatus
from knotopt import Cable, Relaxation, best_cut, read, relax, relaxed_path, torus_knot
from knotopt.errors import RequirementError
from knotopt.path.relaxation import straightening


def forces_by_the_paper(
    p: np.ndarray, v: np.ndarray, rest: np.ndarray, fixed: np.ndarray, asked: Relaxation
) -> np.ndarray:
    """Equations 11 to 13, as they stand, for every node."""
    total = np.zeros_like(p)
    for i in range(len(p)):
        if fixed[i]:
            continue
        to = [(p[k] - p[i]) / np.linalg.norm(p[k] - p[i]) for k in (i - 1, i + 1)]
        both = to[0] + to[1]
        if np.linalg.norm(both) > 2 * np.sin(asked.straight / 2):
            total[i] += asked.alpha * both / np.linalg.norm(both)
        for j in range(len(p)):
            if j != i:
                d = p[j] - p[i]
                x = np.linalg.norm(d)
                unit = d / x
                total[i] += asked.stiffness * (x - rest[i, j]) * unit
                total[i] += asked.damping * ((v[j] - v[i]) @ unit) * unit
    return total


def test_the_trajectory_is_that_of_the_equations() -> None:
    chosen = best_cut(read("4").diagram)
    asked = Relaxation(most_steps=60, least_steps=60)
    run = relax(chosen.cable, chosen.supports, asked)
    assert run.steps == 60 and not run.converged
    p = run.trajectory[0].copy()
    assert p.tolist() == [list(point) for point in chosen.cable.path]
    rest = np.linalg.norm(p[:, None] - p[None], axis=2)
    v = np.zeros_like(p)
    for step in range(1, 61):
        v = v + asked.step * forces_by_the_paper(p, v, rest, run.fixed, asked) / asked.mass
        p = p + asked.step * v
        assert run.trajectory[step] == pytest.approx(p, abs=1e-9)


def test_robots_do_not_move_and_it_comes_to_rest() -> None:
    chosen = best_cut(read("5").diagram)
    run = relax(chosen.cable, chosen.supports)
    assert run.converged
    held = [0, *(k - 1 for k in chosen.supports), len(chosen.cable.path) - 1]
    assert np.flatnonzero(run.fixed).tolist() == held
    assert (run.trajectory[:, held] == run.trajectory[0, held]).all()
    last = np.linalg.norm(np.diff(run.trajectory[-2:], axis=0)[0], axis=1).max()
    assert last < Relaxation().displacement
    free = ~run.fixed
    assert (np.linalg.norm(run.trajectory[-1] - run.trajectory[0], axis=1)[free] > 0.05).all()


def test_straightening_has_constant_size_or_none() -> None:
    points = np.array([[0.0, 0], [1, 0.001], [2, 0], [2, 2], [1, 1], [1, 5]])
    sizes = np.linalg.norm(straightening(points, 0.02), axis=1)
    assert sizes == pytest.approx([0, 0, 1, 1, 1, 0])


def test_nodes_between_turning_points() -> None:
    cable = Cable(torus_knot(2, 3), "L+")
    run = relax(cable, (3,), Relaxation(spacing=1.0, most_steps=3))
    assert len(run.times) == cable.length + 1
    assert np.linalg.norm(np.diff(run.trajectory[0], axis=0), axis=1).max() <= 1


def test_soft_springs_lose_the_knot_and_the_result_says_so() -> None:
    chosen = best_cut(read("5").diagram)
    soft = relaxed_path(chosen.cable, chosen.supports, None, Relaxation(stiffness=0.05))
    assert not soft.report.same_diagram
    assert np.isnan(soft.report.gap)
    stiff = relaxed_path(chosen.cable, chosen.supports)
    assert stiff.status is PathStatus.SOLVED and stiff.report.same_diagram
    assert stiff.curve.length > soft.curve.length


def test_what_diverges_is_no_path() -> None:
    chosen = best_cut(read("3").diagram)
    with np.errstate(all="ignore"):
        result = relaxed_path(
            chosen.cable, chosen.supports, None, Relaxation(stiffness=1e4, step=1.0)
        )
    assert result.status is not PathStatus.SOLVED
    assert np.isfinite(result.curve.points).all()


@pytest.mark.parametrize("name", ["alpha", "stiffness", "mass", "step", "spacing", "most_steps"])
@pytest.mark.parametrize("value", [0, -1, float("nan"), float("inf"), "soft"])
def test_parameters_are_positive_numbers(name: str, value: float) -> None:
    with pytest.raises(RequirementError, match=f"{name} of the relaxation must be a positive"):
        Relaxation(**{name: value})
