"""Drawings of ropes and plans: crossings found again by other code, and what the figures show."""

from __future__ import annotations

from functools import cache
from itertools import combinations, pairwise, permutations

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st
from matplotlib.collections import LineCollection
from matplotlib.figure import Figure
from matplotlib.patches import FancyArrowPatch, FancyBboxPatch
from scipy.optimize import lsq_linear

from knotopt.errors import KnotoptError
from knotopt.plot.figures import figure_bytes
from knotopt.plot.layers import layered
from knotopt.plot.packing import circle_packing
from knotopt.plot.plan_layout import Layout, joined_states, laid_out, text_width
from knotopt.plot.rope import draw_rope, rope_curve
from knotopt.plot.topology import plan_figure
from knotopt.reading.knot import read_knot
from knotopt.supports.lcf import best_cut
from knotopt.topology.actions import R1, R2
from knotopt.topology.cable_state import cable_state
from knotopt.topology.legal import legal_actions, successors
from knotopt.topology.plan import PlanGraph, plan_graph
from knotopt.topology.state import TRIVIAL, RopeState
from knotopt.verify.crossings import curve_crossings


@cache
def plans_to(name: str) -> PlanGraph:
    return plan_graph(cable_state(best_cut(read_knot(name).diagram).cable))


@cache
def states_with(crossings: int) -> tuple[RopeState, ...]:
    if not crossings:
        return (TRIVIAL,)
    after = {
        after
        for state in states_with(crossings - 1)
        for action, after in successors(state)
        if not isinstance(action, R2)
    }
    return tuple(sorted(after, key=lambda state: state.code))


def seen(points: np.ndarray) -> RopeState:
    """The state of a polyline, by the verifier's crossings."""
    visits, signs = curve_crossings(points).code
    return RopeState.from_gauss([k + 1 if over else -k - 1 for k, over in visits], signs)


@st.composite
def ropes(draw: st.DrawFn, most_crossings: int = 9) -> RopeState:
    state = TRIVIAL
    for _ in range(draw(st.integers(0, most_crossings))):
        following = [after for action, after in successors(state) if not isinstance(action, R2)]
        state = following[draw(st.integers(0, len(following) - 1))]
    return state


@pytest.mark.parametrize("crossings", range(4))
def test_ropes_drawn_have_their_states(crossings: int) -> None:
    states = states_with(crossings)
    assert len(states) == (1, 4, 40, 528)[crossings]
    for state in states:
        assert seen(rope_curve(state)) == state


@pytest.mark.parametrize("knot", ["4_1", "5_1", "7_1", "8_19"])
def test_ropes_on_plans_have_their_states(knot: str) -> None:
    for state in plans_to(knot).states:
        assert seen(rope_curve(state)) == state


@settings(max_examples=40, deadline=None)
@given(ropes())
def test_deeper_ropes_have_their_states(state: RopeState) -> None:
    curve = rope_curve(state)
    if np.linalg.norm(np.diff(curve, axis=0), axis=1).min() > 1e-6:  # the verifier's reach
        assert seen(curve) == state


@settings(max_examples=60, deadline=None)
@given(ropes(6))
def test_where_a_rope_is_drawn(state: RopeState) -> None:
    curve = rope_curve(state)
    plan = curve[:, :2]
    assert not curve.flags.writeable
    assert np.ptp(plan, axis=0).max() == pytest.approx(1)
    assert plan.min(axis=0) + plan.max(axis=0) == pytest.approx(0, abs=1e-9)
    assert plan[0, 1] == pytest.approx(plan[-1, 1], abs=1e-9) and plan[0, 0] < plan[-1, 0]
    mirrored = shapely.LineString(rope_curve(state.mirror())[:, :2] * [1, -1])
    assert shapely.LineString(plan).hausdorff_distance(mirrored) < 1e-6
    turns = np.diff(np.unwrap(np.angle(np.diff(plan[:, 0] + 1j * plan[:, 1]))))
    assert np.abs(turns).max(initial=0) < 0.7, "no corners"


@settings(max_examples=60, deadline=None)
@given(ropes(6))
def test_both_ends_lie_outside_if_they_can(state: RopeState) -> None:
    plan = rope_curve(state)[:, :2]
    inside = shapely.unary_union(
        shapely.polygonize([shapely.unary_union(shapely.LineString(plan))]).geoms
    )
    outside = [not inside.covers(shapely.Point(end)) for end in plan[[0, -1]]]
    shared = any({0, 2 * len(state.code) + 1} <= set(face) for face in state.faces)
    assert all(outside) == shared


