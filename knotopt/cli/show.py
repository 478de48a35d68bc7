"""`knotopt show`: a knot's grid diagram in numbers and a picture."""

from __future__ import annotations

from dataclasses import asdict, replace
from typing import TYPE_CHECKING, Annotated, Any

import typer

from knotopt.cli.completion import CUTS, among
from knotopt.cli.formats import WrittenOption, print_form
from knotopt.cli.options import JsonOption, KnotArgument, PlotOption
from knotopt.cli.printing import print_facts, print_json, print_written
from knotopt.cli.reading import read, reading_in_words
from knotopt.cli.sizes import check_size

if TYPE_CHECKING:
    from knotopt.cable.cable import Cable
    from knotopt.reading.record import NamedDiagram

MAX_CROSSINGS = 120  # of an Alexander polynomial computed here: about a second


def show(
    knot: KnotArgument,
    cut: Annotated[
        str,
        typer.Option(
            metavar="CUT",
            autocompletion=among(CUTS),
            help="Where the knot is opened: L+ L- R+ R- B+ B- T+ T-, or col3+, row5-.",
        ),
    ] = "L+",
    written: WrittenOption = None,
    plot: PlotOption = None,
    as_json: JsonOption = False,
) -> None:
    """Show a knot: its cable, crossings, codes and invariants.

    Example: knotopt show 8_19 --plot 8_19.png
    """
    if written is not None:
        print_form(knot, written, {"--plot": plot, "--json": as_json})
        return
    from knotopt.cable.alexander import alexander_polynomial
    from knotopt.cable.cable import Cable
    from knotopt.cli.drawing import draw_text
    from knotopt.cli.identify import identified_in_words, identified_json
    from knotopt.diagram.simplify import simplify
    from knotopt.reading.identification import identify_read

    named = read(knot, says=True)
    check_size(named.diagram.size, "show", **{"--plot": plot})
    cable = Cable(named.diagram, cut)
    # Of a diagram with many crossings, the polynomial is computed on a simpler one of the knot.
    simplest = Cable(simplify(named.diagram), "L+")
    reduced = cable if len(cable.crossings) <= MAX_CROSSINGS else simplest
    polynomial = alexander_polynomial(reduced) if len(reduced.crossings) <= MAX_CROSSINGS else None
    if plot is not None:
        from knotopt.plot.figures import cable_figure, save_figure

        save_figure(cable_figure(cable, f"{named.name}, cut {cable.cut}"), plot)
    simpler = replace(named, diagram=simplest.diagram)
    found = None if named.prime_knot else identify_read(simpler)
    content = _json(named, cable, simplest, polynomial)
    content["identified"] = None if found is None else identified_json(named, found)
    if as_json:
        print_json(content)
        return
    print(draw_text(cable), end="\n\n")
    facts = _facts(content, len(simplest.crossings))
    if found is not None:
        words = identified_in_words(named, found)
        facts.insert([name for name, _ in facts].index("grid size"), ("identified", words))
    print_facts(facts)
    print_written(plot)


def _json(
    named: NamedDiagram, cable: Cable, simplest: Cable, polynomial: tuple[int, ...] | None
) -> dict[str, Any]:
    """What `--json` says."""
    from knotopt.cable.alexander import determinant
    from knotopt.cable.cut import crossing_free_cuts
    from knotopt.cable.notation import dt_code, gauss_code, pd_code
    from knotopt.cable.staircase import find_staircases
    from knotopt.identify.invariants import signature_or_none
    from knotopt.planar.from_grid import planar_diagram

    return {
        "knot": named.name,
        "source": named.source,
        "form": named.form,
        "notes": list(named.notes),
        "grid_size": named.diagram.size,
        "smallest_grid_found": simplest.diagram.size,
        "cut": str(cable.cut),
        "crossing_free_cuts": [str(free) for free in crossing_free_cuts(named.diagram)],
        "turning_points": len(cable.path),
        "length": cable.length,
        "crossings": len(cable.crossings),
        "crossing_list": [asdict(crossing) for crossing in cable.crossings],
        "arcs": [
            {
                "crossings": [None if k is None else k + 1 for k in arc.crossings],
                "start": arc.start,
                "end": arc.end,
                "turning_points": list(arc.turning_points),
            }
            for arc in cable.arcs
        ],
        "writhe": int(cable.crossings.sign.sum()),
        "alexander": None if polynomial is None else list(polynomial),
        "determinant": None if polynomial is None else determinant(polynomial),
        "signature": signature_or_none(planar_diagram(simplest.diagram)),
        "gauss_code": list(gauss_code(cable)),
        "pd_code": [list(crossing) for crossing in pd_code(cable)],
        "dt_code": list(dt_code(cable)),
        "staircases": [
            {
                "crossings": [index + 1 for index in staircase.crossings],
                "direction": staircase.direction,
                "is_twist": staircase.is_twist,
            }
            for staircase in find_staircases(cable)
        ],
        "path": [list(mark) for mark in cable.path],
        "grid": [list(mark) for mark in named.diagram.marks],
    }


def _facts(content: dict[str, Any], fewest: int) -> list[tuple[str, Any]]:
    """What is printed below the drawing; `fewest` crossings has the simplest diagram found."""
    from knotopt.cable.alexander import format_polynomial

    unknown = (
        f"not computed: the smallest grid found has {fewest} crossings, more than {MAX_CROSSINGS}"
    )
    alexander = content["alexander"]
    staircases = [
        f"{len(each['crossings'])} crossings {each['direction']}"
        + (" (twist)" if each["is_twist"] else "")
        for each in content["staircases"]
    ]
    form, notes = content["form"], tuple(content["notes"])
    return [
        ("knot", f"{content['knot']} ({content['source']})"),
        *([("read as", reading_in_words(form, notes))] if notes or form != "name" else []),
        ("grid size", f"{content['grid_size']} (smallest found: {content['smallest_grid_found']})"),
        ("cut", f"{content['cut']} of {' '.join(content['crossing_free_cuts'])}"),
        ("turning points", content["turning_points"]),
        ("cable length", f"{content['length']} grid steps"),
        ("crossings", f"{content['crossings']}, writhe {content['writhe']}"),
        ("Alexander", unknown if alexander is None else format_polynomial(tuple(alexander))),
        ("signature", "not computed" if content["signature"] is None else content["signature"]),
        ("determinant", unknown if alexander is None else content["determinant"]),
        ("Gauss code", " ".join(map(str, content["gauss_code"])) or "none"),
        ("PD code", " ".join(str(tuple(crossing)) for crossing in content["pd_code"]) or "none"),
        ("DT code", " ".join(map(str, content["dt_code"])) or "none"),
        ("staircases", "; ".join(staircases) or "none of 3 crossings or more"),
    ]
