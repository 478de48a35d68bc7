"""Values that make no sense, for every option of every command that there is.

They are refused before any work: what reads a knot is replaced by an error of its own.
"""

from __future__ import annotations

import importlib
import inspect
import re
import types
import typing
from collections.abc import Iterator
from pathlib import Path

import pytest
from typer.models import OptionInfo

from knotopt.cli.app import COMMANDS
from knotopt.errors import KnotoptError
from tests.helpers.command_line import Cli

ON_KNOTS = ("show", "lcf", "solve", "path", "fly", "topology", "compare", "prove")
ARGUMENTS = {
    **{name: ["3"] for name in ON_KNOTS},
    "solve": ["3", "--formulation", "opening"],
    "atlas": ["run", "3"],
    "report": ["no_such_run", "--out", "report"],
    "check": ["no_such_file"],
}
"""What a command takes beside options."""

COMPANY = {
    ("path", "altitude"): ["--step", "0.5"],
    ("path", "floor"): ["--step", "0.5"],
    ("path", "ceiling"): ["--step", "0.5"],
    ("path", "drone_height"): ["--step", "0.5"],
    ("path", "downwash"): ["--step", "0.5"],
    ("solve", "count"): ["--all"],
    ("solve", "forbid"): ["--cut", "L+"],
    ("solve", "force"): ["--cut", "L+"],
    **{
        ("solve", name): ["--verify-physics"]
        for name in ("noise", "trials", "physics_budget", "max_cut")
    },
    **{("fly", name): ["--sim"] for name in ("noise", "gust", "seed", "runs", "tighten", "wind")},
    ("atlas", "solver_limit"): ["--solvers", "highs"],
}
"""Options that an option only goes with."""

HUGE = "99999999999999999999"
SENSELESS = ("nan", f"-{HUGE}", "")
TOO_LARGE = ("1e400", "1e300", HUGE)

UNLIMITED = {"time_limit", "solver_limit", "physics_budget"}
"""Times, which may be without end."""

OF_THE_KNOT = {"forbid", "force"}
"""Counted along a knot's path, so it has to be known."""

SAID_LATER = {"cut", "start", "supports", "solver", "over", "form", "scheduler"}
"""Said to be wrong when the knot is known, or by who is asked at that address."""

COUNTED_OUT = {"count", "max_cut", "payload", "reach", "separation", "seed", "check", "tighten"}
COUNTED_OUT |= {"crossings", "arc_index", "determinant", "altitude", "ceiling", "verbose"}
"""What can be of any size: no knot, set or room is that large, which takes no time to say."""


class ReachedError(KnotoptError):
    """The knot would have been read: nothing was refused."""


def options(*kinds: type) -> Iterator[tuple[str, str, str]]:
    """Command, parameter, and name on the command line of every option of such a type."""
    for command, (module, _) in COMMANDS.items():
        function = getattr(importlib.import_module(f"knotopt.cli.{module}"), command)
        for parameter in inspect.signature(function, eval_str=True).parameters.values():
            base, *notes = typing.get_args(parameter.annotation) or (parameter.annotation,)
            option = next((note for note in notes if isinstance(note, OptionInfo)), None)
            plain = {*typing.get_args(base)} or {base}
            plain = {each for kind in plain for each in typing.get_args(kind) or (kind,)}
            if option is not None and plain - {types.NoneType} <= {*kinds}:
                names = [name for name in option.param_decls or () if name.startswith("--")]
                own = "--" + parameter.name.replace("_", "-")
                yield command, parameter.name, (names or [own])[0]


NUMBERS = [*options(int, float)]
WORDS = [*options(str)]
FILES = [*options(Path)]


@pytest.fixture(autouse=True)
def no_work(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    # Modules that take the reader from there have to be imported before it is replaced.
    for module in ("knotopt.api", "knotopt.atlas.knot_list", "knotopt.reading.goal"):
        importlib.import_module(module)

    def reached(*_: object, **__: object) -> typing.NoReturn:
        raise ReachedError("nothing is refused")

    monkeypatch.setattr("knotopt.reading.knot.read_knot", reached)
    monkeypatch.setattr("knotopt.reading.goal.read_goal", reached)
    monkeypatch.setattr("knotopt.atlas.run.run_atlas", reached)
    monkeypatch.setattr("knotopt.tables.table1.compute_table1", reached)
    monkeypatch.chdir(tmp_path)


def ended(cli: Cli, command: str, name: str, option: str, value: str) -> str:
    """The sentence that a command ends with; "" if it goes to work."""
    beside = [*ARGUMENTS.get(command, []), *COMPANY.get((command, name), [])]
    status, out, err = cli(command, *beside, f"{option}={value}")
    if "nothing is refused" in err or status == 0:
        return ""
    assert status in (1, 2) and not out, (status, out)
    assert "Traceback" not in err
    assert re.search(r"^(knotopt: |Error: )\S.{8}", err, re.MULTILINE), err
    return err


def test_the_options_are_found() -> None:
    assert len(NUMBERS) > 40 and len(WORDS) > 15 and len(FILES) > 8
    assert {("path", "gap", "--gap"), ("topology", "plans", "--plans")} <= {*NUMBERS}


@pytest.mark.parametrize(("command", "name", "option"), NUMBERS)
def test_numbers_that_are_none(cli: Cli, command: str, name: str, option: str) -> None:
    if name in OF_THE_KNOT:
        assert ended(cli, command, name, option, "x")
        return
    for value in SENSELESS:
        assert ended(cli, command, name, option, value), value


@pytest.mark.parametrize(("command", "name", "option"), NUMBERS)
def test_numbers_beyond_all_measure(cli: Cli, command: str, name: str, option: str) -> None:
    for value in TOO_LARGE:
        words = ended(cli, command, name, option, value)
        assert words or name in UNLIMITED | OF_THE_KNOT | COUNTED_OUT, value


@pytest.mark.parametrize(("command", "name", "option"), WORDS)
def test_words_that_mean_nothing(cli: Cli, command: str, name: str, option: str) -> None:
    for value in ("", " ", "nan", "\N{LATIN SMALL LETTER E WITH ACUTE}" * 3000):
        words = ended(cli, command, name, option, value)
        assert words or name in SAID_LATER, value


@pytest.mark.parametrize(("command", "name", "option"), FILES)
def test_files_without_a_name(cli: Cli, command: str, name: str, option: str) -> None:
    for value in ("", "."):
        words = ended(cli, command, name, option, value)
        assert words or name in {"out", "grids", "log"}, value
