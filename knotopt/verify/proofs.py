"""Proofs that fewer robots are too few, checked: by counting, and by refutation.

In a refutation of "at most m robots", variable j = 1 ... n says that p_j carries one. Variables
from n + 1 on count: variable (i, j) says that at least j of p_1 ... p_i do, for i = 1 ... n - 1 and
j = 1 ... min(i, m), numbered in that order.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from itertools import combinations
from math import comb
from typing import Any

from knotopt.errors import CertificateError
from knotopt.verify.definition import Checker, Claim, Proof, and_loops
from knotopt.verify.fields import field, integers
from knotopt.verify.lrat import RefutationError, check_refutation
from knotopt.verify.piercing import loop_clauses

MAX_COUNT = 20_000  # sets that a proof by counting may examine

Clauses = set[frozenset[int]]


def by_counting(check: Checker) -> Proof:
    """The proof that is no more than a word: every smaller set is examined."""

    def proof(claim: Claim, _: Mapping[str, Any]) -> None:
        points, sizes = len(claim.path), range(max(0, claim.robots - 2))
        smaller = sum(comb(points - 2, size) for size in sizes)
        if smaller > MAX_COUNT:
            raise CertificateError(f"{smaller} smaller sets are too many to examine")
        examine = and_loops(check) if claim.with_loops else check
        for size in sizes:
            for supports in combinations(range(2, points), size):
                if examine(claim.path, claim.size, supports, claim.openness, claim.mode).is_open:
                    raise CertificateError(f"the smaller set {supports} is open")

    return proof


def by_refutation(follow: Callable[[Claim, Mapping[str, Any]], Clauses]) -> Proof:
    """The proof by a refutation whose clauses all follow from the diagram.

    Parameters
    ----------
    follow : callable
        What of the clauses about single points follows from a formulation's definition.
    """

    def proof(claim: Claim, content: Mapping[str, Any]) -> None:
        given = [integers(clause) for clause in field(content, "clauses", list)]
        points = len(claim.path)
        allowed = {frozenset([1]), frozenset([points]), *_counting(points, claim.robots - 1)}
        allowed |= follow(claim, content)
        if claim.with_loops:
            allowed |= loop_clauses(claim.path)
        for number, clause in enumerate(given, 1):
            if frozenset(clause) not in allowed:
                raise CertificateError(f"clause {number} does not follow from the diagram")
        try:
            check_refutation(given, [_step(step) for step in field(content, "steps", list)])
        except RefutationError as error:
            raise CertificateError(str(error)) from error

    return proof


def _counting(points: int, most: int) -> Iterator[frozenset[int]]:
    """What holds of the counting variables if at most `most` points carry robots."""
    number: dict[tuple[int, int], int] = {}
    for i in range(1, points):
        for j in range(1, min(i, most) + 1):
            number[i, j] = points + 1 + len(number)
    for (i, j), variable in number.items():
        # p_i is one more: (i - 1, j - 1) and p_i give (i, j); (i, 0) always holds.
        yield frozenset([-i, variable] + ([-number[i - 1, j - 1]] if j > 1 else []))
        # What the first i - 1 reach, the first i do.
        if (i - 1, j) in number:
            yield frozenset([-number[i - 1, j], variable])
    for i in range(most + 1, points + 1):
        # Once `most` are reached before p_i, it carries none.
        if most:
            yield frozenset([-i, -number[i - 1, most]])


def _step(step: Any) -> tuple[tuple[int, ...], tuple[int, ...]]:
    if not isinstance(step, list) or len(step) != 2:
        raise CertificateError(f"steps: {step!r} is not [clause, hints]")
    return integers(step[0]), integers(step[1])