@settings(max_examples=60, deadline=None)
@given(ropes(6))
def test_the_lower_strand_is_broken_and_the_upper_is_not(state: RopeState) -> None:
    axes = Figure().subplots()
    draw_rope(axes, state, centre=(3.0, 4.0), size=2.0, gap=1e-3)
    (lines,) = [artist for artist in axes.collections if isinstance(artist, LineCollection)]
    pieces = [shapely.LineString(piece) for piece in lines.get_segments()]
    assert len(pieces) == state.crossings + 1
    curve = rope_curve(state) * [2, 2, 1] + [3, 4, 0]
    assert axes.lines[0].get_xydata() == pytest.approx(curve[:1, :2])
    for point in curve_crossings(curve).point:
        near = sorted(shapely.Point(point).distance(piece) for piece in pieces)
        assert near[0] < 1e-9 < near[1]
    drawn, whole = sum(piece.length for piece in pieces), shapely.LineString(curve).length
    assert whole - 2 * 2e-3 * state.crossings - 1e-9 <= drawn < whole + 1e-9


def test_a_rope_not_in_the_plane_is_refused() -> None:
    with pytest.raises(ValueError, match="not a rope in the plane"):
        rope_curve(RopeState((10, 14, 0, 4)))


@settings(max_examples=40, deadline=None)
@given(st.integers(3, 12), st.data())
def test_packings(sides: int, data: st.DataObject) -> None:
    """Triangulations made by putting vertices into triangles of a fan."""
    triangles = [(0, k, k + 1) for k in range(1, sides - 1)]
    for vertex in range(sides, sides + data.draw(st.integers(0, 12))):
        a, b, c = triangles.pop(data.draw(st.integers(0, len(triangles) - 1)))
        triangles += [(a, b, vertex), (b, c, vertex), (c, a, vertex)]
    centre, radius = circle_packing(triangles, list(range(sides)))
    distance, touching = np.abs(centre[:, None] - centre), radius[:, None] + radius
    edges = {pair for triangle in triangles for pair in combinations(sorted(triangle), 2)}
    for a, b in combinations(range(len(centre)), 2):
        if (a, b) in edges:
            assert distance[a, b] == pytest.approx(touching[a, b], rel=1e-5)
        else:
            assert distance[a, b] > (1 - 1e-5) * touching[a, b]
    for a, b, c in triangles:
        assert ((centre[b] - centre[a]).conjugate() * (centre[c] - centre[a])).imag > 0


@settings(max_examples=30, deadline=None)
@given(st.lists(st.integers(1, 3), min_size=2, max_size=4), st.data())
def test_layers(sizes: list[int], data: st.DataObject) -> None:
    layers = [[(k, j) for j in range(size)] for k, size in enumerate(sizes)]
    edges = [
        (a, b)
        for low, high in pairwise(layers)
        for a in low
        for b in high
        if data.draw(st.booleans())
    ]
    room = {v: data.draw(st.sampled_from([0.5, 1.0])) for layer in layers for v in layer}
    place = layered(layers, edges, room)

    def crossings(up: dict[tuple[int, int], float]) -> int:
        return sum(
            a[0] == c[0] and (up[a] - up[c]) * (up[b] - up[d]) < 0
            for (a, b), (c, d) in combinations(edges, 2)
        )

    orders = [sorted(layer, key=place.__getitem__) for layer in layers]
    for order in orders:
        for a, b in pairwise(order):
            assert place[b] - place[a] > (room[a] + room[b]) / 2 - 1e-9
    if len(layers) == 2:
        for other in permutations(orders[1]):  # no other order is better
            exchanged = {v: place[u] for v, u in zip(other, orders[1], strict=True)}
            assert crossings(place) <= crossings(place | exchanged)
    # The places are those of the quadratic program, solved as one: lowest places and gaps.
    column = {v: k for k, v in enumerate(v for order in orders for v in order)}
    part, base = np.zeros((len(column), len(column))), np.zeros(len(column))
    low = np.zeros(len(column))
    for order in orders:
        low[column[order[0]]] = -np.inf
        for a, b in pairwise(order):
            base[column[b]] = base[column[a]] + (room[a] + room[b]) / 2
        for k, v in enumerate(order):
            part[column[v], column[order[0]] : column[order[0]] + k + 1] = 1
    rows = [part[column[b]] - part[column[a]] for a, b in edges] + list(0.1 * part)
    wanted = [base[column[a]] - base[column[b]] for a, b in edges] + list(-0.1 * base)
    solved = lsq_linear(np.array(rows), np.array(wanted), (low, np.inf), method="bvls", tol=1e-14)
    expected = base + part @ solved.x
    assert [place[v] for v in column] == pytest.approx(expected.tolist(), abs=0.02)


def box(middle: tuple[float, float], wide: float, high: float) -> shapely.Polygon:
    (x, y) = middle
    return shapely.box(x - wide / 2, y - high / 2, x + wide / 2, y + high / 2)


def laid(graph: PlanGraph) -> Layout:
    return laid_out(graph.start, joined_states(graph, None))


