"""Formulation `span`: its rows against the geometric definition, and the prototype's figures."""

from __future__ import annotations

from fractions import Fraction
from itertools import combinations, pairwise

from hypothesis import given, settings
from hypothesis import strategies as st

from formulations.backends import get_backend
from formulations.solution import Limits
from knotopt.cable.cable import Cable
from knotopt.catalogue.table1_grids import table1_grids
from knotopt.supports.lcf import best_cut
from knotopt.supports.regions import Regions
from knotopt.supports.span import compile_span
from knotopt.supports.threading import Threading
from knotopt.verify.regions import define_regions
from knotopt.verify.span import SpanRules, check_span
from tests.helpers.strategies import cables

MODES = st.sampled_from(list(Threading))
OPENNESS = st.integers(1, 1000).map(lambda thousandths: Fraction(thousandths, 1000))


@settings(max_examples=200)
@given(cables(max_size=8), MODES, OPENNESS, st.booleans(), st.data())
def test_a_set_satisfies_the_rows_exactly_if_the_taut_cable_is_open(
    cable: Cable, mode: Threading, openness: Fraction, pockets: bool, data: st.DataObject
) -> None:
    count = len(cable.path)
    program = compile_span(Regions(cable), mode, pockets=pockets)
    instance = program.instance(float(openness**2))
    for _ in range(6):
        dropped = data.draw(st.sets(st.integers(2, count - 1), max_size=count // 2))
        supports = [k for k in range(2, count) if k not in dropped]
        report = check_span(
            cable.path, cable.diagram.size, supports, openness, mode, pockets=pockets
        )
        holds = not instance.violated(instance.complete([1, *supports, count]))
        assert holds == report.is_open, (supports, report.closures)


def test_figures_measured_before() -> None:
    """Loops only, strands between over and under, r = 0.25, LCF's cut of the preferred grids."""
    found = []
    for grid in table1_grids():
        if grid.preferred:
            regions = best_cut(grid.diagram).regions
            instance = compile_span(regions, pockets=False).instance(0.25**2)
            found.append(get_backend().solve(instance, Limits()).objective)
    assert found == [5, 6, 6, 6, 11, 8]


@settings(max_examples=150)
@given(cables(min_size=4, max_size=8), MODES, OPENNESS, st.data())
def test_what_the_rules_exclude_is_in_no_open_set(
    cable: Cable, mode: Threading, openness: Fraction, data: st.DataObject
) -> None:
    """Rules for certificates: sound (no open set has the spans) and enough (some spans tell)."""
    count = len(cable.path)
    regions = define_regions(cable.path, cable.diagram.size)
    rules = SpanRules(cable.path, regions, openness, mode)
    for _ in range(3):
        dropped = data.draw(st.sets(st.integers(2, count - 1), max_size=count - 2))
        supports = [k for k in range(2, count) if k not in dropped]
        spans = list(pairwise([1, *supports, count]))
        report = check_span(cable.path, cable.diagram.size, supports, openness, mode)
        excluded = any(
            rules.exclude(chosen) for size in (1, 2, 3) for chosen in combinations(spans, size)
        )
        assert excluded != report.is_open, (supports, report.closures)
