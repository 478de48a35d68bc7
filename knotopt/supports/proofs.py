"""Proofs that fewer robots are too few, made; `knotopt.verify.proofs` reads and checks them."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import count
from math import comb
from typing import Any

from formulations.canonical import Program
from formulations.cnf import Clause, at_most, clauses
from formulations.proof import Refutation, refute, refute_lazily
from formulations.span import Span, SpanProgram
from formulations.team import not_consecutive, stretch_literals
from knotopt.errors import CertificateError
from knotopt.supports.formulation import Claim
from knotopt.verify.proofs import MAX_COUNT


def by_counting(claim: Claim[Program]) -> dict[str, Any]:
    """Nothing but the word: the checker goes through all smaller sets.

    Raises
    ------
    CertificateError
        They are too many.
    """
    smaller = sum(comb(claim.instance.decisions - 2, k) for k in range(claim.robots - 2))
    if smaller > MAX_COUNT:
        raise CertificateError(
            f"{smaller} smaller sets are too many to count ({MAX_COUNT} at most)"
        )
    return {}


def by_refutation(claim: Claim[Program]) -> dict[str, Any]:
    """A refutation by CaDiCaL of the program's rows, all of them clauses.

    Raises
    ------
    MissingSolverError
        PySAT is not installed.
    CertificateError
        A smaller set exists.
    """
    given = [*clauses(claim.instance), *_counting(claim)]
    refutation = refute(given)
    return _content(claim, None if refutation is None else (given, refutation))


def by_refutation_of_spans(claim: Claim[SpanProgram]) -> dict[str, Any]:
    """The same of the clauses that paths of too few robots violate, each beside the spans that it
    excludes together.
    """
    points = claim.instance.decisions
    spans: dict[Clause, tuple[Span, ...]] = {}

    def violated(chosen: tuple[int, ...]) -> list[Clause]:
        found = {}
        for excluded in claim.program.excluded(chosen, float(claim.openness**2)):
            literals = {x for u, w in excluded for x in not_consecutive(u, w)}
            found[tuple(sorted(literals, key=abs))] = excluded
        spans.update(found)
        return list(found)

    loops = map(stretch_literals, claim.program.team.stretches)
    refuted = refute_lazily([(1,), (points,), *loops, *_counting(claim)], points, violated)
    content = _content(claim, refuted)
    excused = [spans.get(clause, ()) for clause in content["clauses"]]
    return {"clauses": content["clauses"], "spans": excused, "steps": content["steps"]}


def _counting(claim: Claim[Any]) -> list[Clause]:
    """At most one robot fewer."""
    points = claim.instance.decisions
    return list(at_most(range(1, points + 1), claim.robots - 1, count(points + 1)))


def _content(
    claim: Claim[Any], refuted: tuple[Sequence[Clause], Refutation] | None
) -> dict[str, Any]:
    if refuted is None:
        fewer = claim.robots - 1
        raise CertificateError(f"a set of {fewer} robots exists: {claim.robots} is not the minimum")
    given, refutation = refuted
    return {
        "clauses": [given[index] for index in refutation.needed],
        "steps": [[step.literals, step.hints] for step in refutation.steps],
    }
