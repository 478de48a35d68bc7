"""Formulation `opening`: its rows against the geometric definition, and figures measured before."""

from __future__ import annotations

from fractions import Fraction

from hypothesis import given, settings
from hypothesis import strategies as st
from strategies import cables

from knotopt.cable.cable import Cable
from knotopt.supports.opening import compile_opening
from knotopt.supports.regions import Regions
from knotopt.supports.threading import Threading
from knotopt.verify.opening import check_opening

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
        supports = sorted(data.draw(st.sets(st.integers(2, count - 1))))
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
