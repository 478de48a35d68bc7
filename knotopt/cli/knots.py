"""`knotopt knots`: the knots that can be asked for by name."""

from __future__ import annotations

import fnmatch
from typing import Annotated

import typer

from knotopt.cli.options import JsonOption
from knotopt.cli.printing import print_json, print_table


def knots(
    pattern: Annotated[
        str, typer.Argument(metavar="PATTERN", help="Names to list, such as '9_*'.")
    ] = "*",
    crossings: Annotated[
        int | None, typer.Option(metavar="N", help="Only knots of this crossing number.", min=0)
    ] = None,
    arc_index: Annotated[
        int | None, typer.Option(metavar="N", help="Only knots of this arc index.", min=2)
    ] = None,
    determinant: Annotated[
        int | None, typer.Option(metavar="N", help="Only knots of this determinant.", min=1)
    ] = None,
    alternating: Annotated[
        bool | None,
        typer.Option("--alternating/--non-alternating", help="Only alternating knots, or none."),
    ] = None,
    all_of_knotinfo: Annotated[
        bool, typer.Option("--all", help="All 12,965 of KnotInfo (the knotinfo extra).")
    ] = False,
    as_json: JsonOption = False,
) -> None:
    """List the prime knots in the catalogue.

    Example: knotopt knots --crossings 8 --non-alternating
    """
    from knotopt.cable.alexander import format_polynomial
    from knotopt.catalogue.knotinfo import SHIPPED_CROSSINGS, knotinfo_knots
    from knotopt.catalogue.knots import shipped_knots

    beyond = crossings is not None and crossings > SHIPPED_CROSSINGS
    chosen = [
        knot
        for knot in (knotinfo_knots() if all_of_knotinfo or beyond else shipped_knots()).values()
        if fnmatch.fnmatchcase(knot.name, pattern)
        and crossings in (None, knot.crossing_number)
        and arc_index in (None, knot.arc_index)
        and determinant in (None, knot.determinant)
        and alternating in (None, knot.alternating)
    ]
    if as_json:
        entries = [knot.to_json() for knot in chosen]
        print_json([{"knot": entry.pop("name"), **entry} for entry in entries])
        return
    print_table(
        ("knot", "crossings", "arc index", "alternates", "det", "signature", "Alexander"),
        (
            (
                knot.name,
                knot.crossing_number,
                knot.arc_index,
                knot.alternating,
                knot.determinant,
                knot.signature,
                format_polynomial(knot.alexander),
            )
            for knot in chosen
        ),
    )
    print(f"{len(chosen)} knot" + ("" if len(chosen) == 1 else "s"))
    if not chosen and beyond:
        print("KnotInfo's table ends at 13 crossings.")
    elif not chosen and not all_of_knotinfo:
        print("The catalogue ends at 10 crossings; --all looks among KnotInfo's 12,965 knots.")
