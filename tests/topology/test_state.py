"""Rope states: codes in and out, symmetries, faces; against curves and against networkx."""

from __future__ import annotations

from itertools import product

import networkx as nx
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from knotopt.cable.cable import Cable
from knotopt.cable.notation import gauss_code
from knotopt.errors import KnotoptError
from knotopt.topology.state import TRIVIAL, RopeState, RopeStateError
from knotopt.verify.crossings import curve_crossings
from tests.helpers.strategies import cables

RAW = (1, 4, 40, 528, 7968)  # states by their number of crossings


def all_codes(crossings: int) -> list[tuple[int, ...]]:
    """Every code with matching visits, planar or not."""

    def matchings(free: tuple[int, ...]) -> list[list[tuple[int, int]]]:
        if not free:
            return [[]]
        first, *rest = free
        return [
            [(first, partner), *others]
            for partner in rest
            for others in matchings(tuple(k for k in rest if k != partner))
        ]

    codes = []
    for pairs in matchings(tuple(range(2 * crossings))):
        for bits in product((0, 1, 2, 3), repeat=crossings):
            code = [0] * (2 * crossings)
            for (i, j), bit in zip(pairs, bits, strict=True):
                code[i], code[j] = 4 * j + bit, 4 * i + (bit ^ 2)
            codes.append(tuple(code))
    return codes


def is_drawn(code: tuple[int, ...]) -> bool:
    """Whether networkx finds the rotation system of a code planar.

    Each segment is cut in three so that there are no loops or multiple edges.
    """
    embedding = nx.PlanarEmbedding()
    last = len(code)

    def place(visit: int) -> tuple[str, int]:
        if visit in {-1, last}:
            return ("end", visit)
        return ("crossing", min(visit, code[visit] >> 2))

    around: dict[object, list[object]] = {}
    for segment in range(last + 1):
        first, second = ("cut", 2 * segment), ("cut", 2 * segment + 1)
        around[first] = [place(segment - 1), second]
        around[second] = [first, place(segment)]
    around[place(-1)], around[place(last)] = [("cut", 0)], [("cut", 2 * last + 1)]
    for visit, entry in enumerate(code):
        partner = entry >> 2
        if entry & 2:
            over_in, over_out = ("cut", 2 * visit + 1), ("cut", 2 * visit + 2)
            under_in, under_out = ("cut", 2 * partner + 1), ("cut", 2 * partner + 2)
            left, right = (under_out, under_in) if entry & 1 else (under_in, under_out)
            around[place(visit)] = [over_out, right, over_in, left]  # clockwise
    for node, neighbours in around.items():
        for before, neighbour in zip([None, *neighbours], neighbours, strict=False):
            embedding.add_half_edge(node, neighbour, cw=before) if before else (
                embedding.add_half_edge_first(node, neighbour)
            )
    try:
        embedding.check_structure()
    except nx.NetworkXException:
        return False
    return True


def state_of_curve(points: np.ndarray[tuple[int, int], np.dtype[np.float64]]) -> RopeState:
    visits, signs = curve_crossings(points).code
    return RopeState.from_gauss([k + 1 if over else -k - 1 for k, over in visits], signs)


def random_curve(seed: int, points: int = 9) -> np.ndarray[tuple[int, int], np.dtype[np.float64]]:
    return np.random.default_rng(seed).normal(size=(points, 3))


def state_of_cable(cable: Cable) -> RopeState:
    return RopeState.from_gauss(gauss_code(cable), cable.crossings.sign.tolist())


@pytest.mark.parametrize("crossings", range(5))
def test_number_of_states(crossings: int) -> None:
    planar = [code for code in all_codes(crossings) if RopeState(code).is_planar]
    assert len(planar) == RAW[crossings]
    assert len({RopeState(code).canonical() for code in planar}) == (1, 1, 13, 132, 2032)[crossings]


@pytest.mark.parametrize("crossings", range(4))
def test_planarity_is_that_of_networkx(crossings: int) -> None:
    for code in all_codes(crossings):
        assert RopeState(code).is_planar == is_drawn(code)


@pytest.mark.parametrize("crossings", range(4))
def test_mirror_and_reverse_are_commuting_involutions(crossings: int) -> None:
    for code in all_codes(crossings):
        state = RopeState(code)
        mirrored, back = state.mirror(), state.reverse()
        assert mirrored.mirror() == back.reverse() == state
        assert mirrored.reverse() == back.mirror()
        orbit = {state, mirrored, back, mirrored.reverse()}
        assert len({other.canonical() for other in orbit}) == 1
        assert state.canonical() in orbit
        assert len({other.is_planar for other in orbit}) == 1


@given(st.integers(0, 2**32))
def test_curves(seed: int) -> None:
    curve = random_curve(seed)
    state = state_of_curve(curve)
    assert state.is_planar
    assert state_of_curve(curve * [1, -1, 1]) == state.mirror()
    assert state_of_curve(curve[::-1]) == state.reverse()
    assert RopeState.from_matrix(state.matrix) == RopeState.checked(state.code) == state
    assert RopeState.from_gauss(str(state)) == state


def test_matrix_of_a_curve_by_hand() -> None:
    """East, then back over itself from north to south: over x under = south x east = +1."""
    curve = np.array([[0, 0, 0], [4, 0, 0], [4, 2, 0], [2, 2, 1], [2, -2, 1]], dtype=float)
    assert state_of_curve(curve).matrix.tolist() == [[1, 2], [2, 1], [-1, 1], [1, 1]]


