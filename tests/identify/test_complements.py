"""SnapPy's isometries decide what invariants leave open: mutants, and their mirror images."""

from __future__ import annotations

import pytest

from knotopt.catalogue.knotinfo import knotinfo_knots
from knotopt.diagram.families import random_knot, torus_knot
from knotopt.identify import complements
from knotopt.identify import identify as identify_module
from knotopt.identify.complements import are_isometric, is_unknot
from knotopt.planar.from_grid import planar_diagram
from tests.helpers.random_moves import moved_about

pytest.importorskip("snappy")

NOT_HYPERBOLIC = {"", "0_1", "3_1", "5_1", "7_1", "8_19", "9_1", "10_124", "11a_367", "13a_4878"}


def test_mutants_and_mirror_images() -> None:
    first = knotinfo_knots()["12n_56"].diagram
    moved = planar_diagram(moved_about(first, 1))
    for name in ("12n_56", "12n_57"):
        planar = planar_diagram(knotinfo_knots()[name].diagram)
        assert are_isometric(moved, planar) == (name == "12n_56")
        assert not are_isometric(moved, planar.mirrored)


def test_the_unknot_by_knot_floer_homology() -> None:
    unknots = [planar_diagram(moved_about(torus_knot(1, 4), seed, 2)) for seed in range(3)]
    assert max(len(planar.crossings) for planar in unknots) > 2
    assert all(map(is_unknot, unknots))
    assert not is_unknot(planar_diagram(knotinfo_knots()["11n_34"].diagram))


def test_torus_knots_have_no_hyperbolic_complement() -> None:
    planar = planar_diagram(knotinfo_knots()["8_19"].diagram)
    assert not are_isometric(planar, planar)


def test_what_is_left_with_and_without(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(identify_module, "IF_NEEDED", {})
    diagram = moved_about(knotinfo_knots()["12n_57"].diagram.mirrored, 2)
    found = identify_module.identify(diagram)
    assert found.name == "m12n_57" and found.proven
    assert found.by[-1] == "isometry of complements"
    monkeypatch.setattr(complements, "is_installed", lambda: False)
    found = identify_module.identify(diagram)
    assert "m12n_57" in found.candidates and len(found.candidates) > 1
    assert found.name is None and not found.proven


@pytest.mark.parametrize(
    "seeds", [range(12), pytest.param(range(12, 60), marks=pytest.mark.slow)], ids=["few", "many"]
)
def test_names_of_random_knots_are_right(seeds: range) -> None:
    """Hyperbolic complements of what is named, as SnapPy sees them; the names came without it."""
    named = 0
    for seed in seeds:
        diagram = random_knot(18, seed)
        found = identify_module.identify(diagram)
        name = found.name or ""
        if "#" in name or name.removeprefix("m") in NOT_HYPERBOLIC:
            continue
        knot = knotinfo_knots()[name.removeprefix("m")].diagram
        knot = knot.mirrored if name.startswith("m") else knot
        assert are_isometric(planar_diagram(diagram), planar_diagram(knot)), (seed, name)
        named += 1
    assert named > len(seeds) / 8
