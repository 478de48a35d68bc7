"""Certificates: files that show that a number of robots suffices and that one fewer does not.

A certificate is JSON with a diagram's marks, a set of supports and, for every cut it speaks of, why
no smaller set exists: either a refutation of "at most k - 1 robots" or the word "count", whereupon
every smaller set is examined. The check starts from the marks and the definitions.

In a refutation, variable j = 1 ... n says that p_j carries a robot. Variables from n + 1 on count:
with m = k - 1, variable (i, j) says that at least j of p_1 ... p_i do, for i = 1 ... n - 1 and
j = 1 ... min(i, m), numbered in that order. For `span`, "spans" lists with each clause the spans
that it excludes together.
"""

from __future__ import annotations

import json
import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from fractions import Fraction
from itertools import combinations
from math import comb
from typing import Any

from knotopt.errors import CertificateError
from knotopt.verify.cable import cable_path, closed_path, crossing_free_cuts
from knotopt.verify.lrat import RefutationError, check_refutation
from knotopt.verify.opening import check_opening, closing_clauses
from knotopt.verify.regions import Cell, define_regions
from knotopt.verify.span import SpanRules, check_span

FORMAT = "knotopt certificate 1"
MODES = ("turning-point", "over-under")
MAX_COUNT = 20_000  # sets that a proof by counting may examine


@dataclass(frozen=True)
class CheckedCertificate:
    """What a certificate was found to prove.

    Attributes
    ----------
    knot : str
        As the certificate names it; what was checked is the diagram.
    formulation, threading : str
    openness : Fraction
    robots : int
    cut : str
        Whose cable the set is for.
    cuts : int
        For how many cuts the bound holds.
    every_cut : bool
        Whether these are all crossing-free cuts of the diagram.
    grid : tuple of (column, row)
        The diagram's marks.
    """

    knot: str
    formulation: str
    threading: str
    openness: Fraction
    robots: int
    cut: str
    cuts: int
    every_cut: bool
    grid: tuple[Cell, ...]


