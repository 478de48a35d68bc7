"""`knotopt solve --verify-physics` as a user meets it, with made-up flights."""

from __future__ import annotations

import json
import logging
import sys
from pathlib import Path

import pytest

from knotopt.rehearsal import cut_off
from knotopt.rehearsal.flight_tests import FlightTests
from knotopt.rehearsal.flown_set import FlownSet
from knotopt.sim.judge import Outcome, Verdict
from knotopt.sim.simulators import Simulator
from knotopt.supports.minimal import MinimalSupports
from tests.helpers.command_line import Cli
from tests.helpers.small_flight import flown_set

TIED = Verdict(Outcome.TIED, "3_1", True, True, "1 - t + t^2")
LOST = Verdict(Outcome.WRONG_KNOT, "unknot", False, True, "1")
COMMAND = ("solve", "3", "--formulation", "span", "--r", "0.25", "--verify-physics")


class Flights:
    """The flights of all sets up to a number are lost, then one ties."""

    def __init__(self, lost: int) -> None:
        self.lost, self.stop_at = lost, 1000
        self.flown: list[tuple[str, tuple[int, ...]]] = []

    def __call__(self, name: str, result: MinimalSupports, tests: FlightTests) -> FlownSet:
        if len(self.flown) == self.stop_at:
            self.stop_at = 1000
            raise KeyboardInterrupt
        self.flown.append((str(result.cable.cut), result.supports))
        logging.getLogger("knotopt.rehearsal.attempt").info("span 3 over span 1: as planned")
        assert name == "3_1" and (tests.noise, tests.trials) in ((0.01, 3), (0.02, 1))
        if len(self.flown) > self.lost:
            return flown_set(TIED, *(TIED,) * tests.trials)
        if len(self.flown) % 2:
            return flown_set(LOST)
        return flown_set(TIED, LOST, *(TIED,) * (tests.trials - 1))


@pytest.fixture
def flights(monkeypatch: pytest.MonkeyPatch) -> Flights:
    made_up = Flights(2)
    monkeypatch.setattr(cut_off, "fly_set", made_up)
    monkeypatch.setattr(Simulator, "require", lambda _: None)
    return made_up


def words(text: str) -> str:
    """Without line ends, which depend on the terminal's width."""
    return " ".join(text.split())


def test_a_set_that_ties(cli: Cli, flights: Flights, tmp_path: Path) -> None:
    picture, program = tmp_path / "a.png", tmp_path / "a.json"
    status, out, err = cli(*COMMAND, "--cut", "L+", "--plot", picture, "--export", program)
    assert status == 0 and len(flights.flown) == 3
    said = words(out)
    assert "cut off in flight 1 of 5 robots, 1 of 6 robots" in said
    assert "no set of 5 robots is open on this cut but for 1 cut off" in said
    assert "tied in simulation undisturbed and in 3 of 3 flights with noise of 0.01 m" in said
    assert "wrong knot: unknot" in said and "span 4 over span 1: never crossed" in said
    assert (
        "Proven: no set of fewer than 6 robots meets the rows of `span with loops` on this cut, "
        "but for 1 cut off." in said
    )
    assert "that is no proof that they, flown otherwise, cannot tie the knot" in said
    assert picture.exists() and json.loads(program.read_text())["format"]
    assert err.splitlines()[0] == "set 1: 5 robots, cut L+, p4 p5 p7"
    assert err.count("cut off: wrong knot: unknot") == 2 and "as planned" not in err


@pytest.mark.parametrize("verbose", ["-v", "-vv"])
def test_sets_are_said_once(cli: Cli, flights: Flights, tmp_path: Path, verbose: str) -> None:
    log = tmp_path / "a.log"
    status, _, err = cli(*COMMAND, "--cut", "L+", verbose, "--log", log)
    assert status == 0
    for text in (err, log.read_text()):
        assert text.count("set 1: 5 robots, cut L+, p4 p5 p7\n") == 1
        assert text.count("cut off: wrong knot: unknot") == 2
    flights.flown.clear()
    status, _, err = cli(*COMMAND, "--cut", "L+", "--log", log)
    assert status == 0 and err.count("cut off: wrong knot: unknot") == 2


def test_as_json(cli: Cli, flights: Flights, tmp_path: Path) -> None:
    file = tmp_path / "flown.json"
    options = ("--cut", "L+", "--noise", "0.02", "--trials", "1", "--out", file)
    status, out, _ = cli(*COMMAND, *options, "--json")
    content = json.loads(out)
    assert status == 0
    assert json.loads(file.read_text()) == content and list(tmp_path.iterdir()) == [file]
    physics = content["physics"]
    assert (physics["status"], physics["noise"], physics["trials"]) == ("tied", 0.02, 1)
    assert physics["tied"] == ["tied: 3_1"] * 2 and physics["proven_but_for_cut_off"]
    assert physics["cut_off_by_robots"] == {"5": 1, "6": 1} and not content["proven"]
    assert [
        (each["cut"], each["supports"], each["tied_instead"]) for each in physics["cut_off"]
    ] == [(cut, list(supports), "wrong knot: unknot") for cut, supports in flights.flown[:2]]
    assert cli.json("path", "3", "--supports", file)["supports"] == content["supports"]


