"""Finite groups by their laws, and colouring polynomials as invariants of unoriented knots."""

from __future__ import annotations

from collections import Counter

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from knotopt.cable.alexander import determinant
from knotopt.catalogue.knotinfo import knotinfo_knots
from knotopt.catalogue.knots import shipped_knots
from knotopt.identify.colourings import Wirtinger, colouring_polynomial
from knotopt.identify.finite_groups import ConjugacyClass, alternating_group, psl2
from knotopt.planar.from_grid import planar_diagram
from knotopt.planar.planar_diagram import PlanarDiagram
from tests.helpers.random_moves import moved_about

GROUPS = {"PSL(2,5)": psl2(5), "PSL(2,7)": psl2(7), "A5": alternating_group(5)}
SIZES = {  # of the conjugacy classes, from the ATLAS of Finite Groups; inverse ones once
    "PSL(2,5)": [12, 12, 15, 20],
    "PSL(2,7)": [21, 24, 42, 56],
    "A5": [12, 12, 15, 20],
}


def reversed_knot(planar: PlanarDiagram) -> PlanarDiagram:
    count = 2 * len(planar.crossings)
    turned = ((c, d, a, b) for a, b, c, d in planar.crossings)
    return PlanarDiagram(
        tuple(
            (
                (-1 - a) % count,
                (-1 - b) % count,
                (-1 - c) % count,
                (-1 - d) % count,
            )
            for a, b, c, d in turned
        )
    )


def order(element: int, colours: ConjugacyClass) -> int:
    """The order of the class's first element, counted from the given power on."""
    power, count = int(colours.products[element, 0]), 1
    while power != element:
        power, count = int(colours.products[power, 0]), count + 1
    return count


@pytest.mark.parametrize("name", GROUPS)
def test_classes(name: str) -> None:
    classes = GROUPS[name]
    assert [len(each.conjugates) for each in classes] == SIZES[name]
    for each in classes:
        size = len(each.conjugates)
        first = each.products[each.identity]  # the class's elements, in the group
        for a in range(0, size, 5):
            for b in range(0, size, 3):
                # b (b^-1 a b) = a b, and the other way round.
                left = each.products[first[b], each.conjugates[b, a]]
                assert left == each.products[first[a], b]
                assert each.conjugates_back[b, each.conjugates[b, a]] == a
            assert each.inverse_products[first[a], a] == each.identity
        assert order(each.identity, each) in (2, 3, 4, 5, 7)


def test_fox_s_colourings_by_the_dihedral_classes() -> None:
    """Two involutions generate a dihedral group: knots with two bridges have Fox's colourings."""
    (involutions,) = (each for each in psl2(5) if len(each.conjugates) == 15)
    counts = {
        name: sum(colouring_polynomial(planar_diagram(knot.diagram), involutions) or ())
        for name, knot in shipped_knots().items()
        if knot.crossing_number < 6
    }
    # With one strand's colour held: itself, and every involution whose product with it has an
    # order that divides the determinant: 4 of order 3, 8 of order 5.
    dihedral = {3: 4, 5: 8}
    for name, count in counts.items():
        found = determinant(shipped_knots()[name].alexander)
        assert count == 1 + dihedral.get(found, 0), name


def test_an_unknot_has_one_colouring() -> None:
    for kinked in (PlanarDiagram(()), PlanarDiagram(((0, 0, 1, 1),))):
        for each in psl2(7):
            assert Counter(colouring_polynomial(kinked, each)) == {0: 167, 1: 1}


@settings(max_examples=25)
@given(st.sampled_from([*shipped_knots()]), st.integers(0, 10**6))
def test_moves_and_reversal_leave_them(name: str, seed: int) -> None:
    diagram = shipped_knots()[name].diagram
    planar, moved = planar_diagram(diagram), planar_diagram(moved_about(diagram, seed))
    for each in psl2(7):
        polynomial = colouring_polynomial(planar, each)
        assert colouring_polynomial(moved, each) in (polynomial, None)
        assert colouring_polynomial(reversed_knot(planar), each) == polynomial


def test_reversal_of_knots_that_are_not_their_reverse() -> None:
    for name in ("8_17", "9_32", "10_98"):
        planar = planar_diagram(shipped_knots()[name].diagram)
        for each in alternating_group(5):
            other = colouring_polynomial(reversed_knot(planar), each)
            assert colouring_polynomial(planar, each) == other


def test_mirror_images_that_other_invariants_do_not_tell_apart() -> None:
    """10_71 and 10_104 have the signature 0 and palindromic Jones polynomials."""
    for name in ("10_48", "10_71", "10_91", "10_104"):
        planar = planar_diagram(shipped_knots()[name].diagram)
        assert any(
            colouring_polynomial(planar, each) != colouring_polynomial(planar.mirrored, each)
            for each in (*psl2(7), *psl2(11))
        ), name
    planar = planar_diagram(shipped_knots()["4_1"].diagram)
    for each in psl2(7):
        assert colouring_polynomial(planar, each) == colouring_polynomial(planar.mirrored, each)


def test_too_many_choices_are_not_tried() -> None:
    planar = planar_diagram(knotinfo_knots()["13a_1"].diagram)
    assert len(Wirtinger.of(planar).seeds()) > 2
    assert colouring_polynomial(planar, psl2(7)[0], most=100) is None
    assert np.all(psl2(7)[0].conjugates >= 0)
