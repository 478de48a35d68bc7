"""`knotopt lcf`: supports by the Loop Consistency Filter."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, Any

import typer

from knotopt.cli import options
from knotopt.cli.printing import print_json, print_table, print_written
from knotopt.cli.reading import read
from knotopt.cli.sizes import check_size

if TYPE_CHECKING:
    from knotopt.supports.lcf import LcfResult


def lcf(
    knot: options.KnotArgument,
    cut: Annotated[
        str, options.cut_option("best (of the outer cuts), all (that are crossing-free)")
    ] = "best",
    layered: Annotated[
        bool,
        typer.Option("--layered", help="Also drop supports that lie inside another active region."),
    ] = False,
    plot: options.PlotOption = None,
    as_json: options.JsonOption = False,
) -> None:
    """Select support robots by the Loop Consistency Filter (LCF).

    Example: knotopt lcf '7 Var2' --cut best --plot supports.png
    """
    from knotopt.cable.cut import Cut, crossing_free_cuts
    from knotopt.cli.drawing import print_supports
    from knotopt.supports.lcf import best_cut, lcf_by_cut

    named = read(knot)
    check_size(named.diagram.size, "lcf", **{"--plot": plot, "--cut all": cut == "all"})
    if cut == "all":
        if plot is not None:
            options.refuse("--plot", "draws one cut: give --cut best or a cut's name")
        cuts = crossing_free_cuts(named.diagram)
        by_cut = lcf_by_cut(named.diagram, layered=layered, cuts=cuts)
        _print_cuts(named.name, list(by_cut.values()), as_json=as_json)
        return
    if cut == "best":
        result = best_cut(named.diagram, layered=layered)
    else:
        parsed = Cut.parse(cut, named.diagram.size)
        result = lcf_by_cut(named.diagram, layered=layered, cuts=[parsed])[parsed]
    if plot is not None:
        from knotopt.plot.figures import save_figure, supports_figure

        title = f"{named.name}, cut {result.cable.cut}: {result.robots} robots"
        save_figure(supports_figure(result.regions, result.supports, title), plot)
    if as_json:
        print_json({**_row(named.name, result), **_details(result)})
        return
    print_supports(f"{named.name} ({named.source})", result)
    if not result.regions:
        print_written(plot)
        return
    print_table(
        ("region", "crossings", "boundary", "selects", "state"),
        (
            (
                region.kind,
                " ".join(f"c{index + 1}" for index in region.apexes),
                " ".join(f"p{index}" for index in region.boundary),
                " ".join(f"p{index}" for index in selected),
                region.why,
            )
            for region, selected in zip(result.regions, result.selected, strict=True)
        ),
    )
    print_written(plot)


def _print_cuts(name: str, results: list[LcfResult], *, as_json: bool) -> None:
    """Print a line for each cut."""
    from knotopt.supports.support_set import format_supports

    if as_json:
        print_json([_row(name, result) for result in results])
        return
    print_table(
        ("cut", "robots", "reduction", "supports"),
        (
            (
                result.cable.cut,
                result.robots,
                f"{result.reduction_percent} %",
                format_supports(result.placed_supports),
            )
            for result in results
        ),
    )


def _row(name: str, result: LcfResult) -> dict[str, Any]:
    return {
        "knot": name,
        "cut": str(result.cable.cut),
        "layered": result.layered,
        "robots_before": result.baseline,
        "robots_after": result.robots,
        "reduction_percent": result.reduction_percent,
        "supports": [list(support) for support in result.placed_supports],
    }


def _details(result: LcfResult) -> dict[str, Any]:
    return {
        "grid": [list(mark) for mark in result.cable.diagram.marks],
        "path": [list(mark) for mark in result.cable.path],
        "crossings": [[c.column, c.row] for c in result.cable.crossings],
        "regions": [
            {
                "kind": str(region.kind),
                "crossings": [index + 1 for index in region.apexes],
                "intervals": [list(interval) for interval in region.intervals],
                "boundary": list(region.boundary),
                "active": region.is_active,
                "why": region.why,
                "selects": list(selected),
            }
            for region, selected in zip(result.regions, result.selected, strict=True)
        ],
        "layers": result.regions.layers().T[::-1].tolist(),  # as printed: row N first
    }
