"""Codes and invariants of closed-up cables, against KnotInfo's values and SnapPy's packages."""

from __future__ import annotations

from itertools import pairwise

import pytest
import snappy
import spherogram
from hypothesis import given, settings

from knotopt.cable.alexander import (
    alexander_polynomial,
    determinant,
    format_polynomial,
)
from knotopt.cable.cable import Cable
from knotopt.cable.cut import crossing_free_cuts
from knotopt.cable.notation import dt_code, gauss_code, pd_code
from knotopt.catalogue.knots import PrimeKnot, shipped_knots
from knotopt.diagram.families import random_knot, torus_knot
from tests.helpers.snappy_invariants import (
    euler_characteristic,
    homology_ranks,
    invariants,
    link_of,
    seifert_invariants,
)
from tests.helpers.strategies import cables

KNOTS = shipped_knots()


def test_every_knot_and_crossing_free_cut_has_knotinfos_alexander_polynomial() -> None:
    for knot in KNOTS.values():
        for cut in crossing_free_cuts(knot.diagram):
            polynomial = alexander_polynomial(Cable(knot.diagram, cut))
            assert polynomial == knot.alexander, (knot.name, str(cut))
            assert determinant(polynomial) == knot.determinant, (knot.name, str(cut))


@pytest.mark.slow
def test_every_knot_and_crossing_free_cut_is_the_knot_for_snappy() -> None:
    """SnapPy's packages read our PD code of every cut as one knot, with KnotInfo's polynomial."""
    for knot in KNOTS.values():
        homologies = []
        for cut in crossing_free_cuts(knot.diagram):
            cable = Cable(knot.diagram, cut)
            link = link_of(cable)
            assert sorted(c.sign for c in link.crossings) == sorted(cable.crossings.sign.tolist())
            homologies.append(homology_ranks(link))
            assert euler_characteristic(homologies[-1]) == knot.alexander, (knot.name, str(cut))
        assert all(ranks == homologies[0] for ranks in homologies), knot.name


@pytest.mark.slow
def test_every_knot_has_knotinfos_chirality() -> None:
    """By the signature of Spherogram's Seifert matrix; KnotInfo's has the opposite sign."""
    found = {
        name: seifert_invariants(link_of(Cable(knot.diagram, "R-"))) for name, knot in KNOTS.items()
    }
    expected = {name: (knot.alexander, -knot.signature) for name, knot in KNOTS.items()}
    assert found == expected
    assert sum(signature != 0 for _, signature in found.values()) > 150


@pytest.mark.parametrize("name", ["4_1", "8_20", "9_42", "10_139"])
def test_dt_and_pd_codes_are_read_back_as_the_same_knot(name: str) -> None:
    cable = Cable(KNOTS[name].diagram, "T-")
    from_dt = snappy.Manifold(f"DT:[({','.join(map(str, dt_code(cable)))})]")
    from_pd = link_of(cable).exterior()
    assert from_dt.is_isometric_to(from_pd)
    known = snappy.Manifold(name)
    assert from_dt.is_isometric_to(known)


def test_dt_codes_of_every_tenth_knot_have_its_polynomial() -> None:
    for knot in list(KNOTS.values())[::10]:
        link = spherogram.Link(f"DT: [{dt_code(Cable(knot.diagram, 'B+'))}]")
        assert seifert_invariants(link)[0] == knot.alexander, knot.name


@settings(max_examples=60)
@given(cables(max_size=10))
def test_random_cables_agree_with_snappy(cable: Cable) -> None:
    if len(cable.crossings):
        link = link_of(cable)
        assert alexander_polynomial(cable) == seifert_invariants(link)[0]
        assert sorted(c.sign for c in link.crossings) == sorted(cable.crossings.sign.tolist())
    else:
        assert alexander_polynomial(cable) == (1,)


