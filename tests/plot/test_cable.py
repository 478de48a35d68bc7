"""What the pictures show, read off the artists they are drawn with."""

from __future__ import annotations

from itertools import combinations, pairwise
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.collections import LineCollection
from matplotlib.figure import Figure
from matplotlib.patches import Rectangle

from knotopt import optimise_path, relax, relaxed_path
from knotopt.cable.cable import Cable
from knotopt.cable.cut import outer_cuts
from knotopt.catalogue.knots import shipped_knots
from knotopt.cli.drawing import draw_text
from knotopt.diagram.families import torus_knot
from knotopt.errors import OutputError
from knotopt.plot.cable import GAP, draw_cable, draw_loops, draw_regions, draw_robots
from knotopt.plot.figures import before_after_figure, cable_figure, save_figure, smallest_figure
from knotopt.plot.path_figures import path_figure, relaxation_figure
from knotopt.reading.knot import read_knot
from knotopt.supports.lcf import best_cut, lcf
from knotopt.supports.loops import disjoint_loops
from knotopt.supports.minimal import minimal_supports
from knotopt.supports.regions import Regions
from knotopt.supports.requirements import Requirements
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


def overlapping(figure: Figure, axes: Axes) -> list[tuple[str, str]]:
    """Pairs of labels in a panel whose boxes meet in the finished picture."""
    canvas = FigureCanvasAgg(figure)
    canvas.draw()
    boxes = [(text.get_text(), text.get_window_extent()) for text in axes.texts]
    return [(a, b) for (a, one), (b, other) in combinations(boxes, 2) if one.overlaps(other)]


@pytest.mark.parametrize("name", ["7_6", "8_19", "9_2"])
def test_numbers_of_turning_points_do_not_collide(name: str) -> None:
    for cut in outer_cuts(shipped_knots()[name].diagram):
        figure = cable_figure(Cable(shipped_knots()[name].diagram, cut), name)
        assert not overlapping(figure, figure.axes[0]), (name, cut)


def test_labels_of_a_path_do_not_collide_and_leave_it_visible() -> None:
    """4_1: two supports close to all four crossings."""
    chosen = best_cut(read_knot("4").diagram)
    result = optimise_path(chosen.cable, chosen.supports)
    figure = path_figure([result], "4_1")
    plan = figure.axes[0]
    assert not overlapping(figure, plan)
    path = plan.transData.transform(result.report.samples[:, :2])
    for text in plan.texts:
        box = text.get_window_extent()
        inside = (path >= (box.x0, box.y0)) & (path <= (box.x1, box.y1))
        assert inside.all(axis=1).sum() < 5, text.get_text()


def test_lifting_robots_are_drawn_as_such_in_every_panel() -> None:
    chosen = best_cut(read_knot("4").diagram)
    relaxed = relaxed_path(chosen.cable, chosen.supports)
    run = relax(chosen.cable, chosen.supports)
    figure = relaxation_figure(run, relaxed, relaxed, "Fig. 5")
    for axes in figure.axes[:5]:
        kinds = {line.get_label(): len(line.get_xdata()) for line in axes.lines}
        assert kinds["support robot"] == len(chosen.supports), axes.get_title()
        assert kinds["leader $p_n$"] == kinds["lifting robot $p_1$"] == 1, axes.get_title()


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


def test_disjoint_loops_are_drawn_in_colours_that_differ_where_they_meet() -> None:
    cable = Cable(shipped_knots()["10_123"].diagram, "L+")
    loops = disjoint_loops(cable)
    axes = Figure().subplots()
    lines = draw_loops(axes, cable, loops)
    assert len(lines) == len(loops) == 4
    for line, index in zip(lines, loops, strict=True):
        crossing = cable.crossings[index]
        assert line.get_label() == f"loop c{index + 1} at [{crossing.column},{crossing.row}]"
        drawn = np.stack(line.get_data(), axis=1)
        assert (drawn == cable.cells[crossing.first : crossing.second + 1]).all()
        assert (drawn[0] == drawn[-1]).all()
    for one, other in pairwise(lines):
        assert one.get_color() != other.get_color()
        assert one.get_linewidth() != other.get_linewidth()
    result = minimal_supports(cable, Requirements("loops"))
    (panel,) = smallest_figure(result, "10_123").axes
    assert {line.get_label() for line in lines} < {line.get_label() for line in panel.get_lines()}
    assert not panel.images  # no regions
