"""Formulation `loops`, and the others with loops: optima by trying all sets, proofs, theory."""

from __future__ import annotations

import json
from collections import Counter
from itertools import chain
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from formulations.backends import get_backend
from formulations.loops import pierce
from formulations.solution import Limits
from knotopt.cable.cable import Cable
from knotopt.cable.cut import OUTER_CUTS, Cut, crossing_free_cuts
from knotopt.catalogue.knots import shipped_knots
from knotopt.catalogue.table1_grids import table1_grids
from knotopt.diagram.families import random_knot, torus_knot
from knotopt.diagram.grid import GridDiagram
from knotopt.diagram.moves import Symmetry, transform
from knotopt.errors import CertificateError, RequirementError
from knotopt.reading.knot import read_knot
from knotopt.supports.certificate import prove
from knotopt.supports.loops import disjoint_loops, loop_stretches
from knotopt.supports.minimal import minimal_supports
from knotopt.supports.requirements import Requirements
from knotopt.supports.search import best_supports
from knotopt.verify.certificate import check_certificate
from knotopt.verify.loops import check_loops
from tests.helpers.every_set import fewest_by_trying_all
from tests.helpers.strategies import cables, diagrams

ROOT = Path(__file__).parents[2]
LOOPS = Requirements("loops")
SAFE = Requirements("span", 0.25)
WITH_LOOPS = (LOOPS, SAFE, Requirements("opening", with_loops=True))


def examined(cable: Cable, supports: tuple[int, ...]) -> bool:
    return check_loops(cable.path, cable.diagram.size, supports).is_open


def by_cut(diagram: GridDiagram) -> list[int]:
    """Robots on each outer cut."""
    return [2 + len(disjoint_loops(Cable(diagram, cut))) for cut in OUTER_CUTS]


@settings(max_examples=25)
@given(cables(max_size=6), st.sampled_from(WITH_LOOPS))
def test_the_smallest_by_trying_all(cable: Cable, asked: Requirements) -> None:
    result = minimal_supports(cable, asked, canonical=False)
    assert result.is_proven and result.robots == fewest_by_trying_all(cable, asked)


@pytest.mark.slow
@pytest.mark.parametrize("asked", WITH_LOOPS, ids=lambda asked: asked.words)
def test_the_smallest_of_larger_grids_by_trying_all(asked: Requirements) -> None:
    for seed in range(20):
        diagram = random_knot(7 + seed % 3, seed)
        cuts = crossing_free_cuts(diagram)
        cable = Cable(diagram, cuts[seed % len(cuts)])
        result = minimal_supports(cable, asked, canonical=False)
        assert result.is_proven and result.robots == fewest_by_trying_all(cable, asked)


@settings(max_examples=60)
@given(cables())
def test_as_many_loops_share_no_turning_point(cable: Cable) -> None:
    result = minimal_supports(cable, LOOPS)
    assert result.is_proven and result.canonical and examined(cable, result.supports)
    loops = result.disjoint_loops
    assert len(loops) == len(result.supports)
    stretches = loop_stretches(cable)
    points = [range(stretches[k].first, stretches[k].last + 1) for k in loops]
    every = list(chain(*points))
    assert len(every) == len({*every}) and all(map(list, points))


@settings(max_examples=40)
@given(cables(max_size=8), st.data())
def test_a_set_is_piercing_exactly_if_no_crossing_lies_on_one_span(
    cable: Cable, data: st.DataObject
) -> None:
    count = len(cable.path)
    supports = data.draw(st.sets(st.integers(2, count - 1)))
    held = [cable.times[k - 1] for k in (1, *sorted(supports), count)]

    def span(time: int) -> int:
        return sum(time > robot for robot in held)

    crossed = [span(c.first) != span(c.second) for c in cable.crossings]
    report = check_loops(cable.path, cable.diagram.size, supports)
    assert report.is_open == all(crossed)
    assert list(report.closed_regions) == [k for k, kept in enumerate(crossed) if not kept]


@settings(max_examples=30)
@given(diagrams(max_size=8))
def test_symmetries_reversal_and_the_names_of_cuts(diagram: GridDiagram) -> None:
    expected = by_cut(diagram)
    assert expected[0::2] == expected[1::2]  # both directions of a cut
    assert Counter(by_cut(diagram.reversed)) == Counter(expected)
    for symmetry in Symmetry:
        assert Counter(by_cut(transform(diagram, symmetry))) == Counter(expected)


