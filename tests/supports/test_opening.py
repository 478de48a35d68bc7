"""Formulation `opening`: its rows against the geometric definition, and figures measured before."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from formulations.backends import get_backend
from formulations.cnf import clauses
from formulations.solution import Limits, Status
from knotopt.cable.cable import Cable
from knotopt.cable.cut import crossing_free_cuts
from knotopt.catalogue.knots import shipped_knots
from knotopt.catalogue.table1_grids import table1_grids
from knotopt.diagram.families import random_knot
from knotopt.supports.lcf import best_cut
from knotopt.supports.minimal import minimal_supports
from knotopt.supports.opening import compile_opening
from knotopt.supports.regions import Regions
from knotopt.supports.search import best_supports
from knotopt.supports.threading import Threading
from knotopt.verify.opening import check_opening, closing_clauses
from knotopt.verify.regions import define_regions
from tests.helpers.shortest_path import smallest_path
from tests.helpers.strategies import cables

GUIDE: list[dict[str, Any]] = [
    {"row": "3", "lcf": 5, "lcf_open": False, "same_cut": 5, "best_cut": 5},
    {"row": "4", "lcf": 5, "lcf_open": False, "same_cut": 5, "best_cut": 5},
    {"row": "5", "lcf": 5, "lcf_open": False, "same_cut": 6, "best_cut": 6},
    {"row": "7 Var1", "lcf": 7, "lcf_open": False, "same_cut": 12, "best_cut": 12},
    {"row": "7 Var2", "lcf": 8, "lcf_open": True, "same_cut": 6, "best_cut": 6},
    {"row": "9", "lcf": 6, "lcf_open": False, "same_cut": 6, "best_cut": 5},
]
MODES = st.sampled_from(list(Threading))
OPENNESS = st.integers(1, 1000).map(lambda thousandths: Fraction(thousandths, 1000))


@settings(max_examples=300)
@given(cables(max_size=9), MODES, OPENNESS, st.data())
def test_a_set_satisfies_the_rows_exactly_if_it_is_open(
    cable: Cable, mode: Threading, openness: Fraction, data: st.DataObject
) -> None:
    count = len(cable.path)
    instance = compile_opening(Regions(cable), mode).instance(float(openness**2))
    for _ in range(4):
        dropped = data.draw(st.sets(st.integers(2, count - 1), max_size=count // 2))
        supports = [k for k in range(2, count) if k not in dropped]
        chosen = [1, *supports, count]
        report = check_opening(cable.path, cable.diagram.size, supports, openness, mode)
        assert (not instance.violated(instance.complete(chosen))) == report.is_open


@settings(max_examples=100)
@given(cables(max_size=9), MODES)
def test_every_turning_point_is_open_up_to_one(cable: Cable, mode: Threading) -> None:
    supports = range(2, len(cable.path))
    report = check_opening(cable.path, cable.diagram.size, supports, Fraction(1), mode)
    assert report.is_open


@settings(max_examples=100)
@given(cables(max_size=8), MODES, st.data())
def test_margins_are_the_smallest_opening(
    cable: Cable, mode: Threading, data: st.DataObject
) -> None:
    """The rows of a set's own level hold, those of the next one do not."""
    count = len(cable.path)
    program = compile_opening(Regions(cable), mode)
    supports = sorted(data.draw(st.sets(st.integers(2, count - 1), min_size=count // 2)))
    report = check_opening(cable.path, cable.diagram.size, supports, Fraction(1, 1000), mode)
    if report.is_open and report.smallest_opening_squared is not None:
        opening = float(report.smallest_opening_squared)
        values = program.instance(min(opening, 1.0)).complete([1, *supports, count])
        assert not program.instance(min(opening, 1.0)).violated(values)
        if opening < 1:
            assert opening in program.levels
            assert program.instance(opening + 1e-9).violated(values)


@settings(max_examples=60)
@given(cables(min_size=5, max_size=16), OPENNESS)
def test_the_minimum_is_a_shortest_path(cable: Cable, openness: Fraction) -> None:
    """An algorithm of another kind, from the definition's clauses, finds the same number."""
    regions = define_regions(cable.path, cable.diagram.size)
    clauses = closing_clauses(cable.path, regions, openness)
    active = [region for region in regions if region.threaded_by is not None]
    instance = compile_opening(Regions(cable)).instance(float(openness**2))
    solution = get_backend("cp-sat").solve(instance, Limits())
    assert solution.status is Status.OPTIMAL and solution.objective is not None
    shortest = smallest_path(list(cable.path), clauses, active)
    pockets = [row for row in instance.rows if row.family == "area" and row.at_least == 1]
    without = replace(instance, rows=tuple(row for row in instance.rows if row not in pockets))
    assert shortest == get_backend("cp-sat").solve(without, Limits()).objective
    assert shortest <= solution.objective


@settings(max_examples=60)
@given(cables(max_size=9), MODES, OPENNESS)
def test_the_checkers_clauses_are_the_rows(
    cable: Cable, mode: Threading, openness: Fraction
) -> None:
    """The rows, as clauses, are among the definition's, and imply them all."""
    instance = compile_opening(Regions(cable), mode).instance(float(openness**2))
    regions = define_regions(cable.path, cable.diagram.size)
    defined = closing_clauses(cable.path, regions, openness, mode)
    rows = {frozenset(clause) for clause in clauses(instance)}
    assert rows - {frozenset([1]), frozenset([len(cable.path)])} <= defined
    assert all(any(row <= clause for row in rows) for clause in defined)


@pytest.mark.parametrize("entry", GUIDE, ids=lambda entry: entry["row"])
def test_figures_measured_before(entry: dict[str, Any]) -> None:
    """`opening`, turning points, r = 0.5: LCF's cut and the best outer cut."""
    diagram = next(g.diagram for g in table1_grids() if g.preferred and g.row == entry["row"])
    seeded = best_cut(diagram)
    same = minimal_supports(seeded.cable)
    assert (same.lcf.robots, same.lcf_report.is_open) == (entry["lcf"], entry["lcf_open"])
    assert same.robots == entry["same_cut"] and same.is_proven
    assert best_supports(diagram).best.robots == entry["best_cut"]


@pytest.mark.slow
def test_figures_of_282_pairs() -> None:
    """35 knots up to 8 crossings, all crossing-free cuts, as measured before."""
    found = []
    for knot in shipped_knots().values():
        if knot.crossing_number <= 8:
            for cut in crossing_free_cuts(knot.diagram):
                result = minimal_supports(Cable(knot.diagram, cut), canonical=False)
                assert result.is_proven
                found.append((result.robots, result.lcf.robots, result.lcf_report.is_open))
    robots, lcf_robots, is_open = np.array(found).T
    assert len(found) == 282
    assert round(robots.mean(), 3) == 8.773 and round(lcf_robots.mean(), 2) == 10.82
    assert round(100 * is_open.mean(), 1) == 52.5
    assert round(100 * (lcf_robots < robots).mean(), 1) == 9.9


def test_random_grids_of_size_40() -> None:
    for seed in range(3):
        result = minimal_supports(Cable(random_knot(40, seed), "L+"), canonical=False)
        assert result.solution.status is Status.OPTIMAL
        assert not result.instance.violated(result.instance.complete([1, *result.supports, 80]))
