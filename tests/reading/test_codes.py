"""PD, DT and Gauss codes and braid words in the forms in which people have them."""

from __future__ import annotations

from typing import Any

import pytest
import snappy
import spherogram

from knotopt.errors import KnotoptError
from knotopt.planar.braid import from_braid
from knotopt.planar.dt import from_dt
from knotopt.planar.gauss import from_gauss
from knotopt.planar.planar_diagram import PlanarDiagram
from knotopt.planar.signature import signature
from knotopt.reading import braid, dt, gauss, pd
from knotopt.reading.codes import MAX_CROSSINGS, looks_like_dt, looks_like_gauss
from knotopt.reading.content import Content
from knotopt.reading.knot import read_knot
from knotopt.reading.record import Asked
from tests.helpers.knotinfo_codes import knotinfo_codes
from tests.helpers.snappy_invariants import homology_ranks, seifert_invariants
from tests.helpers.understood import understood

UNKNOT = PlanarDiagram(())
TREFOIL = PlanarDiagram.from_edges([[1, 5, 2, 4], [3, 1, 4, 6], [5, 3, 6, 2]])
UP_TO_MIRROR = ("up to mirror image",)

PD = [
    "[[1,5,2,4],[3,1,4,6],[5,3,6,2]]",
    "[[0,4,1,3],[2,0,3,5],[4,2,5,1]]",
    "[(101,105,102,104),(103,101,104,106),(105,103,106,102)]",
    "[[1.0,5.0,2.0,4.0],[3.0,1.0,4.0,6.0],[5.0,3.0,6.0,2.0]]",
    "PD[X[1,5,2,4], X[3,1,4,6], X[5,3,6,2]]",
    "PD[Xp[1,5,2,4], Xp[3,1,4,6], Xp[5,3,6,2]]",
    "X[1,5,2,4] X[3,1,4,6] X[5,3,6,2]",
    "X[1,5,2,4], X[3,1,4,6],\nX[5,3,6,2]",
    "X1524 X3146 X5362",
    "X1,5,2,4 X3,1,4,6 X5,3,6,2",
    "{{1;5;2;4};{3;1;4;6};{5;3;6;2}}",
    "PD: [(0,4,1,3),(2,0,3,5),(4,2,5,1)]",
    "PD=[[1,5,2,4],[3,1,4,6],[5,3,6,2]]",
    "1 5 2 4\n3 1 4 6\n5 3 6 2",
    "1,5,2,4\n3,1,4,6\n5,3,6,2\n",
    '{"pd_notation": "[[1,5,2,4],[3,1,4,6],[5,3,6,2]]"}',
    '{"pd": [[1,5,2,4],[3,1,4,6],[5,3,6,2]]}',
    "array([[1, 5, 2, 4], [3, 1, 4, 6], [5, 3, 6, 2]])",
    [[1, 5, 2, 4], [3, 1, 4, 6], [5, 3, 6, 2]],
]
DT = [
    "[4, 6, 2]",
    "4 6 2",
    "4, 6, 2",
    "[(4,6,2)]",
    "{4;6;2}",
    "DT: [(4,6,2)]",
    "DT:[(4,6,2)]",
    "DT[(4,6,2)]",
    "DTCode[4, 6, 2]",
    "DT: 4 6 2",
    "dt code = 4,6,2",
    "DT code: 4 6 2",
    "DT:cacbca",
    "DT: cacbca",
    "DT[cacbca]",
    "cacbca",
    "bca",
    '{"dt_notation": "[(4,6,2)]"}',
    '{"dt": "cacbca"}',
    [4, 6, 2],
]
GAUSS = [
    "[1, -2, 3, -1, 2, -3]",
    "1, -2, 3, -1, 2, -3",
    "1 -2 3 -1 2 -3",
    "1, \u22122, 3, \u22121, 2, \u22123",
    "{1;-2;3;-1;2;-3}",
    "[[1, -2, 3, -1, 2, -3]]",
    "GaussCode[1, -2, 3, -1, 2, -3]",
    "GaussCode[{1, -2, 3, -1, 2, -3}]",
    "Gauss: 1 -2 3 -1 2 -3",
    "Gauss code: 1, -2, 3, -1, 2, -3",
    "O1U2O3U1O2U3",
    "o1 u2 o3 u1 o2 u3",
    "1+, 2-, 3+, 1-, 2+, 3-",
    '{"gauss_notation": "{1,-2,3,-1,2,-3}"}',
    [7, -12, 13, -7, 12, -13],
]
ORIENTED = [
    "[[[1, -2, 3, -1, 2, -3]], [1, 1, 1]]",
    "[[1, -2, 3, -1, 2, -3], [1, 1, 1]]",
    '[[1, -2, 3, -1, 2, -3], ["+", "+", "+"]]',
    "O1+U2+O3+U1+O2+U3+",
    "O1+ U2+ O3+ U1+ O2+ U3+",
    "O1+, U2+, O3+, U1+, O2+, U3+",
    "Gauss code: O1+U2+O3+U1+O2+U3+",
    "[[[-1, 2, -3, 1, -2, 3]], [1, 1, 1]]",
]
BRAIDS = [
    "[1,1,1]",
    "1 1 1",
    "{1,1,1}",
    "{1;1;1}",
    "Braid[2, {1,1,1}]",
    "BR[2, {1, 1, 1}]",
    "BR(2, [1, 1, 1])",
    "{2,{1,1,1}}",
    "[[1,1,1],2]",
    "Braid[1,1,1]",
    "BR: [1,1,1]",
    "Braid: 1 1 1",
    "Braid word = 1 1 1",
    "aaa",
    "s0*s0*s0",
    "s1*s1*s1",
    "s1^3",
    "σ1³",
    "σ_1 σ_1 σ_1",
    "sigma_1^3",
    '{"braid_notation": "{1,1,1}"}',
    [2, [1, 1, 1]],
]


