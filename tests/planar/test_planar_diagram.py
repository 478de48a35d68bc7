"""Planar diagrams: any numbering of the edges, signs, visits, faces, mirror images."""

from __future__ import annotations

from random import Random

import pytest
import spherogram
from hypothesis import given
from hypothesis import strategies as st

from knotopt.errors import DiagramError
from knotopt.planar.planar_diagram import PlanarDiagram
from tests.helpers.knotinfo_codes import knotinfo_codes
from tests.helpers.random_diagrams import random_diagrams
from tests.helpers.strategies import planar_diagrams

TREFOIL = PlanarDiagram(((0, 4, 1, 3), (2, 0, 3, 5), (4, 2, 5, 1)))


def test_knotinfos_codes_keep_their_numbers() -> None:
    for codes in knotinfo_codes():
        diagram = PlanarDiagram.from_edges(codes.crossings)
        assert [list(crossing) for crossing in diagram.pd_code] == codes.crossings, codes.name


@given(planar_diagrams(), st.randoms(use_true_random=False))
def test_any_names_of_the_edges(diagram: PlanarDiagram, random: Random) -> None:
    """Other names, numbers from elsewhere on, and the strand below begun at its other end."""
    edges = 2 * len(diagram.crossings)
    start = random.randrange(edges) if edges else 0
    names = random.sample(range(1000), edges)
    rotated = [tuple((edge + start) % edges for edge in x) for x in diagram.crossings]
    again = PlanarDiagram.from_edges([[edge + 7 for edge in x] for x in rotated])
    assert again.crossings == tuple(rotated)
    half_turned = [x[2:] + x[:2] if random.random() < 0.5 else x for x in rotated[1:]]
    named = PlanarDiagram.from_edges(
        [[f"edge {names[edge]}" for edge in x] for x in rotated[:1] + half_turned]
    )
    first = rotated[0][0] if rotated else 0
    expected = [tuple((edge - first) % edges for edge in x) for x in rotated]
    assert named.crossings == tuple(expected)
    assert named.signs == diagram.signs


@given(planar_diagrams())
def test_a_mirror_image_has_the_other_signs(diagram: PlanarDiagram) -> None:
    mirrored = diagram.mirrored
    assert mirrored.signs == tuple(-sign for sign in diagram.signs)
    assert mirrored.visits == diagram.visits
    assert mirrored.mirrored == diagram


def test_signs_and_faces_are_spherograms() -> None:
    for diagram in random_diagrams():
        link = spherogram.Link([list(crossing) for crossing in diagram.pd_code])
        assert [crossing.sign for crossing in link.crossings] == list(diagram.signs)
        faces = sorted(len(face) for face in link.faces())
        assert sorted(map(len, diagram.faces)) == faces


@given(planar_diagrams())
def test_each_end_of_an_edge_is_on_one_face(diagram: PlanarDiagram) -> None:
    ends = [end for face in diagram.faces for end in face]
    count = len(diagram.crossings)
    assert sorted(ends) == [(c, side) for c in range(count) for side in range(4)]
    assert len(diagram.faces) == (count + 2 if count else 0)
    for (c, side), (d, other) in diagram.other_ends.items():
        assert diagram.other_ends[d, other] == (c, side)
        assert diagram.crossings[c][side] == diagram.crossings[d][other]


def test_text_is_knottheorys() -> None:
    assert str(TREFOIL) == "PD[X[1,5,2,4], X[3,1,4,6], X[5,3,6,2]]"
    assert str(PlanarDiagram(())) == "PD[]"
    assert PlanarDiagram.from_edges([]) == PlanarDiagram(())


@pytest.mark.parametrize("kink", [(0, 0, 1, 1), (0, 1, 1, 0), (1, 0, 0, 1), (1, 1, 0, 0)])
def test_one_crossing(kink: tuple[int, int, int, int]) -> None:
    diagram = PlanarDiagram.from_edges([kink])
    link = spherogram.Link([list(crossing) for crossing in diagram.pd_code])
    assert diagram.writhe == link.writhe() != 0
    assert len(diagram.faces) == 3


@pytest.mark.parametrize(
    ("crossings", "message"),
    [
        ([[1, 5, 2, 4], [3, 1, 4]], "crossing 2 has 3 edges, expected four"),
        ([[1, 5, 2, 4], [3, 1, 4, 6], [5, 3, 6, 7]], "edge 2 at crossing 1 occurs once"),
        ([[1, 5, 2, 4], [3, 1, 4, 6], [5, 5, 6, 2]], "edge 5 at crossing 1 occurs 3 times"),
        ([[4, 1, 3, 2], [2, 3, 1, 4]], "this code is a link of 2 components, a knot has 1"),
        ([[1, 2, 1, 2]], "a link of 2 components"),
        ([[1, 4, 2, 5], [3, 1, 4, 6], [5, 3, 6, 2]], "on a surface of genus 1, which"),
    ],
)
def test_codes_that_are_wrong(crossings: list[list[int]], message: str) -> None:
    with pytest.raises(DiagramError, match=message):
        PlanarDiagram.from_edges(crossings)


@pytest.mark.parametrize(
    ("crossings", "message"),
    [
        (((1, 5, 2, 4), (3, 1, 4, 6), (5, 3, 6, 2)), "edge 6 at crossing 2: 3 crossings have"),
        (((1, 4, 0, 3), (2, 0, 3, 5), (4, 2, 5, 1)), "crossing 1 is .* its strands do not run on"),
    ],
)
def test_the_class_takes_its_own_numbering_only(
    crossings: tuple[tuple[int, int, int, int], ...], message: str
) -> None:
    with pytest.raises(DiagramError, match=message):
        PlanarDiagram(crossings)
