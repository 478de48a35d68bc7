"""Gauss codes to and from planar diagrams, and closed curves drawn from their Gauss words."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from knotopt.errors import DiagramError
from knotopt.planar.embedding import handedness, parts
from knotopt.planar.gauss import from_gauss, gauss_code, gauss_letters, oriented_gauss_code
from knotopt.planar.planar_diagram import PlanarDiagram
from knotopt.planar.signature import signature
from tests.helpers.random_diagrams import random_diagrams
from tests.helpers.strategies import planar_diagrams


def same_up_to_parts(diagram: PlanarDiagram, found: PlanarDiagram) -> bool:
    """Whether the curves are the same but for reflections of whole parts of the diagram."""
    if diagram.visits != found.visits:
        return False
    return all(
        len({diagram.signs[crossing] * found.signs[crossing] for crossing in part}) == 1
        for part in parts([crossing for crossing, _ in diagram.visits])
    )


def by_first_visits(diagram: PlanarDiagram) -> PlanarDiagram:
    """The same diagram, its crossings in the order in which the knot meets them."""
    order = dict.fromkeys(crossing for crossing, _ in diagram.visits)
    return PlanarDiagram(tuple(diagram.crossings[crossing] for crossing in order))


@given(planar_diagrams())
def test_grids_with_signs_come_back_as_they_were(diagram: PlanarDiagram) -> None:
    assert from_gauss(*oriented_gauss_code(diagram)) == by_first_visits(diagram)


@given(planar_diagrams())
def test_grids_without_signs_come_back_up_to_mirrored_parts(diagram: PlanarDiagram) -> None:
    assert same_up_to_parts(by_first_visits(diagram), from_gauss(gauss_code(diagram)))


def test_random_diagrams_come_back() -> None:
    for diagram in random_diagrams():
        ordered = by_first_visits(diagram)
        assert from_gauss(*oriented_gauss_code(diagram)) == ordered
        found = from_gauss(gauss_code(diagram))
        assert found in (ordered, ordered.mirrored)
        assert found.signs[0] == 1


def test_a_code_may_be_read_from_behind() -> None:
    """With over for under and the same crossing signs: the same knot, turned over."""
    trefoil = from_gauss([1, -2, 3, -1, 2, -3], [-1, -1, -1])
    behind = from_gauss([-1, 2, -3, 1, -2, 3], [-1, -1, -1])
    assert signature(trefoil) == signature(behind) == 2


def test_letters() -> None:
    trefoil = from_gauss([1, -2, 3, -1, 2, -3], [-1, -1, -1])
    assert gauss_letters(trefoil) == "O1-U2-O3-U1-O2-U3-"
    assert gauss_letters(PlanarDiagram(())) == ""


def test_summands_are_each_up_to_mirror() -> None:
    """Granny and square knot have one Gauss code; read from it, both trefoils are positive."""
    code = [1, -2, 3, -1, 2, -3, 4, -5, 6, -4, 5, -6]
    assert parts([abs(entry) for entry in code]) == [[1, 2, 3], [4, 5, 6]]
    assert from_gauss(code).signs == (1,) * 6
    square = from_gauss(code, [1, 1, 1, -1, -1, -1])
    assert (signature(from_gauss(code)), signature(square)) == (-4, 0)


@given(planar_diagrams(max_size=9), st.data())
def test_each_part_may_be_reflected(diagram: PlanarDiagram, data: st.DataObject) -> None:
    signs = [*oriented_gauss_code(diagram)[1]]
    code = gauss_code(diagram)
    for part in parts([abs(entry) - 1 for entry in code]):
        if data.draw(st.booleans()):
            for crossing in part:
                signs[crossing] = -signs[crossing]
    assert from_gauss(code, signs).signs == tuple(signs)


@given(planar_diagrams(max_size=9), st.data())
def test_no_single_crossing_of_a_part_may_be_reflected(
    diagram: PlanarDiagram, data: st.DataObject
) -> None:
    code, signs = oriented_gauss_code(diagram)
    larger = [part for part in parts([abs(entry) - 1 for entry in code]) if len(part) > 1]
    if not larger:
        return
    crossing = data.draw(st.sampled_from(data.draw(st.sampled_from(larger))))
    reflected = [-sign if c == crossing else sign for c, sign in enumerate(signs)]
    with pytest.raises(DiagramError, match="on a surface of genus"):
        from_gauss(code, reflected)


@pytest.mark.parametrize(
    ("word", "message"),
    [
        ([0, 1, 0, 1], "visits 1 and 3 are of one crossing with an odd number"),
        ([0, 1, 2, 3, 0, 2, 1, 4, 3, 4], "visits 1 and 5"),
        # Gauss's condition holds, but the curve would need a torus.
        ([0, 1, 2, 3, 1, 4, 3, 0, 4, 2], "visit 8 is cut off from visit 7"),
    ],
)
def test_words_of_no_plane_curve(word: list[int], message: str) -> None:
    with pytest.raises(DiagramError, match=message):
        handedness(word)


@given(st.permutations([0, 0, 1, 1, 2, 2, 3, 3, 4, 4]))
def test_words_are_drawn_exactly_if_some_signs_draw_them(word: list[int]) -> None:
    """By trying all signs of the crossings."""
    met: set[int] = set()
    code = []
    for crossing in word:
        code.append(-crossing - 1 if crossing in met else crossing + 1)
        met.add(crossing)
    drawn = []
    for bits in range(2**5):
        signs = [1 if bits >> k & 1 else -1 for k in range(5)]
        try:
            drawn.append(from_gauss(code, signs).signs)
        except DiagramError:
            continue
    if not drawn:
        with pytest.raises(DiagramError, match="in the plane"):
            handedness(word)
        return
    assert len(drawn) == 2 ** len(parts(word))
    assert from_gauss(code).signs in drawn


@pytest.mark.parametrize(
    ("code", "message"),
    [
        ([1, -2, 3, -1, 2], "crossing 3 is visited once, at 3, expected two visits"),
        ([1, -1, 1], "crossing 1 is visited at 1, 2 and 3, expected two visits"),
        ([1, 1], "crossing 1 is passed over at visits 1 and 2, expected once over and once under"),
        ([-7, -7], "crossing 7 is passed under at visits 1 and 2"),
        ([1, 0], "visit 2 is 0"),
    ],
)
def test_codes_that_are_wrong(code: list[int], message: str) -> None:
    with pytest.raises(DiagramError, match=message):
        from_gauss(code)


@pytest.mark.parametrize(
    ("signs", "message"),
    [([1, 1], "2 signs of 3 crossings"), ([1, 2, 1], "sign 2 is 2, expected 1 or -1")],
)
def test_signs_that_are_wrong(signs: list[int], message: str) -> None:
    with pytest.raises(DiagramError, match=message):
        from_gauss([1, -2, 3, -1, 2, -3], signs)
