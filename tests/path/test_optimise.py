"""The path program: the diagram is kept, limits are met, and what cannot be met is named."""

from __future__ import annotations

import math
from dataclasses import replace

import networkx as nx
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from formulations.ipopt import PathStatus, solve
from formulations.path import Bounds, PathProgram, ProgramError, Weights, doubled_areas
from knotopt import (
    Cable,
    PathRequirements,
    best_cut,
    best_supports,
    optimise_path,
    read,
    shipped_knots,
    torus_knot,
)
from knotopt.errors import RequirementError
from knotopt.path import optimise
from knotopt.path.mesh import lay_mesh
from knotopt.path.pairs import strand_pairs
from knotopt.path.remesh import remesh
from knotopt.path.result import TOLERANCE, examine, span_name
from knotopt.path.triangulation import triangulate
from knotopt.verify.crossings import curve_crossings, grid_code
from tests.helpers.strategies import cables

ROWS = ("3", "4", "5", "7 Var1", "7 Var2", "9")


def assert_meets(result: optimise.PathResult) -> None:
    """What SOLVED promises, read off the report."""
    report, asked = result.report, result.requirements
    assert result.status is PathStatus.SOLVED and not result.blocked
    assert report.same_diagram and report.same_knot
    assert report.clearance >= asked.clearance - TOLERANCE
    assert report.opening >= asked.opening - TOLERANCE
    assert report.gap >= asked.gap - TOLERANCE
    assert report.steepest <= asked.slope + 10 * TOLERANCE
    assert asked.floor - TOLERANCE <= report.lowest
    assert report.highest <= asked.ceiling + TOLERANCE
    assert report.robots_off <= 2 * TOLERANCE
    assert result.curve.length > result.taut_length


@pytest.mark.parametrize("row", ROWS)
def test_table_1_with_lcf_and_with_the_smallest_sets(row: str) -> None:
    diagram = read(row).diagram
    for chosen in (best_cut(diagram), best_supports(diagram).best):
        result = optimise_path(chosen.cable, chosen.supports)
        assert_meets(result)
        assert result.stretch < 1.45
        assert all(each.accepted for each in result.rounds)


@pytest.mark.slow
def test_the_catalogue_keeps_its_diagrams() -> None:
    names = list(shipped_knots())[::6]
    solved = 0
    for name in names:
        best = best_supports(shipped_knots()[name].diagram).best
        result = optimise_path(best.cable, best.supports)
        assert result.report.same_diagram and result.report.same_knot
        assert (result.status is PathStatus.SOLVED) == (not result.blocked)
        solved += result.status is PathStatus.SOLVED
    assert solved >= 0.97 * len(names)


@given(cables(3, 6), st.data())
@settings(max_examples=40)
def test_any_supports_of_any_cable_keep_the_diagram(cable: Cable, data: st.DataObject) -> None:
    count = len(cable.path)
    supports = data.draw(st.sets(st.integers(2, count - 1)).map(lambda s: tuple(sorted(s))))
    result = optimise_path(cable, supports)
    assert result.report.same_diagram and result.report.same_knot
    assert result.report.robots_off < 0.01
    assert result.taut_length <= result.report.plan_length + 1e-6


@pytest.mark.parametrize("clearance", [0.1, 0.3, 0.6])
def test_wider_limits_are_kept_and_cost_length(clearance: float) -> None:
    chosen = best_cut(read("5").diagram)
    asked = PathRequirements(clearance=clearance, opening=0.6, gap=0.5)
    result = optimise_path(chosen.cable, chosen.supports, asked)
    assert_meets(result)
    easy = optimise_path(chosen.cable, chosen.supports, PathRequirements(0.05, 0.05, 0.05))
    assert easy.curve.length < result.curve.length


def test_more_bending_weight_bends_less() -> None:
    chosen = best_cut(read("5").diagram)
    curves = [
        optimise_path(chosen.cable, chosen.supports, PathRequirements(bending=b)).curve
        for b in (0.01, 0.1, 1.0)
    ]
    energy = [np.mean(c.curvature(np.linspace(0, c.length, 4000)) ** 2) * c.length for c in curves]
    lengths = [curve.length for curve in curves]
    assert energy == sorted(energy, reverse=True)
    assert lengths == sorted(lengths)


def test_what_the_robots_leave_no_room_for_is_named() -> None:
    """With a robot at every turning point no opening is wider than the grid's cells."""
    cable = Cable(read("5").diagram, "L+")
    every = tuple(range(2, len(cable.path)))
    result = optimise_path(cable, every, PathRequirements(opening=1.5))
    assert result.status in (PathStatus.INFEASIBLE, PathStatus.STOPPED)
    assert result.blocked.startswith("opening 0.99") and "< 1.5 in loop [2,6]" in result.blocked
    assert result.report.same_diagram and result.report.clearance > 0.15


