"""The picture of each kind of result, for `plot` and for notebooks."""

from __future__ import annotations

from functools import singledispatch

from matplotlib.figure import Figure

from knotopt.cable.cable import Cable
from knotopt.diagram.grid import GridDiagram
from knotopt.flight.plan import FlightPlan
from knotopt.path.result import PathResult
from knotopt.plot.figures import (
    cable_figure,
    diagram_figure,
    figure_bytes,
    set_figure,
    smallest_figure,
    supports_figure,
)
from knotopt.plot.flight import flight_figure
from knotopt.plot.path_figures import path_figure
from knotopt.plot.topology import plan_figure
from knotopt.reading.record import NamedDiagram
from knotopt.supports.lcf import LcfResult
from knotopt.supports.minimal import MinimalSupports
from knotopt.supports.search import CutSearch
from knotopt.supports.support_set import SupportSet
from knotopt.topology.plan import PlanGraph

PLANS_DRAWN = 10  # of a graph of plans


def picture_svg(result: object) -> bytes:
    """The picture as SVG."""
    return figure_bytes(picture(result), "svg")


@singledispatch
def picture(result: object, title: str = "") -> Figure:  # noqa: ARG001
    """The picture of a result; by default its title is what the result says of itself."""
    raise TypeError(f"there is no picture of a {type(result).__name__}")


@picture.register
def _(result: GridDiagram, title: str = "") -> Figure:
    return diagram_figure(result, title or f"grid diagram of size {result.size}")


@picture.register
def _(result: NamedDiagram, title: str = "") -> Figure:
    return picture(result.diagram, title or f"{result.name} ({result.source})")


@picture.register
def _(result: Cable, title: str = "") -> Figure:
    return cable_figure(result, title or result.in_words)


@picture.register
def _(result: SupportSet, title: str = "") -> Figure:
    return set_figure(result, title or result.in_words)


@picture.register
def _(result: LcfResult, title: str = "") -> Figure:
    return supports_figure(result.regions, result.supports, title or result.in_words)


@picture.register
def _(result: MinimalSupports, title: str = "") -> Figure:
    return smallest_figure(result, title or result.in_words)


@picture.register
def _(result: CutSearch, title: str = "") -> Figure:
    return picture(result.best, title or result.in_words)


@picture.register
def _(result: PathResult, title: str = "") -> Figure:
    return path_figure([result], title or result.in_words)


@picture.register
def _(result: FlightPlan, title: str = "") -> Figure:
    return flight_figure(result, title)


@picture.register
def _(result: PlanGraph, title: str = "") -> Figure:
    return plan_figure(result, PLANS_DRAWN, title or result.in_words)
