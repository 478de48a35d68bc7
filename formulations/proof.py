"""Refutations: why a set of clauses has no solution, step by step.

CaDiCaL (by PySAT) finds the refutation; it is then trimmed to the steps that matter, each with the
clauses that make it follow by unit propagation (the LRAT format, Cruz-Filipe et al. 2017,
doi:10.1007/978-3-319-63046-5_14), so that a checker needs no search.
"""

from __future__ import annotations

import importlib.util
from collections import defaultdict
from collections.abc import Callable, Sequence
from dataclasses import dataclass

from formulations.cnf import Clause
from formulations.solution import BackendError, MissingSolverError


@dataclass(frozen=True)
class Step:
    """A clause that follows from earlier ones.

    `hints` are indices of those: of the given clauses from 0 on, then of the steps before. Under
    the negation of `literals`, each in turn has one literal left, the last one none.
    """

    literals: Clause
    hints: tuple[int, ...]


@dataclass(frozen=True)
class Refutation:
    """The given clauses that are needed, as indices, and steps that end with the empty clause.

    Hints count the needed clauses from 0 on in the order of `needed`, then the steps.
    """

    needed: tuple[int, ...]
    steps: tuple[Step, ...]


def refute(clauses: Sequence[Clause]) -> Refutation | None:
    """A refutation of the clauses; None if they have a solution.

    Raises
    ------
    MissingSolverError
        PySAT is not installed.

    Examples
    --------
    >>> proof = refute([(1, 2), (-1, 2), (3,), (1, -2), (-1, -2)])
    >>> proof.needed, proof.steps[-1].literals
    ((0, 1, 3, 4), ())
    """
    _need_pysat()
    from pysat.solvers import Solver

    with Solver(name="cadical195", bootstrap_with=map(list, clauses), with_proof=True) as solver:
        if solver.solve():
            return None
        lines = solver.get_proof() or []
    lemmas = [
        tuple(int(word) for word in line.split()[:-1]) for line in lines if not line.startswith("d")
    ]
    return _trim(clauses, [*lemmas, ()])


def refute_lazily(
    clauses: Sequence[Clause],
    decisions: int,
    violated: Callable[[tuple[int, ...]], Sequence[Clause]],
) -> tuple[list[Clause], Refutation] | None:
    """A refutation of clauses that are too many to write down: those in the way are asked for.

    Parameters
    ----------
    clauses : sequence of clauses
        To begin with.
    decisions : int
        The solution shown to `violated` are the variables 1 ... `decisions` that are true.
    violated : callable
        A solution to clauses that it violates, none if it satisfies all.

    Returns
    -------
    all clauses used, and their refutation; None if there is a solution
    """
    _need_pysat()
    from pysat.solvers import Solver

    every = list(clauses)
    with Solver(name="cadical195", bootstrap_with=map(list, every)) as solver:
        while solver.solve():
            model = solver.get_model() or []
            chosen = tuple(j for j in model if 0 < j <= decisions)
            found = violated(chosen)
            if not found:
                return None
            every += found
            for clause in found:
                solver.add_clause(list(clause))
    refutation = refute(every)
    return None if refutation is None else (every, refutation)


def _need_pysat() -> None:
    if importlib.util.find_spec("pysat") is None:
        raise MissingSolverError("cadical", "python-sat", "sat")


def _trim(clauses: Sequence[Clause], lemmas: Sequence[Clause]) -> Refutation:
    """Keep what the empty clause rests on, with hints."""
    propagator = _Propagator()
    for clause in clauses:
        propagator.add(clause)
    hints: dict[int, tuple[int, ...]] = {}
    for lemma in lemmas:
        found = propagator.conflict(lemma)
        if found is None:
            raise BackendError(f"a step of the refutation does not follow: {lemma}")
        hints[len(propagator.clauses)] = found
        propagator.add(lemma)
        if not lemma:
            break
    goal = len(propagator.clauses) - 1
    wanted = {goal}
    for index in range(goal, len(clauses) - 1, -1):
        if index in wanted:
            wanted.update(hints[index])
    needed = sorted(index for index in wanted if index < len(clauses))
    kept = sorted(index for index in wanted if index >= len(clauses))
    number = {index: place for place, index in enumerate((*needed, *kept))}
    steps = tuple(
        Step(propagator.clauses[index], tuple(number[hint] for hint in hints[index]))
        for index in kept
    )
    return Refutation(tuple(needed), steps)


class _Propagator:
    """Unit propagation that remembers why."""

    def __init__(self) -> None:
        self.clauses: list[Clause] = []
        self.occurs: defaultdict[int, list[int]] = defaultdict(list)  # literal to clauses
        self.short: list[int] = []  # unit and empty clauses

    def add(self, clause: Clause) -> None:
        for literal in clause:
            self.occurs[literal].append(len(self.clauses))
        if len(clause) < 2:
            self.short.append(len(self.clauses))
        self.clauses.append(clause)

    def conflict(self, lemma: Clause) -> tuple[int, ...] | None:
        """Clauses that refute the lemma's negation, in the order in which they become unit."""
        reason: dict[int, int | None] = {-literal: None for literal in lemma}
        order: list[int] = []
        queue = list(reason)
        pending = list(self.short)
        while pending or queue:
            if not pending:
                pending = self.occurs[-queue.pop(0)][:]
            for index in pending:
                clause = self.clauses[index]
                unassigned = [literal for literal in clause if -literal not in reason]
                if len(unassigned) > 1 or any(literal in reason for literal in clause):
                    continue
                order.append(index)
                if not unassigned:
                    return self._needed(index, order, reason)
                reason[unassigned[0]] = index
                queue.append(unassigned[0])
            pending = []
        return None

    def _needed(
        self, last: int, order: list[int], reason: dict[int, int | None]
    ) -> tuple[int, ...]:
        wanted = {last}
        for index in reversed(order):
            if index in wanted:
                causes = (reason.get(-literal) for literal in self.clauses[index])
                wanted.update(cause for cause in causes if cause is not None)
        return tuple(index for index in order if index in wanted)
