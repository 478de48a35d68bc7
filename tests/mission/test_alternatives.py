"""Sets tried in turn: the first good one, else the best, with notes on the others."""

from __future__ import annotations

from dataclasses import dataclass, replace
from fractions import Fraction

import pytest

from knotopt import Cable, read
from knotopt.errors import RequirementError
from knotopt.flight.request import FlightRequest
from knotopt.mission.alternatives import first_good, plan_first
from knotopt.supports.lcf import lcf
from knotopt.supports.requirements import Requirements
from knotopt.supports.selection import GivenSupports, equally_small

DIAGRAM = read("4").diagram


@dataclass(frozen=True)
class Result:
    cut: str
    why: str = ""
    rank: int = 0
    notes: tuple[str, ...] = ()

    def noted(self, *notes: str) -> Result:
        return replace(self, notes=self.notes + notes)


def tried(outcomes: dict[str, Result | str], drawn: list[str]) -> Result:
    def attempt(chosen: GivenSupports) -> Result:
        drawn.append(str(chosen.cable.cut))
        outcome = outcomes[drawn[-1]]
        if isinstance(outcome, str):
            raise RequirementError(outcome)
        return outcome

    sets = (GivenSupports(Cable(DIAGRAM, cut), (3,)) for cut in outcomes)
    return first_good(sets, attempt, lambda each: each.why, lambda each: each.rank)


def test_the_first_good_one_is_taken_and_the_rest_not_looked_at() -> None:
    drawn: list[str] = []
    outcomes = {"L+": "no way", "R+": Result("R+", "stuck", 9), "B+": Result("B+"), "T+": "never"}
    found = tried(outcomes, drawn)
    assert found.cut == "B+" and drawn == ["L+", "R+", "B+"]
    assert found.notes == ("not on cut L+: no way", "not on cut R+: stuck")


def test_one_good_set_has_no_notes() -> None:
    assert tried({"L+": Result("L+")}, []).notes == ()
    assert tried({"L+": Result("L+", "stuck")}, []).notes == ()  # the flight itself says so


def test_else_the_best_and_of_equals_the_first() -> None:
    outcomes = {
        "L+": Result("L+", "stuck", 1),
        "L-": Result("L-", "near", 2),
        "R+": Result("R+", "near", 2),
        "R-": "no way",
    }
    found = tried(outcomes, [])
    assert found.cut == "L-"
    assert found.notes == ("not on cut R-: no way", "not on cut L+: stuck", "not on cut R+: near")


def test_where_none_has_a_flight_the_first_error_counts() -> None:
    with pytest.raises(RequirementError, match="the first"):
        tried({"L+": "the first", "R+": "the second"}, [])


@pytest.mark.parametrize("choice", ["lcf", "all", "milp"])
def test_sets_that_are_equally_small(choice: str) -> None:
    asked = Requirements("span", Fraction(1, 4))
    sets = list(equally_small(DIAGRAM, choice, requirements=asked))
    cuts = [str(each.cable.cut) for each in sets]
    assert len(set(cuts)) == len(cuts) > 1
    assert len({each.robots for each in sets}) == 1
    if choice == "lcf":
        least = min(lcf(Cable(DIAGRAM, cut)).robots for cut in ("L+", "L-", "R+", "R-", "B+", "B-"))
        assert all(each.robots <= least for each in sets)
        assert all(lcf(each.cable).supports == each.supports for each in sets)
    only = list(equally_small(DIAGRAM, choice, cuts[-1], asked))
    assert [each.supports for each in only] == [sets[-1].supports]


def test_a_flight_on_another_cut_where_the_first_has_no_way() -> None:
    request = FlightRequest("4_1", "file", schedule="fixed")
    blocked = GivenSupports(Cable(DIAGRAM, "L+"), (8, 9, 10, 11))
    free = GivenSupports(Cable(DIAGRAM, "L-"), tuple(range(2, 12)))
    plan = plan_first([blocked, free], request)
    assert plan.cable is free.cable
    assert plan.notes[-1].startswith("not on cut L+: there is no way for span 3")
    with pytest.raises(RequirementError, match="there is no way for span 3"):
        plan_first([blocked], request)
