"""What the pictures show, read off the artists they are drawn with."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from matplotlib.collections import LineCollection
from matplotlib.figure import Figure
from matplotlib.patches import Rectangle

from knotopt.cable.cable import Cable
from knotopt.catalogue.knots import shipped_knots
from knotopt.cli.drawing import draw_text
from knotopt.diagram.families import torus_knot
from knotopt.errors import OutputError
from knotopt.plot.cable import GAP, draw_cable, draw_regions, draw_robots
from knotopt.plot.figures import before_after_figure, cable_figure, save_figure
from knotopt.supports.lcf import best_cut, lcf
from knotopt.supports.regions import Regions
from tests.helpers.strategies import cables

EIGHT = best_cut(shipped_knots()["8_19"].diagram)


@settings(max_examples=40)
@given(cables(max_size=9))
def test_under_crossings_have_gaps_and_over_crossings_have_none(cable: Cable) -> None:
    axes = Figure().subplots()
    draw_cable(axes, cable)
    (lines,) = [artist for artist in axes.collections if isinstance(artist, LineCollection)]
    pieces = [segment.tolist() for segment in lines.get_segments()]

    def is_drawn(x: float, y: float, along: int) -> bool:
        return any(
            a[1 - along] == b[1 - along] == (x, y)[1 - along]
            and min(a[along], b[along]) <= (x, y)[along] <= max(a[along], b[along])
            for a, b in pieces
        )

    for crossing in cable.crossings:
        x, y = crossing.column, crossing.row
        assert is_drawn(x, y, along=1), "the column passes over"
        assert not is_drawn(x, y, along=0), "the row passes under"
        assert is_drawn(x - GAP, y, along=0) and is_drawn(x + GAP, y, along=0)
    drawn = sum(abs(b[0] - a[0]) + abs(b[1] - a[1]) for a, b in pieces)
    assert drawn == pytest.approx(cable.length - 2 * GAP * len(cable.crossings))


def test_turning_points_are_numbered_beside_their_corners() -> None:
    axes = Figure().subplots()
    draw_cable(axes, EIGHT.cable)
    numbered = {int(text.get_text()): tuple(text.xy) for text in axes.texts}
    assert numbered == dict(enumerate(EIGHT.cable.path, 1))


def test_robots_stand_on_their_turning_points() -> None:
    path = EIGHT.cable.path
    supports, leader, tail = draw_robots(Figure().subplots(), EIGHT.cable, EIGHT.supports)
    marks = {(int(x), int(y)) for x, y in supports.get_xydata()}
    assert marks == {path[index - 1] for index in EIGHT.supports}
    assert leader.get_xydata().tolist() == [list(path[-1])]
    assert tail.get_xydata().tolist() == [list(path[0])]
    assert (leader.get_marker(), tail.get_markerfacecolor()) == ("D", "white")


def touched(cells: np.ndarray) -> set[tuple[int, int]]:
    """Lower left corners of the unit squares around cells of a mask."""
    return {(c + i, r + j) for c, r in np.argwhere(cells).tolist() for i in (0, 1) for j in (0, 1)}


@settings(max_examples=40)
@given(cables(max_size=9))
def test_active_regions_are_shaded_by_layer_and_passive_ones_hatched(cable: Cable) -> None:
    axes = Figure().subplots()
    regions = Regions(cable)
    draw_regions(axes, regions)
    active = [touched(region.interior) for region in regions if region.is_active]
    passive = [touched(region.interior) for region in regions if not region.is_active]
    hatched = {patch.get_xy() for patch in axes.patches if isinstance(patch, Rectangle)}
    assert hatched == set().union(*passive)
    if not active:
        assert not axes.images
        return
    (image,) = axes.images
    shades = image.get_array().T  # masked where nothing is active
    layers = {square: sum(square in region for region in active) for square in set().union(*active)}
    deepest = max(layers.values())
    for (column, row), shade in np.ndenumerate(shades.filled(0)):
        layer = layers.get((column, row), 0)
        assert shade == (layer if deepest <= 4 else -(-4 * layer // deepest))
    assert image.get_extent() == [0, cable.diagram.size + 1, 0, cable.diagram.size + 1]


def test_the_two_panels_say_how_many_robots() -> None:
    figure = before_after_figure(EIGHT, "title")
    before, after = figure.axes
    assert before.get_title() == "before: 14 robots" and len(before.texts) == 14
    assert after.get_title() == "after: 10 robots" and after.images
    assert not before.images


def test_formats(tmp_path: Path) -> None:
    figure = cable_figure(Cable(torus_knot(2, 3), "L+"), "T(2,3)")
    for suffix, start in ((".png", b"\x89PNG"), (".pdf", b"%PDF"), (".SVG", b"<?xml")):
        path = tmp_path / f"picture{suffix}"
        save_figure(figure, path)
        assert path.read_bytes().startswith(start)
    with pytest.raises(OutputError, match=r"picture.gif: pictures are written as .png, .pdf, .svg"):
        save_figure(figure, tmp_path / "picture.gif")


@given(cables(max_size=9))
def test_text_drawings(cable: Cable) -> None:
    supports = lcf(cable).supports
    lines = draw_text(cable, supports).splitlines()
    size = cable.diagram.size
    assert len(lines) == size
    canvas = [line.ljust(2 * size - 1) for line in lines]

    def at(column: int, row: int) -> str:
        return canvas[size - row][2 * (column - 1)]

    assert at(*cable.path[0]) == "◇" and at(*cable.path[-1]) == "◆"
    for index, mark in enumerate(cable.path[1:-1], 2):
        assert at(*mark) in ("●" if index in supports else "┌┐└┘")
    for crossing in cable.crossings:
        assert at(crossing.column, crossing.row) == "│"
