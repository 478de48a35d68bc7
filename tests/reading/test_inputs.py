"""The files that people bring: each comes out as the knot that its table says.

Chirality is told by the signature, computed by Spherogram and PARI.
"""

from __future__ import annotations

from pathlib import Path

import pytest

from knotopt.cable.cable import Cable
from knotopt.catalogue.knotinfo import knotinfo_knots
from knotopt.catalogue.knots import shipped_knots
from knotopt.errors import KnotoptError
from knotopt.reading.knot import read_knot
from tests.helpers.snappy_invariants import invariants

INPUTS = Path(__file__).parents[1] / "data/inputs"
GRIDS = [
    ("knotinfo_grid_3_1.json", "3_1"),
    ("knotinfo_grid_string.json", "8_19"),
]
TREFOILS = {  # of each form the file shows one of the two, and the notes say how it was read
    "arc_pairs_3_1.json": ("arc presentation", -2, "pairs are rows, counted upwards"),
    "hap_3_1.json": ("arc presentation", -2, "columns pass over rows"),
    "knottheory_arc_3_1.txt": ("arc presentation", -2, "columns pass over rows"),
    "xo_dict_3_1.json": ("grid of X and O", -2, "rows of the marks by column, counted from 0"),
    "xo_letters.csv": ("grid of X and O", -2, "the first line is the top row"),
    "grid2fp_pipe.csv": ("grid of X and O", -2, "columns pass over rows"),
    "grid2fp_trefoil.csv": ("grid of X and O", -2, "columns pass over rows"),
}
MATRICES = sorted(path.name for path in INPUTS.glob("m_*"))
MARKS = ["marks0.json", "marks_tuple.json", "marks_xy.csv"]
CODES = {
    "knotinfo_pd_3_1.json": "3_1",
    "knotinfo_pd_8_19.json": "8_19",
    "knotinfo_braid_3_1.json": "3_1",
    "knotinfo_braid_8_19.json": "8_19",
    "gauss_sage.txt": "3_1 or its mirror image",
    "gauss_signed_knotscape.txt": "3_1 or its mirror image",
    "knotinfo_dt_3_1.json": "3_1 or its mirror image",
    "knotinfo_dt_8_19.json": "8_19 or its mirror image",
    "knotinfo_dt_11n_34.json": "11n_34 or its mirror image",
    "dt_alpha.txt": "3_1 or its mirror image",
    "knotinfo_gauss_3_1.txt": "3_1 or its mirror image",
    "knotinfo_gauss_8_19.txt": "8_19 or its mirror image",
    "gauss_unsigned_fig8.txt": "4_1 or its mirror image",
}
CURVES = ["trefoil_knotplot.txt", "trefoil_xyz.csv"]


def signature_and_polynomial(name: str) -> tuple[int, tuple[int, ...]]:
    knot = shipped_knots()[name]
    return -knot.signature, knot.alexander  # KnotInfo's sign is the opposite one


@pytest.mark.parametrize(("file", "name"), GRIDS)
def test_grids_of_knotinfo(file: str, name: str) -> None:
    for form in ({"over": "rows"}, {"form": "grid_notation"}):
        found = read_knot(INPUTS / file, **form)
        assert found.diagram == read_knot(name).diagram
        assert any(note.startswith("rows pass over columns") for note in found.notes)
    bare = read_knot(INPUTS / file)
    assert bare.ambiguous
    assert f"KnotInfo's marks of {name} are these" in bare.notes[0]
    assert invariants(bare.diagram).signature == -signature_and_polynomial(name)[0]


@pytest.mark.parametrize("file", TREFOILS)
def test_trefoils(file: str) -> None:
    form, signature, note = TREFOILS[file]
    found = read_knot(INPUTS / file)
    assert found.form == form and any(note in each for each in found.notes)
    computed = invariants(found.diagram)
    assert (computed.signature, computed.alexander) == (signature, (1, -1, 1))


