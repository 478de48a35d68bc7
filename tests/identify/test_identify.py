"""Names of knots from diagrams of them that were moved about, chirality included."""

from __future__ import annotations

import random

import pytest

from knotopt.catalogue.knotinfo import knotinfo_knots
from knotopt.catalogue.knots import PrimeKnot, shipped_knots
from knotopt.diagram.families import torus_knot
from knotopt.diagram.grid import GridDiagram
from knotopt.diagram.sums import connected_sum
from knotopt.identify import summands
from knotopt.identify.identify import identify
from knotopt.identify.summands import KnotSum, Summand, knots_with
from tests.helpers.random_moves import moved_about


def drawn(knot: PrimeKnot, generator: random.Random) -> tuple[str, GridDiagram]:
    """A diagram of the knot or its mirror image, moved about, and its name."""
    mirrored = generator.random() < 0.5
    diagram = moved_about(knot.diagram, generator.randrange(10**6))
    is_other = mirrored and not knot.is_amphicheiral
    return f"{'m' * is_other}{knot.name}", diagram.mirrored if mirrored else diagram


def check(knots: list[PrimeKnot], generator: random.Random) -> int:
    """How many are named; the others have their names among the candidates."""
    named = 0
    for knot in knots:
        name, diagram = drawn(knot, generator)
        found = identify(diagram)
        assert name in found.candidates, (name, found.candidates)
        named += found.name == name
    return named


def test_shipped_knots_are_named() -> None:
    knots = [*shipped_knots().values()][::12]
    assert check(knots, random.Random(1)) == len(knots)


@pytest.mark.slow
def test_more_shipped_knots_are_named() -> None:
    knots = [*shipped_knots().values()][1::3]
    assert check(knots, random.Random(2)) == len(knots)


@pytest.mark.slow
def test_larger_knots_are_named_or_among_the_candidates() -> None:
    generator = random.Random(3)
    knots = generator.sample([*knotinfo_knots().values()][249:], 20)
    assert check(knots, generator) >= 16


@pytest.mark.parametrize(
    ("names", "expected"),
    [
        (("3_1", "3_1"), "3_1#3_1"),
        (("3_1", "-3_1"), "3_1#m3_1"),
        (("5_2", "4_1", "-3_1"), "m3_1#4_1#5_2"),
        (("-4_1", "4_1"), "4_1#4_1"),
        (("8_19", "-10_71"), "8_19#m10_71"),  # 18 crossings: known by its summands
    ],
)
def test_connected_sums(names: tuple[str, ...], expected: str) -> None:
    grids = [
        shipped_knots()[name[1:]].diagram.mirrored
        if name.startswith("-")
        else shipped_knots()[name].diagram
        for name in names
    ]
    assert identify(moved_about(connected_sum(grids), 5)).name == expected


def test_torus_knots_and_what_is_in_no_table() -> None:
    assert identify(torus_knot(3, 5)).name == "10_124"
    assert identify(torus_knot(-2, 9)).name == "m9_1"
    found = identify(torus_knot(4, 5))
    assert found.candidates == () and found.name is None and found.table_crossings == 13
    assert found.invariants.signature == -8 and found.grid.size == 9


def test_unknots_are_known_by_their_smallest_grid() -> None:
    for seed in range(5):
        found = identify(moved_about(torus_knot(1, 4), seed, 2))
        assert (found.name, found.by, found.crossings) == ("0_1", ("grid of size 2",), 0)
        assert found.invariants.alexander == (1,) and found.invariants.jones == {0: 1}


def test_without_the_extra_the_tables_go_to_10_crossings(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(summands, "is_installed", lambda: False)
    summands._table.cache_clear()
    try:
        found = identify(knotinfo_knots()["11a_1"].diagram)
        assert found.candidates == () and found.table_crossings == 10
        assert identify(shipped_knots()["9_42"].diagram.mirrored).name == "m9_42"
    finally:
        summands._table.cache_clear()


def test_candidates_by_alexander_polynomial_and_signature() -> None:
    for knot in [*shipped_knots().values()][::9]:
        assert KnotSum((Summand(knot),)) in knots_with(knot.alexander, knot.signature)
    small = [each.name for each in knots_with((1, -2, 3, -2, 1), -4) if each.crossing_number < 9]
    assert small == ["3_1#3_1"]
    assert KnotSum(()) in knots_with((1,), 0)
    assert knots_with((1,), 2) == []
