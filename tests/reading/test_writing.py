"""Every form that is written is read back, by this package and by Spherogram, as the same knot."""

from __future__ import annotations

import json
import re

import numpy as np
import pytest
import spherogram
from hypothesis import given, settings
from hypothesis import strategies as st

from knotopt.catalogue.knots import shipped_knots
from knotopt.diagram.families import random_knot
from knotopt.diagram.grid import GridDiagram
from knotopt.errors import DiagramError
from knotopt.planar.from_grid import planar_diagram
from knotopt.planar.gauss import from_gauss
from knotopt.planar.planar_diagram import PlanarDiagram
from knotopt.planar.views import closed_view
from knotopt.reading.knot import read_knot
from knotopt.reading.writing import WRITTEN_FORMS, write_knot
from tests.planar.test_views import floer

EXACT = ("grid", "json", "csv", "arc", "xo")  # the diagram itself comes back
UNKNOT = GridDiagram((1, 2), (2, 1))


def spherograms(form: str, text: str) -> spherogram.Link:
    """The link that Spherogram makes of a text, without this package's readers."""
    if form == "dt":
        return spherogram.Link(text)
    numbers = [int(number) for number in re.findall(r"-?\d+", text)]
    if form == "braid":
        return spherogram.Link(braid_closure=numbers[1:])
    if form == "gauss":  # has no reader there: by the definition, to a PD code
        visits = re.findall(r"([OU])(\d+)([+-])", text)
        where = {(kind, number): edge for edge, (kind, number, _) in enumerate(visits, 1)}
        pd = []
        for number, sign in {(number, sign) for _, number, sign in visits}:
            under, over = where["U", number], where["O", number]
            ends = [over % len(visits) + 1, over][:: 1 if sign == "+" else -1]
            pd.append([under, ends[0], under % len(visits) + 1, ends[1]])
        return spherogram.Link(pd)
    assert form == "pd"
    return spherogram.Link(json.loads(text))


@pytest.mark.parametrize("form", [*WRITTEN_FORMS])
@pytest.mark.parametrize("name", ["3_1", "4_1", "6_2", "8_19", "9_32"])
def test_what_is_written_is_read_back_as_the_knot(name: str, form: str) -> None:
    grid = shipped_knots()[name].diagram
    found = read_knot(write_knot(grid, form)).diagram
    if form in EXACT:
        assert {found, found.reversed} & {grid}
    wanted, ranks = floer(planar_diagram(grid)), floer(planar_diagram(found))
    assert ranks == wanted


@pytest.mark.parametrize("form", ["pd", "dt", "gauss", "braid"])
@pytest.mark.parametrize("name", ["3_1", "5_2", "8_19", "9_32"])
def test_spherogram_reads_the_codes(name: str, form: str) -> None:
    grid = shipped_knots()[name].diagram
    link = spherograms(form, write_knot(grid, form))
    ranks = link.knot_floer_homology(complex=False)["ranks"]
    wanted = floer(planar_diagram(grid))
    assert ranks == wanted


@pytest.mark.parametrize("form", ["pd", "dt", "gauss"])
@pytest.mark.parametrize(
    "name", ["m5_2", "T(-3,4)", "3_1#3_1", "3_1#m3_1", "m3_1#m3_1", "3_1#5_2#m4_1"]
)
def test_mirror_images_and_sums_are_told_apart(name: str, form: str) -> None:
    grid = read_knot(name).diagram
    text = write_knot(grid, form)
    wanted = floer(planar_diagram(grid))
    again = read_knot(text)
    assert floer(planar_diagram(again.diagram)) == wanted and not again.ambiguous
    assert spherograms(form, text).knot_floer_homology(complex=False)["ranks"] == wanted


@settings(max_examples=20, deadline=None)
@given(st.integers(4, 11), st.integers(0, 10_000), st.sampled_from([*WRITTEN_FORMS]))
def test_random_diagrams_with_all_their_crossings(size: int, seed: int, form: str) -> None:
    grid = random_knot(size, seed)
    found = read_knot(write_knot(grid, form)).diagram
    wanted, ranks = floer(planar_diagram(grid)), floer(planar_diagram(found))
    assert ranks == wanted


@pytest.mark.parametrize("form", [*WRITTEN_FORMS])
def test_the_unknot(form: str) -> None:
    assert read_knot(write_knot(UNKNOT, form)).diagram.size == 2


def test_the_curve_is_that_of_the_grid_whoever_reads_it() -> None:
    grid = shipped_knots()["8_19"].diagram
    for form in ("xyz", "obj"):
        lines = write_knot(grid, form).splitlines()
        corners = [line.split()[-3:] for line in lines if not line.startswith("l")]
        points = np.array(corners, dtype=float)[: 4 * grid.size]
        assert floer(closed_view(points).diagram) == floer(planar_diagram(grid))


def test_a_gauss_code_has_the_signs_of_its_diagram() -> None:
    diagram = planar_diagram(shipped_knots()["4_1"].diagram)
    found = re.findall(r"([OU])(\d+)([+-])", write_knot(shipped_knots()["4_1"].diagram, "gauss"))
    code = [int(number) * (1 if kind == "O" else -1) for kind, number, _ in found]
    signs = {int(number): 1 if sign == "+" else -1 for _, number, sign in found}
    again: PlanarDiagram = from_gauss(code, [signs[number] for number in sorted(signs)])
    assert again.writhe == diagram.writhe


def test_a_form_that_there_is_not() -> None:
    with pytest.raises(DiagramError, match="no form is named 'pdf': knots are written as pd, dt"):
        write_knot(UNKNOT, "pdf")
