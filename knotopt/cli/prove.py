"""`knotopt prove` and `knotopt check`: certificates of minimal supports."""

from __future__ import annotations

import json
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from knotopt.cli import options
from knotopt.cli.completion import among
from knotopt.cli.formulations import (
    FormulationOption,
    ThreadingOption,
    WithOption,
    check_openness,
    with_loops,
)
from knotopt.cli.printing import print_json, print_note, print_table, print_written
from knotopt.cli.progress import track
from knotopt.cli.sizes import check_size
from knotopt.supports.requirements import Requirements

if TYPE_CHECKING:
    from knotopt.verify.certificate import CheckedCertificate


def prove(
    knots: options.KnotsArgument = None,
    catalogue: options.CatalogueOption = False,
    formulation: FormulationOption = Requirements.formulation,
    threading: ThreadingOption = None,
    with_: WithOption = None,
    r: options.OpennessOption = None,
    cut: Annotated[
        str, options.cut_option("best: the bound holds for every crossing-free cut")
    ] = "best",
    method: Annotated[
        str | None,
        typer.Option(
            metavar="NAME",
            autocompletion=among(("refutation", "count", "disjoint loops")),
            help="refutation (by CaDiCaL; the default), count (the checker examines every smaller "
            "set) or, of formulation loops and its default, 'disjoint loops'.",
        ),
    ] = None,
    time_limit: options.TimeLimitOption = None,
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

    check_openness(formulation, r)
    asked = Requirements(formulation, r, threading, with_loops=with_loops(with_))
    proofs = find_formulation(formulation).proofs
    if method not in (None, *proofs):
        options.refuse("--method", f"expected {' or '.join(proofs)}")
    limits = options.solver_limits(time_limit)
    found = options.read_knots(knots, catalogue=catalogue)
    for named in found:
        check_size(named.diagram.size, "prove", **{f"--formulation {formulation}": True})
    settings = [asked.words, asked.threading, str(asked.openness), cut, method]
    header = options.run_header("prove", settings, found)
    proven: list[str] = []
    try:
        with resumable_lines(out, header) as lines:
            proven += lines.done
            if lines.done:
                print_note(f"{len(lines.done)} certificates taken over from {out}.partial")
            for named in track(found[len(lines.done) :], "knots", len(found) - len(lines.done)):
                cuts = None if cut == "best" else [Cut.parse(cut, named.diagram.size)]
                certificate = prove_knot(
                    named.name, named.diagram, asked, cuts=cuts, method=method, limits=limits
                )
                proven.append(certificate)
                lines.write(certificate)
    except KeyboardInterrupt:
        if proven:
            print(
                f"stopped: {len(proven)} of {len(found)} certificates are in {out}.partial; "
                "the same command goes on from there",
                file=sys.stderr,
            )
        raise
    claims = map(json.loads, proven)
    print_table(
        ("knot", "formulation", "r", "robots", "cut", "smallest over"),
        (
            (
                claim["knot"],
                asked.words,
                claim["openness"] if find_formulation(formulation).has_openness else "-",
                claim["robots"],
                claim["cut"],
                _cuts(len(claim["bounds"])),
            )
            for claim in claims
        ),
    )
    print_written(out)


def check(
    files: Annotated[
        list[Path], typer.Argument(metavar="FILE", help="As prove writes them, one a line.")
    ],
    as_json: options.JsonOption = False,
) -> None:
    """Check certificates from the definitions alone, without any solver.

    The knot's name is the certificate's own word; "catalogue" says that the grid that was checked
    is the one this package has under that name. Exit status 1 if any is rejected.
    Example: knotopt check 8_19.jsonl
    """
    from knotopt.errors import CertificateError
    from knotopt.verify.certificate import check_certificate

    certificates = [(file, *line) for file in files for line in enumerate(_lines(file), 1)]
    accepted: list[dict[str, Any]] = []
    rejected: list[dict[str, Any]] = []
    names = track(
        certificates, "certificates", len(certificates), lambda each: f"{each[0]}, line {each[1]}"
    )
    for file, number, line in names:
        place = {"file": str(file), "line": number}
        try:
            verdict = check_certificate(line)
        except CertificateError as error:
            rejected.append(place | {"reason": str(error)})
        else:
            accepted.append(place | _accepted(verdict))
    if as_json:
        print_json({"accepted": accepted, "rejected": rejected})
    else:
        _print_verdicts(accepted, rejected)
    if rejected:
        raise typer.Exit(1)


def _lines(file: Path) -> list[str]:
    """The certificates of a file."""
    from knotopt.errors import CertificateError

    try:
        lines = file.read_text(encoding="utf-8").splitlines()
    except OSError as error:
        raise CertificateError(f"cannot read {file}: {error.strerror}") from error
    except UnicodeDecodeError as error:
        raise CertificateError(f"cannot read {file}: it is no text in UTF-8") from error
    if not lines:
        raise CertificateError(f"{file} is empty")
    return lines


def _accepted(verdict: CheckedCertificate) -> dict[str, Any]:
    """What `--json` says of a certificate that was accepted."""
    return {
        "knot": verdict.knot,
        "grid": "catalogue" if _is_shipped(verdict) else "other",
        "formulation": verdict.formulation,
        "with": "loops" if verdict.with_loops else "none",
        "threading": verdict.threading,
        "openness": float(verdict.openness),
        "robots_after": verdict.robots,
        "cut": verdict.cut,
        "cuts": verdict.cuts,
        "every_cut": verdict.every_cut,
    }


def _cuts(count: int) -> str:
    return "1 cut" if count == 1 else f"{count} cuts"


def _print_verdicts(accepted: list[dict[str, Any]], rejected: list[dict[str, Any]]) -> None:
    """Print what was accepted as a table, and why others were rejected."""
    from knotopt.supports.registry import find_formulation

    if accepted:
        print_table(
            ("named", "grid", "formulation", "r", "robots", "cut", "smallest over"),
            (
                (
                    *(each[key] for key in ("knot", "grid")),
                    each["formulation"] + " with loops" * (each["with"] == "loops"),
                    f"{each['openness']:g}"
                    if find_formulation(each["formulation"]).has_openness
                    else "-",
                    *(each[key] for key in ("robots_after", "cut")),
                    "all " * each["every_cut"] + _cuts(each["cuts"]),
                )
                for each in accepted
            ),
        )
    for each in rejected:
        print(f"rejected: {each['file']}, line {each['line']}: {each['reason']}")
    print(f"{len(accepted)} accepted, {len(rejected)} rejected")


def _is_shipped(verdict: CheckedCertificate) -> bool:
    """Whether the grid is one that this package has under the certificate's name."""
    from knotopt.catalogue.knots import shipped_knots
    from knotopt.catalogue.table1_grids import table1_grids

    known = [grid.diagram for grid in table1_grids() if grid.knot == verdict.knot]
    if verdict.knot in shipped_knots():
        known.append(shipped_knots()[verdict.knot].diagram)
    return any(set(diagram.marks) == set(verdict.grid) for diagram in known)