def test_without_anything_cut_off(cli: Cli, flights: Flights) -> None:
    flights.lost = 0
    status, out, _ = cli(*COMMAND)
    assert status == 0 and "cut off in flight none" in words(out)
    assert "over the 8 cuts searched. Seen in simulation" in words(out)
    status, out, _ = cli(*COMMAND, "--cut", "L+", "--json")
    assert status == 0 and json.loads(out)["proven"]


def test_the_budget_ends_and_a_larger_one_goes_on(
    cli: Cli, flights: Flights, tmp_path: Path
) -> None:
    flights.lost = 4
    file = tmp_path / "flown.json"
    status, out, err = cli(*COMMAND, "--max-cut", "2", "--out", file, "--plot", tmp_path / "a.png")
    assert status == 1 and "no set tied the knot before the budget ended" in out
    assert "next set" in out and "not flown" in out
    assert f"2 sets cut off: {file}.partial; with a larger budget it goes on from there" in err
    assert json.loads(file.read_text())["physics"]["status"] == "budget"
    names = {path.name for path in tmp_path.iterdir()}
    assert names == {"flown.json", "flown.json.partial"}
    status, out, err = cli(*COMMAND, "--max-cut", "9", "--out", file)
    assert status == 0 and f"cut off before, from {file}.partial: 2 sets" in err
    assert len(flights.flown) == len(set(flights.flown)) == 5
    assert len(json.loads(file.read_text())["physics"]["cut_off"]) == 4
    assert [path.name for path in tmp_path.iterdir()] == ["flown.json"]


def test_ctrl_c_and_going_on(cli: Cli, flights: Flights, tmp_path: Path) -> None:
    file = tmp_path / "flown.json"
    flights.stop_at = 0
    assert cli(*COMMAND, "--out", file)[0] == 130 and not list(tmp_path.iterdir())
    flights.stop_at = 1
    status, _, err = cli(*COMMAND, "--out", file)
    assert status == 130 and f"stopped, 1 set cut off: {file}.partial" in err
    assert [path.name for path in tmp_path.iterdir()] == ["flown.json.partial"]
    status, _, err = cli(*COMMAND, "--out", file, "--noise", "0.02", "--trials", "1")
    assert status == 1 and "the beginning of another run" in err
    status, _, _ = cli(*COMMAND, "--out", file)
    assert status == 0 and len(flights.flown) == len(set(flights.flown)) == 3
    assert [path.name for path in tmp_path.iterdir()] == ["flown.json"]


def test_no_set_at_all(cli: Cli, flights: Flights) -> None:
    status, out, _ = cli(*COMMAND, "--separation", "100")
    assert status == 1 and not flights.flown
    assert "no set of supports does what is asked on any of 8 cuts" in out
    flights.lost = 1000
    few = ("--cut", "L+", "--max-cut", "999", "--forbid", "2", "--forbid", "3", "--forbid", "9")
    status, out, _ = cli(*COMMAND, *few)
    assert status == 1 and "none of the sets that meet the requirements tied the knot" in out
    count = len(flights.flown)
    proven = f"Proven: no set but the {count} cut off meets the rows of `span with loops`"
    assert proven in words(out)


@pytest.mark.parametrize(
    ("arguments", "status", "message"),
    [
        (("--cut", "all"), 2, "give --cut best or a cut's name"),
        (("--all",), 2, "does not go with --verify-physics"),
        (("--diagrams",), 2, "does not go with --verify-physics"),
        (("--trials", "0"), 1, "disturbed flights are at least 1, not 0"),
        (("--noise", "-1"), 1, "noise is a number of metres from 0 up, not -1"),
        (("--physics-budget", "0"), 1, "time for flights must be positive"),
        (("--max-cut", "0"), 1, "at least 1 set may be cut off"),
        (("--out", "a.csv"), 1, "the answer is written as .json"),
        (("--plot", "a.gif"), 1, "pictures are written as"),
        (("--forbid", "3"), 2, "turning points are numbered along one cable"),
    ],
)
def test_what_does_not_go_together(
    cli: Cli,
    flights: Flights,
    arguments: tuple[str, ...],
    status: int,
    message: str,
    tmp_path: Path,
) -> None:
    cli.monkeypatch.chdir(tmp_path)
    found, _, err = cli(*COMMAND, *arguments)
    assert found == status and message in words(err.replace("│", " "))
    assert not flights.flown and not list(tmp_path.iterdir())


@pytest.mark.parametrize(
    ("option", "value"),
    [("--noise", "1"), ("--trials", "1"), ("--physics-budget", "1"), ("--max-cut", "1")],
)
def test_options_of_flights_that_are_not_flown(cli: Cli, option: str, value: str) -> None:
    status, _, err = cli("solve", "3", "--formulation", "opening", option, value)
    assert status == 2 and "goes with --verify-physics" in words(err) and option in err


def test_without_mujoco(cli: Cli, monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setitem(sys.modules, "mujoco", None)
    for out in ((), ("--out", tmp_path / "a.json")):
        status, _, err = cli(*COMMAND, *out)
        assert status == 1 and "needs mujoco, which is not installed" in err
        assert "knotopt[sim]" in err and not list(tmp_path.iterdir())
