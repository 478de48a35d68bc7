"""Programs without knots: instances, their files, solvers, and what is done with answers."""

from __future__ import annotations

import json
import subprocess
import sys
from dataclasses import replace
from itertools import combinations, count, product
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from pysat.examples.rc2 import RC2
from pysat.formula import WCNF

from formulations import solution
from formulations.backends import BACKENDS, get_backend
from formulations.backends.cp_sat import CpSat
from formulations.backends.exhaustive import Exhaustive
from formulations.canonical import lexicographically_first
from formulations.cnf import at_least, at_most, clauses
from formulations.export import to_mps, to_opb, to_wcnf
from formulations.infeasible import conflict
from formulations.instance import Instance, InstanceError, Row
from formulations.proof import refute
from formulations.solution import Answer, BackendError, Feature, Limits, Status, checked
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


COVER = Instance(
    "edges of a triangle",
    ("a", "b", "c"),
    3,
    (1, 1, 1),
    tuple(Row(edge, 1, "cover", str(edge)) for edge in ((1, 2), (2, 3), (1, 3))),
)


def test_a_wrong_answer_is_an_error() -> None:
    """Whatever a solver says of a set that violates a row."""
    for said in (Status.OPTIMAL, Status.FEASIBLE):
        wrong = Answer(said, "kOptimal", [1, 0, 0], bound=1.0)
        found = checked(wrong, COVER, Limits(), build_seconds=0, solver="")
        assert (found.status, found.chosen, found.objective) == (Status.ERROR, None, None)
        assert "violates cover: (2, 3)" in found.raw_status
        none = checked(Answer(said, "ok"), COVER, Limits(), build_seconds=0, solver="")
        assert none.status is Status.ERROR
    unproven = Answer(Status.OPTIMAL, "gap limit", [1, 1, 1], bound=1.2)
    found = checked(unproven, COVER, Limits(), build_seconds=0, solver="")
    assert (found.status, found.objective, found.bound) == (Status.FEASIBLE, 3, 2)
    proven = Answer(Status.FEASIBLE, "time limit", [1, 1, 0], bound=1.2)
    found = checked(proven, COVER, Limits(), build_seconds=0, solver="")
    assert (found.status, found.gap) == (Status.OPTIMAL, 0)


@pytest.mark.parametrize(
    ("seconds", "spent", "interrupted"),
    [(None, 1, True), (10, 1, True), (10, 9.5, False), (1e-3, 2e-4, False)],
)
def test_stopped_early_without_a_limit(
    seconds: float | None, spent: float, interrupted: bool
) -> None:
    answer = Answer(Status.UNKNOWN, "stopped", solve_seconds=spent)
    found = checked(answer, COVER, Limits(seconds), build_seconds=0, solver="")
    assert found.interrupted is interrupted


def test_instances_that_need_no_solver() -> None:
    """Without rows, or with one that has too few literals: all solvers say the same."""
    impossible = replace(COVER, rows=(*COVER.rows, Row((1,), 2, "two of one", "a")))
    for name in BACKENDS:
        found = get_backend(name).solve(impossible, Limits())
        assert (found.status, found.bound) == (Status.INFEASIBLE, None)
        assert "two of one: a" in found.raw_status
        empty = get_backend(name).solve(replace(COVER, rows=()), Limits())
        assert (empty.status, empty.chosen, empty.bound) == (Status.OPTIMAL, (), 0)


def test_starts() -> None:
    for start, accepted in (((1, 2), True), ((1,), False)):
        found = get_backend("cp-sat").solve(replace(COVER, start=start), Limits())
        assert found.start_accepted is accepted and found.objective == 2
    assert get_backend("cp-sat").solve(COVER, Limits()).start_accepted is None
    assert get_backend("highs").solve(replace(COVER, start=(1, 2)), Limits()).start_accepted is None


def hard_instance() -> Instance:
    """Random covers that no solver here finishes within a minute."""
    import random

    source = random.Random(1)
    rows = tuple(
        Row(tuple(source.sample(range(1, 201), 3)), 1, "cover", str(k)) for k in range(900)
    )
    names = tuple(f"x{j}" for j in range(200))
    return Instance("hard", names, 200, (1,) * 200, rows, start=tuple(range(1, 201)))


@pytest.mark.parametrize("name", ["cp-sat", "highs", "scip", "maxsat"])
def test_a_time_limit_gives_what_is_known(name: str) -> None:
    found = get_backend(name).solve(hard_instance(), Limits(seconds=1, seed=3))
    assert found.status is Status.FEASIBLE and found.chosen is not None
    assert found.objective is not None and found.bound is not None
    assert found.bound < found.objective and 0 < (found.gap or 0) <= 1
    assert found.seed == 3 and found.raw_status