def test_limits_that_cannot_be_met_name_the_pair() -> None:
    cable = Cable(read("3").diagram, "L+")
    asked = PathRequirements(gap=1.9, slope=0.3)
    result = optimise_path(cable, (3, 4, 6), asked)
    assert result.status in (PathStatus.INFEASIBLE, PathStatus.STOPPED)
    assert "gap" in result.blocked or "slope" in result.blocked
    assert result.report.same_diagram
    worst = {each.family: each for each in result.rounds[-1].violations}
    assert set(worst) >= {"diagram", "clearance", "gap", "slope"}
    assert worst["gap"].where.startswith("p")


def test_a_time_limit_leaves_a_path_that_keeps_the_knot() -> None:
    cable = Cable(torus_knot(4, 5), "L+")
    result = optimise_path(cable, (), seconds=1e-3)
    assert result.report.same_diagram and result.report.same_knot
    assert len(result.rounds) == 1 and result.status is not PathStatus.SOLVED
    with pytest.raises(RequirementError, match="time limit must be positive"):
        optimise_path(cable, (), seconds=0)


@pytest.mark.parametrize(
    ("supports", "words"),
    [
        ((1,), "no support robot can be at p1: those of this cable are p2 to p9"),
        ((10,), "p10"),
        ((3, 3), "two support robots at p3"),
        ((3, 4.5), "no support robot can be at p4.5"),
    ],
)
def test_supports_that_are_no_turning_points(supports: tuple[float, ...], words: str) -> None:
    cable = Cable(read("3").diagram, "L+")
    with pytest.raises(RequirementError, match=words):
        optimise_path(cable, supports)  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("wrong", "words"),
    [
        ({"clearance": 0}, "clearance must be a positive number"),
        ({"gap": math.nan}, "gap must be a finite number"),
        ({"opening": math.inf}, "opening must be a finite number"),
        ({"bending": "much"}, "bending must be a finite number"),
        ({"floor": 0.5}, "robots hover at height 0"),
        ({"clearance": 11}, "clearance 11 is more than 10 grid steps"),
        ({"gap": 3.0}, "no room for a gap of 3"),
    ],
)
def test_requirements_that_make_no_sense(wrong: dict[str, float], words: str) -> None:
    with pytest.raises(RequirementError, match=words):
        PathRequirements(**wrong)


@given(cables(3, 8), st.integers(0, 2**32))
def test_remeshing_keeps_the_diagram(cable: Cable, seed: int) -> None:
    mesh = lay_mesh(cable, ())
    random = np.random.default_rng(seed)
    for _ in range(3):
        # Any move that keeps every triangle keeps the diagram; remeshing afterwards must as well.
        triangles = triangulate(mesh.positions, mesh.segments)
        moved = mesh.positions + 0.1 * random.standard_normal(mesh.positions.shape)
        moved[mesh.held] = mesh.positions[mesh.held]
        if (doubled_areas(moved, triangles) > 1e-6).all():
            mesh = mesh.moved(moved, mesh.heights)
        none = np.empty(0, dtype=np.int64)
        mesh = remesh(mesh, none, random.uniform(0.3, 1.5), random.uniform(0.05, 0.3))
        over = np.zeros(len(mesh.chain))
        over[mesh.over] = 1.0
        # A crossing is a vertex of both strands: seen from the middles of segments, it is none.
        points = np.column_stack((mesh.plan, over))
        middles = np.concatenate((points[:1], (points[:-1] + points[1:]) / 2, points[-1:]))
        visits, _ = curve_crossings(middles).code if len(cable.crossings) else ([], [])
        expected, _ = grid_code(cable.path)
        assert [k for k, _ in visits] == [k for k, _ in expected]


def test_clearance_pairs_by_brute_force() -> None:
    """With strands far apart on the cable, a vertex and a segment are a pair if they are near."""
    cable = Cable(torus_knot(3, 4), "L+")
    mesh = lay_mesh(cable, ())
    triangles = triangulate(mesh.positions, mesh.segments)
    clearance, neighbourhood = 0.9, 1.5
    pairs, least = strand_pairs(mesh, triangles, clearance, neighbourhood)
    assert (least <= clearance).all()
    found = {tuple(pair) for pair in pairs.tolist()}
    graph = nx.Graph()
    for (a, b), length in zip(mesh.segments.tolist(), mesh.lengths, strict=True):
        graph.add_edge(a, b, weight=length)
    ways = dict(nx.all_pairs_dijkstra_path_length(graph))
    missing = 0
    for vertex in set(mesh.chain.tolist()):
        for a, b in mesh.segments.tolist():
            p, q, x = (mesh.positions[v] for v in (a, b, vertex))
            share = np.clip(np.dot(x - p, q - p) / np.dot(q - p, q - p), 0, 1)
            near = np.linalg.norm(x - p - share * (q - p)) < clearance + 0.2
            apart = min(ways[vertex][a], ways[vertex][b]) >= neighbourhood
            if near and apart and not mesh.held[[vertex, a, b]].all():
                missing += (vertex, *sorted((a, b))) not in found
    assert len(found) > 50 and missing == 0