@pytest.mark.parametrize("knot", PD, ids=str)
def test_pd(knot: Any) -> None:
    assert understood(knot) == ("PD code", TREFOIL, ())


@pytest.mark.parametrize("knot", DT, ids=str)
def test_dt(knot: Any) -> None:
    assert understood(knot) == ("DT code", from_dt([4, 6, 2]), UP_TO_MIRROR)


@pytest.mark.parametrize(
    "text",
    ["DT:[(4,6,2)],[0,0,1]", "DT: [(4, 6, 2)], [0, 0, 1]", "DT[cacbca.001]", "DT:cacbca.001"],
)
def test_dt_with_flips_is_exact(text: str) -> None:
    assert understood(text) == ("DT code", from_dt([4, 6, 2], [0, 0, 1]), ())
    other_flips = text.translate(str.maketrans("01", "10"))
    assert understood(other_flips)[1].signs == (-1, -1, -1)


@pytest.mark.parametrize("knot", GAUSS, ids=str)
def test_gauss(knot: Any) -> None:
    found = from_gauss([1, -2, 3, -1, 2, -3])
    assert understood(knot) == ("Gauss code", found, UP_TO_MIRROR)


@pytest.mark.parametrize("text", ORIENTED)
def test_oriented_gauss_is_exact(text: str) -> None:
    title, diagram, notes = understood(text)
    assert (title, signature(diagram), notes) == ("Gauss code", -2, ())
    mirrored = text.replace("+", "-").replace("[1, 1, 1]", "[-1, -1, -1]")
    assert signature(understood(mirrored)[1]) == 2


@pytest.mark.parametrize("knot", BRAIDS, ids=str)
def test_braids(knot: Any) -> None:
    notes = ("positive letters are positive crossings",)
    assert understood(knot) == ("braid word", from_braid([1, 1, 1]), notes)


@pytest.mark.parametrize(
    ("text", "word"),
    [
        ("aBaB", [1, -2, 1, -2]),
        ("[1,-2,1,-2]", [1, -2, 1, -2]),
        ("s0*s1^-1*s0*s1^-1", [1, -2, 1, -2]),
        ("sigma_1 sigma_2^{-1} sigma_1 sigma_2^{-1}", [1, -2, 1, -2]),
        ("σ1σ2⁻¹σ1σ2⁻¹", [1, -2, 1, -2]),
        ("Braid[1,-2,1,-2]", [1, -2, 1, -2]),
        ("BR[3, {-1, -2, -1, -2}]", [-1, -2, -1, -2]),
    ],
)
def test_braids_of_three_strands(text: str, word: list[int]) -> None:
    assert understood(text)[:2] == ("braid word", from_braid(word))


def test_the_first_of_two_braid_words() -> None:
    text = "{{-1,-1,-2,3,-2,1,-2,-2,3,2,2},{-1,2,-1,2,3,-2,-2,-4,3,-4}}"
    title, diagram, notes = understood(text)
    assert (title, notes[-1]) == ("braid word", "the first of 2 braid words")
    assert diagram == from_braid([-1, -1, -2, 3, -2, 1, -2, -2, 3, 2, 2])


