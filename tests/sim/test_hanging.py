"""Cable that hangs between robots when a flight starts: chains of equal links."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from knotopt.sim.hanging import hanging_chain


@pytest.mark.parametrize("end", [[1.0, 0, 0], [0.3, 0.4, 1.0], [1.49, 0, 0], [0.2, 0, -1.2]])
def test_a_hanging_chain_is_balanced(end):
    """At every inner joint the pulls of both links and an equal weight add up to nothing."""
    chain = hanging_chain(np.zeros(3), np.array(end), 1.5, 12)
    links = np.diff(chain, axis=0)
    np.testing.assert_allclose(chain[-1], end, atol=1e-8)
    np.testing.assert_allclose(np.linalg.norm(links, axis=1), 0.125)
    across = np.hypot(links[:, 0], links[:, 1])
    slopes = links[:, 2] / across
    np.testing.assert_allclose(np.diff(slopes, n=2), 0, atol=1e-5 * np.abs(slopes).max())
    assert (np.diff(slopes) > 0).all()


def hangs(chain, start, end, length):
    """Whether a chain of equal links goes from start to end."""
    links = np.linalg.norm(np.diff(chain, axis=0), axis=1)
    np.testing.assert_allclose(chain[[0, -1]], [start, end], atol=1e-9)
    np.testing.assert_allclose(links, length / len(links), rtol=1e-9)


@given(
    across=st.floats(0.05, 2),
    rise=st.one_of(st.just(0.0), st.floats(-1e-9, 1e-9), st.floats(-0.3, 0.3)),
    heading=st.floats(0, 6.3),
    spare=st.floats(0, 1),
    links=st.integers(4, 80),
)
def test_a_chain_hangs_wherever_a_flight_starts(across, rise, heading, spare, links):
    start = np.array([0.2, 2.5, 2.2])
    end = start + np.array([across * np.cos(heading), across * np.sin(heading), rise])
    taut = np.linalg.norm(end - start)
    length = taut + spare**3 * (8 - taut)
    hangs(hanging_chain(start, end, length, links), start, end, length)


def test_a_chain_whose_pull_is_hard_to_find():
    start = np.array([0.20522906986330294, 2.517431392222606, 2.200000000000006])
    end = np.array([0.49999999981315457, 2.4999999993771347, 2.2])
    hangs(hanging_chain(start, end, 4.232239161685759, 42), start, end, 4.232239161685759)


@pytest.mark.parametrize(("drop", "links"), [(0.0, 11), (1.2, 12), (0.1, 12)])
def test_the_sides_of_a_narrow_bight_lean_outwards(drop, links):
    start, end = np.zeros(3), np.array([0.05, 0, -drop])
    chain = hanging_chain(start, end, 1.5, links)
    hangs(chain, start, end, 1.5)
    moves = np.diff(chain, axis=0)
    lowest = np.argmin(np.abs(moves[:, 2]))
    assert moves[lowest, 0] > 0.05
    assert (np.delete(moves[:, 0], lowest) < 0).all()
    assert np.ptp(chain[:, 0]) < 0.14
