"""Certificates of minimal supports, written; `knotopt.verify.certificate` reads and checks them."""

from __future__ import annotations

import json
from collections.abc import Iterable
from itertools import count
from math import comb
from typing import Any, Literal

from formulations.canonical import Program
from formulations.cnf import Clause, at_most, clauses
from formulations.instance import Instance
from formulations.proof import refute, refute_lazily
from formulations.solution import Limits, MissingSolverError
from formulations.span import Span, SpanProgram
from formulations.team import not_consecutive
from knotopt.cable.cable import Cable
from knotopt.cable.cut import Cut, crossing_free_cuts
from knotopt.diagram.grid import GridDiagram
from knotopt.errors import CertificateError, MissingExtraError, RequirementError
from knotopt.supports.lcf import lcf
from knotopt.supports.minimal import compile_program
from knotopt.supports.requirements import Formulation, Requirements
from knotopt.supports.search import best_supports
from knotopt.verify.certificate import FORMAT, MAX_COUNT

Method = Literal["refutation", "count"]


def prove(
    name: str,
    diagram: GridDiagram,
    requirements: Requirements | None = None,
    *,
    cuts: Iterable[Cut] | None = None,
    method: Method | None = None,
    limits: Limits | None = None,
) -> str:
    """A certificate, as JSON, of the smallest number of robots over the given cuts.

    Parameters
    ----------
    name : str
        What to call the knot.
    diagram : GridDiagram
    requirements : Requirements, optional
        Formulation, openness and threading mode; nothing else can be certified.
    cuts : iterable of Cut, optional
        By default every crossing-free one.
    method : "refutation" or "count", optional
        By default a refutation by CaDiCaL. With "count" the checker goes through all smaller sets,
        `MAX_COUNT` at most.
    limits : Limits, optional

    Raises
    ------
    MissingExtraError
        A refutation is asked for, and PySAT is not installed.
    RequirementError
        Requirements that cannot be certified.
    CertificateError
        The minimum was not proven within the limits, or there are too many sets to count.
    """
    asked = requirements or Requirements()
    if asked != Requirements(asked.formulation, asked.openness, asked.threading):
        raise RequirementError(
            "a certificate is about a formulation, an openness and a threading mode; "
            "leave out the other options"
        )
    chosen = tuple(dict.fromkeys(crossing_free_cuts(diagram) if cuts is None else cuts))
    search = best_supports(diagram, asked, cuts=chosen, limits=limits)
    best = search.best
    if search.interrupted:
        raise KeyboardInterrupt
    if not search.is_proven:
        raise CertificateError(f"{name}: the minimum was not proven within the limits")
    method = method or "refutation"
    bounds = []
    for cut in chosen:
        program = compile_program(lcf(Cable(diagram, cut)), asked)
        instance = program.instance(float(asked.openness**2))
        bound: dict[str, Any] = {"cut": str(cut), "instance": instance.hash, "method": method}
        if method == "refutation":
            bound |= _refutation(program, instance, best.robots, asked)
        else:
            smaller = sum(comb(instance.decisions - 2, k) for k in range(best.robots - 2))
            if smaller > MAX_COUNT:
                raise CertificateError(
                    f"{name}, cut {cut}: {smaller} smaller sets are too many to count "
                    f"({MAX_COUNT} at most)"
                )
        bounds.append(bound)
    certificate = {
        "format": FORMAT,
        "knot": name,
        "grid": [list(mark) for mark in diagram.marks],
        "formulation": str(asked.formulation),
        "openness": str(asked.openness),
        "threading": str(asked.threading),
        "robots": best.robots,
        "cut": str(best.cable.cut),
        "supports": list(best.supports),
        "every_cut": set(chosen) == set(crossing_free_cuts(diagram)),
        "solver": best.solution.solver,
        "bounds": bounds,
    }
    return json.dumps(certificate, separators=(",", ":")) + "\n"


def _refutation(
    program: Program, instance: Instance, robots: int, asked: Requirements
) -> dict[str, Any]:
    points = instance.decisions
    counting = list(at_most(range(1, points + 1), robots - 1, count(points + 1)))
    spans: dict[Clause, tuple[Span, ...]] = {}

    def violated(chosen: tuple[int, ...]) -> list[Clause]:
        """Clauses of `span` that a path violates; which spans they speak of is kept."""
        assert isinstance(program, SpanProgram)
        found = {}
        for excluded in program.excluded(chosen, float(asked.openness**2)):
            literals = {x for u, w in excluded for x in not_consecutive(u, w)}
            found[tuple(sorted(literals, key=abs))] = excluded
        spans.update(found)
        return list(found)

    try:
        if asked.formulation is Formulation.SPAN:
            refuted = refute_lazily([(1,), (points,), *counting], points, violated)
        else:
            given = [*clauses(instance), *counting]
            refutation = refute(given)
            refuted = None if refutation is None else (given, refutation)
    except MissingSolverError as error:
        raise MissingExtraError(error.package, error.extra, "a refutation") from error
    if refuted is None:
        raise CertificateError(f"a set of {robots - 1} robots exists: {robots} is not the minimum")
    given, refutation = refuted
    needed = [given[index] for index in refutation.needed]
    content: dict[str, Any] = {"clauses": needed}
    if asked.formulation is Formulation.SPAN:
        content["spans"] = [spans.get(clause, ()) for clause in needed]
    return {**content, "steps": [[step.literals, step.hints] for step in refutation.steps]}