def check_certificate(text: str) -> CheckedCertificate:
    """Check a certificate from the definitions alone.

    Raises
    ------
    CertificateError
        It cannot be read, or does not prove what it claims; the message says what fails.
    """
    certificate = _parse(text)
    marks = [_cell(mark) for mark in _get(certificate, "grid", list)]
    try:
        closed_path(marks)
    except ValueError as error:
        raise CertificateError(f"grid: {error}") from error
    formulation = _get(certificate, "formulation", str)
    mode = _get(certificate, "threading", str)
    if formulation not in ("opening", "span") or mode not in MODES:
        raise CertificateError(f"no formulation {formulation!r} with threading {mode!r} is known")
    openness = _fraction(_get(certificate, "openness", str))
    robots, cut = _get(certificate, "robots", int), _get(certificate, "cut", str)
    supports = [_integer(k, "supports") for k in _get(certificate, "supports", list)]
    path = _path(marks, cut)
    if len(set(supports)) != len(supports) or not all(1 < k < len(path) for k in supports):
        raise CertificateError("supports: not distinct turning points between the cable's ends")
    if len(supports) + 2 != robots:
        raise CertificateError(f"{len(supports)} supports and 2 lifting robots are not {robots}")
    examine = check_span if formulation == "span" else check_opening
    report = examine(path, len(marks) // 2, supports, openness, mode)
    if not report.is_open:
        closure = report.closures[0]
        raise CertificateError(f"the set is not open: {closure.region}: {closure.reason}")
    bounds = _get(certificate, "bounds", list)
    covered = []
    for bound in bounds:
        if not isinstance(bound, dict):
            raise CertificateError("bounds: an entry is no object")
        covered.append(_get(bound, "cut", str))
        _check_bound(bound, marks, formulation, openness, mode, robots)
    if cut not in covered or len(set(covered)) != len(covered):
        raise CertificateError("bounds: the set's own cut is missing, or a cut comes twice")
    every = crossing_free_cuts(marks)
    every_cut = set(covered) == every
    if _get(certificate, "every_cut", bool) and not every_cut:
        missing = ", ".join(sorted(every - set(covered)))
        raise CertificateError(
            f"the bound is claimed for every cut, but none is given for {missing}"
        )
    return CheckedCertificate(
        _get(certificate, "knot", str),
        formulation,
        mode,
        openness,
        robots,
        cut,
        len(covered),
        every_cut,
        tuple(marks),
    )


def _check_bound(
    bound: dict[str, Any],
    marks: list[Cell],
    formulation: str,
    openness: Fraction,
    mode: str,
    robots: int,
) -> None:
    """Whether `robots` - 1 robots are too few on one cut."""
    cut, method = _get(bound, "cut", str), _get(bound, "method", str)
    path = _path(marks, cut)
    regions = define_regions(path, len(marks) // 2)
    if method == "count":
        examine = check_span if formulation == "span" else check_opening
        size = len(marks) // 2

        def is_open(supports: tuple[int, ...]) -> bool:
            return examine(path, size, supports, openness, mode, regions).is_open

        _count_smaller(cut, len(path), robots, is_open)
        return
    if method != "refutation":
        raise CertificateError(f"cut {cut}: no method {method!r} is known")
    given = [_clause(clause) for clause in _get(bound, "clauses", list)]
    allowed = {frozenset([1]), frozenset([len(path)]), *_count_clauses(len(path), robots - 1)}
    if formulation == "opening":
        allowed |= closing_clauses(path, regions, openness, mode)
    else:
        allowed |= _span_clauses(bound, SpanRules(path, regions, openness, mode))
    for number, clause in enumerate(given, 1):
        if frozenset(clause) not in allowed:
            raise CertificateError(f"cut {cut}: clause {number} does not follow from the diagram")
    try:
        check_refutation(given, [_step(step) for step in _get(bound, "steps", list)])
    except RefutationError as error:
        raise CertificateError(f"cut {cut}: {error}") from error


def _count_smaller(
    cut: str, points: int, robots: int, is_open: Callable[[tuple[int, ...]], bool]
) -> None:
    """Whether no set of fewer robots is open, by examining every one."""
    sizes = range(max(0, robots - 2))
    smaller = sum(comb(points - 2, size) for size in sizes)
    if smaller > MAX_COUNT:
        raise CertificateError(f"cut {cut}: {smaller} smaller sets are too many to examine")
    for size in sizes:
        for supports in combinations(range(2, points), size):
            if is_open(supports):
                raise CertificateError(f"cut {cut}: the smaller set {supports} is open")


def _span_clauses(bound: dict[str, Any], rules: SpanRules) -> set[frozenset[int]]:
    """The clauses of those listed sets of spans that no open set has together.

    (u, w) is no span: p_u or p_w carries no robot, or one between them does.
    """
    found = set()
    for entry in _get(bound, "spans", list):
        spans = [_clause(span) for span in entry] if isinstance(entry, list) else [()]
        if not all(len(span) == 2 and 1 <= span[0] < span[1] <= rules.points for span in spans):
            raise CertificateError(f"spans: {entry!r} is no list of pairs of turning points")
        if spans and rules.exclude([(u, w) for u, w in spans]):
            found.add(frozenset(x for u, w in spans for x in (-u, -w, *range(u + 1, w))))
    return found


def _count_clauses(points: int, most: int) -> Iterator[frozenset[int]]:
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


def _parse(text: str) -> dict[str, Any]:
    try:
        certificate = json.loads(text)
    except (ValueError, RecursionError) as error:
        raise CertificateError(f"not JSON, or cut off: {error}") from error
    if not isinstance(certificate, dict) or certificate.get("format") != FORMAT:
        raise CertificateError(f'not a certificate: no "format": "{FORMAT}"')
    return certificate


def _get(content: dict[str, Any], key: str, kind: type) -> Any:
    if key not in content:
        raise CertificateError(f"key {key!r} is missing")
    value = content[key]
    if not isinstance(value, kind) or (kind is int and isinstance(value, bool)):
        raise CertificateError(f"{key}: {value!r} is not of type {kind.__name__}")
    return value


def _integer(value: Any, key: str) -> int:
    if not isinstance(value, int) or isinstance(value, bool):
        raise CertificateError(f"{key}: {value!r} is no integer")
    return value


def _cell(mark: Any) -> Cell:
    if not isinstance(mark, list) or len(mark) != 2:
        raise CertificateError(f"grid: {mark!r} is not [column, row]")
    return _integer(mark[0], "grid"), _integer(mark[1], "grid")


def _clause(literals: Any) -> tuple[int, ...]:
    if not isinstance(literals, list):
        raise CertificateError(f"{literals!r} is no list of integers")
    return tuple(_integer(literal, "clauses") for literal in literals)


def _step(step: Any) -> tuple[tuple[int, ...], tuple[int, ...]]:
    if not isinstance(step, list) or len(step) != 2:
        raise CertificateError(f"steps: {step!r} is not [clause, hints]")
    return _clause(step[0]), _clause(step[1])


def _fraction(text: str) -> Fraction:
    if re.fullmatch(r"1|[0-9]{1,3}/[1-9][0-9]{0,3}", text, re.ASCII) is None:
        raise CertificateError(f"openness: {text[:20]!r} is no fraction such as 1/2")
    value = Fraction(text)
    if not 0 < value <= 1:
        raise CertificateError(f"openness: {text} does not lie in (0, 1]")
    return value


def _path(marks: list[Cell], cut: str) -> list[Cell]:
    if cut not in crossing_free_cuts(marks):
        raise CertificateError(f"{cut!r} is no crossing-free cut of this grid")
    return cable_path(marks, cut)