@settings(max_examples=4)
@given(diagrams(min_size=4, max_size=6), st.sampled_from(WITH_LOOPS[1:]))
def test_symmetries_of_the_square_with_loops(diagram: GridDiagram, asked: Requirements) -> None:
    def robots(of: GridDiagram) -> Counter[int]:
        cuts = (Cable(of, cut) for cut in OUTER_CUTS)
        return Counter(minimal_supports(cable, asked, canonical=False).robots for cable in cuts)

    expected = robots(diagram)
    for symmetry in Symmetry:
        assert robots(transform(diagram, symmetry)) == expected


def test_table1_on_every_outer_cut() -> None:
    preferred = [grid for grid in table1_grids() if grid.preferred]
    assert [{*by_cut(grid.diagram)} for grid in preferred] == [{3}, {3}, {3}, {3}, {4}, {3}]


@pytest.mark.slow
def test_table1_is_as_safe_without_loops() -> None:
    for grid in (grid for grid in table1_grids() if grid.preferred):
        with_loops, without = (
            best_supports(grid.diagram, Requirements("span", with_loops=loops)).best.robots
            for loops in (True, False)
        )
        assert with_loops == without


def test_all_knots_of_the_catalogue() -> None:
    """1,992 pairs of a knot and an outer cut: a set, and as many disjoint loops."""
    best = []
    for knot in shipped_knots().values():
        sizes = []
        for name in OUTER_CUTS:
            cable = Cable(knot.diagram, name)
            supports = pierce(loop_stretches(cable))
            assert len(disjoint_loops(cable)) == len(supports) and examined(cable, supports)
            sizes.append(len(supports) + 2)
        best.append(min(sizes))
    assert Counter(best) == {3: 18, 4: 112, 5: 100, 6: 18, 7: 1}
    assert round(sum(best) / len(best), 2) == 4.49


def test_it_is_no_bound_for_the_knot() -> None:
    """Stored flights of 1,280 sets: some tie that lay another diagram than the grid's."""
    lines = (ROOT / "benchmarks/results/physics_subsets.jsonl").read_text().splitlines()[1:]
    seen: Counter[tuple[bool, bool]] = Counter()
    for row in map(json.loads, lines):
        case = row["case"]
        cable = Cable(read_knot(case["row"]).diagram, case["cut"])
        seen[examined(cable, case["supports"]), row["result"]["tied"]] += 1
    assert seen == {(True, True): 604, (True, False): 508, (False, True): 4, (False, False): 164}


@pytest.mark.slow
def test_one_support_off_a_loop_ties_the_trefoil() -> None:
    """R+ {8} of Table I's row 3, flown: its lost crossing is not needed."""
    pytest.importorskip("mujoco")
    from knotopt.flight.planner import plan_flight
    from knotopt.sim.trials import fly_trial

    cable = Cable(read_knot("3").diagram, "R+")
    assert not examined(cable, (8,))
    plan = plan_flight("3_1", cable, (8,), "file", schedule="optimised")
    assert fly_trial(plan).is_tied


def test_wishes_of_a_team_are_met_by_solvers() -> None:
    cable = Cable(read_knot("7 Var2").diagram, "L+")
    plain = minimal_supports(cable, LOOPS)
    assert plain.solution.solver == "sweep" and plain.supports == (9, 14)
    asked: tuple[dict[str, Any], ...] = (
        {"separation": 1.5},
        {"payload": 6.0},
        {"forbidden": (9,)},
        {"forced": (2,)},
        {"reach": 4.0},
        {"max_robots": 5},
        {"excluded": ((9, 14),)},
    )
    for wishes in asked:
        found = {
            solver: minimal_supports(cable, Requirements("loops", **wishes), solver=solver)
            for solver in ("cp-sat", "highs")
        }
        assert len({each.supports for each in found.values()}) == 1
        for each in found.values():
            assert each.is_proven and examined(cable, each.supports)
            assert each.solution.solver != "sweep"
    none = minimal_supports(cable, Requirements("loops", max_robots=3))
    assert not none.found and ("at most", "3 robots") in none.conflict
    assert {family for family, _ in none.conflict} == {"at most", "ends", "loops"}


def test_a_cut_that_is_no_better_is_passed_over() -> None:
    search = best_supports(read_knot("10_123").diagram, LOOPS)
    assert search.is_proven and search.bound == search.best.robots == 6
    assert [outcome.robots for outcome in search.outcomes[1:]] == [None] * 9
    unknot = minimal_supports(Cable(torus_knot(1, 2), "L+"), LOOPS)
    assert unknot.supports == () == unknot.disjoint_loops and unknot.robots == 2


