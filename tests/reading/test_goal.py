"""Goals by name, matrix, Gauss code and file, and what is said about wrong ones."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from knotopt.cable.cable import Cable
from knotopt.errors import CutError, FileFormatError, UnknownKnotError
from knotopt.reading.goal import GoalSet, read_goal
from knotopt.reading.knot import read_knot
from knotopt.topology.cable_state import cable_state
from knotopt.topology.state import TRIVIAL, RopeState, RopeStateError

OVERHAND = RopeState.from_gauss("U1+ O2+ U3+ O1+ U2+ O3+")


@pytest.mark.parametrize("knot", ["3_1", "7 Var1", "T(2,7)", "9"])
@pytest.mark.parametrize("cut", [None, "L+", "T-"])
def test_knots(knot: str, cut: str | None) -> None:
    goal = read_goal(knot, cut)
    named = read_knot(knot)
    assert goal.cable == Cable(named.diagram, cut or "L+")
    assert goal.states == (cable_state(goal.cable),)
    assert (goal.name, goal.source) == (named.name, named.source)


def test_sets_of_goals() -> None:
    assert read_goal(str(OVERHAND)).states == (OVERHAND,)
    assert read_goal(str(OVERHAND), which="mirror").states == (OVERHAND, OVERHAND.mirror())
    orbit = read_goal(str(OVERHAND), which=GoalSet.ORBIT).states
    assert orbit[0] == OVERHAND and len(orbit) == 4
    assert {each.reverse() for each in orbit} == {each.mirror() for each in orbit} == {*orbit}
    for symmetric, size in (("trivial", 1), ("O1+ U2+ U1+ O2+", 2)):
        assert len(read_goal(symmetric, which="orbit").states) == size
    with pytest.raises(ValueError, match="few"):
        read_goal("3_1", which="few")


@pytest.mark.parametrize("knot", ["3_1", "4_1", "8_19"])
def test_files_hold_what_was_written(tmp_path: Path, knot: str) -> None:
    state = read_goal(knot).states[0]
    rows = state.matrix.tolist()
    lines = [",".join(map(str, row)) for row in rows]
    files = {
        "rows.json": json.dumps(rows),
        "object.json": json.dumps({"matrix": rows, "crossings": state.crossings}),
        "rows.csv": "\n".join(lines) + "\n",
        "ROWS.CSV": "\ufeff" + "\n\n".join(lines),
        "rows.txt": "\n".join(line.replace(",", "  ") for line in lines),
        "numpy.txt": str(state.matrix) if len(rows[0]) < 12 else "\n".join(lines),
        "code.txt": f"{state}\n",
        "lower.txt": str(state).lower().replace(" ", "\n"),
    }
    for name, content in files.items():
        path = tmp_path / name
        path.write_text(content, encoding="utf-8")
        goal = read_goal(str(path))
        assert goal.states == (state,) and goal.cable is None and goal.name == name


@pytest.mark.parametrize("crossings", [0, 1, 2])
def test_small_matrices_are_not_taken_for_grids(tmp_path: Path, crossings: int) -> None:
    state = (TRIVIAL, *map(RopeState.from_gauss, ("U1+ O1+", "O1+ U1+ O2- U2-")))[crossings]
    path = tmp_path / "state.json"
    path.write_text(json.dumps({"matrix": state.matrix.tolist()}))
    assert read_goal(str(path)).states == (state,)


@pytest.mark.parametrize(
    ("name", "content"),
    [
        ("marks.csv", "column,row\n1,1\n1,2\n2,1\n2,2\n"),
        ("marks.json", "[[1, 1], [1, 2], [2, 1], [2, 2]]"),
        ("matrix.json", "[[-1, 1, 0, 0], [0, -1, 1, 0], [0, 0, -1, 1], [1, 0, 0, -1]]"),
        ("matrix.csv", "-1,1,0,0\n0,-1,1,0\n0,0,-1,1\n1,0,0,-1\n"),
    ],
)
def test_small_grids_are_not_taken_for_states(tmp_path: Path, name: str, content: str) -> None:
    path = tmp_path / name
    path.write_text(content)
    goal = read_goal(str(path), "R-")
    assert goal.cable is not None and goal.states == (TRIVIAL,)


def test_a_grid_file_with_a_knot(tmp_path: Path) -> None:
    path = tmp_path / "grid.json"
    path.write_text(json.dumps({"grid": read_knot("5_2").diagram.marks}))
    assert read_goal(str(path), "B+").states == read_goal("5_2", "B+").states


@pytest.mark.parametrize(
    ("name", "content", "words"),
    [
        ("a.json", "[[1,2,3,4],[3,4,1,2],[1,1,-1,-1],[1,1,1,1]]", "visit 4: a rope in the plane"),
        ("a.json", '{"matrix": [[1,2],[2,1],[1,1],[1,1]]}', "are both over"),
        ("a.json", '{"matrix": [[1,2],[2,1],[1,-1],[1,-1]]}', "have opposite signs"),
        ("a.json", '{"matrix": [[1,2,3],[2,1]]}', "differ in length"),
        ("a.json", "[[1,2,3,4],[2,1,4,3],[1,-1,1,-1]]", "expected 4 rows"),
        ("a.json", "[[{}],[{}],[{}],[{}]]", "lists, but not those of a grid"),
        ("a.json", '[["1","2","3"],["a"],["1"],["1"]]', "differ in length"),
        ("a.json", "[[1,2.5],[2,1],[1,-1],[1,1]]", "visit 2: the matrix has an entry that is not"),
        ("a.json", "[[1,2", "line 1 opens '[', which is not closed"),
        ("a.json", '{"goal": 3}', 'expected a key such as "grid", "matrix" or "pd_code"'),
        ("a.csv", "1,2,3,4\n2,1,4,5\n1,-1,1,-1\n1,1,1,1\n", "visit 3: its partner is visit 4"),
        ("a.csv", "1,2\n2,1\n1,-1\n1,x\n", "line 4 is '1,x', expected whole numbers"),
        ("a.txt", "1 2\n2 x\n", "line 2 is '2 x', expected whole numbers"),
        ("a.txt", "1 2\n2 1\n1 -1\n", "3 rows of 2 numbers"),
        ("a.txt", "", "there is nothing in it"),
        ("a.txt", "U1+ Q1+", "visit 2: 'Q1+' is not a visit"),
        ("a.txt", "U1+ O2+ U1+ O2+", "visits 1 and 3 of one crossing are both under"),
    ],
)
def test_wrong_files(tmp_path: Path, name: str, content: str, words: str) -> None:
    path = tmp_path / name
    path.write_text(content)
    with pytest.raises(FileFormatError) as caught:
        read_goal(str(path))
    assert words in str(caught.value) and str(path) in str(caught.value)


def test_files_that_cannot_be_read(tmp_path: Path) -> None:
    for name in ("missing.txt", "missing.json", "missing.csv"):
        with pytest.raises(FileFormatError, match=rf"{name}.*No such file"):
            read_goal(str(tmp_path / name))
    path = tmp_path / "bytes.txt"
    path.write_bytes(b"O1+ \xff")
    with pytest.raises(FileFormatError, match=r"not UTF-8 text \(byte 4\)"):
        read_goal(str(path))


def test_wrong_words() -> None:
    with pytest.raises(UnknownKnotError, match="no knot is named 'grany'"):
        read_goal("grany")
    with pytest.raises(RopeStateError, match="visit 1 of crossing 1 has no sign"):
        read_goal("O1 U2 O3 U1 O2 U3")
    with pytest.raises(RopeStateError, match="1 visits"):
        read_goal("O1+")
    with pytest.raises(CutError, match=r"no grid to cut at T\+"):
        read_goal(str(OVERHAND), "T+")
    with pytest.raises(CutError, match="carries 1 crossing"):
        read_goal("3_1", "col3+")
