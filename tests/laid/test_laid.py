"""The exact test: what is lost, what is left, by two codes that share nothing, and by flights."""

from __future__ import annotations

import json
from collections import Counter
from itertools import combinations
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from knotopt.cable.cable import Cable
from knotopt.cable.cut import Cut
from knotopt.catalogue.knots import shipped_knots
from knotopt.diagram.grid import GridDiagram
from knotopt.errors import RequirementError
from knotopt.flight.grid_layout import span_words
from knotopt.laid import invariants
from knotopt.laid.heuristics import monotone_windings, self_crossings_over
from knotopt.laid.hooks import Loss, flown_crossings, lost_hooks
from knotopt.laid.invariants import Invariants, compared_by, without_kinks
from knotopt.laid.laid import LaidTest, laid_diagram
from knotopt.planar.braid import from_braid
from knotopt.planar.from_grid import planar_diagram
from knotopt.reading.knot import read_knot
from knotopt.verify.laid import check_laid
from knotopt.verify.piercing import bare_loops
from tests.helpers.strategies import cables

SUBSETS = Path(__file__).parents[2] / "benchmarks/results/physics_subsets.jsonl"


@st.composite
def cables_with_supports(draw: st.DrawFn) -> tuple[Cable, tuple[int, ...]]:
    """Of prime knots, or of random grids, most of which are unknots."""
    knots = st.sampled_from(list(shipped_knots().values())).map(lambda each: each.diagram)
    sides = st.sampled_from("LRBT"), st.sampled_from("+-")
    cable = draw(
        st.one_of(
            cables(3, 9),
            st.builds(
                lambda grid, side, way: Cable(grid, Cut.parse(side + way, grid.size)),
                *(knots, *sides),
            ),
        )
    )
    points = st.integers(2, len(cable.path) - 1)
    return cable, tuple(sorted(draw(st.sets(points, max_size=8))))


@given(cables_with_supports())
def test_maker_and_checker_agree(drawn: tuple[Cable, tuple[int, ...]]) -> None:
    cable, supports = drawn
    laid, report = LaidTest(cable).laid(supports), check_laid(cable.path, supports)
    cells = [tuple(cable.crossings.cell[each.crossing].tolist()) for each in laid.lost]
    assert cells == list(report.lost)
    assert report.same_polynomial == (laid.apart != "Alexander polynomial")
    if report.same_polynomial:
        assert report.same_signature == (laid.apart != "signature")
    if laid.is_knot:
        assert report.is_knot


@given(cables_with_supports())
def test_hooks_are_what_is_left_of_the_flights_words(drawn: tuple[Cable, tuple[int, ...]]) -> None:
    cable, supports = drawn
    words = span_words(cable, supports)
    kept = {letter.rank for word in words for letter in word if not letter.over}
    lost = {each.crossing for each in lost_hooks(cable, supports)}
    hooks = [c for c, each in enumerate(cable.crossings) if each.first_over]
    assert lost == {c for c in hooks if float(cable.crossings.first[c]) not in kept}


@given(cables_with_supports(), st.randoms(use_true_random=False))
def test_a_hook_stays_lost_while_its_turning_points_are_bare(drawn, source) -> None:  # type: ignore[no-untyped-def]
    cable, supports = drawn
    for lost in lost_hooks(cable, supports):
        if lost.bare is None:
            continue
        assert not lost.bare & set(supports)
        rest = [k for k in range(2, len(cable.path)) if k not in lost.bare]
        for _ in range(3):
            others = tuple(sorted(source.sample(rest, source.randint(0, len(rest)))))
            assert lost.crossing in {each.crossing for each in lost_hooks(cable, others)}


def test_a_robot_at_every_turning_point_loses_nothing() -> None:
    for knot in list(shipped_knots().values())[::10]:
        cable = Cable(knot.diagram, "L+")
        laid = LaidTest(cable).laid(tuple(range(2, len(cable.path))))
        assert laid.is_knot and not laid.lost
        assert laid_diagram(cable, ()).signs == planar_diagram(knot.diagram).signs or laid.is_knot


def test_a_support_on_every_loop_does_not_keep_every_crossing() -> None:
    """Two crossings of two spans undo each other, though a later strand passes between them."""
    cable, supports = Cable(shipped_knots()["6_3"].diagram, "L+"), (5, 7, 13)
    assert not bare_loops(cable.path, supports)
    laid = LaidTest(cable).laid(supports)
    assert [each.loss for each in laid.lost] == [Loss.UNDONE, Loss.UNDONE]
    assert laid.apart == "Alexander polynomial"
    assert not check_laid(cable.path, supports).is_knot


def test_crossings_that_are_flown_must_be_the_knot_by_themselves() -> None:
    """Of 4_1 on this grid no hook is lost, and of all its crossings one is flown."""
    cable = Cable(GridDiagram((4, 5, 2, 3, 1, 6), (1, 3, 4, 6, 5, 2)), "R-")
    laid = LaidTest(cable).laid((4,))
    assert len(flown_crossings(cable, (4,))) == 1
    assert not laid.lost and laid.apart == "Alexander polynomial"
    assert not check_laid(cable.path, (4,)).is_knot


