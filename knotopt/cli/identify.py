"""`knotopt identify`: which knot a diagram shows, by invariants."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, Any

import typer

from knotopt.cli.options import JsonOption, KnotArgument
from knotopt.cli.printing import print_facts, print_json
from knotopt.cli.reading import read, reading_in_words
from knotopt.cli.sizes import check_size

if TYPE_CHECKING:
    from knotopt.identify.identify import Identified
    from knotopt.reading.record import NamedDiagram

SHOWN = 12  # candidates in one line


def identify(
    knot: KnotArgument,
    prove: Annotated[
        bool,
        typer.Option(
            "--prove", help="Have SnapPy prove it for hyperbolic knots (the snappy extra)."
        ),
    ] = False,
    as_json: JsonOption = False,
) -> None:
    """Name the knot of any diagram, by invariants.

    Example: knotopt identify 'DT: [(4, 8, 10, 2, 12, 6)]'
    """
    from knotopt.reading.identification import identify_read

    named = read(knot, says=True)
    check_size(named.diagram.size, "identify")
    found = identify_read(named, prove=prove)
    if as_json:
        print_json(_json(named, found))
    else:
        print_facts(_facts(named, found))


def identified_in_words(named: NamedDiagram, found: Identified) -> str:
    """`8_19, by Alexander polynomial, signature and Jones polynomial`, or what else there is."""
    from knotopt.reading.identification import name_given

    if not found.candidates:
        given = name_given(named, found)
        words = "" if given is None else f"{given}, by name; "
        if found.invariants.alexander is None:
            return f"{words}too many crossings to compare ({found.crossings})"
        words += f"no knot of up to {found.table_crossings} crossings"
        return words + ("" if found.table_crossings > 10 else " (the knotinfo extra goes to 13)")
    return f"{candidates_in_words(found)}, by {_listed(found.by)}"


def candidates_in_words(found: Identified) -> str:
    """`3_1#3_1 or 3_1#m3_1`, `3_1 or its mirror image`; empty if there are none."""
    names = " or ".join(found.candidates[:SHOWN])
    if len(found.candidates) > SHOWN:
        names += f" or {len(found.candidates) - SHOWN} others"
    mirror = "its mirror image" if len(found.candidates) == 1 else "their mirror images"
    return f"{names} or {mirror}" if found.up_to_mirror and names else names


def identified_json(named: NamedDiagram, found: Identified) -> dict[str, Any]:
    """What `--json` says of it, here and in `show`."""
    from knotopt.reading.identification import name_given

    return {
        "identified": found.name,
        "candidates": list(found.candidates),
        "by": list(found.by),
        "proven": found.proven,
        "given_name": name_given(named, found),
        "amphicheiral": found.is_amphicheiral if found.candidates else None,
        "compared_up_to_crossings": found.table_crossings,
    }


def _json(named: NamedDiagram, found: Identified) -> dict[str, Any]:
    invariants = found.invariants
    return {
        "knot": named.name,
        "source": named.source,
        "form": named.form,
        "notes": list(named.notes),
        "up_to_mirror_image": named.ambiguous,
        **identified_json(named, found),
        "signature": invariants.signature,
        "alexander": None if invariants.alexander is None else list(invariants.alexander),
        "determinant": invariants.determinant,
        "jones": None if invariants.jones is None else [list(x) for x in invariants.jones.items()],
        "smallest_grid_found": found.grid.size,
        "crossings": found.crossings,
        "grid": [list(mark) for mark in found.grid.marks],
    }


def _facts(named: NamedDiagram, found: Identified) -> list[tuple[str, Any]]:
    from knotopt.cable.alexander import format_polynomial

    invariants = found.invariants
    alexander, jones = invariants.alexander, invariants.jones
    compared = f"prime knots of up to {found.table_crossings} crossings and their connected sums"
    return [
        ("read as", f"{reading_in_words(named.form, named.notes)} ({named.source})"),
        ("knot", identified_in_words(named, found)),
        *([("proven", _proven(named, found))] if found.candidates else []),
        ("compared with", compared),
        ("smallest grid", f"{found.grid.size}, {found.crossings} crossings"),
        ("signature", "not computed" if invariants.signature is None else invariants.signature),
        ("determinant", "not computed" if alexander is None else invariants.determinant),
        ("Alexander", "not computed" if alexander is None else format_polynomial(alexander)),
        ("Jones", "not computed" if jones is None else format_polynomial(jones)),
    ]


def _proven(named: NamedDiagram, found: Identified) -> str:
    from knotopt.reading.identification import name_given

    if found.proven:
        return "yes" if len(found.candidates) == 1 else "yes, that it is one of these"
    given = name_given(named, found)
    if given in found.candidates:
        return f"by name: it was asked for as {given}"
    return "no; a knot of more crossings may have the same invariants"


def _listed(words: tuple[str, ...]) -> str:
    """`a, b and c`."""
    return " and ".join(filter(None, (", ".join(words[:-1]), words[-1])))
