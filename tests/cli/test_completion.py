"""What the shell completes, asked for as a shell does."""

from __future__ import annotations

import pytest

from formulations.backends import BACKENDS
from knotopt.cli.app import COMMANDS, app
from knotopt.cli.completion import knot_names
from knotopt.reading.writing import WRITTEN_FORMS


def completed(
    line: str, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> list[str]:
    """What Bash is offered for the last word of a line."""
    monkeypatch.setenv("_KNOTOPT_COMPLETE", "complete_bash")
    monkeypatch.setenv("COMP_WORDS", line)
    monkeypatch.setenv("COMP_CWORD", str(line.count(" ")))
    monkeypatch.setattr("sys.argv", ["knotopt"])
    with pytest.raises(SystemExit):
        app(prog_name="knotopt")
    return capsys.readouterr().out.rstrip("\n").split("\n")


OUTER = ["L+", "L-", "R+", "R-", "B+", "B-", "T+", "T-"]


@pytest.mark.parametrize(
    ("line", "expected"),
    [
        ("knotopt solve 8_2", ["8_2", "8_20", "8_21"]),
        ("knotopt show 7", [f"7_{k}" for k in range(1, 8)] + ["7 Var1", "7 Var2"]),
        ("knotopt show granny", ["granny"]),
        ("knotopt compare 3_1 6_", ["6_1", "6_2", "6_3"]),
        ("knotopt topology 3_", ["3_1"]),
        ("knotopt show 3 --cut ", OUTER),
        ("knotopt lcf 3 --cut ", ["best", "all", *OUTER]),
        ("knotopt path 3 --cut b", ["best"]),
        ("knotopt solve 3 --cut a", ["all"]),
        ("knotopt fly 3 --cut a", [""]),
        ("knotopt solve 3 --solver ", [*BACKENDS]),
        ("knotopt atlas run --solvers highs,", ["highs,cp-sat", "highs,scip", "highs,maxsat"]),
        ("knotopt solve 3 --formulation s", ["span"]),
        ("knotopt solve 3 --threading ", ["turning-point", "over-under"]),
        ("knotopt path 3 --method n", ["nlp"]),
        ("knotopt path 3 --supports l", ["lcf"]),
        ("knotopt fly 3 --schedule ", ["optimised", "fixed"]),
        ("knotopt topology 3_1 --goals ", ["one", "mirror", "orbit"]),
        ("knotopt topology 3_1 --rule p", ["paper", "public"]),
        ("knotopt prove 3 --method r", ["refutation"]),
        ("knotopt show 3 --format ", [*WRITTEN_FORMS]),
        ("knotopt show 3 --over ", ["columns", "rows"]),
        ("knotopt show 3 --as gr", ["grid_notation"]),
        ("knotopt to", ["topology"]),
    ],
)
def test_bash_completes(
    line: str,
    expected: list[str],
    capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    found = completed(line, capsys, monkeypatch)
    if "--solvers" in line:  # in any number
        assert {*expected} < {*found}
    else:
        assert found == expected


def test_every_command_completes(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    assert completed("knotopt ", capsys, monkeypatch) == [*COMMANDS]


def test_names_are_completed_whatever_their_letters() -> None:
    assert "trefoil" in knot_names("TRE")
