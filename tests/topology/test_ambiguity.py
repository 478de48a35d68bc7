"""Places where the state of a polyline is ambiguous, one by one, and places that look like it."""

from __future__ import annotations

import numpy as np
import pytest

from knotopt.arrays import FloatArray
from knotopt.topology.ambiguity import Reason
from knotopt.topology.extract import extract_state
from tests.helpers.polylines import by_verifier, state_of

Points = FloatArray
Moves = dict[int, tuple[float, float, float]]


HOOK = [[0, 0, 0], [4, 0, 0], [4, 2, 1]]
AMBIGUOUS: dict[str, tuple[list[list[float]], Reason, tuple[int, ...], Moves, Moves]] = {
    "strands at one height": (
        [*HOOK[:2], [4, 2, 0], [2, 2, 0], [2, -2, 0]],
        Reason.HEIGHT,
        (0, 3),
        {4: (0, 0, 0.1)},
        {4: (0, 0, -0.1)},
    ),
    "a vertical piece through a strand": (
        [[0, 0, 0.5], [4, 0, 0.5], [4, 2, 0], [2, 2, 0], [2, 0, 0], [2, 0, 1], [2, -2, 1]],
        Reason.HEIGHT,
        (0, 5),
        {4: (0, 0.1, 0), 5: (0, 0.1, 0)},
        {4: (0, -0.1, 0), 5: (0, -0.1, 0)},
    ),
    "a corner that touches a strand": (
        [*HOOK, [3, 2, 1], [2, 0, 1], [1, 2, 1]],
        Reason.TANGENT,
        (0, 4),
        {4: (0, 0.1, 0)},
        {4: (0, -0.1, 0)},
    ),
    "two corners that touch": (
        [[0, -2, 0], [2, 0, 0], [4, -2, 0], [5, 2, 1], [3, 2, 1], [2, 0, 1], [1, 2, 1]],
        Reason.TANGENT,
        (0, 4),
        {5: (0, 0.1, 0)},
        {5: (0, -0.1, 0)},
    ),
    "a strand that lies along another": (
        [*HOOK, [3, 0, 1], [1, 0, 1], [0.5, 2, 1]],
        Reason.OVERLAP,
        (0, 3),
        {3: (0, 0.1, 0), 4: (0, 0.1, 0)},
        {3: (0, -0.1, 0), 4: (0, -0.1, 0)},
    ),
    "a strand that crosses at next to no angle": (
        [*HOOK, [3, 1e-7, 1], [1, -1e-7, 1], [0, -2, 1]],
        Reason.OVERLAP,
        (0, 3),
        {3: (0, 0.1, 0), 4: (0, -0.1, 0)},
        {3: (0, -0.1, 0), 4: (0, 0.1, 0)},
    ),
    "a fold": (
        [[0, 0, 0], [4, 0, 0], [1, 0, 1], [1, 2, 1]],
        Reason.FOLD,
        (0, 2),
        {2: (0, 0.1, 0)},
        {2: (0, -0.1, 0)},
    ),
    "points that nearly repeat at a kink": (
        [[0, 0, 0], [2, 0, 0], [2 - 1e-8, 1e-8, 1], [4, -1, 1]],
        Reason.REPEATED,
        (0, 2),
        {2: (0.5, 0, 0)},
        {2: (-0.5, 0.1, 0)},
    ),
    "three strands through one point": (
        [[-4, 0, 0], [4, 0, 0], [3, 3, 1], [-3, -3, 1], [3, -3, 2], [-3, 3, 2]],
        Reason.TRIPLE,
        (0, 2, 4),
        {4: (0, 0.1, 0), 5: (0, 0.1, 0)},
        {4: (0, -0.1, 0), 5: (0, -0.1, 0)},
    ),
    "the last end on a strand": (
        [*HOOK, [2, 0, 1]],
        Reason.END,
        (0, 2),
        {3: (0, 0.1, 0)},
        {3: (0, -0.1, 0)},
    ),
    "the first end on a strand": (
        [[2, 0, 1], [4, 2, 1], [4, 0, 0], [0, 0, 0]],
        Reason.END,
        (0, 2),
        {0: (0, 0.1, 0)},
        {0: (0, -0.1, 0)},
    ),
}


@pytest.mark.parametrize("name", AMBIGUOUS)
def test_an_ambiguous_place_is_named(name: str) -> None:
    rows, reason, segments, *moves = AMBIGUOUS[name]
    found = extract_state(rows)
    assert found.state is None and len(found.visits) == 0 and found.ranges.shape == (0, 2)
    (ambiguity,) = found.ambiguous
    assert (ambiguity.reason, ambiguity.segments) == (reason, segments), str(ambiguity)
    corners = np.array(rows)[:, :2]
    for segment in segments[:1]:
        along = corners[segment + 1] - corners[segment]
        off = np.array(ambiguity.place) - corners[segment]
        assert abs(along[0] * off[1] - along[1] * off[0]) < 1e-5
    states = set()
    for move in moves:
        moved = np.array(rows, dtype=float)
        for row, by in move.items():
            moved[row] += by
        states.add(state_of(moved))
    assert len(states) == 2


