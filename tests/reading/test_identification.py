"""Knots that a reading leaves open, against SnapPy's reading of the same codes."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import product

import pytest
import spherogram

from knotopt.identify.identify import identify
from knotopt.planar.dt import dt_code, dt_flips, from_dt
from knotopt.planar.embedding import parts
from knotopt.planar.from_grid import planar_diagram
from knotopt.planar.gauss import gauss_code, parts_by_themselves
from knotopt.planar.planar_diagram import PlanarDiagram
from knotopt.planar.small_grid import small_grid
from knotopt.reading.identification import identify_read
from knotopt.reading.knot import read_knot


def all_hands(diagram: PlanarDiagram) -> Iterator[PlanarDiagram]:
    """The diagrams with the DT code of this one, by their flips."""
    order = [crossing for crossing, _ in diagram.visits[::2]]
    code, flips = dt_code(diagram), dt_flips(diagram)
    mirrored_together = parts([crossing for crossing, _ in diagram.visits])
    for turned in product((False, True), repeat=len(mirrored_together)):
        other = {
            c for part, turn in zip(mirrored_together, turned, strict=True) if turn for c in part
        }
        yield from_dt(code, [f ^ (c in other) for c, f in zip(order, flips, strict=True)])


def from_name(name: str) -> PlanarDiagram:
    """A diagram of the knot of that name, its summands one after the other."""
    return planar_diagram(read_knot(name).diagram)


@pytest.mark.parametrize("name", ["3_1#3_1", "3_1#m5_2", "3_1#4_1", "3_1#m3_1#m3_1"])
def test_all_diagrams_of_a_code_are_of_the_candidates(name: str) -> None:
    code = dt_code(from_name(name))
    found = identify_read(read_knot(f"DT: {[code]}"))
    meant = {knot.name for knot in found.knots}
    if found.up_to_mirror:
        meant |= {knot.mirror.name for knot in found.knots}
    assert found.proven
    names = {identify(small_grid(each)).name for each in all_hands(from_dt(code))}
    assert names == meant


@pytest.mark.parametrize("code", ["[(4, 6, 2, 10, 12, 8)]", "[(4, 6, 2, 10, 12, 14, 8)]"])
def test_snappys_reading_is_among_the_candidates(code: str) -> None:
    link = spherogram.Link(f"DT: {code}")
    its = identify_read(read_knot(f"PD: {[tuple(c) for c in link.PD_code()]}"))
    assert its.proven and its.name is not None
    ours = identify_read(read_knot(f"DT: {code}"))
    assert its.knots[0] in {each for knot in ours.knots for each in (knot, knot.mirror)}
    assert ours.up_to_mirror or its.name in ours.candidates


@pytest.mark.parametrize("name", ["3_1#3_1", "3_1#5_2"])
def test_unsigned_gauss_codes_leave_the_same_open(name: str) -> None:
    diagram = from_name(name)
    by_gauss = identify_read(read_knot(f"GaussCode{[*gauss_code(diagram)]}"))
    by_dt = identify_read(read_knot(f"DT: {[dt_code(diagram)]}"))
    assert {*by_gauss.candidates} == {*by_dt.candidates}
    assert len(by_dt.candidates) == (3 if name == "3_1#3_1" else 4)


def test_parts_are_the_summands() -> None:
    found = parts_by_themselves(from_dt([4, 6, 2, 10, 12, 14, 8]))
    assert [identify(small_grid(part)).name for part in found] == ["3_1", "4_1"]


def test_the_code_itself_is_compared() -> None:
    """The grid that it is drawn on may have more crossings than the tables, the code has not."""
    named = read_knot("DT: [(4, 8, 10, 2, 12, 6)]")
    assert named.planar is not None and identify_read(named).proven
    granny = read_knot("granny", mirror=True)
    assert identify_read(granny).up_to_mirror and identify_read(granny).name == "m3_1#m3_1"