@pytest.mark.parametrize(
    ("text", "form"),
    [
        ("PD[]", None),
        ("PD[Loop[1]]", None),
        ('{"pd": []}', None),
        ("[]", "pd"),
        ("DT: [()]", None),
        ("DT: []", None),
        ('{"dt": []}', None),
        ("GaussCode[]", None),
        ("[]", "gauss"),
        ("Braid[1, {}]", None),
        ("BR[1, {}]", None),
        ("[]", "braid"),
    ],
)
def test_the_unknot(text: str, form: str | None) -> None:
    assert understood(text, form)[1] == UNKNOT


@pytest.mark.parametrize("name", ["3_1", "8_19", "K11n34", "L5a1"])
def test_links_of_spherogram(name: str) -> None:
    link = spherogram.Link(name)
    if len(link.link_components) > 1:
        with pytest.raises(KnotoptError, match="a link of 2 components"):
            understood(link)
        return
    title, diagram, _ = understood(link)
    assert title == "PD code"
    assert signature(diagram) == -seifert_invariants(link)[1]
    assert sorted(diagram.signs) == sorted(crossing.sign for crossing in link.crossings)


def test_links_without_crossings() -> None:
    assert understood(spherogram.Link([]))[1] == UNKNOT
    assert understood(snappy.Link(braid_closure=[1]))[1].signs == (1,)
    two = spherogram.Link(braid_closure=[1, -1])
    two.simplify("basic")
    with pytest.raises(KnotoptError, match="2 circles"):
        understood(two)


def test_a_link_object_is_drawn() -> None:
    found = read_knot(spherogram.Link("8_19"))
    assert (found.form, found.source, found.diagram.size) == ("PD code", "link object", 7)


def test_knotinfos_cells_are_its_knots() -> None:
    """Chirality included where the form has it."""
    for codes in knotinfo_codes():
        title, diagram, _ = understood(codes.pd)
        assert (title, signature(diagram)) == ("PD code", codes.signature), codes.name
        title, diagram, _ = understood(codes.braid)
        assert (title, signature(diagram)) == ("braid word", codes.signature), codes.name
        for form, cell in (("DT code", codes.dt), ("Gauss code", codes.gauss)):
            title, diagram, notes = understood(cell)
            assert (title, notes) == (form, UP_TO_MIRROR), codes.name
            assert abs(signature(diagram)) == abs(codes.signature), codes.name


@pytest.mark.slow
def test_knotinfos_cells_are_one_knot_by_knot_floer_homology() -> None:
    told_apart = 0
    for codes in knotinfo_codes():
        pd, braid, dt, gauss = (
            homology_ranks(spherogram.Link(list(map(list, understood(cell)[1].pd_code))))
            for cell in (codes.pd, codes.braid, codes.dt, codes.gauss)
        )
        mirrored = {(-alexander, -maslov): rank for (alexander, maslov), rank in pd.items()}
        assert braid == pd, codes.name
        assert dt in (pd, mirrored) and gauss in (pd, mirrored), codes.name
        told_apart += pd != mirrored
    assert told_apart > 170


@pytest.mark.slow
def test_cells_of_knotinfos_larger_knots() -> None:
    """Every fiftieth one of 11 to 13 crossings, by the signature."""
    for codes in knotinfo_codes(13)[249::50]:
        for cell in (codes.pd, codes.braid):
            assert signature(understood(cell)[1]) == codes.signature, codes.name
        for cell in (codes.dt, codes.gauss):
            assert abs(signature(understood(cell)[1])) == abs(codes.signature), codes.name


@pytest.mark.slow
def test_no_braid_word_of_knotinfo_looks_like_another_code() -> None:
    for codes in knotinfo_codes(13):
        for word in codes.words:
            assert not looks_like_dt(word) and not looks_like_gauss(word), codes.name


def test_a_composite_diagram_says_what_is_open() -> None:
    title, _, notes = understood("DT: [(4, 6, 2, 10, 12, 8)]")
    assert title == "DT code"
    assert notes == ("up to mirror image, of each of the diagram's 2 parts by itself",)


