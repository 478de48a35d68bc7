"""`knotopt prove` and `knotopt check`: certificates of minimal supports."""

from __future__ import annotations

import json
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from knotopt.cli.output import (
    CatalogueOption,
    FormulationOption,
    JsonOption,
    KnotsArgument,
    OpennessOption,
    ThreadingOption,
    TimeLimitOption,
    find_knots,
    print_json,
    print_note,
    print_table,
    print_written,
    run_header,
    solver_limits,
    track,
)

if TYPE_CHECKING:
    from knotopt.verify.certificate import Verdict


def prove(
    knots: KnotsArgument = None,
    catalogue: CatalogueOption = False,
    formulation: FormulationOption = "opening",
    threading: ThreadingOption = None,
    r: OpennessOption = None,
    cut: Annotated[
        str, typer.Option(help="best: the bound holds for every crossing-free cut; or one: L+ ...")
    ] = "best",
    method: Annotated[
        str | None,
        typer.Option(
            help="refutation (by CaDiCaL; the default) or count (the checker examines every "
            "smaller set).",
            show_default=False,
        ),
    ] = None,
    time_limit: TimeLimitOption = None,
    out: Annotated[
        Path, typer.Option(metavar="FILE", help="Where the certificates go, one a line.")
    ] = Path("certificate.jsonl"),
) -> None:
    """Write certificates that a number of robots suffices and one fewer does not.

    A run over many knots that is interrupted goes on where it stopped.
    Example: knotopt prove 8_19 --out 8_19.jsonl
    """
    from knotopt.cable.cut import Cut
    from knotopt.files import resumable_lines
    from knotopt.supports.certificate import prove as prove_knot
    from knotopt.supports.registry import find_formulation
    from knotopt.supports.requirements import Requirements

    found = find_knots(knots, catalogue=catalogue)
    asked = Requirements(formulation, r, threading)
    proofs = find_formulation(formulation).proofs
    if method not in (None, *proofs):
        raise typer.BadParameter(f"expected {' or '.join(proofs)}", param_hint="--method")
    limits = solver_limits(time_limit)
    settings = [formulation, asked.threading, str(asked.openness), cut, method]
    header = run_header("prove", settings, found)
    proven: list[str] = []
    try:
        with resumable_lines(out, header) as lines:
            proven += lines.done
            if lines.done:
                print_note(f"{len(lines.done)} certificates taken over from {out}.partial")
            for named in track(found[len(lines.done) :], "knots", len(found) - len(lines.done)):
                cuts = None if cut == "best" else [Cut.parse(cut, named.diagram.size)]
                proven.append(
                    prove_knot(
                        named.name,
                        named.diagram,
                        asked,
                        cuts=cuts,
                        method=method,
                        limits=limits,
                    )
                )
                lines.write(proven[-1])
    except KeyboardInterrupt:
        if proven:
            print(
                f"stopped: {len(proven)} of {len(found)} certificates are in {out}.partial; "
                "the same command goes on from there",
                file=sys.stderr,
            )
        raise
    claims = [json.loads(line) for line in proven]
    print_table(
        ("knot", "formulation", "r", "robots", "cut", "smallest over"),
        (
            (
                claim["knot"],
                claim["formulation"],
                claim["openness"],
                claim["robots"],
                claim["cut"],
                f"{len(claim['bounds'])} cuts",
            )
            for claim in claims
        ),
    )
    print_written(out)


def check(
    files: Annotated[list[Path], typer.Argument(metavar="FILE...", show_default=False)],
    as_json: JsonOption = False,
) -> None:
    """Check certificates from the definitions alone, without any solver.

    The knot's name is the certificate's own word; "catalogue" says that the grid that was checked
    is the one this package has under that name. Exit status 1 if any is rejected.
    Example: knotopt check 8_19.jsonl
    """
    from knotopt.errors import CertificateError
    from knotopt.verify.certificate import check_certificate

    certificates = []
    for file in files:
        try:
            lines = file.read_text(encoding="utf-8").splitlines()
        except OSError as error:
            raise CertificateError(f"cannot read {file}: {error.strerror}") from error
        except UnicodeDecodeError as error:
            raise CertificateError(f"cannot read {file}: it is no text in UTF-8") from error
        if not lines:
            raise CertificateError(f"{file} is empty")
        certificates += [(file, number, line) for number, line in enumerate(lines, 1)]
    accepted, rejected = [], []
    for file, number, line in track(certificates, "certificates", len(certificates)):
        try:
            verdict = check_certificate(line)
        except CertificateError as error:
            rejected.append({"file": str(file), "line": number, "reason": str(error)})
            continue
        accepted.append(
            {
                "file": str(file),
                "line": number,
                "knot": verdict.knot,
                "grid": "catalogue" if _is_shipped(verdict) else "other",
                "formulation": verdict.formulation,
                "threading": verdict.threading,
                "openness": float(verdict.openness),
                "robots_after": verdict.robots,
                "cut": verdict.cut,
                "cuts": verdict.cuts,
                "every_cut": verdict.every_cut,
            }
        )
    if as_json:
        print_json({"accepted": accepted, "rejected": rejected})
    else:
        if accepted:
            print_table(
                ("named", "grid", "formulation", "r", "robots", "cut", "smallest over"),
                (
                    (
                        verdict["knot"],
                        verdict["grid"],
                        verdict["formulation"],
                        f"{verdict['openness']:g}",
                        verdict["robots_after"],
                        verdict["cut"],
                        ("all " if verdict["every_cut"] else "") + f"{verdict['cuts']} cuts",
                    )
                    for verdict in accepted
                ),
            )
        for each in rejected:
            print(f"rejected: {each['file']}, line {each['line']}: {each['reason']}")
        print(f"{len(accepted)} accepted, {len(rejected)} rejected")
    if rejected:
        raise typer.Exit(1)


def _is_shipped(verdict: Verdict) -> bool:
    """Whether the grid is one that this package has under the certificate's name."""
    from knotopt.catalogue.knots import shipped_knots
    from knotopt.catalogue.table1_grids import table1_grids

    known = [grid.diagram for grid in table1_grids() if grid.knot == verdict.knot]
    if verdict.knot in shipped_knots():
        known.append(shipped_knots()[verdict.knot].diagram)
    return any(set(diagram.marks) == set(verdict.grid) for diagram in known)