def test_an_end_folded_back_onto_its_own_rope() -> None:
    assert [a.reason for a in extract_state([[0, 0, 0], [4, 0, 0], [1, 0, 1]]).ambiguous] == [
        Reason.END
    ]


def test_a_rope_that_is_a_point_in_plan() -> None:
    (ambiguity,) = extract_state([[1, 2, 0], [1, 2, 1], [1, 2, 3]]).ambiguous
    assert (ambiguity.reason, ambiguity.segments) == (Reason.REPEATED, (0, 1))
    assert ambiguity.place == (1, 2)


def test_every_ambiguous_place_is_named() -> None:
    rows = [*HOOK, [3, 2, 1], [2, 0, 1], [1, 2, 1], [0.5, 2, 0], [0.5, -1, 0], [1, 0, 0]]
    found = [(a.reason, a.segments) for a in extract_state(rows).ambiguous]
    assert found == [(Reason.TANGENT, (0, 4)), (Reason.HEIGHT, (0, 6)), (Reason.END, (0, 7))]


# Degenerate places that are harmless

HARMLESS = {
    "a straight rope": [[k, 0, 0] for k in range(64)],
    "a slanting straight rope": [[0.1 * k, 0.3 * k, 0] for k in range(64)],
    "through a corner": [[0, 0, 0], [2, 0.5, 0], [4, 0, 0], [4, 2, 1], [2, 2, 1], [2, -2, 1]],
    "through a corner that strays by less than the tolerance": [
        [0, 0, 0], [2, 1e-7, 0], [4, 0, 0], [4, 2, 1], [2, 2, 1], [2, -2, 1]
    ],
    "corner through strand": [*HOOK, [2, 2, 1], [2.5, 0, 1], [2, -2, 1]],
    "corner through corner": [
        [0, 0, 0], [2, 0.5, 0], [4, 0, 0], [4, 2, 1], [2.5, 2, 1], [2, 0.5, 1], [2.5, -2, 1]
    ],
    "corner through corner, from the other side": [
        [4, 0, 0], [2, 0.5, 0], [0, 0, 0], [0, 2, 1], [1.5, 2, 1], [2, 0.5, 1], [1.5, -2, 1]
    ],
    "added points on both strands at their crossing": [
        [0, 0, 0], [1.9999999, 0, 0], [2, 0, 0], [4, 0, 0], [4, 2, 1], [2, 2, 1],
        [2, 1e-7, 1], [2, 0, 1], [2, -1e-7, 1], [2, -2, 1],
    ],
    "a second strand on the line of the first": [
        [0, 0, 0], [2, 0, 0], [3, 1, 0], [4, 0, 0], [6, 0, 0], [1, -1, 1], [1, 1, 1]
    ],
    "a sharp turn": [[0, 0, 0], [4, 0, 0], [0, 0.001, 1], [0, 1, 1]],
}  # fmt: skip


@pytest.mark.parametrize("name", HARMLESS)
def test_a_harmless_place_is_no_ambiguity(name: str) -> None:
    points = np.array(HARMLESS[name], dtype=float)
    state = state_of(points)
    rng = np.random.default_rng(5)
    step = np.hypot(*np.diff(points[:, :2], axis=0).T).min()
    for _ in range(20):
        moved = points.copy()
        moved[:, :2] += rng.uniform(-0.3, 0.3, moved[:, :2].shape) * min(1e-6, step / 4)
        assert by_verifier(moved) == state


def test_repeated_points_and_vertical_pieces_are_harmless() -> None:
    plain = [*HOOK, [2, 2, 1], [2, -2, 1]]
    expected = extract_state(plain)
    doubled = [row for row in plain for _ in range(3)]
    doubled.append([2, -2, 5])  # the last end stands up
    doubled.insert(6, [4, 0, 0.5])
    found = extract_state(doubled)
    assert found.state == expected.state
    assert found.visits.segment.tolist() == [2, 12]
    assert np.allclose(found.visits.fraction, expected.visits.fraction)
    assert np.allclose(found.visits.gap, expected.visits.gap)
    over = [[0, 0, 0.5], [4, 0, 0.5], [4, 2, 1], [2, 2, 1], [2, 0, 1], [2, 0, 2], [2, -2, 2]]
    assert state_of(over) == expected.state  # it stands up above the strand that it crosses