@pytest.mark.parametrize(
    ("row", "cut", "supports", "pierced", "is_knot"),
    [
        ("3", "R+", (8,), False, False),  # ties 5 of 5 all the same: what is lost is flown
        ("3", "T-", (4,), False, True),  # ties 5 of 5: the loop without support was redundant
        ("3", "L-", (6,), True, True),
        ("3", "L+", (4,), True, True),
        ("5", "L-", (9,), True, True),
        ("4", "B+", (7, 10), True, True),
        ("4", "B+", (7, 9), True, True),
    ],
)
def test_sets_that_have_tied(
    row: str, cut: str, supports: tuple[int, ...], *, pierced: bool, is_knot: bool
) -> None:
    cable = Cable(read_knot(row).diagram, cut)
    assert (not bare_loops(cable.path, supports)) == pierced
    assert LaidTest(cable).laid(supports).is_knot == is_knot
    assert check_laid(cable.path, supports).is_knot == is_knot


def test_subsets_that_were_flown() -> None:
    """Every subset of two cables: none that lays another knot has tied."""
    tests: dict[tuple[str, str], LaidTest] = {}
    counts: Counter[tuple[bool, bool]] = Counter()
    by_c: Counter[tuple[bool, bool | None, bool]] = Counter()
    for line in SUBSETS.read_text(encoding="utf-8").splitlines()[1:]:
        row = json.loads(line)
        case, tied = row["case"], row["result"]["tied"]
        key = case["row"], case["cut"]
        if key not in tests:
            tests[key] = LaidTest(Cable(read_knot(key[0]).diagram, key[1]))
        test, supports = tests[key], tuple(case["supports"])
        counts[test.laid(supports).is_knot, tied] += 1
        assert self_crossings_over(test, supports) == test.laid(supports).is_knot
        pierced = not bare_loops(test.cable.path, supports)
        by_c[pierced, monotone_windings(test, supports), tied] += 1
    assert counts == {(True, True): 608, (True, False): 512, (False, False): 160}
    assert by_c[True, False, True] == 0 and by_c[True, False, False] == 10
    assert by_c[True, True, True] == 604


def test_the_wrong_knot_of_a_flight_is_foretold() -> None:
    """7_5 with supports of `opening`, flown, tied 5_1 or 10_132, which have one polynomial."""
    cable, supports = Cable(shipped_knots()["7_5"].diagram, "B+"), (3, 5, 6, 7, 10)
    test = LaidTest(cable)
    laid = test.laid(supports)
    assert self_crossings_over(test, supports) and not laid.is_knot
    left = Invariants(laid_diagram(cable, [each.crossing for each in laid.lost]))
    assert left.alexander == (1, -1, 1, -1, 1)
    assert laid.needed and not set(laid.redundant) & set(laid.needed)


def test_supports_that_are_none() -> None:
    test = LaidTest(Cable(read_knot("3").diagram, "L+"))
    with pytest.raises(RequirementError, match="no support robot can be at p1:"):
        test.laid((1,))


def test_nugatory_crossings_go() -> None:
    assert without_kinks(from_braid([1, 1, 1, 2])).crossings == from_braid([1, 1, 1]).crossings
    assert len(without_kinks(from_braid([1, 1, 1, 2, 3, 3, 3])).crossings) == 6


@given(cables(3, 9), st.data())
def test_invariants_stay_when_a_diagram_is_reduced(cable: Cable, data: st.DataObject) -> None:
    hooks = LaidTest(cable).hooks
    planar = laid_diagram(cable, data.draw(st.sets(st.sampled_from(hooks))) if hooks else ())
    reduced = without_kinks(planar)
    assert without_kinks(reduced) == reduced
    assert Invariants(reduced).apart(Invariants(planar)) is None
    assert invariants.signature(planar) == invariants.signature(reduced)


def test_without_knot_floer_homology_the_rest_decides(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(invariants, "HOMOLOGY", "no_such_package")
    trefoil, five = (Invariants(from_braid([1] * count)) for count in (3, 5))
    assert trefoil.homology is None
    assert trefoil.apart(five) == "Alexander polynomial"
    assert trefoil.apart(Invariants(from_braid([-1] * 3))) == "signature"
    assert trefoil.apart(trefoil) is None
    assert compared_by() == "Alexander polynomial and signature"


def test_homology_tells_what_polynomial_and_signature_do_not() -> None:
    five, ten = (Invariants(planar_diagram(shipped_knots()[k].diagram)) for k in ("5_1", "10_132"))
    assert five.alexander == ten.alexander
    mirrored = Invariants(ten.planar.mirrored)
    found = {five.apart(ten), five.apart(mirrored)}
    assert "knot Floer homology" in found or found == {"signature"}


def test_every_pair_of_supports_of_table_one_is_judged_alike_by_both() -> None:
    cable = Cable(read_knot("4").diagram, "B+")
    test = LaidTest(cable)
    for supports in combinations(range(2, len(cable.path)), 2):
        assert test.laid(supports).is_knot == check_laid(cable.path, supports).is_knot
