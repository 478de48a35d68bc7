"""Damaged inputs of every form end in a knot or in one sentence."""

from __future__ import annotations

import pytest

from tests.helpers import mutated


def test_damaged_inputs() -> None:
    found = {mutated.answer(text) for text in mutated.mutated(300)}
    assert found == {"knot", "sentence"}


@pytest.mark.slow
def test_many_damaged_inputs() -> None:
    for text in mutated.mutated(5000, seed=1):
        mutated.answer(text)


def test_seeds_are_read_as_they_stand() -> None:
    answers = [mutated.answer(text) for text in mutated.seeds()]
    assert answers.count("knot") > 40