@pytest.mark.parametrize("file", ["pyarcknot_8_21.txt", "xco_8_21.json"])
def test_pyarcknots_8_21_is_the_mirror_image_of_knotinfos(file: str) -> None:
    """Its writhe is -4 in pyarcknot's own tests."""
    found = read_knot(INPUTS / file)
    signature, polynomial = signature_and_polynomial("8_21")
    computed = invariants(found.diagram)
    assert (computed.signature, computed.alexander) == (-signature, polynomial)
    assert Cable(found.diagram, "L+").crossings.sign.sum() == -4


@pytest.mark.parametrize("file", MATRICES)
def test_matrices_in_the_dialects_of_tables(file: str) -> None:
    found = read_knot(INPUTS / file)
    assert found.form == "matrix" and found.ambiguous
    assert found.notes == ("columns pass over rows", "the first line is the top row")
    assert found.diagram.minus == (1, 5, 4, 3, 2) and found.diagram.plus == (4, 3, 2, 1, 5)
    assert invariants(found.diagram).signature == 2


@pytest.mark.parametrize("file", MARKS)
def test_marks_are_those_of_table_1(file: str) -> None:
    found = read_knot(INPUTS / file)
    assert found.diagram.marks == read_knot("3").diagram.marks
    assert ("counted from 0" in found.notes) == (file == "marks0.json")


@pytest.mark.parametrize(
    ("file", "signature", "polynomial"),
    [
        ("composite_3_1+3_1.json", 4, (1, -2, 3, -2, 1)),
        ("composite_3_1+4_1.json", 2, (1, -4, 5, -4, 1)),
    ],
)
def test_composites(file: str, signature: int, polynomial: tuple[int, ...]) -> None:
    """KnotInfo's grids joined: signatures add up, polynomials multiply."""
    found = invariants(read_knot(INPUTS / file, over="rows").diagram)
    assert (found.signature, found.alexander) == (signature, polynomial)


@pytest.mark.parametrize("file", CODES)
def test_codes(file: str) -> None:
    found = read_knot(INPUTS / file)
    computed = invariants(found.diagram)
    name = CODES[file].split()[0]
    knot = knotinfo_knots()[name]
    assert computed.alexander == knot.alexander
    assert found.diagram.size == knot.arc_index
    exact = CODES[file] == name
    assert found.ambiguous == (not exact and not file.startswith("gauss_s"))
    assert computed.signature in ({-knot.signature} if exact else {knot.signature, -knot.signature})


@pytest.mark.parametrize("file", CURVES)
def test_curves(file: str) -> None:
    computed = invariants(read_knot(INPUTS / file).diagram)
    assert computed.alexander == (1, -1, 1)


@pytest.mark.parametrize(
    ("file", "message"),
    [
        ("hopf.json", "this grid is a link of 2 components"),
        ("gauss_1minus.txt", "crossing 1 is visited once, at 1, expected two visits"),
        # Spherogram, too, finds no way to draw this one.
        ("dt_snappy_14n.txt", "the code cannot be drawn in the plane (a virtual knot)"),
    ],
)
def test_what_is_no_knot(file: str, message: str) -> None:
    with pytest.raises(KnotoptError, match=file) as caught:
        read_knot(INPUTS / file)
    assert message in str(caught.value)
    assert "\n" not in str(caught.value)


def test_every_file_is_tried() -> None:
    tried = {*TREFOILS, *MATRICES, *MARKS, *CODES, *CURVES, *(file for file, _ in GRIDS)}
    tried |= {"pyarcknot_8_21.txt", "xco_8_21.json", "composite_3_1+3_1.json"}
    tried |= {"composite_3_1+4_1.json", "hopf.json", "gauss_1minus.txt", "dt_snappy_14n.txt"}
    assert {path.name for path in INPUTS.iterdir()} == tried


def test_letters_with_zeros_are_a_grid_and_no_gauss_code() -> None:
    found = read_knot("O000X\nXO000\n000XO\n00XO0\n0XO00")
    assert (found.form, found.diagram.size) == ("grid of X and O", 5)
    assert read_knot("O1-\nU2-\nO3-\nU1-\nO2-\nU3-\n").form == "Gauss code"