def test_with_loops_is_asked_for_or_not() -> None:
    assert Requirements("span").with_loops and Requirements("span").words == "span with loops"
    assert not Requirements("opening").with_loops and not LOOPS.with_loops
    assert Requirements("loops", with_loops=True) == LOOPS  # which has these rows anyway
    cable = Cable(read_knot("4").diagram, "L+")
    for name in ("opening", "span"):
        plain = minimal_supports(cable, Requirements(name, with_loops=False))
        added = minimal_supports(cable, Requirements(name, with_loops=True))
        assert plain.disjoint_loops == () and added.disjoint_loops == disjoint_loops(cable)
        assert added.robots >= plain.robots and examined(cable, added.supports)
        families = {row.family for row in added.instance.rows}
        assert families == {row.family for row in plain.instance.rows} | {"loops"}
        extra = len(added.instance.rows) - len(plain.instance.rows)
        assert extra == len(cable.crossings)
        assert added.report.is_open
    bare = minimal_supports(cable, Requirements("opening"))
    assert not examined(cable, bare.supports) and bare.report.is_open


@pytest.fixture(scope="module")
def certificate() -> str:
    return prove("7_6", read_knot("7 Var2").diagram, LOOPS)


def _changed(text: str, **bound: Any) -> str:
    content = json.loads(text)
    content["bounds"][0] |= bound
    return json.dumps(content)


def test_certificates_of_disjoint_loops(certificate: str) -> None:
    verdict = check_certificate(certificate)
    assert (verdict.formulation, verdict.robots, verdict.every_cut) == ("loops", 4, True)
    content = json.loads(certificate)
    assert {bound["method"] for bound in content["bounds"]} == {"disjoint loops"}
    loops = content["bounds"][0]["loops"]
    assert loops == [[4, 6], [6, 2]]
    for wrong, message in (
        (loops[1:], "loops: 1 need no 2 supports"),
        ([loops[0], *loops], r"those at \[4, 6\] and \[4, 6\] share p3"),
        ([[1, 1], *loops], r"\[1, 1\] is no crossing"),
        ([[4], *loops], r"\[4\] is no crossing"),
        ([["4", 6], *loops], "no integer"),
        (3, "not of type list"),
    ):
        with pytest.raises(CertificateError, match=message):
            check_certificate(_changed(certificate, loops=wrong))
    moved = json.loads(certificate)
    moved["supports"] = [2, 3]
    with pytest.raises(CertificateError, match=r"the set is not open: loop \[.*no support on it"):
        check_certificate(json.dumps(moved))


@pytest.mark.parametrize("method", ["disjoint loops", "refutation", "count"])
def test_three_kinds_of_proof(method: str) -> None:
    verdict = check_certificate(prove("3_1", read_knot("3").diagram, LOOPS, method=method))
    assert verdict.robots == 3


def test_certificates_with_loops_say_so() -> None:
    """A bound of sets with loops proves nothing of sets without, and the other way round."""
    diagram = read_knot("4").diagram
    asked, cuts = Requirements("opening", with_loops=True), [Cut.parse("L+", diagram.size)]
    for method in ("refutation", "count"):
        text = prove("4_1", diagram, asked, cuts=cuts, method=method)
        verdict = check_certificate(text)
        assert verdict.with_loops and verdict.robots == 6
        content = json.loads(text)
        assert content.pop("with") == "loops"
        message = "does not follow" if method == "refutation" else "smaller set"
        with pytest.raises(CertificateError, match=message):
            check_certificate(json.dumps(content))
        for wrong, message in (("none", "only loops"), (1, "not of type str")):
            with pytest.raises(CertificateError, match=message):
                check_certificate(json.dumps(content | {"with": wrong}))
    plain = json.loads(prove("4_1", diagram, Requirements("opening"), cuts=cuts))
    assert "with" not in plain and not check_certificate(json.dumps(plain)).with_loops
    with pytest.raises(CertificateError, match=r"not open: loop"):
        check_certificate(json.dumps(plain | {"with": "loops"}))
    with pytest.raises(RequirementError, match="is proven by refutation or count"):
        prove("4_1", diagram, asked, method="disjoint loops")


def test_every_optimum_of_the_relaxation_is_a_number_of_robots() -> None:
    from formulations.loops import relaxation
    from knotopt.supports.loops import compile_loops
    from knotopt.supports.regions import Regions

    for name in ("7_4", "9_35", "10_123"):
        for cut in OUTER_CUTS:
            program = compile_loops(Regions(Cable(shipped_knots()[name].diagram, cut)))
            value = relaxation(program)[0]
            assert value == pytest.approx(
                2 + len(disjoint_loops(Cable(shipped_knots()[name].diagram, cut)))
            )
            solution = get_backend("highs").solve(program.instance(), Limits())
            assert solution.objective == round(value)
