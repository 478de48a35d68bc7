"""Grid diagrams of planar diagrams and braids are of the same knot, mirror image and all."""

from __future__ import annotations

import json

import pytest
import snappy
import spherogram
from hypothesis import given, settings
from hypothesis import strategies as st

from knotopt.cable.alexander import alexander_from_gauss
from knotopt.catalogue.knotinfo import knotinfo_knots
from knotopt.diagram.grid import GridDiagram
from knotopt.diagram.simplify import simplify
from knotopt.errors import DiagramError
from knotopt.planar.braid import from_braid
from knotopt.planar.braid_grid import braid_grid
from knotopt.planar.from_grid import planar_diagram
from knotopt.planar.grid_drawing import draw_grid
from knotopt.planar.planar_diagram import PlanarDiagram
from knotopt.planar.signature import signature
from knotopt.planar.small_grid import small_grid
from knotopt.planar.sums import summands
from tests.helpers.knotinfo_codes import Codes, knotinfo_codes
from tests.helpers.random_diagrams import random_diagrams
from tests.helpers.snappy_invariants import (
    homology_ranks,
    invariants,
)
from tests.helpers.strategies import planar_diagrams

K14N27120 = (
    "[[6,0,7,27],[0,20,1,19],[8,1,9,2],[21,3,22,2],[3,10,4,11],[4,14,5,13],[14,6,15,5],"
    "[18,7,19,8],[20,10,21,9],[11,23,12,22],[23,13,24,12],[24,15,25,16],[16,25,17,26],"
    "[26,17,27,18]]"
)
"""SnapPy's `Link("K14n27120").PD_code()`."""


def link_of(diagram: PlanarDiagram) -> spherogram.Link:
    return spherogram.Link([list(crossing) for crossing in diagram.pd_code])


def some_of_knotinfo(step: int) -> tuple[Codes, ...]:
    """Every so manieth of its 12,965 knots of 3 to 13 crossings."""
    return knotinfo_codes(most_crossings=13)[::step]


@pytest.mark.slow
def test_knotinfos_codes_become_grids_at_the_arc_index() -> None:
    """Of its PD codes and its braids, by knot Floer homology."""
    some = some_of_knotinfo(57)
    assert len(some) > 220
    above = []
    for codes in some:
        planar = PlanarDiagram.from_edges(codes.crossings)
        expected = homology_ranks(link_of(planar))
        for grid in (small_grid(planar), small_grid(from_braid(codes.words[0]))):
            assert invariants(grid).ranks == expected, codes.name
            if grid.size > knotinfo_knots()[codes.name].arc_index:
                above.append(codes.name)
    assert len(above) <= 0.02 * 2 * len(some), above


def invariants_of(knot: PlanarDiagram | GridDiagram) -> tuple[tuple[int, ...], int]:
    """Alexander polynomial and signature, by code that is tested elsewhere."""
    planar = planar_diagram(knot) if isinstance(knot, GridDiagram) else knot
    crossings, over = zip(*planar.visits, strict=True) if planar.crossings else ((), ())
    return alexander_from_gauss(crossings, over, planar.signs), signature(planar)


def test_drawings_have_two_rows_more_than_crossings_or_fewer() -> None:
    knots = knotinfo_knots()
    for codes in some_of_knotinfo(113):
        knot = knots[codes.name]
        grid = draw_grid(PlanarDiagram.from_edges(codes.crossings))
        assert grid.size <= knot.crossing_number + 2
        for each in (grid, braid_grid(codes.words[0])):
            assert invariants_of(each) == (knot.alexander, knot.signature), codes.name
        if knot.alternating:
            assert grid.size == knot.arc_index


def test_large_prime_diagrams() -> None:
    for planar in random_diagrams():
        drawn, small = draw_grid(planar), small_grid(planar)
        assert drawn.size <= len(planar.crossings) + 2
        assert signature(planar_diagram(drawn)) == signature(planar)
        assert invariants_of(small) == invariants_of(planar)


@pytest.mark.slow
def test_large_prime_diagrams_by_knot_floer_homology() -> None:
    for planar in random_diagrams():
        if len(planar.crossings) <= 40:
            assert invariants(small_grid(planar)).ranks == homology_ranks(link_of(planar))