@pytest.mark.parametrize("knot", ["3_1", "4_1", "5_1", "7_1", "8_19"])
def test_nothing_lies_on_anything_else(knot: str) -> None:
    layout = laid(plans_to(knot))
    frames = {state: box(at, layout.side, layout.side) for state, at in layout.place.items()}
    for a, b in combinations(frames.values(), 2):
        assert not a.intersects(b)
    labels = [box((label.x, label.y), label.width, label.height) for label in layout.labels]
    for a, b in combinations(labels, 2):
        assert a.intersection(b).area < 1e-9
    for label in labels:
        assert not any(label.intersection(frame).area > 1e-9 for frame in frames.values())
    for (before, after), points in layout.lines.items():
        line = shapely.LineString(points)
        for state, frame in frames.items():
            inside = line.intersection(frame.buffer(-1e-6)).length
            assert inside == 0, (state, before, after)
        assert frames[before].distance(shapely.Point(points[0])) < 1e-9
        assert frames[after].distance(shapely.Point(points[-1])) < 1e-9
        assert (np.diff(points[:, 0]) > 0).all(), "from left to right"


@pytest.mark.parametrize("knot", ["3_1", "4_1", "5_1", "7_1"])
def test_the_figure_shows_every_state_and_action(knot: str) -> None:
    graph = plans_to(knot)
    figure = plan_figure(graph)
    (axes,) = figure.axes
    frames = [patch for patch in axes.patches if isinstance(patch, FancyBboxPatch)]
    assert len(frames) == len(graph.states) == len(axes.collections)
    assert sum(frame.get_linewidth() >= 1 for frame in frames) == len(graph.goals)
    words = [text.get_text() for text in axes.texts]
    actions = [str(action) for steps in graph.steps.values() for action, _ in steps]
    columns = graph.goals[0].crossings + 1
    assert sorted(words[: -columns - 1]) == sorted(actions)
    assert words[-1] == f"{graph.plan_count} plans, {len(graph.states)} states"
    arrows = [patch for patch in axes.patches if isinstance(patch, FancyArrowPatch)]
    kinds = {(a, type(x), b) for a, steps in graph.steps.items() for x, b in steps}
    assert len(arrows) == len(kinds)
    assert len(figure.legends[0].get_texts()) == len({kind for _, kind, _ in kinds}) + 1


def test_labels_of_one_pair_of_states_stand_together() -> None:
    """An R1 before a loop and one behind it give the same state."""
    graph = plan_graph(RopeState.from_gauss("U1+ O1+ U2+ O2+"))
    several = [label for label in laid(graph).labels if len(label.actions) > 1]
    assert [set(map(str, label.actions)) for label in several] == [{"R1(0,1,1)", "R1(2,1,1)"}]
    texts = [text.get_text() for text in plan_figure(graph).axes[0].texts]
    assert {"R1(0,1,1)", "R1(2,1,1)"} <= set(texts)


def test_large_graphs_have_no_labels() -> None:
    graph = plans_to("8_19")
    assert len(joined_states(graph, None)) > 40
    texts = [text.get_text() for text in plan_figure(graph, title="eight").axes[0].texts]
    assert texts == ["0 crossings", "1 crossing", *(f"{n} crossings" for n in range(2, 9)), "eight"]


def test_some_of_the_plans() -> None:
    graph = plans_to("5_1")
    for count in (1, 2, 99):
        joined = joined_states(graph, count)
        wanted = {
            (before, after, action)
            for plan in graph.plans(count)
            for before, action, after in zip(
                plan.states, plan.actions, plan.states[1:], strict=False
            )
        }
        assert {(a, b, x) for (a, b), xs in joined.items() for x in xs} == wanted
    words = plan_figure(graph, plans=1).axes[0].texts[-1].get_text()
    assert words == "1 of 16 plans, 6 states"


def test_figures_without_plans_and_with_the_shortest() -> None:
    unreachable = plan_graph(TRIVIAL, start=states_with(1)[0])
    for graph, plans in ((unreachable, None), (plans_to("3_1"), 0)):
        with pytest.raises(KnotoptError, match="no plan to draw"):
            plan_figure(graph, plans)
    figure = plan_figure(
        plan_graph(TRIVIAL), title="a title that is wider than the one state of it"
    )
    assert len(figure.axes[0].collections) == 1
    title = "a title that is wider than the one state of it"
    assert figure.get_figwidth() > text_width(title, 9)
    start = states_with(1)[0]
    goals = [after for action, after in successors(start) if isinstance(action, R1)][:2]
    figure = plan_figure(plan_graph(goals, start=start))
    assert [text.get_text() for text in figure.axes[0].texts][-3:-1] == [
        "1 crossing",
        "2 crossings",
    ]


def test_the_same_plans_give_the_same_bytes() -> None:
    graph = plans_to("4_1")
    pictures = []
    for _ in range(2):
        rope_curve.cache_clear()
        pictures.append([figure_bytes(plan_figure(graph), kind) for kind in ("png", "svg")])
    assert pictures[0] == pictures[1]


def test_r2_lines_pass_between_the_states() -> None:
    state = next(
        after
        for action, after in successors(TRIVIAL)
        if isinstance(action, R2) and action in set(legal_actions(TRIVIAL))
    )
    graph = plan_graph(state)
    layout = laid(graph)
    line = layout.lines[TRIVIAL, state]
    assert len(line) == 4 and line[1, 1] == line[2, 1]
    assert line[1, 0] < layout.columns[1] < line[2, 0]
