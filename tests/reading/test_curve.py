"""Curves in space in the dialects that programs write, and what is no curve."""

from __future__ import annotations

import json
import re
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from knotopt.catalogue.knots import shipped_knots
from knotopt.diagram.lifted import lifted
from knotopt.errors import KnotoptError
from knotopt.planar.from_grid import planar_diagram
from knotopt.reading.knot import read_knot
from tests.planar.test_views import floer, torus, turned

TREFOIL = torus(2, -3, 60)
"""Right-handed, as the catalogue's 3_1 is."""
RANKS = floer(planar_diagram(shipped_knots()["3_1"].diagram))


def rows(separator: str = " ", index: int | None = None) -> list[str]:
    cells = [[f"{value:.6f}" for value in row] for row in TREFOIL]
    if index is not None:
        cells = [[str(k + index), *row] for k, row in enumerate(cells)]
    return [separator.join(row) for row in cells]


def is_trefoil(text: str) -> bool:
    found = read_knot(text)
    assert found.form == "curve in space"
    return floer(planar_diagram(found.diagram)) == RANKS


DIALECTS = {
    "blanks": rows(),
    "tabs": rows("\t"),
    "commas": rows(","),
    "semicolons": rows(";"),
    "decimal commas": [row.replace(".", ",") for row in rows(";")],
    "header": ["x,y,z", *rows(",")],
    "header in words": ["x [m], y [m], z [m]", *rows(", ")],
    "index from 0": rows(" ", 0),
    "index from 1": rows(",", 1),
    "pandas": [",x,y,z", *rows(",", 0)],
    "remarks": ["# a knot", *rows(), "# its end"],
    "chemistry": ["60", "a trefoil", *(f"C {row}" for row in rows())],
    "chemistry, numbers": ["60", "", *rows()],
    "blank lines around": ["", "", *rows(), "", ""],
    "other columns": ["t,z,y,x", *(f"9,{','.join(row.split(',')[::-1])}" for row in rows(","))],
    "names with more": ["pos_X,pos_Y,pos_Z,v", *(f"{row},1" for row in rows(","))],
    "element and header": ["atom,x,y,z", *(f"C,{row}" for row in rows(","))],
    "an empty column": [row.replace(",", ",,") for row in rows(",")],
    "closed by its first point": [*rows(), rows()[0]],
    "points twice": [row for row in rows() for _ in range(2)],
    "obj": [*(f"v {row}" for row in rows()), "l " + " ".join(map(str, [*range(1, 61), 1]))],
    "json": [json.dumps(TREFOIL.tolist())],
    "json with a key": [json.dumps({"points": TREFOIL.tolist()})],
    "numpy": str(np.round(TREFOIL, 4)).split("\n"),
}


@pytest.mark.parametrize("dialect", DIALECTS)
def test_a_trefoil_in_every_dialect(dialect: str) -> None:
    assert is_trefoil("\n".join(DIALECTS[dialect]))


@settings(max_examples=20, deadline=None)
@given(
    st.sampled_from(["3_1", "4_1", "5_2", "8_19", "8_20"]),
    st.integers(0, 1000),
    st.sampled_from([" ", ",", ";", "\t", " , "]),
    st.sampled_from([None, 0, 1]),
    st.booleans(),
)
def test_knots_turned_in_space(
    name: str, seed: int, separator: str, index: int | None, header: bool
) -> None:
    grid = shipped_knots()[name].diagram
    corners = lifted(grid)
    lines = [
        separator.join([*([] if index is None else [str(k + index)]), *map(repr, row)])
        for k, row in enumerate(turned(np.vstack((corners, corners[:1])), seed).tolist())
    ]
    if header:
        lines.insert(0, separator.join([*([] if index is None else [""]), "x", "y", "z"]))
    found = read_knot("\n".join(lines)).diagram
    assert floer(planar_diagram(found)) == floer(planar_diagram(grid))


def test_an_open_rope_says_how_it_was_closed(tmp_path: Path) -> None:
    rope = np.vstack(([[3.0, -6, 0]], TREFOIL[2:-2], [[3.0, 6, 0]]))
    np.savetxt(tmp_path / "rope.xyz", rope)
    found = read_knot(tmp_path / "rope.xyz")
    assert found.diagram.size == 5 and floer(planar_diagram(found.diagram)) == RANKS
    (note,) = found.notes
    assert note.startswith("open curve of 58 points, seen from above, ends joined")


def test_an_array_in_python() -> None:
    found = read_knot(TREFOIL)
    assert floer(planar_diagram(found.diagram)) == RANKS and found.diagram.size == 5
    assert found.notes == ("closed curve of 60 points, seen from above",)


def changed(line: int, to: str) -> str:
    lines = rows()
    lines[line] = to
    return "\n".join(lines)


@pytest.mark.parametrize(
    ("text", "words"),
    [
        (changed(6, "1 nan 2"), "line 7 has a coordinate that is no finite number"),
        (changed(6, "1 inf 2"), "line 7 has a coordinate that is no finite number"),
        (changed(6, "1 2"), "line 7 is '1 2', expected a point x, y, z"),
        (changed(6, "1 2 here"), "line 7 is '1 2 here', expected a point x, y, z"),
        (changed(6, "1 2 3 4"), "line 7 is '1 2 3 4', expected a point x, y, z"),
        (changed(6, "1e300 2 3"), "line 7 has a coordinate beyond 1e+150"),
        (changed(30, rows()[2]), "the curve meets itself, near points"),
        ("\n".join([*rows()[:30], "", *rows()[30:]]), "parts the points into 2 curves: a link"),
        ("\n".join(["0.5 0 0", "1 0 0", "2 0 0", "3 0 0", "0.5 0 0"]), "lie on one line"),
        ("\n".join(["0.5 0 0"] * 5), "at least three different points, not 1"),
        ("\n".join(["0.5 0 0", "1 0 0"] * 3), "takes at least three|meets itself"),
        ("knot,crossings,robots,time\na,3,5,1\nb,4,5,2\nc,5,5,3\n", "and a curve's names x, y and"),
        ("u,y,z\n1,2,3\n1,3,3\n1,5,6\n1,5,7\n", "and a curve's names x, y and z once each"),
        ("x,y,z\n7,2,3,4\n7,3,3,4\n7,5,6,7\n", "the header names 3 columns, the lines have 4"),
        ("1,2,.5,\n,2,3,4\n3,4,,.5\n,1,2,3\n", "line 2 has other empty cells than line 1"),
        ("x,y,z\n1,2,.5\n1,,2,4\n3,4,5\n", "line 3"),
        ("\n".join([*rows(), "v"]), "line 61 is 'v', expected a point"),
        ("\n".join([*(f"v {row}" for row in rows()), "l 1 2 99 1"]), "names a vertex"),
        (json.dumps([[0.5, 1, 2], [1, 2, "a"], [2, 3, 4], [3, 4, 9]]), "point 2 is [1, 2, 'a']"),
    ],
)
def test_what_is_no_curve_is_said_in_a_sentence(text: str, words: str) -> None:
    with pytest.raises(KnotoptError) as error:
        read_knot(text)
    assert any(re.search(re.escape(each), str(error.value)) for each in words.split("|"))


def test_more_points_than_are_read() -> None:
    with pytest.raises(KnotoptError, match="a curve of 100001 points: at most 100000 are read"):
        read_knot(np.random.default_rng(0).normal(size=(100_001, 3)))
