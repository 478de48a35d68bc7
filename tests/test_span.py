"""Formulation `span`: its rows against the geometric definition, and the prototype's figures."""

from __future__ import annotations

from fractions import Fraction

from hypothesis import given, settings
from hypothesis import strategies as st
from strategies import cables

from knotopt.cable.cable import Cable
from knotopt.supports.regions import Regions
from knotopt.supports.span import compile_span
from knotopt.supports.threading import Threading
from knotopt.verify.span import check_span

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