@pytest.mark.slow
@pytest.mark.parametrize("name", ["cp-sat", "highs", "scip", "maxsat"])
def test_ctrl_c_gives_the_best_so_far(name: str, tmp_path: Path) -> None:
    file = tmp_path / "hard.json"
    file.write_text(hard_instance().to_json())
    code = (
        "import os, subprocess\n"
        "from formulations.backends import get_backend\n"
        "from formulations.instance import Instance\n"
        "from formulations.solution import Limits\n"
        f"instance = Instance.from_json(open({str(file)!r}).read())\n"
        f"backend = get_backend({name!r})\n"
        "subprocess.Popen(f'sleep 2; kill -INT {os.getpid()}', shell=True)\n"
        "found = backend.solve(instance, Limits(seconds=60))\n"
        "print(found.status, found.objective, found.solve_seconds < 30)\n"
    )
    run = subprocess.run(
        [sys.executable, "-c", code], capture_output=True, text=True, check=False, timeout=120
    )
    last = run.stdout.splitlines()[-1].split()
    assert last[0] == "feasible" and int(last[1]) > 0 and last[2] == "True", run


def test_what_makes_no_sense_is_refused() -> None:
    for limits, message in (
        ({"seconds": 0}, "time limit"),
        ({"gap": 1}, "gap"),
        ({"threads": 0}, "threads"),
        ({"seed": -1}, "seed"),
    ):
        with pytest.raises(BackendError, match=message):
            Limits(**limits)  # type: ignore[arg-type]
    with pytest.raises(BackendError, match="no solver is named 'gurobi'"):
        get_backend("gurobi")
    one = (Row((1, 2), 1, "cover", "12"),)
    wide = Instance("wide", tuple(map(str, range(23))), 23, (1,) * 23, one)
    with pytest.raises(BackendError, match="at most 22 variables; this instance has 23"):
        Exhaustive().solve(wide, Limits())
    with pytest.raises(BackendError, match="one weight"):
        Exhaustive().solve(replace(COVER, objective=(1, 2, 1)), Limits())


def test_a_missing_solver_is_named(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("importlib.util.find_spec", lambda _: None)
    for name, package, extra in (("scip", "pyscipopt", "scip"), ("maxsat", "python-sat", "sat")):
        with pytest.raises(solution.MissingSolverError) as caught:
            get_backend(name)
        assert (caught.value.package, caught.value.extra) == (package, extra)
    with pytest.raises(solution.MissingSolverError, match="cadical"):
        refute([(1,), (-1,)])


def test_features() -> None:
    assert get_backend("cp-sat").features == set(Feature)
    assert Feature.START not in get_backend("highs").features
    assert {n for n in BACKENDS if Feature.ENUMERATION in get_backend(n).features} == {
        "cp-sat",
        "exhaustive",
    }


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"objective": (1, 1)}, "2 weights for 3 variables"),
        ({"objective": (1, 1, -1)}, "found -1"),
        ({"decisions": 2}, "2 decisions and 0 definitions"),
        ({"rows": (Row((4,), 1, "f", "o"),)}, r"row 1 \(f\): a literal names no variable"),
        ({"rows": (Row((1, -1), 1, "f", "o"),)}, r"row 1 \(f\): a variable stands there twice"),
        ({"decisions": 2, "definitions": ((3,),)}, "variable 3 is not defined by earlier ones"),
        ({"start": (4,)}, "4 is no decision variable"),
    ],
)
def test_bad_instances(change: dict[str, object], message: str) -> None:
    with pytest.raises(InstanceError, match=message):
        replace(COVER, **change)  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("{", "not JSON: line 1"),
        ("[]", "not an instance"),
        (COVER.to_json()[:-2], "not JSON"),
        (COVER.to_json().replace('"rows"', '"row"'), "key 'rows' is missing"),
        (COVER.to_json().replace('"decisions":3', '"decisions":"x"'), "wrong kind"),
        (COVER.to_json().replace('"decisions":3', '"decisions":4'), "4 decisions"),
        (COVER.to_json().replace('"at_least":1', '"at_least":1.5'), "1.5 is no integer"),
        (COVER.to_json().replace('"literals":[1,2]', '"literals":"12"'), "'12' is no list"),
    ],
)
def test_bad_files(text: str, message: str) -> None:
    with pytest.raises(InstanceError, match=message):
        Instance.from_json(text)


def test_solvers_share_a_process_in_either_order() -> None:
    for order in (("cp-sat", "highs", "scip"), ("scip", "highs", "cp-sat")):
        code = (
            "from formulations.backends import get_backend\n"
            "from formulations.instance import Instance\n"
            "from formulations.solution import Limits\n"
            f"instance = Instance.from_json({COVER.to_json()!r})\n"
            f"print([get_backend(n).solve(instance, Limits()).objective for n in {order!r}])\n"
        )
        run = subprocess.run(
            [sys.executable, "-c", code],
            capture_output=True,
            text=True,
            check=True,
        )
        assert json.loads(run.stdout) == [2, 2, 2]
