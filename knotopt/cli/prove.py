"""`knotopt prove` and `knotopt check`: certificates of minimal supports."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, cast, get_args

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
    print_table,
    print_written,
    solver_limits,
    track,
)


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
            help="refutation (by CaDiCaL; opening only) or count (the checker examines every "
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
    from knotopt.certificate import Method
    from knotopt.certificate import prove as prove_knot
    from knotopt.files import resumable_lines
    from knotopt.supports.requirements import Requirements

    found = find_knots(knots, catalogue=catalogue)
    if method not in (None, *get_args(Method)):
        raise typer.BadParameter("expected refutation or count", param_hint="--method")
    asked = Requirements(formulation, r, threading)
    limits = solver_limits(time_limit)
    header = f"{formulation} {asked.threading} {asked.openness} {cut} {method}"
    with resumable_lines(out, f"{header} {' '.join(named.name for named in found)}") as lines:
        for named in track(found[len(lines.done) :], "knots", len(found) - len(lines.done)):
            cuts = None if cut == "best" else [Cut.parse(cut, named.diagram.size)]
            lines.write(
                prove_knot(
                    named.name,
                    named.diagram,
                    asked,
                    cuts=cuts,
                    method=cast("Method | None", method),
                    limits=limits,
                )
            )
    print_written(out)


def check(
    files: Annotated[list[Path], typer.Argument(metavar="FILE...", show_default=False)],
    as_json: JsonOption = False,
) -> None:
    """Check certificates from the definitions alone, without any solver.

    Example: knotopt check 8_19.jsonl
    """
    from knotopt.errors import CertificateError
    from knotopt.verify.certificate import check_certificate

    certificates = []
    for file in files:
        try:
            lines = file.read_text(encoding="utf-8").splitlines()
        except (OSError, UnicodeDecodeError) as error:
            raise CertificateError(f"cannot read {file}: {error}") from error
        if not lines:
            raise CertificateError(f"{file} is empty")
        certificates += [(file, number, line) for number, line in enumerate(lines, 1)]
    verdicts = []
    for file, number, line in track(certificates, "certificates", len(certificates)):
        try:
            verdicts.append(check_certificate(line))
        except CertificateError as error:
            raise CertificateError(f"{file}, line {number}: rejected: {error}") from error
    if as_json:
        print_json(
            [
                {
                    "knot": verdict.knot,
                    "formulation": verdict.formulation,
                    "threading": verdict.threading,
                    "openness": float(verdict.openness),
                    "robots_after": verdict.robots,
                    "cut": verdict.cut,
                    "cuts": verdict.cuts,
                    "every_cut": verdict.every_cut,
                    "accepted": True,
                }
                for verdict in verdicts
            ]
        )
        return
    print_table(
        ("knot", "formulation", "r", "robots", "cut", "smallest over", "verdict"),
        (
            (
                verdict.knot,
                verdict.formulation,
                f"{float(verdict.openness):g}",
                verdict.robots,
                verdict.cut,
                f"all {verdict.cuts} cuts" if verdict.every_cut else f"{verdict.cuts} of the cuts",
                "accepted",
            )
            for verdict in verdicts
        ),
    )
    print(f"{len(verdicts)} accepted")
