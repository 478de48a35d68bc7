"""The signature against KnotInfo's, Spherogram's Seifert matrices, and what it must do."""

from __future__ import annotations

import json

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from knotopt.cable.cable import Cable
from knotopt.catalogue.knotinfo import knotinfo_knots
from knotopt.catalogue.knots import shipped_knots
from knotopt.diagram.families import random_knot, torus_knot
from knotopt.diagram.moves import Symmetry, transform
from knotopt.planar.from_grid import planar_diagram
from knotopt.planar.planar_diagram import PlanarDiagram
from knotopt.planar.signature import signature
from tests.helpers.snappy_invariants import link_of, seifert_invariants


def test_shipped_knots_and_their_mirror_images() -> None:
    for knot in shipped_knots().values():
        assert signature(planar_diagram(knot.diagram)) == knot.signature, knot.name
        mirror = transform(knot.diagram, Symmetry.FLIP_ROWS)
        assert signature(planar_diagram(mirror)) == -knot.signature, knot.name


def test_grids_of_knotinfo_up_to_13_crossings() -> None:
    for knot in [*knotinfo_knots().values()][249::13]:
        assert signature(planar_diagram(knot.diagram)) == knot.signature, knot.name


@pytest.mark.slow
def test_codes_of_knotinfo() -> None:
    from database_knotinfo import link_list

    _, _, *rows = link_list()  # the columns' names, and the unknot, which has no code
    assert len(rows) == 12_965
    for row in rows:
        code = [[edge - 1 for edge in crossing] for crossing in json.loads(row["pd_notation"])]
        assert signature(PlanarDiagram(tuple(map(tuple, code)))) == int(row["signature"])  # type: ignore[arg-type]


@pytest.mark.parametrize(("p", "q", "expected"), [(2, 9, -8), (3, 4, -6), (3, 7, -8), (5, -6, 16)])
def test_torus_knots(p: int, q: int, expected: int) -> None:
    """By the count of Gordon, Litherland and Murasugi (doi:10.4153/CJM-1981-030-2)."""
    assert signature(planar_diagram(torus_knot(p, q))) == expected


@settings(max_examples=40)
@given(st.integers(4, 14), st.integers(0, 10**6))
def test_random_knots_as_by_the_seifert_matrix(size: int, seed: int) -> None:
    cable = Cable(random_knot(size, seed), "L+")
    _, seifert = seifert_invariants(link_of(cable)) if len(cable.crossings) else ((1,), 0)
    assert signature(planar_diagram(random_knot(size, seed))) == -seifert


def test_no_crossing_and_one() -> None:
    assert signature(PlanarDiagram(())) == 0
    for kink in ((0, 0, 1, 1), (1, 0, 0, 1), (0, 1, 1, 0)):
        assert signature(PlanarDiagram((kink,))) == 0