def square() -> PathProgram:
    """A path from left to right below a held vertex, in a frame."""
    positions = np.array([[0.0, 0], [1, 0.1], [2, 0], [-2, -2], [4, -2], [4, 2], [-2, 2]])
    chain = np.arange(3)
    triangles = triangulate(positions, np.array([[0, 1], [1, 2]]))
    none = np.empty((0, 3), dtype=np.int64)
    two = np.empty((0, 2), dtype=np.int64)
    return PathProgram(
        positions=positions,
        held=np.array([True, False, True, True, True, True, True]),
        chain=chain,
        heights=np.zeros(3),
        held_heights=np.array([True, False, True]),
        spacing=np.ones(2),
        triangles=triangles,
        strand_pairs=none,
        strand_distances=np.empty(0),
        opening_pairs=none,
        corners=none,
        turns=none,
        arcs=two,
        crossings=two,
        steep=np.arange(2),
        bounds=Bounds(0.1, 0.5, 0.1, 0.1, 1.0, -1.0, 1.0),
        weights=Weights(0.01, 0.1, 0.0),
    )


def test_the_program_itself_straightens_a_chain() -> None:
    found = solve(square())
    assert found.status is PathStatus.SOLVED
    assert found.positions[1] == pytest.approx([1, 0], abs=0.02)
    assert found.heights == pytest.approx([0, 0, 0], abs=0.02)
    assert {each.family for each in found.violations} == {"diagram", "slope"}
    assert all(each.amount <= 1e-5 for each in found.violations)


def test_the_program_keeps_its_distance() -> None:
    apart = replace(
        square(),
        positions=np.array([[0, 0], [1, 0.1], [2, 0], [1, -0.2], [4, -2], [4, 2], [-2, 2.0]]),
        triangles=np.empty((0, 3), dtype=np.int64),
        strand_pairs=np.array([[3, 0, 1], [3, 1, 2]]),
        strand_distances=np.array([0.3, 0.3]),
    )
    found = solve(apart)
    assert found.positions[1, 1] > 0.1
    along = found.positions[1] - found.positions[0]
    away = apart.positions[3] - found.positions[0]
    distance = abs(along[0] * away[1] - along[1] * away[0]) / np.linalg.norm(along)
    assert 0.3 - 1e-4 <= distance < 0.35


def test_wrong_numbers_are_named() -> None:
    with pytest.raises(ProgramError, match=r"positions: entry \[1, 0\] is not a finite number"):
        replace(square(), positions=square().positions * [[1], [np.nan], [1], [1], [1], [1], [1]])
    with pytest.raises(ProgramError, match="places 0 and 1 of the chain coincide"):
        replace(square(), positions=square().positions[[0, 0, 2, 3, 4, 5, 6]])


def test_a_solver_that_breaks_down_leaves_the_path_as_it_was(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    def broken(program: PathProgram, **_: object) -> object:
        found = solve(program, iterations=1)
        flipped = found.positions.copy()
        flipped[0] += 100
        return replace(found, status=PathStatus.FAILED, raw_status="Broken", positions=flipped)

    monkeypatch.setattr(optimise, "solve", broken)
    cable = Cable(read("3").diagram, "L+")
    result = optimise_path(cable, (3, 4, 6))
    assert result.status is PathStatus.STOPPED and result.raw_status == "Broken"
    assert not any(each.accepted for each in result.rounds)
    assert result.report.same_diagram


def test_one_structure_is_built_once() -> None:
    from formulations.elements import build_solver

    chosen = best_cut(read("3").diagram)
    build_solver.cache_clear()
    for _ in range(2):
        result = optimise_path(chosen.cable, chosen.supports)
    assert build_solver.cache_info().hits == len(result.rounds)


def test_places_are_named_by_turning_points() -> None:
    cable = Cable(read("3").diagram, "L+")
    names = [span_name(cable, float(time)) for time in cable.times]
    assert names == [f"p{k}" for k in range(1, 11)]
    result = optimise_path(cable, (3, 4, 6))
    again = examine(cable, (3, 4, 6), result.curve, result.requirements)
    assert again.clearance == result.report.clearance
