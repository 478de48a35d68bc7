"""What the help of every command says of its options."""

from __future__ import annotations

import re
from fractions import Fraction
from pathlib import Path
from typing import Any

import pytest
import typer

from formulations.backends import DEFAULT
from formulations.solution import Limits
from knotopt.atlas.schema import Settings
from knotopt.cli.app import COMMANDS, app
from knotopt.flight.limits import ROOM, FlightLimits
from knotopt.path.requirements import PathRequirements
from knotopt.path.world import World
from knotopt.supports.requirements import Requirements

FILLED: tuple[tuple[str, object, str], ...] = (
    ("solve", Requirements(), "openness=--r"),
    ("path", Requirements(), "formulation openness=--r"),
    ("prove", Requirements(), "formulation openness=--r"),
    ("compare", Requirements(), "openness=--r"),
    ("solve", Limits(), "gap threads seed"),
    ("path", PathRequirements(), "clearance opening gap slope bending"),
    ("path", World(step=0.5), "altitude floor ceiling drone_height downwash"),
    ("fly", ROOM, "step altitude floor ceiling"),
    (
        "fly",
        FlightLimits(),
        "speed acceleration separation downwash spacing slack hover_before hover_after",
    ),
    ("atlas", Settings(), "openness=--r seed check solver_limit"),
)
"""Commands, what their options fill, and which fields: of the same name unless another is given."""

OWN = {
    ("topology", "--plans"): 10,
    ("prove", "--out"): Path("certificate.jsonl"),
}
"""Numbers and files that no dataclass holds."""


def expected_defaults() -> dict[tuple[str, str], object]:
    expected: dict[tuple[str, str], object] = {**OWN}
    for command, filled, names in FILLED:
        for name in names.split():
            field, _, option = name.partition("=")
            option = option or "--" + field.replace("_", "-")
            expected[command, option] = getattr(filled, field)
    return expected


def options(command: str) -> dict[str, Any]:
    group: Any = typer.main.get_command(app)
    found = group.get_command(None, command).params
    return {max(each.opts, key=len): each for each in found if each.param_type_name == "option"}


def is_same(shown: object, expected: object) -> bool:
    try:
        return Fraction(str(shown)) == Fraction(str(expected))
    except ValueError:
        return str(shown) == str(expected)


@pytest.mark.parametrize("command", COMMANDS)
def test_defaults_are_those_of_what_the_options_fill(command: str) -> None:
    expected = {
        name: value for (owner, name), value in expected_defaults().items() if owner == command
    }
    found = options(command)
    assert expected.keys() <= found.keys()
    for name, option in found.items():
        default = option.default
        if name in expected:
            shown = option.show_default if default is None else default
            assert is_same(shown, expected[name]), (name, shown, expected[name])
        elif name == "--solver":
            assert default == DEFAULT
        else:  # no number but here
            assert default is None or isinstance(default, bool | str) or name == "--verbose", name


@pytest.mark.parametrize("command", COMMANDS)
def test_every_option_says_what_it_is_and_in_which_unit(command: str) -> None:
    for name, option in options(command).items():
        assert option.help and option.help.endswith("."), name
        if isinstance(option.default, float):
            assert re.search(r"\[.+\]|Metres|share|[Rr]elative|length in plan", option.help), name