@settings(max_examples=60)
@given(cables(max_size=9))
def test_the_winding_numbers_of_the_grid_give_the_same_polynomial(cable: Cable) -> None:
    """det t^w(i,j) = +- t^k (1 - t)^(N-1) Delta(t), w the winding number about lattice point (i,j)
    (Manolescu, Ozsvath, Sarkar, doi:10.4007/annals.2009.169.633): a formula without crossings."""
    from cypari import pari

    diagram = cable.diagram
    size = diagram.size
    winding = [[0] * size for _ in range(size)]
    for column in range(1, size):
        for row in range(size):
            # Crossing the column's segment from left to right changes the winding number.
            low, high = diagram.minus[column - 1], diagram.plus[column - 1]
            step = (low <= row < high) - (high <= row < low)
            winding[row][column] = winding[row][column - 1] + step
    shift = min(min(line) for line in winding)
    entries = [pari(f"t^{w - shift}") for line in winding for w in line]
    quotient = pari.matrix(size, size, entries).matdet() / pari(f"(1-t)^{size - 1}")
    coefficients = [int(c) for c in quotient.Vecrev()]
    low = next(k for k, c in enumerate(coefficients) if c)
    sign = 1 if coefficients[-1] > 0 else -1
    assert alexander_polynomial(cable) == tuple(sign * c for c in coefficients[low:])


@given(cables(max_size=10))
def test_codes_are_well_formed(cable: Cable) -> None:
    count = len(cable.crossings)
    gauss = gauss_code(cable)
    assert sorted(gauss) == sorted([*range(1, count + 1), *range(-count, 0)])
    edges = [edge for crossing in pd_code(cable) for edge in crossing]
    assert sorted(edges) == sorted([*range(1, 2 * count + 1)] * 2)
    assert sorted(map(abs, dt_code(cable))) == list(range(2, 2 * count + 1, 2))


def test_signs_of_the_trefoil() -> None:
    """3_1 of KnotInfo and T(2,3) are the same positive trefoil; T(2,-3) is its mirror image."""
    assert set(Cable(torus_knot(2, 3), "L+").crossings.sign.tolist()) == {1}
    assert set(Cable(torus_knot(2, -3), "L+").crossings.sign.tolist()) == {-1}
    assert invariants(torus_knot(2, 3)) == invariants(KNOTS["3_1"].diagram)


@given(cables(max_size=10))
def test_dt_signs_are_all_alike_exactly_if_over_and_under_alternate(cable: Cable) -> None:
    code, over = dt_code(cable), cable.visits[2].tolist()
    alternating = all(a != b for a, b in pairwise(over))
    assert (len({entry > 0 for entry in code}) <= 1) == alternating


def test_alexander_of_many_crossings_and_of_none() -> None:
    cable = Cable(random_knot(26, seed=2), "L+")
    assert len(cable.crossings) > 60
    polynomial = alexander_polynomial(cable)
    assert abs(sum(polynomial)) == 1 and polynomial == polynomial[::-1]
    assert alexander_polynomial(Cable(torus_knot(1, 1), "L+")) == (1,)


@pytest.mark.parametrize(
    ("polynomial", "text"),
    [
        ((1,), "1"),
        ((1, -3, 1), "1 - 3t + t^2"),
        ((-1, 0, 2), "-1 + 2t^2"),
        ((2, -1), "2 - t"),
    ],
)
def test_polynomials_as_text(polynomial: tuple[int, ...], text: str) -> None:
    assert format_polynomial(polynomial) == text


def test_the_catalogue_is_complete_and_its_grids_smallest() -> None:
    counts: dict[int, int] = {}
    for knot in KNOTS.values():
        counts[knot.crossing_number] = counts.get(knot.crossing_number, 0) + 1
        assert knot.diagram.size == knot.arc_index
        assert PrimeKnot.from_json(knot.to_json()) == knot
    assert counts == {3: 1, 4: 1, 5: 2, 6: 3, 7: 7, 8: 21, 9: 49, 10: 165}
