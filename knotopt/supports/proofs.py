"""Proofs that fewer robots are too few, made; `knotopt.verify.proofs` reads and checks them."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import count
from math import comb
from typing import Any

from formulations.canonical import Program
from formulations.cnf import Clause, at_most, clauses
from formulations.proof import Refutation, refute, refute_lazily
from formulations.solution import MissingSolverError
from formulations.span import Span, SpanProgram
from formulations.team import not_consecutive
from knotopt.errors import CertificateError, MissingExtraError
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
    MissingExtraError
        PySAT is not installed.
    CertificateError
        A smaller set exists.
    """
    given = [*clauses(claim.instance), *_counting(claim)]
    try:
        refutation = refute(given)
    except MissingSolverError as error:
        raise _missing(error) from error
    return _content(claim, None if refutation is None else (given, refutation))[1]


def by_refutation_of_spans(claim: Claim[SpanProgram]) -> dict[str, Any]:
    """A refutation by CaDiCaL of the clauses that paths of too few robots violate.

    Beside each clause go the spans that it excludes together.

    Raises
    ------
    As `by_refutation`.
    """
    points = claim.instance.decisions
    spans: dict[Clause, tuple[Span, ...]] = {}

    def violated(chosen: tuple[int, ...]) -> list[Clause]:
        """Clauses that a path violates; which spans they speak of is kept."""
        found = {}
        for excluded in claim.program.excluded(chosen, float(claim.openness**2)):
            literals = {x for u, w in excluded for x in not_consecutive(u, w)}
            found[tuple(sorted(literals, key=abs))] = excluded
        spans.update(found)
        return list(found)

    try:
        refuted = refute_lazily([(1,), (points,), *_counting(claim)], points, violated)
    except MissingSolverError as error:
        raise _missing(error) from error
    needed, content = _content(claim, refuted)
    excused = [spans.get(clause, ()) for clause in needed]
    return {"clauses": content["clauses"], "spans": excused, "steps": content["steps"]}


def _counting(claim: Claim[Any]) -> list[Clause]:
    """At most one robot fewer."""
    points = claim.instance.decisions
    return list(at_most(range(1, points + 1), claim.robots - 1, count(points + 1)))


def _content(
    claim: Claim[Any], refuted: tuple[Sequence[Clause], Refutation] | None
) -> tuple[list[Clause], dict[str, Any]]:
    """The clauses needed, and what goes into the certificate."""
    if refuted is None:
        fewer = claim.robots - 1
        raise CertificateError(f"a set of {fewer} robots exists: {claim.robots} is not the minimum")
    given, refutation = refuted
    needed = [given[index] for index in refutation.needed]
    steps = [[step.literals, step.hints] for step in refutation.steps]
    return needed, {"clauses": needed, "steps": steps}


def _missing(error: MissingSolverError) -> MissingExtraError:
    return MissingExtraError(error.package, error.extra, "a refutation")
