"""Knots by name: the knot that is meant, chirality included, and what is said of a miss."""

from __future__ import annotations

import string

import pytest
from hypothesis import given
from hypothesis import strategies as st

from knotopt.cable.alexander import alexander_polynomial
from knotopt.cable.cable import Cable
from knotopt.catalogue.everyday_names import everyday_names
from knotopt.catalogue.knotinfo import LARGEST_KNOTS, knotinfo_knots
from knotopt.catalogue.knots import shipped_knots, unknot
from knotopt.catalogue.prime_names import numbered, prime_named, range_of
from knotopt.diagram.grid import GridDiagram
from knotopt.errors import GridError, KnotoptError, UnknownKnotError
from knotopt.identify.jones import jones_polynomial, mirrored
from knotopt.planar.from_grid import planar_diagram
from knotopt.planar.signature import signature
from knotopt.reading.content import Content
from knotopt.reading.knot import read_knot
from knotopt.reading.names import mirror_name, read
from knotopt.reading.near_names import unknown
from knotopt.reading.record import Asked

KNOTS = [*knotinfo_knots().values()]


def signature_of(diagram: GridDiagram) -> int:
    return signature(planar_diagram(diagram))


def test_every_name_of_every_knot_of_knotinfo() -> None:
    for knot in KNOTS:
        plain = [name.replace("_", "") for name in knot.other_names if "a" in name or "n" in name]
        for name in (knot.name, *knot.other_names, *plain, *(f"K{each}" for each in plain)):
            assert prime_named(name) == knot, name
    assert prime_named("0_1") == unknot()


def test_the_last_names_of_each_form() -> None:
    for head, last in LARGEST_KNOTS.items():
        names = {name for knot in KNOTS for name in (knot.name, *knot.other_names)}
        assert f"{head}_{last}" in names and f"{head}_{last + 1}" not in names
    assert range_of("8_99") == 21 and range_of("8n_99") == 3 and range_of("14a_1") is None


@pytest.mark.parametrize(
    ("text", "name"),
    [
        (" 8_19 ", "8_19"),
        ("8\u2081\u2089", "8_19"),
        ("$8_{19}$", "8_19"),
        ("8.19", "8_19"),
        ("Knot[8, 19]", "8_19"),
        ("K8n3", "8_19"),
        ("k11N34", "11n_34"),
        ("Knot[11, NonAlternating, 34]", "11n_34"),
        ("Knot[11, Alternating, 1]", "11a_1"),
        ("11_471", "11n_34"),
        ("unknot", "0_1"),
        ("U", "0_1"),
        ("m3_1", "m3_1"),
        ("-3_1", "m3_1"),
        ("\u22123_1", "m3_1"),
        ("mirror(3_1)", "m3_1"),
        ("mirror image of 3_1", "m3_1"),
        ("Mirror[Knot[3, 1]]", "m3_1"),
        ("3_1*", "m3_1"),
        ("m(m3_1)", "3_1"),
        ("mK11n34", "m11n_34"),
        ("-T(2,3)", "T(2,-3)"),
        ("TorusKnot[3, 5]", "T(3,5)"),
        ("3_1#m3_1#4_1", "3_1#m3_1#4_1"),
        ("3_1 # 0_1", "3_1"),
        ("unknot#unknot", "0_1"),
        ("-(3_1#4_1)", "m3_1#m4_1"),
        ("granny#T(2,5)", "3_1#3_1#T(2,5)"),
        ("3#4", "3_1#4_1"),
        ("left-handed trefoil", "m3_1"),
        ("mirror left-handed trefoil", "3_1"),
        ("Miller Institute knot", "6_2"),
    ],
)
def test_names(text: str, name: str) -> None:
    assert read_knot(text).name == name


def test_everyday_names_are_the_knots_that_they_say() -> None:
    for entry in everyday_names().values():
        for name in entry.names:
            found = read_knot(name)
            assert found.name == entry.knot and found.ambiguous == entry.either_hand


def test_mirror_images_and_sums_by_invariants() -> None:
    for knot in [*shipped_knots().values()][::10]:
        mirror = read_knot(f"m{knot.name}").diagram
        assert signature_of(mirror) == -knot.signature
        assert jones_polynomial(planar_diagram(mirror)) == mirrored(
            jones_polynomial(planar_diagram(knot.diagram))
        )
        total = read_knot(f"{knot.name}#m3_1#{knot.name}").diagram
        assert signature_of(total) == 2 * knot.signature + 2
        assert total.size == 2 * knot.arc_index + 5 - 4
    assert signature_of(read_knot("granny").diagram) == -4
    assert signature_of(read_knot("square").diagram) == 0
    square = alexander_polynomial(Cable(read_knot("square").diagram, "L+"))
    assert square == (1, -2, 3, -2, 1)


def test_mirror_images_by_the_option() -> None:
    assert read_knot("3_1#m4_1", mirror=True).name == "m3_1#4_1"
    assert read_knot("T(2,3)", mirror=True).name == "T(2,-3)"
    code = read_knot("[[1,5,2,4],[3,1,4,6],[5,3,6,2]]", mirror=True)
    assert code.name == "PD code" and code.planar is not None and code.planar.writhe == -3


def test_the_trefoil_s_hands() -> None:
    assert signature_of(read_knot("right-handed trefoil").diagram) == -2
    assert signature_of(read_knot("left-handed trefoil").diagram) == 2
    assert read_knot("3_1").ambiguous is False and read_knot("trefoil").ambiguous is True


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("8_22", "'8_22'; KnotInfo has 8_1 to 8_21$"),
        ("m8_22", "'m8_22'; KnotInfo has 8_1 to 8_21$"),
        ("8n_4", "KnotInfo has 8n_1 to 8n_3$"),
        ("11a_400", "KnotInfo has 11a_1 to 11a_367$"),
        ("11_600", "Conway's list has 11_1 to 11_552$"),
        ("12_5", "KnotInfo has 12a_1 to 12a_1288 and 12n_1 to 12n_888$"),
        ("10_166", "Rolfsen's 10_163 to 10_166"),
        ("K14n27120", "names are known up to 13 crossings: give a PD or DT code"),
        ("2_1", "no knot has a crossing number of 2"),
        ("5n_1", "all knots of 5 crossings alternate"),
        ("0_2", "KnotInfo has 0_1$"),
        ("trefol", "nearest: trefoil"),
        ("figure eigth", "nearest: figure-eight"),
        ("6", "nearest: 6_1, 6_2, 6_3$"),
        ("12", "nearest: 12a_1, 12n_1$"),
        ("3_1#foo", "no knot is named 'foo'"),
    ],
)
def test_misses(text: str, message: str) -> None:
    with pytest.raises(UnknownKnotError, match=message):
        read_knot(text)


def test_a_torus_link_is_said_to_be_one() -> None:
    with pytest.raises(GridError, match="a link of 2 components"):
        read_knot("3_1#T(2,4)")


@given(st.sampled_from([knot.name for knot in KNOTS]), st.integers(0, 4))
def test_mirror_images_of_mirror_images(name: str, times: int) -> None:
    text, expected = name, name
    for _ in range(times):
        text, expected = f"m({text})", mirror_name(expected)
    assert read_knot(text).name == expected


@given(st.text(string.printable, max_size=30) | st.text("Tmk()#,-_*!an013579", max_size=20))
def test_any_text_is_a_knot_or_a_sentence(text: str) -> None:
    try:
        prime_named(text)
        numbered(text)
        read(Content(text), Asked())
        str(unknown(text))
    except KnotoptError as error:
        assert str(error)
