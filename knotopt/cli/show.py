"""`knotopt show`: a knot's grid diagram in numbers and a picture."""

from __future__ import annotations

from dataclasses import asdict
from typing import Annotated

import typer

from knotopt.cli.options import JsonOption, KnotArgument, PlotOption
from knotopt.cli.printing import print_facts, print_json, print_written

MAX_CROSSINGS = 120  # of an Alexander polynomial computed here: about a second


def show(
    knot: KnotArgument,
    cut: Annotated[str, typer.Option(help="L+ L- R+ R- B+ B- T+ T-, or col3+, row5-.")] = "L+",
    plot: PlotOption = None,
    as_json: JsonOption = False,
) -> None:
    """Show a knot: its cable, crossings, codes and invariants.

    Example: knotopt show 8_19 --plot 8_19.png
    """
    from knotopt.cable.alexander import alexander_polynomial, determinant, format_polynomial
    from knotopt.cable.cable import Cable
    from knotopt.cable.cut import crossing_free_cuts
    from knotopt.cable.notation import dt_code, gauss_code, pd_code
    from knotopt.cable.staircase import find_staircases
    from knotopt.catalogue.lookup import find_knot
    from knotopt.diagram.simplify import simplify

    named = find_knot(knot)
    cable = Cable(named.diagram, cut)
    crossings = cable.crossings
    # Of a diagram with many crossings, the polynomial is computed on a simpler one of the knot.
    smallest = simplify(named.diagram)
    reduced = cable if len(crossings) <= MAX_CROSSINGS else Cable(smallest, "L+")
    polynomial = alexander_polynomial(reduced) if len(reduced.crossings) <= MAX_CROSSINGS else None
    staircases = find_staircases(cable)
    if plot is not None:
        from knotopt.plot.figures import cable_figure, save_figure

        save_figure(cable_figure(cable, f"{named.name}, cut {cable.cut}"), plot)
    if as_json:
        print_json(
            {
                "knot": named.name,
                "source": named.source,
                "grid_size": named.diagram.size,
                "smallest_grid_found": smallest.size,
                "cut": str(cable.cut),
                "crossing_free_cuts": [str(free) for free in crossing_free_cuts(named.diagram)],
                "turning_points": len(cable.path),
                "length": cable.length,
                "crossings": len(crossings),
                "crossing_list": [asdict(crossing) for crossing in crossings],
                "arcs": [
                    {
                        "crossings": [None if k is None else k + 1 for k in arc.crossings],
                        "start": arc.start,
                        "end": arc.end,
                        "turning_points": list(arc.turning_points),
                    }
                    for arc in cable.arcs
                ],
                "writhe": int(crossings.sign.sum()),
                "alexander": None if polynomial is None else list(polynomial),
                "determinant": None if polynomial is None else determinant(polynomial),
                "signature": named.prime_knot.signature if named.prime_knot else None,
                "gauss_code": list(gauss_code(cable)),
                "pd_code": [list(crossing) for crossing in pd_code(cable)],
                "dt_code": list(dt_code(cable)),
                "staircases": [
                    {
                        "crossings": [index + 1 for index in run.crossings],
                        "direction": run.direction,
                        "is_twist": run.is_twist,
                    }
                    for run in staircases
                ],
                "path": [list(mark) for mark in cable.path],
                "grid": [list(mark) for mark in named.diagram.marks],
            }
        )
        return
    from knotopt.cli.drawing import draw_text

    print(draw_text(cable), end="\n\n")
    unknown = (
        f"not computed: the smallest grid found has {len(reduced.crossings)} crossings, "
        f"more than {MAX_CROSSINGS}"
    )
    print_facts(
        [
            ("knot", f"{named.name} ({named.source})"),
            ("grid size", f"{named.diagram.size} (smallest found: {smallest.size})"),
            ("cut", f"{cable.cut} of " + " ".join(map(str, crossing_free_cuts(named.diagram)))),
            ("turning points", len(cable.path)),
            ("cable length", f"{cable.length} grid steps"),
            ("crossings", f"{len(crossings)}, writhe {int(crossings.sign.sum())}"),
            ("Alexander", unknown if polynomial is None else format_polynomial(polynomial)),
            (
                "signature",
                named.prime_knot.signature
                if named.prime_knot
                else "known for knots of the catalogue only",
            ),
            ("determinant", unknown if polynomial is None else determinant(polynomial)),
            ("Gauss code", " ".join(map(str, gauss_code(cable)))),
            ("PD code", " ".join(map(str, pd_code(cable)))),
            ("DT code", " ".join(map(str, dt_code(cable)))),
            (
                "staircases",
                "; ".join(
                    f"{len(run)} crossings {run.direction}" + (" (twist)" if run.is_twist else "")
                    for run in staircases
                )
                or "none of 3 crossings or more",
            ),
        ]
    )
    if plot is not None:
        print_written(plot)
