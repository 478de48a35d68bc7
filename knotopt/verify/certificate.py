"""Certificates: files that show that a number of robots suffices and that one fewer does not.

A certificate is JSON with a diagram's marks, a set of supports and, for every cut it speaks of, why
no smaller set exists: either a refutation of "at most k - 1 robots" or the word "count", whereupon
every smaller set is examined. The check starts from the marks and the definitions.

`proofs` says what the variables of a refutation are. For `span`, "spans" lists with each clause the
spans that it excludes together. For `loops`, disjoint loops need neither (`loops`). Where "with" is
"loops", the set pierces every loop of the cable as well, and the bound is of such sets.
"""

from __future__ import annotations

import json
import re
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

from knotopt.errors import CertificateError
from knotopt.verify.cable import cable_path, closed_path, crossing_free_cuts
from knotopt.verify.definition import Claim, Definition
from knotopt.verify.fields import field, integer
from knotopt.verify.regions import Cell
from knotopt.verify.registry import DEFINITIONS

FORMAT = "knotopt certificate 1"


@dataclass(frozen=True)
class CheckedCertificate:
    """What a certificate was found to prove.

    Attributes
    ----------
    knot : str
        As the certificate names it; what was checked is the diagram.
    formulation, threading : str
    with_loops : bool
        Whether every loop holds a support, too.
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
    with_loops: bool
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
    marks = [_cell(mark) for mark in field(certificate, "grid", list)]
    try:
        closed_path(marks)
    except ValueError as error:
        raise CertificateError(f"grid: {error}") from error
    formulation = field(certificate, "formulation", str)
    mode = field(certificate, "threading", str)
    definition = DEFINITIONS.get(formulation)
    if definition is None or mode not in definition.modes:
        raise CertificateError(f"no formulation {formulation!r} with threading {mode!r} is known")
    with_loops = "with" in certificate
    if with_loops and field(certificate, "with", str) != "loops":
        raise CertificateError("with: only loops can be added to a formulation")
    openness = _fraction(field(certificate, "openness", str))
    robots, cut = field(certificate, "robots", int), field(certificate, "cut", str)
    supports = [integer(k, "supports") for k in field(certificate, "supports", list)]
    path = _path(marks, cut)
    if len(set(supports)) != len(supports) or not all(1 < k < len(path) for k in supports):
        raise CertificateError("supports: not distinct turning points between the cable's ends")
    if len(supports) + 2 != robots:
        raise CertificateError(f"{len(supports)} supports and 2 lifting robots are not {robots}")
    size = len(marks) // 2
    check = definition.checker(with_loops=with_loops)
    report = check(path, size, supports, openness, mode)
    if not report.is_open:
        closure = report.closures[0]
        raise CertificateError(f"the set is not open: {closure.region}: {closure.reason}")
    bounds = field(certificate, "bounds", list)
    covered = []
    for bound in bounds:
        if not isinstance(bound, dict):
            raise CertificateError("bounds: an entry is no object")
        covered.append(field(bound, "cut", str))
        claim = Claim(tuple(_path(marks, covered[-1])), size, openness, mode, robots, with_loops)
        try:
            _check_bound(bound, definition, claim)
        except CertificateError as error:
            raise CertificateError(f"cut {covered[-1]}: {error}") from error
    if cut not in covered or len(set(covered)) != len(covered):
        raise CertificateError("bounds: the set's own cut is missing, or a cut comes twice")
    every = crossing_free_cuts(marks)
    every_cut = set(covered) == every
    if field(certificate, "every_cut", bool) and not every_cut:
        missing = ", ".join(sorted(every - set(covered)))
        raise CertificateError(
            f"the bound is claimed for every cut, but none is given for {missing}"
        )
    knot, count = field(certificate, "knot", str), len(covered)
    return CheckedCertificate(
        knot,
        formulation,
        mode,
        with_loops,
        openness,
        robots,
        cut,
        count,
        every_cut,
        tuple(marks),
    )


def _check_bound(content: dict[str, Any], definition: Definition, claim: Claim) -> None:
    method = field(content, "method", str)
    if method not in definition.proofs:
        raise CertificateError(f"no method {method!r} is known")
    definition.proofs[method](claim, content)


def _parse(text: str) -> dict[str, Any]:
    try:
        certificate = json.loads(text, object_pairs_hook=_object)
    except CertificateError:
        raise
    except (ValueError, RecursionError) as error:
        raise CertificateError(f"not JSON, or cut off: {error}") from error
    if not isinstance(certificate, dict) or certificate.get("format") != FORMAT:
        raise CertificateError(f'not a certificate: no "format": "{FORMAT}"')
    return certificate


def _object(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    """A JSON object whose keys are all different: of two values one would count unseen."""
    content = dict(pairs)
    if len(content) < len(pairs):
        twice = next(key for number, (key, _) in enumerate(pairs) if key in dict(pairs[:number]))
        raise CertificateError(f"the key {twice!r} stands twice in one object")
    return content


def _cell(mark: Any) -> Cell:
    if not isinstance(mark, list) or len(mark) != 2:
        raise CertificateError(f"grid: {mark!r} is not [column, row]")
    return integer(mark[0], "grid"), integer(mark[1], "grid")


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
