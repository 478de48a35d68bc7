"""Programs without knots: instances, their files, solvers, and what is done with answers."""

from __future__ import annotations

from dataclasses import replace
from itertools import combinations, count, product
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from pysat.examples.rc2 import RC2
from pysat.formula import WCNF

from formulations.backends import BACKENDS, get_backend
from formulations.backends.cp_sat import CpSat
from formulations.backends.exhaustive import Exhaustive
from formulations.canonical import lexicographically_first
from formulations.cnf import at_least, at_most, clauses
from formulations.export import to_mps, to_opb, to_wcnf
from formulations.infeasible import conflict
from formulations.instance import Instance, Row
from formulations.proof import refute
from formulations.solution import Limits, Status
from knotopt.verify.lrat import RefutationError, check_refutation


@st.composite
def instances(draw: st.DrawFn, max_decisions: int = 7) -> Instance:
    """Small programs with rows of every kind and, now and then, defined variables."""
    decisions = draw(st.integers(2, max_decisions))
    literals = st.integers(1, decisions).flatmap(lambda j: st.sampled_from([j, -j]))
    definitions = tuple(
        tuple(draw(st.lists(literals, min_size=1, max_size=3, unique_by=abs)))
        for _ in range(draw(st.integers(0, 2)))
    )
    total = decisions + len(definitions)
    rows = []
    for number in range(draw(st.integers(1, 6))):
        signs = draw(st.lists(st.booleans(), min_size=total, max_size=total))
        chosen = sorted(draw(st.sets(st.integers(1, total), min_size=1)))
        row = tuple(j if signs[j - 1] else -j for j in chosen)
        rows.append(Row(row, draw(st.integers(0, len(row))), "random", f"row {number}"))
    for helper, definition in enumerate(definitions, decisions + 1):
        rows += [Row((-helper, x), 1, "definition", f"z{helper}") for x in definition]
        rows.append(Row((helper, *(-x for x in definition)), 1, "definition", f"z{helper}"))
    return Instance(
        "random",
        tuple(f"x{j}" for j in range(1, total + 1)),
        decisions,
        (1,) * decisions + (0,) * len(definitions),
        tuple(rows),
        definitions,
        tuple(draw(st.sets(st.integers(1, decisions)))),
    )


def by_brute_force(instance: Instance) -> set[tuple[int, ...]]:
    """All sets that satisfy the rows, row by row as they read."""
    found = set()
    for size in range(instance.decisions + 1):
        for chosen in combinations(range(1, instance.decisions + 1), size):
            true = {j: j in chosen for j in range(1, instance.decisions + 1)}
            for helper, definition in enumerate(instance.definitions, instance.decisions + 1):
                true[helper] = all(true[abs(x)] == (x > 0) for x in definition)
            if all(
                sum(true[abs(x)] == (x > 0) for x in row.literals) >= row.at_least
                for row in instance.rows
            ):
                found.add(chosen)
    return found


@settings(max_examples=60)
@given(instances())
def test_all_solvers_find_the_optimum(instance: Instance) -> None:
    sets = by_brute_force(instance)
    for name in BACKENDS:
        found = get_backend(name).solve(instance, Limits())
        if not sets:
            assert (found.status, found.chosen) == (Status.INFEASIBLE, None), name
            continue
        assert found.status is Status.OPTIMAL, (name, found)
        assert found.objective == found.bound == min(map(len, sets)) and found.gap == 0
        assert found.chosen in sets
        assert found.build_seconds >= 0 and found.solve_seconds > 0 and name in found.solver


@settings(max_examples=60)
@given(instances(), st.integers(1, 5))
def test_enumeration_lists_all_sets(instance: Instance, few: int) -> None:
    sets = by_brute_force(instance)
    for backend in (CpSat(), Exhaustive()):
        every = backend.enumerate(instance, Limits(), 1000)
        assert set(every.sets) == sets and every.complete
        assert list(every.sets) == sorted(every.sets)
        some = backend.enumerate(instance, Limits(), few)
        assert len(some.sets) == min(few, len(sets)) and set(some.sets) <= sets
        assert some.complete == (len(sets) <= few)


@settings(max_examples=100)
@given(instances())
def test_json_and_matrix(instance: Instance) -> None:
    again = Instance.from_json(instance.to_json())
    assert again.to_json() == instance.to_json() and again.hash == instance.hash
    sets = by_brute_force(instance)
    for size in range(instance.decisions + 1):
        for chosen in combinations(range(1, instance.decisions + 1), size):
            assert (not instance.violated(instance.complete(chosen))) == (chosen in sets)


