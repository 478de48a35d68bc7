"""The theorem on one support: windings drawn and identified, and words that break assumptions."""

from __future__ import annotations

import random
from itertools import permutations, product

import pytest

from knotopt.catalogue.knots import shipped_knots
from knotopt.diagram.families import torus_knot
from knotopt.errors import RequirementError
from knotopt.laid.fewest import fewest_by_claim
from knotopt.laid.invariants import Invariants
from knotopt.planar.braid import from_braid
from knotopt.planar.from_grid import planar_diagram
from tests.helpers.one_support import RayLetter, Winding, diagram, distances, shadows, windings


def sum_of_torus_knots(numbers: list[int]) -> Invariants:
    """Of T(2, m) # ..., for m odd: side by side in one braid."""
    word = [(k if m > 0 else -k) for k, m in enumerate(numbers, 1) for _ in range(abs(m))]
    return Invariants(from_braid(word))


def torus_numbers(turns: tuple[Winding, ...], letters: list[RayLetter]) -> list[int]:
    """m of each winding, as the theorem has it."""
    found, start = [], 0
    for count, inwards in turns:
        some = letters[start : start + count]
        found.append(-sum(x.sense if x.over else -x.sense for x in some) if inwards else 1)
        start += count
    return found


def agrees(turns: tuple[Winding, ...], letters: list[RayLetter]) -> bool:
    """Whether the cable is the knot that the theorem names; as far as that is asked for cheaply."""
    planar = diagram(letters)
    assert planar is not None
    knot = sum_of_torus_knots(torus_numbers(turns, letters))
    return knot.apart(Invariants(planar)) is None


def test_every_sequence_of_windings_is_the_sum_that_the_theorem_names() -> None:
    seen = 0
    for count in range(1, 5):
        for turns in windings(count):
            at = distances(turns)
            for senses, over in product(shadows(at), product((True, False), repeat=count)):
                letters = [RayLetter(*each) for each in zip(at, over, senses, strict=True)]
                assert agrees(turns, letters), (turns, letters)
                seen += 1
    assert seen == 2484


@pytest.mark.slow
def test_no_random_sequence_of_windings_breaks_the_theorem() -> None:
    """Up to 15 crossings: the shadows grow letter by letter, over and under at random."""
    source = random.Random(17)
    seen: set[tuple[int, ...]] = set()
    for _ in range(400):
        turns: list[Winding] = []
        while sum(count for count, _ in turns) < 9:
            inwards = source.random() < 0.7
            turns.append((source.choice((3, 5, 7)) if inwards else source.choice((1, 2)), inwards))
        letters = random_letters(turns, source)
        assert agrees(tuple(turns), letters), (turns, letters)
        seen.add(tuple(torus_numbers(tuple(turns), letters)))
    assert len(seen) > 100


def random_letters(turns: list[Winding], source: random.Random) -> list[RayLetter]:
    """Winding by winding: each is a summand, so that its senses do not depend on the others."""
    letters: list[RayLetter] = []
    at = distances(turns)
    for count, inwards in turns:
        own = distances([(count, inwards)])
        senses = source.choice(list(shadows(own)))
        start = len(letters)
        if letters and source.random() < 0.5:
            senses = tuple(-sense for sense in senses)
        for k, sense in enumerate(senses):
            letters.append(RayLetter(at[start + k], source.random() < 0.5, sense))
    return letters if diagram(letters) is not None else random_letters(turns, source)


def words(at: list[int], over: str) -> list[Invariants]:
    """Of each way to draw crossings at these distances."""
    return [
        Invariants(planar)
        for senses in shadows(at)
        for letters in [zip(at, [c == "o" for c in over], senses, strict=True)]
        if (planar := diagram([RayLetter(*each) for each in letters]))
    ]


def of_knot(name: str) -> Invariants:
    return Invariants(planar_diagram(shipped_knots()[name].diagram))


def is_up_to_mirror(found: Invariants, name: str) -> bool:
    knot = of_knot(name)
    mirrored = Invariants(knot.planar.mirrored)
    return None in (knot.apart(found), mirrored.apart(found))


def test_three_half_turns_are_the_trefoil_inwards_and_nothing_outwards() -> None:
    assert any(is_up_to_mirror(each, "3_1") for each in words([3, 2, 1], "ouo"))
    assert all(each.alexander == (1,) for each in words([1, 2, 3], "ouo"))
    unknot = Invariants(from_braid([], 1))
    assert all(each.apart(unknot) is None for each in words([1, 2, 3], "ouo"))


def test_two_trefoils_one_beyond_the_other() -> None:
    sums = [each.alexander for each in words([3, 2, 1, 6, 5, 4], "ouoouo")]
    assert (1, -2, 3, -2, 1) in sums


@pytest.mark.parametrize(("over", "name"), [("ououo", "5_2"), ("ouoou", "4_1")])
def test_crossings_between_the_robot_and_a_winding_tie_other_knots(over: str, name: str) -> None:
    assert any(is_up_to_mirror(each, name) for each in words([3, 4, 5, 2, 1], over))


def test_crossings_in_any_order_tie_the_figure_eight() -> None:
    found = [each for at in permutations((1, 2, 3, 4)) for each in words(list(at), "ouou")]
    assert any(is_up_to_mirror(each, "4_1") for each in found)


def test_of_the_knots_to_ten_crossings_four_may_have_three_robots() -> None:
    three = [name for name in shipped_knots() if fewest_by_claim([name], ()).robots == 3]
    assert three == ["3_1", "5_1", "7_1", "9_1"]
    other = fewest_by_claim(["5_2"], ())
    assert len(other.assumptions) == 4 and "tied 5_2 with three robots" in other.against


def test_without_a_name_the_polynomial_decides() -> None:
    for name, knot in shipped_knots().items():
        by_name = fewest_by_claim([name], ()).robots
        by_polynomial = fewest_by_claim([], Invariants(planar_diagram(knot.diagram)).alexander)
        # 10_132 has the polynomial of 5_1, and the like: then the bound is the lower one.
        assert by_polynomial.robots == by_name or (by_name, by_polynomial.robots) == (4, 3)
    for count in (3, 5, 9, 15, 21):
        knot = Invariants(planar_diagram(torus_knot(2, count)))
        assert fewest_by_claim([], knot.alexander).robots == 3


def test_of_several_candidates_the_bound_is_the_least() -> None:
    assert fewest_by_claim(["5_1", "10_132"], ()).robots == 3
    assert fewest_by_claim(["4_1#4_1", "3_1#m4_1"], ()).robots == 4
    assert fewest_by_claim(["0_1#3_1"], ()).robots == 3
    assert fewest_by_claim(["T(-2,7)", "mT(3,2)"], ()).robots == 3
    assert fewest_by_claim(["T(3,4)"], ()).robots == 4
    assert fewest_by_claim(["T(1,4)"], ()).robots == 2
    with pytest.raises(RequirementError, match="'7 Var2' is no name of a knot"):
        fewest_by_claim(["7 Var2"], ())