@settings(max_examples=200)
@given(planar_diagrams(max_size=14))
def test_diagrams_with_kinks_and_summands(planar: PlanarDiagram) -> None:
    grid = draw_grid(planar)
    assert grid.size <= 2 + sum(len(part.crossings) for part in summands(planar))
    assert invariants_of(grid) == invariants_of(planar)


def test_the_orientation_is_kept() -> None:
    """By 9_32, whose exterior has no isometry to itself but the identity: that to the exterior of
    a grid tells the directions of meridian and longitude."""
    (codes,) = (codes for codes in knotinfo_codes() if codes.name == "9_32")
    planar = PlanarDiagram.from_edges(codes.crossings)
    exterior = link_of(planar).exterior()
    for grid in (draw_grid(planar), small_grid(planar)):
        (isometry,) = oriented_exterior(grid).is_isometric_to(exterior, return_isometries=True)
        assert isometry.cusp_maps()[0].list() == [1, 0, 0, 1]
        (isometry,) = oriented_exterior(grid.reversed).is_isometric_to(
            exterior, return_isometries=True
        )
        assert isometry.cusp_maps()[0].list() == [-1, 0, 0, -1]


def oriented_exterior(grid: GridDiagram) -> snappy.Manifold:
    """With a longitude that runs along columns from -1 to +1."""
    planar = planar_diagram(grid)
    if grid.minus[0] > grid.plus[0]:  # then the direction "+" is the other one
        last = 2 * len(planar.crossings) - 1
        planar = PlanarDiagram(
            tuple((last - c, last - d, last - a, last - b) for a, b, c, d in planar.crossings)
        )
    return link_of(planar).exterior()


def test_a_knot_that_no_catalogue_has() -> None:
    planar = PlanarDiagram.from_edges(json.loads(K14N27120))
    grid = small_grid(planar)
    assert grid.size <= 14 and draw_grid(planar).size <= 16  # it does not alternate
    assert invariants(grid).ranks == homology_ranks(link_of(planar))
    assert small_grid(planar) == grid
    found = link_of(planar_diagram(grid)).exterior().identify()
    assert "K14n27120" in {manifold.name() for manifold in found}


@given(
    st.integers(2, 7).flatmap(
        lambda strands: st.tuples(
            st.just(strands),
            st.lists(st.integers(1, strands - 1), max_size=12),
            st.lists(st.booleans(), min_size=2 * 12, max_size=2 * 12),
        )
    )
)
def test_twisted_unknots_end_at_two_columns(
    drawn: tuple[int, list[int], list[bool]],
) -> None:
    """Conjugates of one letter of each kind."""
    strands, letters, up = drawn
    word = [letter if sign else -letter for letter, sign in zip(letters, up, strict=False)]
    once = [i if sign else -i for i, sign in zip(range(1, strands), up[12:], strict=False)]
    unknot = [*word, *once, *(-letter for letter in reversed(word))]
    assert small_grid(from_braid(unknot)).size == 2
    assert simplify(braid_grid(unknot)).size == 2


def test_a_circle() -> None:
    for grid in (draw_grid(PlanarDiagram(())), braid_grid([]), small_grid(from_braid([1, -2]))):
        assert grid.size == 2


@given(
    st.integers(2, 6).flatmap(
        lambda strands: st.lists(
            st.integers(1, strands - 1).flatmap(lambda i: st.sampled_from((i, -i))),
            min_size=1,
            max_size=20,
        )
    )
)
def test_grids_of_braids_and_of_their_diagrams(word: list[int]) -> None:
    try:
        planar = from_braid(word)
    except DiagramError as error:
        with pytest.raises(DiagramError, match=f"^{error}$"):
            braid_grid(word)
        return
    grid = braid_grid(word)
    assert grid.size <= len(word) + max(map(abs, word)) + 1
    assert invariants_of(grid) == invariants_of(draw_grid(planar)) == invariants_of(planar)


def test_braids_that_are_none() -> None:
    with pytest.raises(DiagramError, match="letter 2 of the braid word is 0"):
        braid_grid([1, 0])
    with pytest.raises(DiagramError, match="a link of 2 components"):
        braid_grid([1, 1])
    with pytest.raises(DiagramError, match="a link of 2 components"):
        braid_grid([1, 1, 1], strands=3)