@settings(max_examples=25)
@given(instances())
def test_other_solvers_read_the_files(instance: Instance) -> None:
    """MPS by HiGHS, OPB and MPS by SCIP, WCNF by RC2: the same optimum."""
    import tempfile

    import highspy
    import pyscipopt

    sets = by_brute_force(instance)
    optimum = min(map(len, sets)) if sets else None
    with tempfile.TemporaryDirectory() as folder:
        mps, opb = Path(folder) / "a.mps", Path(folder) / "a.opb"
        mps.write_text(to_mps(instance))
        opb.write_text(to_opb(instance))
        highs = highspy.Highs()
        highs.setOptionValue("output_flag", False)
        assert highs.readModel(str(mps)) == highspy.HighsStatus.kOk
        highs.run()
        if optimum is None:
            assert highs.getModelStatus() == highspy.HighsModelStatus.kInfeasible
        else:
            assert round(highs.getInfo().objective_function_value) == optimum
        for file in (mps, opb):
            model = pyscipopt.Model()
            model.hideOutput()
            model.readProblem(str(file))
            model.optimize()
            assert model.getStatus() == ("infeasible" if optimum is None else "optimal")
            assert optimum is None or round(model.getObjVal()) == optimum
    if all(clauses(instance)):
        with RC2(WCNF(from_string=to_wcnf(instance))) as maxsat:
            model = maxsat.compute()
            assert (model is None) == (optimum is None)
            assert optimum is None or maxsat.cost == optimum


@given(st.integers(1, 7), st.data())
def test_counting_clauses(length: int, data: st.DataObject) -> None:
    """Clauses hold for some auxiliary values exactly if the row does."""
    bound = data.draw(st.integers(0, length + 1))
    encodings = [(at_least(range(1, length + 1), bound, count(length + 1)), bound.__le__)]
    if 1 <= bound < length:
        encodings.append((at_most(range(1, length + 1), bound, count(length + 1)), bound.__ge__))
    for encoding, holds in encodings:
        found = list(encoding)
        for values in product((False, True), repeat=length):
            units = [(j if value else -j,) for j, value in enumerate(values, 1)]
            satisfiable = () not in found and refute([*found, *units]) is None
            assert satisfiable == holds(sum(values))


@given(instances())
def test_refutations(instance: Instance) -> None:
    given_clauses = list(clauses(instance))
    if () in given_clauses:
        return
    refutation = refute(given_clauses)
    assert (refutation is None) == bool(by_brute_force(instance))
    if refutation is None:
        return
    needed = [given_clauses[index] for index in refutation.needed]
    steps = [(step.literals, step.hints) for step in refutation.steps]
    check_refutation(needed, steps)
    assert refute(needed) is not None
    # Without its last step, with a clause less or a hint less, it proves nothing.
    with pytest.raises(RefutationError):
        check_refutation(needed, steps[:-1])
    for index in range(len(needed)):
        with pytest.raises(RefutationError):
            check_refutation([*needed[:index], (1, -1), *needed[index + 1 :]], steps)
    for number, (clause, hints) in enumerate(steps):
        with pytest.raises(RefutationError, match=f"step {number + 1} "):
            check_refutation(needed, [*steps[:number], (clause, hints[:-1]), *steps[number + 1 :]])


@settings(max_examples=60)
@given(instances())
def test_conflicts_are_smallest(instance: Instance) -> None:
    if by_brute_force(instance):
        return
    groups, sure = conflict(instance, get_backend(), Limits())
    assert sure

    def impossible(kept: set[tuple[str, str]]) -> bool:
        rows = tuple(row for row in instance.rows if (row.family, row.origin) in kept)
        found = list(clauses(replace(instance, rows=rows)))
        return () in found or refute(found) is not None

    assert impossible(set(groups))
    assert not any(impossible(set(groups) - {group}) for group in groups)


@settings(max_examples=60)
@given(instances())
def test_the_lexicographically_first_set(instance: Instance) -> None:
    sets = by_brute_force(instance)
    if not sets:
        return
    size = min(map(len, sets))
    smallest = sorted(chosen for chosen in sets if len(chosen) == size)
    for known in (smallest[0], smallest[-1]):
        found, sure = lexicographically_first(instance, get_backend(), Limits(), size, known)
        assert sure and found == smallest[0]
