"""Braid words to planar diagrams, and braids of grids, against KnotInfo and Spherogram."""

from __future__ import annotations

import pytest
import spherogram
from hypothesis import given, settings
from hypothesis import strategies as st

from knotopt.catalogue.knots import shipped_knots
from knotopt.diagram.grid import GridDiagram
from knotopt.errors import DiagramError
from knotopt.planar.braid import from_braid
from knotopt.planar.braid_of_grid import braid_of_grid, braid_word
from knotopt.planar.from_grid import planar_diagram
from knotopt.planar.planar_diagram import PlanarDiagram
from knotopt.planar.signature import signature
from tests.helpers.knotinfo_codes import knotinfo_codes
from tests.helpers.random_diagrams import random_diagrams
from tests.helpers.snappy_invariants import seifert_invariants
from tests.helpers.strategies import diagrams

WORDS = st.integers(2, 6).flatmap(
    lambda strands: st.lists(
        st.integers(1, strands - 1).flatmap(lambda i: st.sampled_from((i, -i))), max_size=20
    )
)


def link_of(diagram: PlanarDiagram) -> spherogram.Link:
    return spherogram.Link([list(crossing) for crossing in diagram.pd_code])


def invariants(diagram: PlanarDiagram) -> tuple[tuple[int, ...], int]:
    """Alexander polynomial and signature, by Spherogram's Seifert matrix."""
    return seifert_invariants(link_of(diagram)) if diagram.crossings else ((1,), 0)


def test_positive_letters_are_knotinfos_positive_crossings() -> None:
    """Its braids are its knots, chirality included."""
    for codes in knotinfo_codes():
        for word in codes.words:
            assert signature(from_braid(word)) == codes.signature, codes.name


@given(WORDS)
def test_closures_are_spherograms(word: list[int]) -> None:
    """Or links of as many components."""
    if not word:
        assert from_braid(word) == PlanarDiagram(())
        return
    link = spherogram.Link(braid_closure=word)
    components = len(link.link_components) + link.unlinked_unknot_components
    if components > 1:
        with pytest.raises(DiagramError, match=f"is a link of {components} components"):
            from_braid(word)
        return
    found = from_braid(word)
    assert found.signs == tuple(1 if letter > 0 else -1 for letter in word)
    assert seifert_invariants(link_of(found)) == seifert_invariants(link)


@settings(max_examples=40)
@given(diagrams(max_size=12))
def test_braids_of_grids_are_the_same_knot(grid: GridDiagram) -> None:
    word, strands = braid_of_grid(grid)
    assert strands < grid.size
    assert invariants(from_braid(word, strands)) == invariants(planar_diagram(grid))


def test_braids_of_the_catalogues_grids_have_its_signatures() -> None:
    for name, knot in shipped_knots().items():
        word, strands = braid_of_grid(knot.diagram)
        assert signature(from_braid(word, strands)) == knot.signature, name


def test_braids_of_random_diagrams_are_the_same_knot() -> None:
    for diagram in random_diagrams()[:24]:
        assert invariants(from_braid(*braid_word(diagram))) == invariants(diagram)


def test_braids_of_the_unknot() -> None:
    assert from_braid([]) == from_braid([], 1) == PlanarDiagram(())
    assert braid_word(PlanarDiagram(())) == ((), 1)
    assert braid_word(PlanarDiagram.from_edges([(0, 0, 1, 1)])) == ((), 1)


@pytest.mark.parametrize(
    ("word", "strands", "message"),
    [
        ([1, 1], None, "the closure of this braid is a link of 2 components, a knot has 1"),
        ([1, 1, 1], 3, "a link of 2 components"),
        ([], 4, "a link of 4 components"),
        ([10**12], None, "a link of 1000000000000 components"),
        ([1, 2, 1], 2, "letter 2 of the braid word is 2; a braid of 2 strands has letters"),
        ([1, 0], None, "letter 2 of the braid word is 0"),
        ([], 0, "a braid of 0 strands, expected at least 1"),
    ],
)
def test_words_that_are_wrong(word: list[int], strands: int | None, message: str) -> None:
    with pytest.raises(DiagramError, match=message):
        from_braid(word, strands)
