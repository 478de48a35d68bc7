"""DT codes to and from planar diagrams, against Spherogram's reading of them."""

from __future__ import annotations

import pytest
import spherogram
from hypothesis import given

from knotopt.errors import DiagramError
from knotopt.planar.dt import dt_code, dt_flips, dt_letters, dt_numbers, from_dt
from knotopt.planar.planar_diagram import PlanarDiagram
from knotopt.planar.signature import signature
from tests.helpers.random_diagrams import random_diagrams
from tests.helpers.strategies import planar_diagrams


def signs_by_edges(diagram: PlanarDiagram) -> dict[tuple[int, int], int]:
    """Sign at each pair of edges that come in, so that the order of crossings does not matter."""
    places: dict[int, list[int]] = {}
    for edge, (crossing, _) in enumerate(diagram.visits):
        places.setdefault(crossing, []).append(edge)
    return {(a, b): diagram.signs[crossing] for crossing, (a, b) in places.items()}


@given(planar_diagrams())
def test_flips_bring_the_diagram_back(diagram: PlanarDiagram) -> None:
    code, flips = dt_code(diagram), dt_flips(diagram)
    assert sorted(from_dt(code, flips).crossings) == sorted(diagram.crossings)
    assert dt_code(from_dt(code)) == code


def test_random_diagrams_come_back_up_to_mirror() -> None:
    for diagram in random_diagrams():
        found = sorted(from_dt(dt_code(diagram)).crossings)
        assert found in (sorted(diagram.crossings), sorted(diagram.mirrored.crossings))


def test_spherogram_reads_codes_and_flips_as_we_do() -> None:
    for diagram in random_diagrams():
        code, flips = dt_code(diagram), dt_flips(diagram)
        link = spherogram.Link(f"DT: [{code}], {list(flips)}")
        there = PlanarDiagram.from_edges(link.PD_code())
        assert sorted(there.signs) == sorted(diagram.signs)
        assert signature(there) == signature(diagram)
        # Of a prime diagram it chooses the same mirror image, by the first crossing.
        chosen = spherogram.Link(f"DT: [{code}]")
        assert sorted(c.sign for c in chosen.crossings) == sorted(from_dt(code).signs)


def test_letters_are_spherograms() -> None:
    for diagram in random_diagrams():
        code = dt_code(diagram)
        if len(code) > 26:
            with pytest.raises(DiagramError, match="a DT code in letters has 1 to 26"):
                dt_letters(code)
            continue
        letters = dt_letters(code)
        assert dt_numbers(letters) == dt_numbers(letters[3:]) == code
        flips = "".join(map(str, dt_flips(diagram)))
        link = spherogram.Link(f"DT: {letters}.{flips}")
        assert link.DT_code(DT_alpha=True) is not None
        assert sorted(c.sign for c in link.crossings) == sorted(diagram.signs)


@pytest.mark.parametrize(
    ("code", "message"),
    [
        ([4, 6, 3], "entry 3 of the DT code is 3: 3 crossings have the even numbers 2 to 6"),
        ([4, 8, 2], "entry 2 of the DT code is 8"),
        ([4, 0, 2], "entry 2 of the DT code is 0"),
        ([4, -4, 2], "entries 1 and 2 of the DT code are both 4, expected each even number once"),
        ([4, 6, 8, 10, 2], "visit 8 is cut off from visit 7"),
    ],
)
def test_codes_that_are_wrong(code: list[int], message: str) -> None:
    with pytest.raises(DiagramError, match=message):
        from_dt(code)


def test_a_code_that_spherogram_cannot_draw_either() -> None:
    code = (4, 8, -12, 2, -18, -20, -6, -26, -10, -28, -16, -24, -22, -14)
    with pytest.raises(IndexError):
        spherogram.Link(f"DT: [{code}]")
    with pytest.raises(DiagramError, match="visit 20 is cut off from visit 19"):
        from_dt(code)


@pytest.mark.parametrize(
    ("letters", "message"),
    [
        ("cacbcab", "'cacbcab' neither has each of its first 7 letters once nor begins"),
        ("cabbca", "3 crossings by its first letter and 2 by its third"),
        ("c1", "letter 2 of the DT code is '1', expected a to z"),
        ("dbbbabcd", "a link of 2 components, a knot has 1"),
    ],
)
def test_letters_that_are_wrong(letters: str, message: str) -> None:
    with pytest.raises(DiagramError, match=message):
        dt_numbers(letters)


def test_flips_that_are_wrong() -> None:
    with pytest.raises(DiagramError, match="expected 0 or 1 for each of 3 crossings"):
        from_dt([4, 6, 2], [0, 1])
    with pytest.raises(DiagramError, match="on a surface of genus"):
        from_dt([4, 6, 2], [0, 0, 0])