@given(cables())
def test_cables(cable: Cable) -> None:
    state = state_of_cable(cable)
    assert state.is_planar
    assert (
        RopeState.from_gauss(" ".join(map(str, gauss_code(cable))), cable.crossings.sign) == state
    )


@given(st.integers(0, 2**32))
def test_faces(seed: int) -> None:
    state = state_of_curve(random_curve(seed))
    faces = state.faces
    assert len(faces) == state.crossings + 1
    assert sorted(dart for face in faces for dart in face) == list(range(4 * state.crossings + 2))
    assert all(face[0] == min(face) for face in faces)


def test_face_inside_a_loop() -> None:
    """Anticlockwise, so the inside is left of the loop, segment 1."""
    assert (2,) in RopeState.from_gauss("U1+ O1+").faces
    assert (3,) in RopeState.from_gauss("O1+ U1+").faces


def test_trivial() -> None:
    assert TRIVIAL.is_planar
    assert TRIVIAL.crossings == 0
    assert TRIVIAL.faces == ((0, 1),)
    assert TRIVIAL.matrix.shape == (4, 0)
    assert TRIVIAL == TRIVIAL.mirror() == TRIVIAL.reverse() == TRIVIAL.canonical()
    assert RopeState.from_matrix(TRIVIAL.matrix) == RopeState.from_gauss(str(TRIVIAL)) == TRIVIAL
    assert RopeState.from_gauss("") == RopeState.from_gauss(()) == TRIVIAL


@pytest.mark.parametrize(
    "text", ["O1+U2+O3+U1+O2+U3+", "o7+, u9+, o2+, u7+, o9+, u2+", "(O1+ U2+ O3+; U1+ O2+ U3+)"]
)
def test_gauss_codes_that_are_read(text: str) -> None:
    assert str(RopeState.from_gauss(text)) == "O1+ U2+ O3+ U1+ O2+ U3+"


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("O1+ U2+ O1+", "3 visits: every crossing has two"),
        ("O1+ U2+ U1+ O3+", "visit 2: crossing 2 is met once, not twice"),
        ("O1+ U1+ U1+ O2+", "visit 3: crossing 1 is met 3 times"),
        ("O1+ O1+", "visits 1 and 2 of one crossing are both over"),
        ("U2- O1+ U1+ U2-", "visits 1 and 4 of one crossing are both under"),
        ("O1+ U1-", "visits 1 and 2 of one crossing have opposite signs"),
        ("O1+ U2- O3+ U1+ O2- U3+", "visit 5: a rope .* come back to visit 2 here with sign -"),
        ("O1 U1", "visit 1 of crossing 1 has no sign"),
        ("1 -1", "visit 1 of crossing 1 has no sign"),
        ("O1+ U1+ P2+ O2+", "visit 3: 'P2"),
    ],
)
def test_gauss_codes_that_are_wrong(text: str, message: str) -> None:
    with pytest.raises(RopeStateError, match=message) as caught:
        RopeState.from_gauss(text)
    assert isinstance(caught.value, KnotoptError)


def test_signs_that_are_wrong() -> None:
    with pytest.raises(RopeStateError, match="crossing 2 has no sign: 1 signs are given"):
        RopeState.from_gauss((1, -2, -1, 2), (1,))
    with pytest.raises(RopeStateError, match="visit 1: crossing 1 has sign 3"):
        RopeState.from_gauss((1, -1), (3,))


@pytest.mark.parametrize(
    ("matrix", "message"),
    [
        ([[1, 2], [2, 1], [1, -1]], "expected 4 rows"),
        ([[1, 2], [2, 1], [1], [1, 1]], "differ in length"),
        ([["1", "2"], ["2", "1"], ["o", "u"], ["+", "+"]], "not numbers"),
        ([[1, 2], [2, 1.5], [1, -1], [1, 1]], "visit 2: .* not whole"),
        ([[1, 2], [2, 1], [1, -1], [float("nan"), 1]], "visit 1: .* not whole"),
        ([[1, 3], [2, 1], [1, -1], [1, 1]], "column 2 of the matrix is numbered 3"),
        ([[1, 2, 3], [2, 1, 3], [1, -1, 1], [1, 1, 1]], "3 visits"),
        ([[1, 2], [2, 2], [1, -1], [1, 1]], "visit 1: .* visit 2, whose partner is visit 2"),
        ([[1, 2], [1, 2], [1, -1], [1, 1]], "visit 1 is its own partner"),
        ([[1, 2], [3, 1], [1, -1], [1, 1]], "visit 1: its partner is visit 3, but"),
        ([[1, 2], [2, 1], [1, 0], [1, 1]], "visit 2: over or under is 0"),
        ([[1, 2], [2, 1], [1, -1], [2, 2]], "visit 1: sign is 2"),
        ([[1, 2], [2, 1], [1, 1], [1, 1]], "visits 1 and 2 of one crossing are both over"),
        ([[1, 2], [2, 1], [1, -1], [1, -1]], "visits 1 and 2 of one crossing have opposite signs"),
    ],
)
def test_matrices_that_are_wrong(matrix: list[list[float]], message: str) -> None:
    with pytest.raises(RopeStateError, match=message):
        RopeState.from_matrix(matrix)


@pytest.mark.parametrize("crossings", range(4))
def test_codes_out_of_the_plane_name_a_visit(crossings: int) -> None:
    for code in all_codes(crossings):
        if not RopeState(code).is_planar:
            with pytest.raises(RopeStateError, match=r"visit \d: a rope in the plane"):
                RopeState.checked(code)
