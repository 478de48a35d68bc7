"""Regions and LCF against the definition, the paper's Table I and figures measured before."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings

from benchmarks.lcf_by_definition import slow_lcf
from knotopt.cable.cable import Cable
from knotopt.cable.cut import crossing_free_cuts
from knotopt.catalogue.knots import shipped_knots
from knotopt.diagram.families import random_knot, torus_knot
from knotopt.diagram.grid import GridDiagram
from knotopt.errors import GridError
from knotopt.supports import interior
from knotopt.supports.lcf import best_cut, lcf, lcf_by_cut
from knotopt.supports.regions import Regions
from knotopt.verify.regions import define_regions
from tests.helpers.strategies import cables

TABLE1: list[dict[str, Any]] = json.loads(
    (Path(__file__).parents[1] / "data" / "table1_expected.json").read_text()
)


def assert_regions_as_defined(cable: Cable) -> None:
    size = cable.diagram.size
    slow = {
        (region.kind, region.walk): (region.apexes, region.interior, region.threaded_by)
        for region in define_regions(list(cable.path), size)
    }
    fast = {}
    for region in Regions(cable):
        walk = list(range(region.intervals[0][0], region.intervals[0][1] + 1))
        for low, high in region.intervals[1:]:
            forward = tuple(cable.cells[low]) == tuple(cable.cells[walk[-1]])
            walk += range(low, high + 1) if forward else reversed(range(low, high + 1))
        apexes = frozenset(tuple(cable.crossings.cell[k].tolist()) for k in region.apexes)
        cells = frozenset(tuple(cell) for cell in (np.argwhere(region.interior) + 1).tolist())
        fast[str(region.kind), tuple(walk)] = (apexes, cells, region.threaded_by)
        corners = {t: k for k, t in enumerate(cable.times.tolist(), 1)}
        assert region.boundary == tuple(corners[t] for t in walk if t in corners)
    assert list(fast.items()) == list(slow.items())  # in the same order, too


@settings(max_examples=150)
@given(cables(max_size=11))
def test_regions_and_lcf_follow_the_definition(cable: Cable) -> None:
    assert_regions_as_defined(cable)
    for layered in (False, True):
        expected = slow_lcf(list(cable.path), cable.diagram.size, layered)
        assert lcf(cable, layered=layered).supports == expected


def test_the_definition_on_torus_knots_and_a_larger_grid() -> None:
    for diagram in (torus_knot(3, 4), torus_knot(2, 11), random_knot(18, seed=4)):
        cable = Cable(diagram, "B-")
        assert_regions_as_defined(cable)
        assert lcf(cable).supports == slow_lcf(list(cable.path), diagram.size, layered=False)


@pytest.mark.parametrize("entry", TABLE1, ids=lambda entry: f"{entry['row']}-{entry['knot']}")
def test_table1_grids(entry: dict[str, Any]) -> None:
    diagram = GridDiagram.from_marks(entry["grid"])
    cable = Cable(diagram, entry["cut"])
    assert [list(mark) for mark in cable.path] == entry["path"]
    result = lcf(cable)
    assert [list(support) for support in result.placed_supports] == entry["lcf_supports"]
    assert result.baseline == entry["robots_before"]
    by_cut = {str(cut): result.robots for cut, result in lcf_by_cut(diagram).items()}
    assert by_cut == entry["lcf_robots_by_cut"]
    best = best_cut(diagram)
    assert (str(best.cable.cut), best.robots) == (entry["cut"], entry["robots_after_lcf"])
    assert best.robots == entry["robots_after_paper"]


def test_mean_robots_up_to_eight_crossings() -> None:
    """282 knot-cut pairs: 10.82 robots, layered 8.94 (to the digits that were measured before)."""
    knots = [knot for knot in shipped_knots().values() if knot.crossing_number <= 8]
    pairs = [(k.diagram, cut) for k in knots for cut in crossing_free_cuts(k.diagram)]
    assert (len(knots), len(pairs)) == (35, 282)
    plain = [lcf(Cable(diagram, cut)).robots for diagram, cut in pairs]
    layered = [lcf(Cable(diagram, cut), layered=True).robots for diagram, cut in pairs]
    assert round(float(np.mean(plain)), 3) == 10.819
    assert round(float(np.mean(layered)), 3) == 8.943


@given(cables(max_size=10))
def test_layers_count_the_active_interiors(cable: Cable) -> None:
    regions = Regions(cable)
    counted = sum(
        (region.interior.astype(int) for region in regions if region.is_active),
        start=np.zeros((cable.diagram.size,) * 2, dtype=int),
    )
    assert (regions.layers() == counted).all()
    assert all(("active" if r.is_active else "passive") in r.why for r in regions)


def test_interiors_do_not_depend_on_the_batch(monkeypatch: pytest.MonkeyPatch) -> None:
    cable = Cable(random_knot(20, seed=3), "R-")
    whole = Regions(cable)
    monkeypatch.setattr(interior, "_CELLS_AT_ONCE", 1000)
    batched = Regions(cable)
    assert (whole.packed_interiors == batched.packed_interiors).all()
    assert (whole.layers() == batched.layers()).all()


def test_selection_does_not_depend_on_the_batch(monkeypatch: pytest.MonkeyPatch) -> None:
    cable = Cable(random_knot(25, seed=3), "R-")
    whole = lcf(cable)
    monkeypatch.setattr("knotopt.supports.lcf._ENTRIES_AT_ONCE", 300)
    batched = lcf(cable)
    assert whole == batched and len(whole.regions.active) > 6


def test_a_grid_that_is_too_large_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(interior, "MAX_GIBIBYTES", 1e-6)
    with pytest.raises(GridError, match=r"a grid of size 41 with \d+ regions is too large"):
        lcf(Cable(torus_knot(20, 21), "L+"))


def test_a_cable_without_crossings_needs_no_supports() -> None:
    result = best_cut(torus_knot(1, 1))
    assert (result.robots, result.supports, len(result.regions)) == (2, (), 0)


@given(cables(max_size=9))
def test_layered_only_drops_points_inside_active_regions(cable: Cable) -> None:
    plain, layered = lcf(cable), lcf(cable, layered=True)
    assert set(layered.supports) <= set(plain.supports)
    active = [region for region in plain.regions if region.is_active]
    for dropped in set(plain.supports) - set(layered.supports):
        column, row = cable.path[dropped - 1]
        assert any(region.interior[column - 1, row - 1] for region in active)
    assert plain.reduction_percent == pytest.approx(
        100 - 100 * plain.robots / plain.baseline, abs=0.051
    )


def test_results_are_values() -> None:
    """Equal inputs give equal, hashable results, and no array of theirs can be written to."""
    first, second = (lcf(Cable(torus_knot(2, 5), "R+")) for _ in range(2))
    assert first == second and len({first, second}) == 1
    boundaries = first.regions.boundaries
    for array in (first.regions.packed_interiors, boundaries.a, boundaries.apexes):
        with pytest.raises(ValueError, match="read-only"):
            array[0] = 0
