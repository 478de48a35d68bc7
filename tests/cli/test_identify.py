"""`knotopt identify`, and what `show` says of a knot's name."""

from __future__ import annotations

from pathlib import Path

import pytest

from knotopt.identify import complements
from tests.helpers.command_line import Cli


def test_names_of_diagrams(cli: Cli) -> None:
    found = cli.json("identify", "T(3,-4)")
    assert (found["identified"], found["candidates"]) == ("m8_19", ["m8_19"])
    assert found["proven"] is True and found["amphicheiral"] is False
    assert found["signature"] == 6 and found["jones"] == [[-8, -1], [-5, 1], [-3, 1]]
    status, out, err = cli("identify", "T(3,-4)")
    assert (status, err) == (0, "")
    assert "knot           m8_19, by Alexander polynomial, signature, Jones polynomial and" in out
    assert "Jones          -t^-8 + t^-5 + t^-3" in out


def test_a_form_without_chirality_is_up_to_mirror(cli: Cli) -> None:
    _, out, _ = cli("identify", "DT: [(4, 6, 2)]")
    assert "3_1 or its mirror image, by" in out
    _, out, _ = cli("identify", "DT: [(4, 6, 8, 2)]")
    assert "4_1, by" in out, "4_1 is its own mirror image"
    assert cli.json("identify", "trefoil")["up_to_mirror_image"] is True


@pytest.mark.parametrize("knot", ["trefoil", "DT: [(4, 6, 2)]"])
def test_mirroring_decides_nothing_that_is_open(cli: Cli, knot: str) -> None:
    status, out, err = cli("identify", knot, "--mirror")
    assert (status, err) == (0, "") and "m3_1 or its mirror image, by" in out
    assert cli.json("identify", knot, "--mirror")["up_to_mirror_image"] is True


TWO_TREFOILS = ["3_1#3_1", "3_1#m3_1", "m3_1#m3_1"]


@pytest.mark.parametrize("knot", ["DT: [(4, 6, 2, 10, 12, 8)]", "trefoil#trefoil"])
@pytest.mark.parametrize("options", [(), ("--mirror",)])
def test_every_hand_of_every_summand_is_named(
    cli: Cli, knot: str, options: tuple[str, ...]
) -> None:
    found = cli.json("identify", knot, *options)
    assert sorted(found["candidates"]) == TWO_TREFOILS
    assert found["identified"] is None and found["proven"] and found["amphicheiral"] is False
    _, out, _ = cli("identify", knot, *options)
    assert "or its mirror image," not in out.split("\nknot", 1)[1]
    assert "proven         yes, that it is one of these" in out
    shown = cli.json("show", knot, *options)["identified"]
    assert sorted(shown["candidates"]) == TWO_TREFOILS


def test_summands_that_are_certain_stay_so(cli: Cli) -> None:
    assert cli.json("identify", "trefoil#m3_1")["candidates"] == ["3_1#m3_1", "m3_1#m3_1"]
    _, out, _ = cli("identify", "trefoil#4_1")
    assert "3_1#4_1 or its mirror image, by" in out
    _, out, _ = cli("identify", "granny")
    assert "3_1#3_1 or its mirror image, by" in out
    assert cli.json("identify", "3_1#m3_1")["identified"] == "3_1#m3_1"


def test_names_given_are_said(cli: Cli) -> None:
    found = cli.json("identify", "8_18")
    assert found["proven"] is False and found["given_name"] == "8_18"
    for name in ("8_18", "m8_18"):
        assert "proven         by name: it was asked for as 8_18" in cli("identify", name)[1]
    assert cli.json("identify", "trefoil")["given_name"] is None
    _, out, _ = cli("identify", "T(12,13)")
    assert "knot           T(12,13), by name; too many crossings to compare" in out


def test_a_code_of_few_crossings_is_compared_as_it_is(cli: Cli) -> None:
    code = "PD[X[1,4,2,5], X[3,8,4,9], X[9,12,10,13], X[13,17,14,16], X[5,15,6,14], X[15,7,16,6], "
    code += "X[11,18,12,1], X[17,10,18,11], X[7,2,8,3]]"
    found = cli.json("identify", code)
    assert found["crossings"] == 9 and found["proven"] is True
    mirror = cli.json("identify", code, "--mirror")
    assert mirror["identified"].removeprefix("m") == found["identified"].removeprefix("m")
    assert mirror["identified"] != found["identified"]


def test_the_unknot_and_a_knot_in_no_table(cli: Cli) -> None:
    _, out, _ = cli("identify", "unknot")
    assert "0_1, by grid of size 2" in out and "proven         yes" in out
    _, out, _ = cli("identify", "T(4,5)")
    assert "knot           T(4,5), by name; no knot of up to 13 crossings\n" in out
    assert "proven" not in out
    braid = f"BR[4, {{{', '.join(['1, 2, 3'] * 5)}}}]"
    _, out, _ = cli("identify", braid)
    assert "knot           no knot of up to 13 crossings\n" in out


def test_too_large_a_diagram_is_said_to_be(cli: Cli, tmp_path: Path) -> None:
    from knotopt.diagram.families import torus_knot

    path = tmp_path / "large.json"
    path.write_text(str([list(mark) for mark in torus_knot(12, 13).marks]))
    status, out, _ = cli("identify", path)
    assert status == 0 and "too many crossings to compare" in out
    assert "Alexander      not computed" in out and "Jones          not computed" in out


def test_proofs(cli: Cli, monkeypatch: pytest.MonkeyPatch) -> None:
    pytest.importorskip("snappy")
    plain, proven = cli.json("identify", "10_71"), cli.json("identify", "10_71", "--prove")
    assert plain["identified"] == proven["identified"] == "10_71"
    assert proven["proven"] is True and "isometry of complements" in proven["by"]
    monkeypatch.setattr(complements.importlib.util, "find_spec", lambda _: None)
    status, _, err = cli("identify", "10_71", "--prove")
    assert status == 1 and "pip install 'knotopt[snappy]'" in err


def test_show_names_what_was_not_asked_for_by_name(cli: Cli) -> None:
    _, out, _ = cli("show", "3")
    assert "identified      3_1, by Alexander polynomial" in out and "signature       -2" in out
    assert cli.json("show", "8_19")["identified"] is None
    shown = cli.json("show", "m3_1")
    assert shown["identified"]["identified"] == "m3_1" and shown["signature"] == 2
    _, out, _ = cli("show", "stevedore")
    assert "read as         name: stevedore is 6_1 or its mirror image" in out
