"""Certificates of minimal supports, written; `knotopt.verify.certificate` reads and checks them."""

from __future__ import annotations

import json
from collections.abc import Iterable

from formulations.solution import Limits, MissingSolverError
from knotopt.cable.cable import Cable
from knotopt.cable.cut import Cut, crossing_free_cuts
from knotopt.diagram.grid import GridDiagram
from knotopt.errors import CertificateError, MissingExtraError, RequirementError
from knotopt.supports.formulation import Claim
from knotopt.supports.lcf import lcf
from knotopt.supports.minimal import compile_program
from knotopt.supports.registry import find_formulation
from knotopt.supports.requirements import Requirements
from knotopt.supports.search import best_supports
from knotopt.verify.certificate import FORMAT


def prove(
    name: str,
    diagram: GridDiagram,
    requirements: Requirements | None = None,
    *,
    cuts: Iterable[Cut] | None = None,
    method: str | None = None,
    limits: Limits | None = None,
) -> str:
    """A certificate, as JSON, of the smallest number of robots over the given cuts.

    Parameters
    ----------
    name : str
        What to call the knot.
    diagram : GridDiagram
    requirements : Requirements, optional
        Formulation, with loops or without, openness and threading mode; nothing else can be
        certified.
    cuts : iterable of Cut, optional
        By default every crossing-free one.
    method : str, optional
        One of the formulation's kinds of proof: "refutation", the default, is by CaDiCaL; with
        "count" the checker goes through all smaller sets, 20,000 at most.
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
    with_loops = asked.with_loops
    certified = Requirements(
        asked.formulation, asked.openness, asked.threading, with_loops=with_loops
    )
    if asked != certified:
        raise RequirementError(
            "a certificate is about a formulation, with loops or without, an openness and a "
            "threading mode; leave out the other options"
        )
    proofs = find_formulation(asked.formulation).proofs
    method = method or next(iter(proofs))
    if method not in proofs:
        kinds = " or ".join(proofs)
        raise RequirementError(f"{asked.formulation} is proven by {kinds}, not by {method!r}")
    chosen = tuple(dict.fromkeys(crossing_free_cuts(diagram) if cuts is None else cuts))
    search = best_supports(diagram, asked, cuts=chosen, limits=limits)
    best = search.best
    if search.interrupted:
        raise KeyboardInterrupt
    if not search.is_proven:
        raise CertificateError(f"{name}: the minimum was not proven within the limits")
    bounds = []
    for cut in chosen:
        cable = Cable(diagram, cut)
        program = compile_program(lcf(cable), asked)
        instance = program.instance(float(asked.openness**2))
        bound = {"cut": str(cut), "instance": instance.hash, "method": method}
        try:
            claim = Claim(cable, program, instance, asked.openness, best.robots)
            proof = proofs[method](claim)
        except CertificateError as error:
            raise CertificateError(f"{name}, cut {cut}: {error}") from error
        except MissingSolverError as error:
            raise MissingExtraError(error.package, error.extra, "a refutation") from error
        bounds.append(bound | proof)
    certificate = {
        "format": FORMAT,
        "knot": name,
        "grid": [list(mark) for mark in diagram.marks],
        "formulation": asked.formulation,
        **({"with": "loops"} if with_loops else {}),
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
