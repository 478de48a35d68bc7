"""`knotopt solve --laid` as a user meets it."""

from __future__ import annotations

import pytest

from knotopt.cable.cable import Cable
from knotopt.laid import invariants
from knotopt.laid.laid import LaidTest
from knotopt.reading.knot import read_knot
from knotopt.rehearsal import cut_off
from knotopt.sim.judge import Outcome, Verdict
from knotopt.sim.simulators import Simulator
from knotopt.supports.minimal import MinimalSupports
from tests.helpers.command_line import Cli
from tests.helpers.small_flight import flown_set

LOST = Verdict(Outcome.WRONG_KNOT, "unknot", False, True, "1")


def test_what_is_cut_off_is_counted(cli: Cli) -> None:
    status, out, err = cli("solve", "7 Var2", "--formulation", "opening", "--laid", "--cut", "L+")
    assert (status, err) == (0, "")
    assert "7 robots instead of 18" in out
    assert "no set of 6 robots is open and lays the knot on this cut" in out
    assert "cut off        1 set that lays another knot, and others with it" in out
    content = cli.json("solve", "7 Var2", "--formulation", "opening", "--laid", "--cut", "L+")
    assert content["laid"] == {
        "compared_by": invariants.compared_by(),
        "cut_off": 1,
        "is_knot": True,
        "redundant": [],
        "all_flown": True,
    }
    assert (content["robots_after"], content["proven_over_cuts"]) == (7, True)
    assert "laid" not in cli.json("solve", "7 Var2", "--formulation", "opening", "--cut", "L+")


def test_it_goes_with_what_a_team_asks(cli: Cli) -> None:
    content = cli.json("solve", "8_12", "--formulation", "loops", "--laid", "--cut", "R+")
    assert content["robots_after"] == 4
    forbidden = content["supports"][0][0]
    options = ("--formulation", "loops", "--laid", "--cut", "R+", "--forbid", forbidden)
    assert cli.json("solve", "8_12", *options)["robots_after"] >= 4


@pytest.mark.parametrize(
    ("options", "named"),
    [
        (("--all",), "--all"),
        (("--max-robots", "5"), "--max-robots"),
        (("--diagrams",), "--diagrams"),
        (("--cut", "all"), "--cut all"),
    ],
)
def test_what_does_not_go_with_it(cli: Cli, options: tuple[str, ...], named: str) -> None:
    status, _, err = cli("solve", "3", "--laid", *options)
    assert status == 2
    assert f"Invalid value for {named}: does not go with --laid" in err


def test_flights_are_of_sets_that_lay_the_knot(cli: Cli, monkeypatch: pytest.MonkeyPatch) -> None:
    flown: list[tuple[int, ...]] = []

    def fly(_: str, result: MinimalSupports, tests: object) -> object:  # noqa: ARG001
        flown.append(result.supports)
        return flown_set(LOST)

    monkeypatch.setattr(cut_off, "fly_set", fly)
    monkeypatch.setattr(Simulator, "require", lambda _: None)
    command = ("solve", "7 Var2", "--formulation", "opening", "--cut", "L+")
    command += ("--verify-physics", "--max-cut", "2")
    status, out, _ = cli(*command, "--laid")
    assert status == 1 and "or lay another knot, were not flown" in out
    test = LaidTest(Cable(read_knot("7 Var2").diagram, "L+"))
    assert len(flown) == 2 and all(test.laid(each).is_knot for each in flown)
    flown.clear()
    cli(*command)
    assert not all(test.laid(each).is_knot for each in flown)
