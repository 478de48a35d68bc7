"""Names in words: one knot each, facts that KnotInfo and the definitions confirm."""

from __future__ import annotations

from collections import Counter

import pytest

from knotopt.catalogue.everyday_names import everyday_names, plain
from knotopt.catalogue.knotinfo import knotinfo_knots
from knotopt.catalogue.knots import shipped_json, shipped_knots, unknot


def test_no_name_stands_twice_and_every_knot_exists() -> None:
    entries = shipped_json("everyday_names.json")
    counts = Counter(plain(name) for entry in entries for name in entry["names"])
    assert {name: count for name, count in counts.items() if count > 1} == {}
    for entry in entries:
        assert entry["source"]
        for factor in entry["knot"].split("#"):
            assert factor.removeprefix("m") in {unknot().name, *knotinfo_knots()}


@pytest.mark.parametrize(
    ("name", "knot"),
    [
        ("the Trefoil Knot", "3_1"),
        ("left handed trefoil", "m3_1"),
        ("figure-8", "4_1"),
        ("Figure of eight knot", "4_1"),
        ("SOLOMON\u2019S SEAL", "5_1"),
        ("Kinoshita\u2013Terasaka knot", "11n_42"),
        ("unknot", "0_1"),
        ("square knot", "3_1#m3_1"),
    ],
)
def test_names_are_found_however_written(name: str, knot: str) -> None:
    assert everyday_names()[plain(name)].knot == knot


def test_the_right_handed_trefoil_is_positive() -> None:
    """The signature of a positive knot is negative in KnotInfo's sign."""
    assert shipped_knots()["3_1"].signature == -2


@pytest.mark.parametrize(("name", "genus"), [("conway", 3), ("kinoshitaterasaka", 2)])
def test_which_of_two_mutants(name: str, genus: int) -> None:
    """They have trivial Alexander polynomials and are told apart by their genus."""
    from database_knotinfo import link_list

    knot = everyday_names()[name].knot
    assert knotinfo_knots()[knot].alexander == (1,)
    (row,) = (row for row in link_list() if row["name"] == knot)
    assert int(row["three_genus"]) == genus