def test_a_list_of_two_readings_is_what_it_is_asked_as() -> None:
    with pytest.raises(KnotoptError, match="visits 1 and 3 are of one crossing"):
        understood("[1, 2, -1, -2]")
    assert understood("[1, 2, -1, -2]", "braid")[1] == from_braid([1, 2, -1, -2])
    assert understood("[2, 4]")[0] == "DT code"
    assert understood("abc")[0] == "DT code"
    assert understood("abc", "braid")[1] == from_braid([1, 2, 3])


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("[[1,5,2,4],[3,1,4],[5,3,6,2]]", "crossing 2 has 3 edges, expected four"),
        ("[[1,5,2,4],[3,1,4,6],[5,3,6,7]]", "edge 2 at crossing 1 occurs once, expected twice"),
        ("PD[X[1,5,2,4], X[3,1,4.5,6], X[5,3,6,2]]", "edge 3 of crossing 2 is 4.5"),
        ("PD[X[1,5,2,4], X[3,1,a,6], X[5,3,6,2]]", "edge 3 of crossing 2 is 'a'"),
        ("PD[X[4,1,3,2], X[2,3,1,4]]", "a link of 2 components, a knot has 1"),
        ("PD[{1,{2}}]", "a PD code is a list of crossings"),
        ("[4,6,3]", "entry 3 of the DT code is 3: 3 crossings have the even numbers 2 to 6"),
        ("[4,6,6]", "entries 2 and 3 of the DT code are both 6"),
        ("DT:[(4,6),(2,8)]", "this DT code is a link of 2 components, a knot has 1"),
        ("DT: cacb", "the DT code 'cacb' neither"),
        ("DT: [[[1]]]", "a DT code is a list of even numbers, or letters"),
        ("[1,-2,3,-1,2,-4]", "crossing 3 is visited once, at 3, expected two visits"),
        ("[1,-2,2,-1,3,-4,4,3]", "crossing 3 is passed over at visits 5 and 8"),
        ("GaussCode[{1,-2},{2,-1}]", "a link of 2 components"),
        ("[[[1,-2],[2,-1]],[1,1]]", "a link of 2 components"),
        ("[[[1,-2,3,-1,2,-3]],[1,1]]", "2 signs of 3 crossings"),
        ("GaussCode[{1,{2}}]", "a Gauss code is a list of whole numbers"),
        ("O1-U2-O3-U1-O2-U3+", r"crossing 3 has the sign - at its first visit and \+ at visit 6"),
        ("O1-U2-O3-U1-O2-X3-", "visit 6 is 'X3-', expected O or U"),
        ("O1U2-O3-U1O2-U3-", "crossing 1 has no sign, others have one"),
        ("1-, 2+", "crossing 1 is visited once, at 1"),
        ("[1,1]", "the closure of this braid is a link of 2 components"),
        ("BR[3,{1,1,1}]", "a link of 2 components"),
        ("BR[2,{1,2,1}]", "letter 2 of the braid word is 2; a braid of 2 strands has"),
        ("[1,0,1]", "letter 2 of the braid word is 0"),
        ("aab", "a link of 2 components"),
        ("Braid[{1,{2},3}]", "a braid word is a list of whole numbers"),
    ],
)
def test_codes_that_are_wrong(text: str, message: str) -> None:
    with pytest.raises(KnotoptError, match=message):
        understood(text)


@pytest.mark.parametrize(
    "text", ["mT(2,3)", "P(-2,3,7)", "Knot[3,1]", "TorusKnot[3,5]", "f(1,1,1)", "ab", "word", "X"]
)
def test_other_texts_are_no_codes(text: str) -> None:
    for form in (pd, dt, gauss, braid):
        assert form.read(Content(text), Asked()) is None


@pytest.mark.parametrize(
    "text",
    [
        str([[k, k, k + 1, k + 1] for k in range(1, 10**5, 2)]),
        str(list(range(2, 2 * 10**5, 2))),
        str([1] * 10**5),
        "a" * 10**6,
        "O1+U1+" * 10**5,
        "X1122" * 10**5,
        "s1^999999",
        "s1 " * 10**5,
        "DT: [" + "4," * 10**5 + "]",
        "GaussCode[" + "1," * 10**5 + "]",
    ],
    ids=lambda text: text[:12],
)
def test_codes_that_are_too_long(text: str) -> None:
    with pytest.raises(KnotoptError, match=f"; up to {MAX_CROSSINGS} are read"):
        understood(text)


@pytest.mark.parametrize(
    "text",
    [
        "[" * 10**5 + "1" + "]" * 10**5,
        "PD[" * 10**5,
        "[1, 1, " + "9" * 5000 + "]",
        "BR[2, {1, 1, " + "9" * 5000 + "}]",
        "O1+U" + "2" * 5000 + "+",
        "s" + "1" * 5000,
        "X" + "1" * 5000,
        "((" * 50000,
        "1+" * 10**6,
    ],
    ids=lambda text: text[:12],
)
def test_codes_without_end_or_bottom(text: str) -> None:
    with pytest.raises(KnotoptError) as error:
        understood(text)
    assert len(str(error.value)) < 300
